"""The digest of a run's inputs: equal digests mean that a result is up to date.

Digests are made of what the user decided, not of what was computed from it: that goes through a file
bit by bit, where a sine may differ in its last bit from one computer to the next. Names, locks and
what is switched off are left out, for they change no result.
"""

from __future__ import annotations

import hashlib
from dataclasses import asdict
from functools import lru_cache

import numpy as np

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.plan.traced_line import Trace
from bobdesk.project.project import Project, SourceLine
from bobdesk.project.runs import InputsDigest
from bobdesk.solve.settings import PUBLISHED_THRESHOLD

_LENGTH = 16
_ON_THE_PUBLISHED_OBJECTIVE = ("published", "lbfgsb", "slsqp", "trustconstr", "de")


def inputs_digest(project: Project) -> InputsDigest:
    """Return the digests of all that a run of this project would depend on."""
    return InputsDigest(
        plan=_digest(_line(project.trace, project.source), _extent(project), _scale(project)),
        fit=_digest(_numbers(asdict(project.fit))),
        segments=_segments(project),
        targets=_targets(project),
        solver=_solver(project),
    )


def _line(trace: Trace | None, source: SourceLine | None) -> str:
    if source is not None:
        return _of_array(_Held(source.polyline.vertices))
    return "" if trace is None else _of_array(_Held(trace.points))


class _Held:
    """An array that is hashed by its identity, and kept while its digest is."""

    def __init__(self, array: FloatArray) -> None:
        self.array = array

    def __hash__(self) -> int:
        return id(self.array)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Held) and other.array is self.array


@lru_cache(maxsize=8)
def _of_array(held: _Held) -> str:
    return hashlib.sha256(np.ascontiguousarray(held.array, dtype="<f8").tobytes()).hexdigest()


def _extent(project: Project) -> object:
    extent = project.extent
    sideways = 0.0 if extent.digitised == "centre" else extent.offset
    return (_number(extent.start), _number(extent.end), extent.digitised if sideways else "", _number(sideways))


def _scale(project: Project) -> object:
    choice = project.calibration
    if project.source is not None:
        return ("metres", choice.way == "unknown")
    if choice.way == "scale":
        return (choice.way, _number(choice.metres_per_pixel))
    picture = project.picture
    if choice.way == "drawing scale":
        dpi = () if picture is None or picture.file_dpi is None else picture.file_dpi
        return (choice.way, _number(choice.one_to), *map(_number, dpi))
    if choice.way == "world":
        world = () if picture is None or picture.world is None else picture.world.coefficients
        return (choice.way, *map(_number, world))
    if choice.way == "unknown":
        return choice.way
    points = [
        tuple(map(_number, (point.x_px, point.y_px, point.x_m, point.y_m)))
        for point in project.control_points
        if point.used
    ]
    distances = [
        tuple(map(_number, (*known.start_px, *known.end_px, known.length_m)))
        for known in project.known_distances
        if known.used
    ]
    return (choice.way, points, distances)


def _segments(project: Project) -> str:
    if project.segments is None:
        return _digest("automatic", _numbers(asdict(project.segmentation)))
    return _digest(of_segments(project.segments))


def of_segments(segments: Segments) -> object:
    """Return what of segments counts for a result."""
    return [(segment.kind, _number(segment.start), _number(segment.end)) for segment in segments]


def _targets(project: Project) -> str:
    chosen = asdict(project.targets)
    del chosen["name"]
    if chosen["mean_gradient"] is None:
        del chosen["mean_gradient_is"]
    limits = asdict(project.limits)
    # The band alone depends on it.
    del limits["gradient_change"]
    known = sorted(
        (_number(item.station) or "", _number(item.elevation) or "", _number(item.tolerance) or "")
        for item in project.known_elevations
    )
    return _digest(_numbers(chosen), _numbers(limits), known)


def _solver(project: Project) -> str:
    settings = project.solver
    if settings.method == "pgd":
        return _digest(settings.method, _numbers(asdict(settings.pgd)))
    weights = _numbers(asdict(settings.weights))
    if settings.method == "published":
        # Usual values are left out, so that files from before there were other ones stay up to date.
        others = [_number(settings.rate)] if settings.rate is not None else []
        others += [_number(settings.threshold)] if settings.threshold != PUBLISHED_THRESHOLD else []
        return _digest(settings.method, weights, *others)
    if settings.method in _ON_THE_PUBLISHED_OBJECTIVE:
        return _digest(settings.method, weights)
    # What a plug-in looks at is its own affair.
    return _digest(settings.method, weights, _numbers(asdict(settings.pgd)), _number(settings.rate))


def _numbers(values: dict[str, object]) -> object:
    return sorted((name, _number(value) if isinstance(value, int | float) else value) for name, value in values.items())


def _number(value: float | None) -> str | None:
    """Return a number as text that is the same for equal numbers: 1, 1.0 and True, 0.0 and -0.0."""
    return None if value is None else repr(float(value) + 0.0)


def _digest(*parts: object) -> str:
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:_LENGTH]
