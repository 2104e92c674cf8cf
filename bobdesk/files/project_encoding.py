"""A project becomes `project.json` and the blobs beside it: the picture, and tables of numbers."""

from __future__ import annotations

import hashlib
import math
import types
import typing
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any, TypeVar

import msgspec
import numpy as np

from bobdesk.alignment.design import DesignList
from bobdesk.errors import InputError
from bobdesk.files import project_schema as schema
from bobdesk.files.npy import npy_bytes
from bobdesk.plan.polyline import Polyline
from bobdesk.plan.traced_line import Trace
from bobdesk.project.kept_iterates import KeptIterates
from bobdesk.project.layout import Layout
from bobdesk.project.project import ActualTrack, Picture, Project, SourceLine
from bobdesk.project.runs import Run, RunInputs
from bobdesk.solve.settings import SolverSettings

Entry = TypeVar("Entry", bound=msgspec.Struct)
PICTURE = "picture"
_DIGITS = 24


@dataclass(frozen=True, eq=False)
class Encoded:
    """A project as bytes: the document, and what it refers to by name, in the order of the file."""

    document: bytes
    blobs: dict[str, bytes]


def encode_project(project: Project) -> Encoded:
    """Return a project as bytes; the same project gives the same bytes.

    Raises
    ------
    InputError
        If a number in it is not finite, which no edit lets in.
    """
    tables: dict[str, bytes] = {}
    for run in project.runs:
        tables.update((_table_of(run.inputs.polyline), _history_of(run)))
        if run.iterates is not None:
            tables.update((_iterates_of(run.iterates),))
    blobs = {} if project.picture is None else {PICTURE: project.picture.data}
    blobs.update((name, tables[name]) for name in sorted(tables))
    return Encoded(msgspec.json.encode(_document(project)), blobs)


def _document(project: Project) -> schema.Document:
    source, segments, actual = project.source, project.segments, project.actual
    return _entry(
        schema.Document,
        project,
        format=schema.FORMAT,
        version=schema.VERSION,
        picture=None if project.picture is None else _picture(project.picture),
        control_points=_entries(schema.PointEntry, project.control_points),
        known_distances=_entries(schema.DistanceEntry, project.known_distances),
        check_distances=_entries(schema.DistanceEntry, project.check_distances),
        calibration=_entry(schema.CalibrationEntry, project.calibration),
        trace=None if project.trace is None else _trace(project.trace),
        source=None if source is None else _source(source),
        extent=_entry(schema.ExtentEntry, project.extent),
        fit=_entry(schema.FitEntry, project.fit),
        segmentation=_entry(schema.SegmentationEntry, project.segmentation),
        segments=None if segments is None else _entries(schema.SegmentEntry, segments),
        target_sets=_entries(schema.TargetSetEntry, project.target_sets),
        limits=_entry(schema.LimitsEntry, project.limits),
        known_elevations=_entries(schema.KnownEntry, project.known_elevations),
        solver=_solver(project.solver),
        runs=[_run(run) for run in project.runs],
        actual=None if actual is None else _actual(actual),
        export=_entry(schema.ExportEntry, project.export),
        rules=None if project.rules is None else _entries(schema.RuleEntry, project.rules),
        sled=_entry(schema.SledEntry, project.sled),
        design=None if project.design is None else _design(project.design),
    )


def _picture(picture: Picture) -> schema.PictureEntry:
    return _entry(schema.PictureEntry, picture, world=None if picture.world is None else picture.world.coefficients)


@lru_cache(maxsize=4)
def _trace(trace: Trace) -> schema.TraceEntry:
    return _entry(
        schema.TraceEntry,
        trace,
        points=_rows(trace.points),
        confidence=_rows(trace.confidence),
        warnings=list(trace.warnings),
        suspect=trace.suspect.tolist(),
    )


@lru_cache(maxsize=4)
def _source(source: SourceLine) -> schema.SourceEntry:
    return _entry(schema.SourceEntry, source, points=_rows(source.polyline.vertices))


@lru_cache(maxsize=4)
def _actual(actual: ActualTrack) -> schema.ActualEntry:
    return _entry(schema.ActualEntry, actual, points=_rows(actual.points))


def _design(design: DesignList) -> schema.DesignEntry:
    return _entry(schema.DesignEntry, design, curves=_entries(schema.DesignCurveEntry, design.curves))


