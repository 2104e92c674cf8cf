"""What follows from a finished run: its line, its deviations, and whether it is out of date.

Whatever needs scipy is imported where it is called: the window shows a project before that is loaded.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.plan.projection import Georeference
from bobdesk.project import derive
from bobdesk.project.digest import inputs_digest, of_segments
from bobdesk.project.layout import Layout
from bobdesk.project.project import ActualTrack, Project
from bobdesk.project.runs import Run
from bobdesk.sentences import listed
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import Envelope, envelope
from bobdesk.solve.iterates import Solution
from bobdesk.solve.warm_start import WarmStart
from bobdesk.track.comparison import Comparison, compare
from bobdesk.track.figures import Deviations, deviations

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline
    from bobdesk.solve.profile import Profile
    from bobdesk.track.centreline3d import Centreline3D

_SAME_SCALE = 1e-12


def why_out_of_date(project: Project, run: Run) -> str | None:
    """Return what has changed since a run, in words, or None if it is up to date."""
    now = inputs_digest(project)
    changed = [
        words
        for name, words in (
            ("plan", "the line in plan or its scale"),
            ("fit", "spacing or smoothing"),
            ("segments", "the segments"),
            ("targets", "targets, limits or known elevations"),
            ("solver", "the solver's settings"),
        )
        if getattr(now, name) != getattr(run.digest, name) and not (name == "segments" and _same_segments(project, run))
    ]
    if not changed:
        return None
    return f"{listed(changed)} changed since this run"


def _same_segments(project: Project, run: Run) -> bool:
    """Return whether segments that are kept by hand are still those that the run found automatically."""
    return project.segments is not None and of_segments(project.segments) == of_segments(run.inputs.segments)


def warm_start(project: Project) -> WarmStart | None:
    """Return where a run begins: at the gradients of the run that is shown, once that is out of date.

    A run whose inputs have not changed is made again from the beginning, to the same numbers.
    """
    run = project.run
    if run is None or why_out_of_date(project, run) is None:
        return None
    return WarmStart(run.layout.edges / run.layout.edges[-1], run.gradients)


def run_centreline(run: Run) -> Centreline:
    """Return the centreline that a run was made on."""
    from bobdesk.alignment.centreline import fit_centreline

    return fit_centreline(run.inputs.polyline, run.inputs.fit)


@lru_cache(maxsize=16)
def run_solution(run: Run) -> Solution:
    """Return a run's end as the solver returned it."""
    return Solution(
        method=run.inputs.settings.method,
        profile=_profile(run, run.layout),
        gradients=run.gradients,
        edge_gradients=run.edge_gradients,
        scale=run.scale,
        start_elevation=run.start_elevation,
        status=run.status,
        message=run.message,
        nit=run.nit,
        nfev=run.nfev,
        njev=run.njev,
        objective=float("nan") if run.objective is None else run.objective,
        optimality=float("nan") if run.optimality is None else run.optimality,
    )


@lru_cache(maxsize=16)
def _profile(run: Run, layout: Layout) -> Profile:
    from bobdesk.solve.profile import Profile, profile_rows

    breaks = layout.edges[1:-1][layout.held].tolist()
    stations, points, bends = profile_rows(run_centreline(run), breaks)
    return Profile(stations, points, layout.edges, layout.segment_of, layout.half_transitions, layout.held, bends)


def iterate_line(run: Run, row: int) -> Centreline3D:
    """Return the 3D line of an iterate that a run has kept, in true size.

    Raises
    ------
    IndexError
        If it has kept none, or not so many.
    """
    from bobdesk.track.centreline3d import make_centreline3d

    kept = run.iterates
    if kept is None or not 0 <= row < len(kept.table):
        raise IndexError("there is no such iterate")
    index = kept.layout_of(row)
    solution = replace(
        run_solution(run),
        profile=_profile(run, kept.layouts[index]),
        gradients=kept.gradients_of(row),
        edge_gradients=kept.edge_gradients[index],
        scale=kept.scale_of(row),
    )
    return make_centreline3d(run_centreline(run), run.inputs.segments, solution)


@lru_cache(maxsize=16)
def run_line(run: Run, spacing: float | None = None) -> Centreline3D:
    """Return a run's 3D line, in true size.

    Parameters
    ----------
    spacing
        Of the rows in plan, m; None for the rows that were solved for. Known elevations keep their rows.
    """
    from bobdesk.track.centreline3d import make_centreline3d

    solution = run_solution(run)
    line = run_centreline(run)
    if spacing is not None:
        solution = replace(solution, profile=_spaced(run, line, solution.profile, spacing / run.scale))
    return make_centreline3d(line, run.inputs.segments, solution)


def _spaced(run: Run, line: Centreline, profile: Profile, spacing: float) -> Profile:
    """Return a profile with rows at another distance: the same pieces, so that its falls stay exact."""
    from bobdesk.alignment.centreline import at_stations
    from bobdesk.solve.profile import row_stations

    breaks = run.layout.edges[1:-1][run.layout.held].tolist()
    stations = row_stations(line.length, spacing, breaks)
    bends = np.interp(stations, profile.stations, profile.curvature)
    return replace(profile, stations=stations, points=at_stations(line, stations), curvature=bends)


def run_georeference(project: Project, run: Run) -> Georeference | None:
    """Return where the origin of a run's line lies on the Earth, or None if nothing says so.

    A run on another plan than the project's present one, or one that found a scale, does not lie there.
    """
    if inputs_digest(project).plan != run.digest.plan or abs(run.inputs.factor * run.scale - 1) > _SAME_SCALE:
        return None
    return derive.georeference(project)


def run_deviations(run: Run) -> Deviations:
    """Return a run's figures less its targets, %."""
    return deviations(run.figures, run.inputs.targets)


@lru_cache(maxsize=8)
def run_envelope(run: Run) -> Envelope:
    """Return the band that every profile within a run's limits and known elevations lies in.

    Raises
    ------
    TargetError
        If no profile meets them all.
    """
    anchors = anchors_of(run.inputs.targets, run_centreline(run).length)
    rows = run_solution(run).profile.stations
    return envelope(rows, anchors, run.inputs.targets, scale=run.scale)


def run_comparison(project: Project, run: Run) -> Comparison | None:
    """Return a run's line beside the actual track, where there is one."""
    return None if project.actual is None else _comparison(run, project.actual)


@lru_cache(maxsize=16)
def _comparison(run: Run, actual: ActualTrack) -> Comparison:
    return compare(run_line(run).points, actual.points)
