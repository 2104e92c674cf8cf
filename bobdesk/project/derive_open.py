"""What the data of a project leave open: jobs that a thread pulls, since each takes longer than a frame.

Whatever needs scipy is imported where it is called: the window shows a project before that is loaded.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import InputError
from bobdesk.progress import Progress
from bobdesk.project import derive
from bobdesk.project.derive_runs import run_line, why_out_of_date
from bobdesk.project.project import Project
from bobdesk.project.runs import RunInputs
from bobdesk.solve.anchors import Anchors, anchors_of
from bobdesk.solve.envelope import GRID, Envelope, envelope, smooth_envelope

if TYPE_CHECKING:
    from bobdesk.solve.next_elevation import NextElevation
    from bobdesk.solve.profile_sampling import Bundle
    from bobdesk.track.error_budget import ErrorBudget
    from bobdesk.track.input_errors import InputErrors

_SPACING = 2.0
_MOST_STATIONS = 4000
# Cells of smooth bands and of random profiles, which must lie on one grid to be comparable.
_MOST_CELLS = 150
# Profiles that quantiles are made of; and the seed, so that the same data always look the same.
_PROFILES, _SEED = 200, 1


@dataclass(frozen=True, eq=False)
class OpenBand:
    """The band of all elevations that the data allow.

    Attributes
    ----------
    shares : (n,)
        Stations as shares of the line, 0 to 1, so that a line of another scale can be laid over it.
    lowest, highest : (n,)
        m.
    length
        Of the plan in true size, m.
    """

    shares: FloatArray
    lowest: FloatArray
    highest: FloatArray
    length: float

    def __post_init__(self) -> None:
        for name in ("shares", "lowest", "highest"):
            object.__setattr__(self, name, frozen(getattr(self, name)))


@dataclass(frozen=True, eq=False)
class OpenProfiles:
    """Profiles drawn at random among all that the data allow.

    Attributes
    ----------
    shares : (n,)
        Stations as shares of the line.
    elevations : (c, n)
        Of c profiles, m.
    gradients : (c, n - 1)
        Between each two stations.
    """

    shares: FloatArray
    elevations: FloatArray
    gradients: FloatArray

    def __post_init__(self) -> None:
        for name in ("shares", "elevations", "gradients"):
            object.__setattr__(self, name, frozen(getattr(self, name)))


@dataclass(frozen=True, eq=False)
class _Case:
    inputs: RunInputs
    anchors: Anchors
    length: float
    scale: float

    @property
    def step(self) -> float:
        """Of the grid, m in true size."""
        return max(GRID, self.scale * self.length / _MOST_CELLS)


def open_band(project: Project) -> Generator[Progress, None, OpenBand]:
    """Return the band of the targets, limits and known elevations as they are now.

    Raises
    ------
    InputError, TargetError
        If there is none: something is missing, or no profile meets all.
    """
    yield Progress(0.0, "the band")
    case = _case(project)
    change = project.limits.gradient_change
    found: Envelope
    if change is None:
        count = min(_MOST_STATIONS, max(2, round(case.length / _SPACING)))
        at = np.linspace(0.0, case.length, count + 1)
        # The faces of the band have their corners anywhere, but known elevations must be met.
        at = np.union1d(at, [item.station for item in case.anchors])
        found = envelope(at, case.anchors, case.inputs.targets, scale=case.scale)
    else:
        found = yield from smooth_envelope(
            case.anchors, case.inputs.targets, largest_change=change, scale=case.scale, step=case.step
        )
    length = float(found.stations[-1])
    return OpenBand(found.stations / length, found.lowest, found.highest, length)


def open_profiles(project: Project) -> Generator[Progress, None, OpenProfiles]:
    """Return profiles at random of the targets, limits and known elevations as they are now.

    Raises
    ------
    InputError, TargetError
        If there are none.
    """
    from bobdesk.solve.profile_sampling import sample_profiles

    yield Progress(0.0, "profiles at random")
    case = _case(project)
    found: Bundle = yield from sample_profiles(
        case.anchors,
        case.inputs.targets,
        count=_PROFILES,
        seed=_SEED,
        largest_change=project.limits.gradient_change,
        scale=case.scale,
        step=case.step,
    )
    at = found.stations
    return OpenProfiles(at / at[-1], found.elevations, -np.diff(found.elevations, axis=1) / np.diff(at))


def advice(project: Project) -> Generator[Progress, None, NextElevation]:
    """Return where one more known elevation would help most.

    Raises
    ------
    InputError, TargetError
        If there is no such place.
    """
    from bobdesk.solve.next_elevation import next_elevation

    yield Progress(0.0, "where one more elevation helps")
    case = _case(project)
    run, estimate = project.run, None
    if run is not None and why_out_of_date(project, run) is None:
        line = run_line(run)
        estimate = (line.stations, line.elevations)
    return (
        yield from next_elevation(
            case.anchors,
            case.inputs.targets,
            estimate=estimate,
            largest_change=project.limits.gradient_change,
            scale=case.scale,
        )
    )


def own_station(project: Project, found: NextElevation) -> float:
    """Return the advised station as a project's known elevations count it, in the plan's own scale, m."""
    return found.station / (scale_now(project) * derive.plan_factor(project))


def scale_now(project: Project) -> float:
    """Return the scale factor on the working plan: that of a result that is up to date, else 1."""
    run = project.run
    if derive.scale_is_known(project) or run is None or why_out_of_date(project, run) is not None:
        return 1.0
    return run.scale


def errors_of_inputs(project: Project) -> InputErrors:
    """Return how sure the figures are that a result of this project begins with.

    Raises
    ------
    InputError
        If something is missing for a result.
    """
    from bobdesk.track.input_errors import input_errors

    inputs = derive.run_inputs(project).needed()
    return input_errors(
        derive.centreline(project).needed(),
        derive.targets(project).needed(),
        vertices=len(inputs.polyline.vertices),
        wavelength=project.fit.wavelength,
        scale=derive.scale_error(project),
    )


def budget(project: Project) -> Generator[Progress, None, ErrorBudget]:
    """Return the error budget of the project as it is now, the one that `bobdesk reconstruct` writes.

    Raises
    ------
    InputError, TargetError
        If there is none.
    """
    from bobdesk.track.error_budget import error_budget

    yield Progress(0.0, "the error budget")
    if project.solver.method != "pgd":
        raise InputError("the error budget goes with the recommended method alone")
    inputs = derive.run_inputs(project).needed()
    errors = errors_of_inputs(project)
    line = derive.centreline(project).needed()
    return (yield from error_budget(line, inputs.segments, inputs.targets, errors, project.solver.pgd))


def _case(project: Project) -> _Case:
    inputs = derive.run_inputs(project).needed()
    length = derive.centreline(project).needed().length
    anchors = anchors_of(inputs.targets, length)
    return _Case(inputs, anchors, length, scale_now(project))