def _solver(settings: SolverSettings) -> schema.SolverEntry:
    return _entry(
        schema.SolverEntry,
        settings,
        pgd=_entry(schema.PgdEntry, settings.pgd),
        weights=_entry(schema.WeightsEntry, settings.weights),
        rate=settings.rate,
        threshold=settings.threshold,
    )


@lru_cache(maxsize=64)
def _run(run: Run) -> schema.RunEntry:
    return _entry(
        schema.RunEntry,
        run,
        digest=_entry(schema.DigestEntry, run.digest),
        inputs=_inputs(run.inputs),
        layout=_layout(run.layout),
        gradients=_rows(run.gradients),
        edge_gradients=_rows(run.edge_gradients),
        figures=_entry(schema.FiguresEntry, run.figures),
        stages=list(run.stages),
        history=_history_of(run)[0],
        iterates=None if run.iterates is None else _iterates(run.iterates),
    )


def _layout(layout: Layout) -> schema.LayoutEntry:
    return _entry(
        schema.LayoutEntry,
        layout,
        edges=_rows(layout.edges),
        segment_of=layout.segment_of.tolist(),
        half_transitions=_rows(layout.half_transitions),
        held=layout.held.tolist(),
    )


def _iterates(kept: KeptIterates) -> schema.IteratesEntry:
    return schema.IteratesEntry(
        layouts=[_layout(layout) for layout in kept.layouts],
        edge_gradients=[_rows(gradients) for gradients in kept.edge_gradients],
        table=_iterates_of(kept)[0],
    )


def _inputs(inputs: RunInputs) -> schema.InputsEntry:
    targets = _entry(schema.TargetsEntry, inputs.targets, known=_entries(schema.KnownEntry, inputs.targets.known))
    return _entry(
        schema.InputsEntry,
        inputs,
        polyline=_table_of(inputs.polyline)[0],
        fit=_entry(schema.FitEntry, inputs.fit),
        segments=_entries(schema.SegmentEntry, inputs.segments),
        targets=targets,
        settings=_solver(inputs.settings),
    )


@lru_cache(maxsize=64)
def _table_of(polyline: Polyline) -> tuple[str, bytes]:
    return _named(npy_bytes(polyline.vertices))


@lru_cache(maxsize=64)
def _history_of(run: Run) -> tuple[str, bytes]:
    return _named(npy_bytes(run.history))


@lru_cache(maxsize=64)
def _iterates_of(kept: KeptIterates) -> tuple[str, bytes]:
    _rows(kept.table)
    return _named(npy_bytes(kept.table))


def _named(data: bytes) -> tuple[str, bytes]:
    """Name a table by its content, so that runs on one plan share it."""
    return f"tables/{hashlib.sha256(data).hexdigest()[:_DIGITS]}.npy", data


def _rows(array: np.ndarray[Any, Any]) -> Any:
    if not np.isfinite(array).all():
        raise InputError("the project holds a number that is not finite, and cannot be written")
    return array.tolist()


def _entries(kind: type[Entry], values: Iterable[object]) -> list[Entry]:
    return [_entry(kind, value) for value in values]


def _entry(kind: type[Entry], value: object, **given: Any) -> Entry:
    """Fill an entry from the attributes of the same names, with numbers as the entry has them."""
    fields = {
        name: given[name] if name in given else _plain(getattr(value, name), hint)
        for name, hint in _hints(kind).items()
    }
    return kind(**fields)


@cache
def _hints(kind: type[msgspec.Struct]) -> dict[str, Any]:
    return {name: _without_none(hint) for name, hint in typing.get_type_hints(kind).items()}


def _without_none(hint: Any) -> Any:
    if isinstance(hint, types.UnionType):
        return next(one for one in typing.get_args(hint) if one is not types.NoneType)
    return hint


def _plain(value: Any, hint: Any) -> Any:
    """Return a float where one is wanted (1 and 1.0 must be the same bytes), or refuse it."""
    if value is None:
        return None
    if hint is float:
        if not math.isfinite(value):
            raise InputError("the project holds a number that is not finite, and cannot be written")
        return float(value)
    if typing.get_origin(hint) is tuple:
        return tuple(_plain(part, of) for part, of in zip(value, typing.get_args(hint), strict=True))
    if isinstance(value, str):
        # A file's name may hold bytes that are no text.
        return value.encode("utf-8", "replace").decode()
    if isinstance(value, np.generic):
        return value.item()
    return value
