"""The project: everything that the user decided, and nothing that follows from it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from bobdesk.alignment.design import DesignList
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray, frozen
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.polyline import Polyline
from bobdesk.plan.traced_line import Trace
from bobdesk.plan.world import PixelToWorld
from bobdesk.project.runs import Run
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import (
    HIGHEST_GRADIENT,
    LOWEST_GRADIENT,
    KnownElevation,
    MeanGradientDefinition,
)
from bobdesk.track.design_rules import Rule
from bobdesk.track.sled import Sled

CalibrationWay = Literal["points", "scale", "drawing scale", "world", "unknown"]
DigitisedLine = Literal["centre", "left edge", "right edge"]


@dataclass(frozen=True, eq=False)
class Picture:
    """The plan picture as the user gave it.

    Attributes
    ----------
    data
        The file's bytes, untouched.
    name
        Of the file.
    page, dpi
        Which page is shown, and at which resolution pages (PDF, SVG) are drawn.
    size_px
        Width and height of what is shown, pixels.
    file_dpi
        What the file says of itself, None where it says nothing.
    world
        Position in metres by the file's own tags or by a world file that lay beside it.
    """

    data: bytes
    name: str
    page: int = 1
    dpi: float = 200.0
    size_px: tuple[int, int] | None = None
    file_dpi: tuple[float, float] | None = None
    world: PixelToWorld | None = None


@dataclass(frozen=True)
class CalibrationChoice:
    """How pixels become metres.

    Attributes
    ----------
    way
        "points": fitted to control points and known distances. "scale": metres per pixel as given.
        "drawing scale": 1 : `one_to` at the picture's own dpi. "world": by the picture's tags or world
        file. "unknown": nobody knows; the factor f is solved for.
    metres_per_pixel, one_to
        For the ways that need them; kept when another way is chosen.
    """

    way: CalibrationWay = "points"
    metres_per_pixel: float | None = None
    one_to: float | None = None


@dataclass(frozen=True, eq=False)
class SourceLine:
    """A plan that came from a file of coordinates instead of a picture.

    Attributes
    ----------
    name
        Of the file.
    polyline
        Its vertices, m.
    longitude, latitude
        Of the metres' origin, degrees, where the file was georeferenced (transverse Mercator about that
        point); None otherwise.
    """

    name: str
    polyline: Polyline
    longitude: float | None = None
    latitude: float | None = None


@dataclass(frozen=True)
class Extent:
    """Which part of the digitised line is the track, and on which side of it the centreline lies.

    Attributes
    ----------
    start, finish
        Distances along the digitised line, in pixels of a trace or metres of a source line; a finish of
        None is the line's end.
    cut_off
        Distance at which the final climb is cut off, or None to keep it.
    digitised
        Which line of the track was followed.
    offset
        From the digitised edge to the centreline, m.
    """

    start: float = 0.0
    finish: float | None = None
    cut_off: float | None = None
    digitised: DigitisedLine = "centre"
    offset: float = 0.0

    @property
    def end(self) -> float | None:
        """Where the track ends: at the finish or the cut, whichever comes first; None for the line's end."""
        ends = [end for end in (self.finish, self.cut_off) if end is not None]
        return min(ends) if ends else None


@dataclass(frozen=True)
class TargetSet:
    """The figures that one result must meet; a track with two start houses has two sets.

    Attributes
    ----------
    name
        What the user calls it, different from all others.
    length, drop
        m; None until the user has given them.
    mean_gradient, mean_gradient_is
        As in `bobdesk.solve.targets.Targets`.
    """

    name: str
    length: float | None = None
    drop: float | None = None
    mean_gradient: float | None = None
    mean_gradient_is: MeanGradientDefinition = "drop-per-length"


@dataclass(frozen=True)
class Limits:
    """Limits of the gradient, downhill positive.

    Attributes
    ----------
    min_gradient, max_gradient
        Of every result.
    gradient_change
        The largest change of the gradient per metre, 1/m, that the band of possible profiles reckons with; None for
        no limit. Results do not depend on it.
    """

    min_gradient: float = LOWEST_GRADIENT
    max_gradient: float = HIGHEST_GRADIENT
    gradient_change: float | None = None


@dataclass(frozen=True, eq=False)
class ActualTrack:
    """The track as it was measured, to compare with: points (n, 3), x y z, m, from start to end."""

    name: str
    points: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, columns=3))


@dataclass(frozen=True)
class ExportChoice:
    """How the result was exported last.

    Attributes
    ----------
    format, flavour
        Keys of a format, and of a flavour of tables.
    spacing
        Of the rows, m; None for the rows that were solved for.
    """

    format: str = "csv"
    flavour: str = "default"
    spacing: float | None = None


@dataclass(frozen=True, eq=False)
class Project:
    """All that the user decided; `bobdesk.project.derive` says what follows.

    Attributes
    ----------
    name, notes
        Free text.
    picture
        None for a plan from coordinates, or before there is one.
    control_points, known_distances, calibration
        What the scale is made of, and how.
    check_distances
        Distances that take no part in the calibration.
    trace
        The digitised vertices, pixels.
    source
        Coordinates from a file; they go before a trace.
    extent
        Start, finish, cut, and which line was digitised.
    fit
        Spacing of the stations and smoothing.
    segmentation
        How segments are found.
    segments
        None while they are found automatically; else as the user left them. Their stations count in
        metres on the centreline that they were made for, and follow it in proportion when it changes.
    target_sets, chosen_targets
        At least one set, and the index of the one in force.
    limits, known_elevations, solver
        The rest of what a run needs.
    runs, chosen_run
        Finished runs, oldest first, and the index of the one that is shown, if any.
    actual
        The actual track for comparison.
    export
        How the result was exported last.
    plan_error
        1 sigma of the plan's scale as a share of it, as the user knows it; None for what the calibration says.
    rules, sled
        Design rules, None for those that come with BobDesk, and the sled that some are judged by.
    design
        The designer's list of curves that the segments are compared with.
    """

    name: str = ""
    notes: str = ""
    picture: Picture | None = None
    control_points: tuple[ControlPoint, ...] = ()
    known_distances: tuple[KnownDistance, ...] = ()
    check_distances: tuple[KnownDistance, ...] = ()
    calibration: CalibrationChoice = CalibrationChoice()
    trace: Trace | None = None
    source: SourceLine | None = None
    extent: Extent = Extent()
    fit: FitSettings = field(default_factory=FitSettings)
    segmentation: SegmentationSettings = field(default_factory=SegmentationSettings)
    segments: Segments | None = None
    target_sets: tuple[TargetSet, ...] = (TargetSet("Track"),)
    chosen_targets: int = 0
    limits: Limits = Limits()
    known_elevations: tuple[KnownElevation, ...] = ()
    solver: SolverSettings = field(default_factory=SolverSettings)
    runs: tuple[Run, ...] = ()
    chosen_run: int | None = None
    actual: ActualTrack | None = None
    export: ExportChoice = ExportChoice()
    plan_error: float | None = None
    rules: tuple[Rule, ...] | None = None
    sled: Sled = field(default_factory=Sled)
    design: DesignList | None = None

    @property
    def targets(self) -> TargetSet:
        """The target set in force."""
        return self.target_sets[self.chosen_targets]

    @property
    def run(self) -> Run | None:
        """The run that is shown."""
        return None if self.chosen_run is None else self.runs[self.chosen_run]
