"""The shape of `project.json`, version 1, apart from the types of the program.

A field that the program renames must not rename itself in the files that people keep: so each thing is
spelled out here, every field is required (a default stands only where the first files of this version had no
such field yet), and unknown ones are refused. A new version of the format
changes this file, adds a migration, and stores a file of its own in the tests.
"""

from __future__ import annotations

from typing import Literal

import msgspec

FORMAT = "bobdesk-project"
VERSION = 1

Pair = tuple[float, float]


class _Strict(msgspec.Struct, forbid_unknown_fields=True):
    pass


class PictureEntry(_Strict):
    """A Picture; its bytes are the entry `picture` of the file."""

    name: str
    page: int
    dpi: float
    size_px: tuple[int, int] | None
    file_dpi: Pair | None
    world: tuple[float, float, float, float, float, float] | None


class PointEntry(_Strict):
    """A ControlPoint."""

    x_px: float
    y_px: float
    x_m: float
    y_m: float
    name: str
    used: bool


class DistanceEntry(_Strict):
    """A KnownDistance."""

    start_px: Pair
    end_px: Pair
    length_m: float
    name: str
    used: bool


class CalibrationEntry(_Strict):
    """A CalibrationChoice."""

    way: Literal["points", "scale", "drawing scale", "world", "unknown"]
    metres_per_pixel: float | None
    one_to: float | None


class TraceEntry(_Strict):
    """A Trace."""

    points: list[Pair]
    confidence: list[float]
    line_width_px: float
    kind: Literal["single", "double", "dashed"]
    warnings: list[str]
    suspect: list[tuple[int, int]]


class SourceEntry(_Strict):
    """A SourceLine."""

    name: str
    points: list[Pair]
    longitude: float | None
    latitude: float | None


class ExtentEntry(_Strict):
    """An Extent."""

    start: float
    finish: float | None
    cut_off: float | None
    digitised: Literal["centre", "left edge", "right edge"]
    offset: float


class FitEntry(_Strict):
    """A FitSettings."""

    spacing: float
    wavelength: float


class SegmentationEntry(_Strict):
    """A SegmentationSettings."""

    threshold: float | None
    count: int | None
    change_cost: float
    shortest: float
    rule: Literal["recommended", "published"]
    curvature: Literal["fitted", "l1", "published"]


class SegmentEntry(_Strict):
    """A Segment."""

    kind: Literal["straight", "curve"]
    start: float
    end: float
    locked: bool
    name: str
    by_hand: bool = False


MeanIs = Literal["drop-per-length", "drop-per-plan", "segments"]


class TargetSetEntry(_Strict):
    """A TargetSet."""

    name: str
    length: float | None
    drop: float | None
    mean_gradient: float | None
    mean_gradient_is: MeanIs


class LimitsEntry(_Strict):
    """A Limits."""

    min_gradient: float
    max_gradient: float
    gradient_change: float | None = None


class KnownEntry(_Strict):
    """A KnownElevation."""

    station: float
    elevation: float
    tolerance: float


class PgdEntry(_Strict):
    """A PgdSettings."""

    meet_length: bool
    evenness: float
    plausible: float
    typical_swing: float
    transition: float
    level_out: float
    longest_piece: float
    longest_swing: float
    tolerance: float
    max_iterations: int


class WeightsEntry(_Strict):
    """A Weights."""

    length: float
    height: float
    curvature: float
    gradient: float


class SolverEntry(_Strict):
    """A SolverSettings."""

    method: str
    pgd: PgdEntry
    weights: WeightsEntry
    rate: float | None
    threshold: float = 1e-3


class DigestEntry(_Strict):
    """An InputsDigest."""

    plan: str
    fit: str
    segments: str
    targets: str
    solver: str


class TargetsEntry(_Strict):
    """A Targets."""

    length: float
    drop: float
    mean_gradient: float | None
    mean_gradient_is: MeanIs
    min_gradient: float
    max_gradient: float
    known: list[KnownEntry]
    unknown_scale: bool


class InputsEntry(_Strict):
    """A RunInputs; the polyline is the name of a table of x and y."""

    polyline: str
    factor: float
    fit: FitEntry
    segments: list[SegmentEntry]
    targets: TargetsEntry
    settings: SolverEntry


class LayoutEntry(_Strict):
    """A Layout."""

    edges: list[float]
    segment_of: list[int]
    half_transitions: list[float]
    held: list[bool]


class FiguresEntry(_Strict):
    """A Figures."""

    length: float
    drop: float
    plan_length: float
    mean_gradient_drop_per_length: float
    mean_gradient_drop_per_plan: float
    mean_gradient_segments: float
    max_gradient: float
    min_gradient: float
    mean_curvature_difference: float


class IteratesEntry(_Strict):
    """A KeptIterates; the table is the name of one."""

    layouts: list[LayoutEntry]
    edge_gradients: list[list[float]]
    table: str


class RunEntry(_Strict):
    """A Run; the history is the name of a table."""

    name: str
    digest: DigestEntry
    target_set: str
    inputs: InputsEntry
    layout: LayoutEntry
    gradients: list[float]
    edge_gradients: list[float]
    scale: float
    start_elevation: float
    status: int
    message: str
    nit: int
    nfev: int
    njev: int
    objective: float | None
    optimality: float | None
    figures: FiguresEntry
    seconds: float
    stages: list[str]
    history: str
    iterates: IteratesEntry | None = None


class ActualEntry(_Strict):
    """An ActualTrack."""

    name: str
    points: list[tuple[float, float, float]]


class ExportEntry(_Strict):
    """An ExportChoice."""

    format: str
    flavour: str
    spacing: float | None


class RuleEntry(_Strict):
    """A design Rule."""

    name: str
    quantity: Literal["length", "mean gradient", "gradient", "speed", "acceleration", "curves"]
    lowest: float | None
    highest: float | None
    start: float
    end: float | None
    source: str
    is_used: bool


class SledEntry(_Strict):
    """A Sled."""

    mass: float
    drag_area: float
    friction: float
    start_speed: float
    air_density: float


class DesignCurveEntry(_Strict):
    """A DesignCurve."""

    start: float
    length: float
    radius: float
    side: Literal["left", "right"] | None
    name: str


class DesignEntry(_Strict):
    """A DesignList."""

    name: str
    curves: list[DesignCurveEntry]
    offset: float


class Document(_Strict):
    """A Project."""

    format: Literal["bobdesk-project"]
    version: Literal[1]
    name: str
    notes: str
    picture: PictureEntry | None
    control_points: list[PointEntry]
    known_distances: list[DistanceEntry]
    check_distances: list[DistanceEntry]
    calibration: CalibrationEntry
    trace: TraceEntry | None
    source: SourceEntry | None
    extent: ExtentEntry
    fit: FitEntry
    segmentation: SegmentationEntry
    segments: list[SegmentEntry] | None
    target_sets: list[TargetSetEntry]
    chosen_targets: int
    limits: LimitsEntry
    known_elevations: list[KnownEntry]
    solver: SolverEntry
    runs: list[RunEntry]
    chosen_run: int | None
    actual: ActualEntry | None
    export: ExportEntry | None = None
    plan_error: float | None = None
    rules: list[RuleEntry] | None = None
    sled: SledEntry | None = None
    design: DesignEntry | None = None
