"""Solvers of other packages beside the built-in ones; whatever such a one does wrong is one sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.alignment.segments import Segments
from bobdesk.errors import InputError, SolverFaultError, TargetError
from bobdesk.files.plugins import Plugins, find_plugins
from bobdesk.solve.iterates import Iterate, Run, Solution
from bobdesk.solve.run import METHODS, SolverMethod, solve
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import Targets

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline

SOLVER_GROUP = "bobdesk.solvers"


def solver_methods() -> Plugins[SolverMethod]:
    """Return the methods of this program and of its plug-ins, and why a plug-in could not be used."""
    return find_plugins(SOLVER_GROUP, SolverMethod, built_in=METHODS)


def solve_with_plugins(centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
    """Start the solver of the settings, as `bobdesk.solve.run.solve` does, built in or not.

    Raises
    ------
    InputError
        Besides what `solve` raises: if a plug-in fails, or ends in something that is no solution.
    """
    return solve(centreline, segments, targets, settings, methods=watched_methods())


def watched_methods() -> tuple[SolverMethod, ...]:
    """Return the methods of this program and of its plug-ins, the latter under watch."""
    return tuple(
        method if method in METHODS else replace(method, solve=_Watched(method), solve_from=None, solve_asking=None)
        for method in solver_methods().formats
    )


class _Watched:
    """A plug-in's solver that lets nothing else through than iterates, a solution and the two errors."""

    def __init__(self, method: SolverMethod) -> None:
        self._method = method

    def __call__(self, centreline: Centreline, segments: Segments, targets: Targets, settings: SolverSettings) -> Run:
        run: Run | None = None
        while True:
            try:
                run = self._method.solve(centreline, segments, targets, settings) if run is None else run
                iterate = next(run)
            except StopIteration as end:
                return self._checked(end.value)
            except (InputError, TargetError):
                raise
            except Exception as error:
                said = " ".join(str(error).split())[:200]
                raise self._failed(f"{type(error).__name__}: {said}") from error
            if not isinstance(iterate, Iterate):
                raise self._failed(f"it yielded a {type(iterate).__name__}, not an Iterate")
            yield iterate

    def _checked(self, solution: object) -> Solution:
        if not isinstance(solution, Solution):
            raise self._failed(f"it returned a {type(solution).__name__}, not a Solution")
        pieces = len(solution.profile.edges) - 1
        shapes = (np.shape(solution.gradients), np.shape(solution.edge_gradients))
        if shapes != ((pieces,), (max(pieces - 1, 1),)):
            raise self._failed(f"it returned gradients of the shapes {shapes[0]} and {shapes[1]} for {pieces} pieces")
        numbers = [*solution.gradients, *solution.edge_gradients, solution.scale, solution.start_elevation]
        if not (np.isfinite(numbers).all() and solution.scale > 0):
            raise self._failed("it returned figures that are no numbers")
        return replace(solution, method=self._method.key)

    def _failed(self, why: str) -> SolverFaultError:
        return SolverFaultError(f"the plug-in for the method {self._method.title} failed: {why}")
