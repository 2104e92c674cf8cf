"""`project.json` and its blobs become a project again, or one sentence says why not."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import msgspec
import numpy as np

from bobdesk.alignment.design import MOST_CURVES, DesignCurve, DesignList
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segment, Segments, check_segments
from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files import project_schema as schema
from bobdesk.files.migrations import migrated
from bobdesk.files.npy import npy_table
from bobdesk.files.project_encoding import PICTURE, Encoded
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.polyline import Polyline, polyline_from_points
from bobdesk.plan.projection import is_place
from bobdesk.plan.trace_vertices import checked_vertices
from bobdesk.plan.traced_line import Trace
from bobdesk.plan.world import PixelToWorld
from bobdesk.project.kept_iterates import FIRST_GRADIENT, KeptIterates
from bobdesk.project.layout import Layout
from bobdesk.project.project import (
    ActualTrack,
    CalibrationChoice,
    ExportChoice,
    Extent,
    Limits,
    Picture,
    Project,
    SourceLine,
    TargetSet,
)
from bobdesk.project.record import MOST_KEPT
from bobdesk.project.runs import (
    HISTORY_COLUMNS,
    MOST_HISTORY_ROWS,
    InputsDigest,
    Run,
    RunInputs,
)
from bobdesk.solve.settings import PgdSettings, SolverSettings, Weights
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.design_rules import Rule, check_rule
from bobdesk.track.figures import Figures
from bobdesk.track.sled import Sled, check_sled

Blobs = Callable[[str], bytes]
Value = TypeVar("Value")
MOST_DOCUMENT_BYTES = 120_000_000
_MOST_VALUES = 8_000_000
_MOST_RUNS = 1000
_PIECES = "the pieces of a run do not fit together"


class _Head(msgspec.Struct):
    format: str
    version: int


# Made once, while nobody else can: two threads that have the same classes looked through for the first time, such as
# the one that opens a project and the one that looks at recent ones, end the program.
_HEADS = msgspec.json.Decoder(_Head)
_DOCUMENTS = msgspec.json.Decoder(schema.Document)


def decode_project(document: bytes, blobs: Blobs) -> Project:
    """Return the project of a document; `blobs` returns the bytes of a name, or raises KeyError.

    Raises
    ------
    InputError
        If it is no project, made by a newer BobDesk, damaged, or over a limit; the sentence goes on
        after "NAME: ".
    """
    if len(document) > MOST_DOCUMENT_BYTES or document.count(b",") > _MOST_VALUES:
        raise InputError("it holds more points than a project may")
    try:
        return _project(_document(document), _Tables(blobs))
    except msgspec.ValidationError as error:
        raise InputError(f"the project in it is damaged: {_lower(str(error))}") from error
    except msgspec.MsgspecError as error:
        raise InputError("the project in it is damaged: it is not JSON") from error
    except RecursionError:
        raise InputError("the project in it is damaged: it is nested too deeply") from None
    except KeyError as error:
        raise InputError(f"a part of the project is missing in it: {error.args[0]}") from error
    except (ValueError, IndexError, OverflowError) as error:
        raise InputError(f"the project in it is damaged: {_lower(str(error))}") from error


def checked(encoded: Encoded) -> Encoded:
    """Return an encoded project if it can be opened again; a millisecond, or half a second for a million points.

    Raises
    ------
    InputError
        If it cannot: a whole file must never be replaced by one that is lost.
    """
    try:
        decode_project(encoded.document, lambda name: encoded.blobs[name])
    except InputError as error:
        raise InputError(f"cannot be written, for it could not be opened again: {error}") from error
    return encoded


def _document(document: bytes) -> schema.Document:
    head = _HEADS.decode(document)
    if head.format != schema.FORMAT:
        raise InputError("this is not a BobDesk project")
    if head.version > schema.VERSION:
        raise InputError("this project was made by a newer BobDesk; update BobDesk to open it")
    if head.version < 1:
        raise InputError(f"there is no version {head.version} of BobDesk projects")
    if head.version == schema.VERSION:
        return _DOCUMENTS.decode(document)
    plain = msgspec.json.decode(document)
    return msgspec.convert(migrated(plain, to=schema.VERSION), type=schema.Document)


class _Tables:
    """The blobs, and the polylines that several runs share."""

    def __init__(self, blobs: Blobs) -> None:
        self.blobs = blobs
        self._polylines: dict[str, Polyline] = {}

    def polyline(self, name: str) -> Polyline:
        if name not in self._polylines:
            found, kept = polyline_from_points(npy_table(self.blobs(name), columns=2))
            self._polylines[name] = found
            if len(kept) < len(npy_table(self.blobs(name), columns=2)):
                raise ValueError("a run's plan has points twice")
        return self._polylines[name]


def _project(found: schema.Document, tables: _Tables) -> Project:
    if len(found.runs) > _MOST_RUNS:
        raise ValueError("it has more runs than a project may")
    names = [targets.name for targets in found.target_sets]
    if len(set(names)) < len(names) or not 0 <= found.chosen_targets < len(names):
        raise ValueError("its sets of targets contradict each other")
    if found.chosen_run is not None and not 0 <= found.chosen_run < len(found.runs):
        raise ValueError("the run that it shows is missing")
    source, actual = found.source, found.actual
    return Project(
        name=found.name,
        notes=found.notes,
        picture=None if found.picture is None else _picture(found.picture, tables.blobs),
        control_points=tuple(_built(ControlPoint, point) for point in found.control_points),
        known_distances=tuple(_built(KnownDistance, known) for known in found.known_distances),
        check_distances=tuple(_built(KnownDistance, known) for known in found.check_distances),
        calibration=_built(CalibrationChoice, found.calibration),
        trace=None if found.trace is None else _trace(found.trace),
        source=None if source is None else _source(source),
        extent=_built(Extent, found.extent),
        fit=_built(FitSettings, found.fit),
        segmentation=_built(SegmentationSettings, found.segmentation),
        segments=None if found.segments is None else _segments(found.segments),
        target_sets=tuple(_built(TargetSet, targets) for targets in found.target_sets),
        chosen_targets=found.chosen_targets,
        limits=_built(Limits, found.limits),
        known_elevations=tuple(_built(KnownElevation, known) for known in found.known_elevations),
        solver=_solver(found.solver),
        runs=tuple(_run(run, tables) for run in found.runs),
        chosen_run=found.chosen_run,
        actual=None if actual is None else ActualTrack(actual.name, np.array(actual.points).reshape(-1, 3)),
        design=None if found.design is None else _design(found.design),
        export=ExportChoice() if found.export is None else _built(ExportChoice, found.export),
        plan_error=found.plan_error,
        rules=None if found.rules is None else tuple(check_rule(_built(Rule, rule)) for rule in found.rules),
        sled=Sled() if found.sled is None else check_sled(_built(Sled, found.sled)),
    )


def _picture(found: schema.PictureEntry, blobs: Blobs) -> Picture:
    return _built(
        Picture, found, data=blobs(PICTURE), world=None if found.world is None else PixelToWorld(*found.world)
    )


def _trace(found: schema.TraceEntry) -> Trace:
    points = checked_vertices(found.points)
    sure = np.array(found.confidence, dtype=np.float64)
    suspect = np.array(found.suspect, dtype=np.int64).reshape(-1, 2)
    if len(points) < 2 or len(sure) != len(points) or not ((sure >= 0) & (sure <= 1)).all():
        raise ValueError("the points of the line and how sure they are do not fit together")
    if len(suspect) and (suspect.min() < 0 or suspect.max() >= len(points) or (suspect[:, 0] > suspect[:, 1]).any()):
        raise ValueError("a stretch of the line lies beyond its end")
    for array in (points, sure, suspect):
        array.flags.writeable = False
    return _built(Trace, found, points=points, confidence=sure, warnings=tuple(found.warnings), suspect=suspect)


def _source(found: schema.SourceEntry) -> SourceLine:
    points = np.array(found.points, dtype=np.float64).reshape(-1, 2)
    line, kept = polyline_from_points(points)
    if len(kept) < len(points):
        raise ValueError("the plan has points twice")
    place = (found.longitude, found.latitude)
    if place != (None, None) and not is_place(*place):
        raise ValueError("the place of the plan on the Earth makes no sense")
    return SourceLine(found.name, line, found.longitude, found.latitude)


def _segments(found: list[schema.SegmentEntry]) -> Segments:
    segments = tuple(_built(Segment, segment) for segment in found)
    return check_segments(segments, length=segments[-1].end if segments else 0.0)


def _design(found: schema.DesignEntry) -> DesignList:
    curves = tuple(_built(DesignCurve, curve) for curve in found.curves)
    if not 0 < len(curves) <= MOST_CURVES or any(not (curve.length > 0 and curve.radius > 0) for curve in curves):
        raise ValueError("the designer's list of curves makes no sense")
    return DesignList(found.name, curves, found.offset)


def _solver(found: schema.SolverEntry) -> SolverSettings:
    return SolverSettings(
        found.method, _built(PgdSettings, found.pgd), _built(Weights, found.weights), found.rate, found.threshold
    )


def _run(found: schema.RunEntry, tables: _Tables) -> Run:
    history = npy_table(tables.blobs(found.history), columns=len(HISTORY_COLUMNS))
    if len(history) > MOST_HISTORY_ROWS:
        raise ValueError("a run's history is longer than it may be")
    inputs = found.inputs
    segments = _segments(inputs.segments)
    layout = _layout(found.layout, found.edge_gradients, len(segments))
    if len(found.gradients) != len(layout.edges) - 1 or not found.scale > 0:
        raise ValueError(_PIECES)
    known = tuple(_built(KnownElevation, item) for item in inputs.targets.known)
    return _built(
        Run,
        found,
        digest=_built(InputsDigest, found.digest),
        inputs=RunInputs(
            polyline=tables.polyline(inputs.polyline),
            factor=inputs.factor,
            fit=_built(FitSettings, inputs.fit),
            segments=segments,
            targets=_built(Targets, inputs.targets, known=known),
            settings=_solver(inputs.settings),
        ),
        layout=layout,
        gradients=np.array(found.gradients),
        edge_gradients=np.array(found.edge_gradients),
        nit=_iterations(found.nit, history),
        figures=_built(Figures, found.figures),
        stages=tuple(found.stages),
        history=history,
        iterates=None if found.iterates is None else _iterates(found.iterates, len(segments), tables.blobs),
    )


def _iterations(nit: int, history: FloatArray) -> int:
    """Return the number of the last iterate: older files counted the one where a run begins as an iteration too."""
    return min(nit, int(history[-1, 0])) if len(history) and np.isfinite(history[-1, 0]) else nit


def _layout(found: schema.LayoutEntry, edge_gradients: list[float], segments: int) -> Layout:
    layout = Layout(
        np.array(found.edges), np.array(found.segment_of), np.array(found.half_transitions), np.array(found.held)
    )
    pieces = len(layout.edges) - 1
    inner = len(layout.half_transitions)
    fits = pieces >= 1 and len(layout.segment_of) == pieces
    fits = fits and inner == len(layout.held) == pieces - 1 and len(edge_gradients) == max(inner, 1)
    fits = (
        fits
        and bool((np.diff(layout.edges) > 0).all())
        and bool(((layout.segment_of >= 0) & (layout.segment_of < segments)).all())
    )
    if not fits:
        raise ValueError(_PIECES)
    return layout


def _iterates(found: schema.IteratesEntry, segments: int, blobs: Blobs) -> KeptIterates:
    if not 1 <= len(found.layouts) <= MOST_KEPT or len(found.layouts) != len(found.edge_gradients):
        raise ValueError(_PIECES)
    layouts = tuple(
        _layout(layout, gradients, segments)
        for layout, gradients in zip(found.layouts, found.edge_gradients, strict=True)
    )
    pieces = max(len(layout.edges) - 1 for layout in layouts)
    table = npy_table(blobs(found.table), columns=FIRST_GRADIENT + pieces)
    fits = 1 <= len(table) <= MOST_KEPT and bool(np.isfinite(table).all())
    fits = fits and bool((np.diff(table[:, 0]) > 0).all()) and bool((table[:, 2] > 0).all())
    if not fits or not np.isin(table[:, 1], np.arange(len(layouts))).all():
        raise ValueError("the iterates of a run do not fit together")
    return KeptIterates(layouts, tuple(np.array(gradients) for gradients in found.edge_gradients), table)


def _built(kind: Callable[..., Value], found: msgspec.Struct, **given: Any) -> Value:
    return kind(**(msgspec.structs.asdict(found) | given))


def _lower(text: str) -> str:
    return text[:1].lower() + text[1:].rstrip(".")
