"""The error budget: what each source of error does to plan length, scale, elevation and gradient."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segments import Segments, stretched
from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import TargetError
from bobdesk.progress import Progress, finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.openness import openness, swing_about_stretches
from bobdesk.solve.pgd import pgd
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.targets import Targets, in_scale
from bobdesk.track.centreline3d import Centreline3D, make_centreline3d
from bobdesk.track.input_errors import InputErrors

COVERED = 1.96
_SPREAD_OF_SWING = 0.5


@dataclass(frozen=True)
class Share:
    """What one source is worth: half widths of 95 % bands, m; elevation and gradient as RMS along the line."""

    source: str
    plan_length: float
    scale: float
    elevation: float
    gradient: float


@dataclass(frozen=True, eq=False)
class ErrorBudget:
    """All sources, and their sum.

    Attributes
    ----------
    line
        The result that the bands lie about.
    shares
        One a source; the last one is their sum, by squares.
    stations, elevation, gradient : (n,)
        m in true size; half widths of the 95 % bands, m and a number.
    sentence
        For a person.
    """

    line: Centreline3D
    shares: tuple[Share, ...]
    stations: FloatArray
    elevation: FloatArray
    gradient: FloatArray
    sentence: str

    def __post_init__(self) -> None:
        for name in ("stations", "elevation", "gradient"):
            object.__setattr__(self, name, frozen(getattr(self, name)))


def error_budget(
    centreline: Centreline,
    segments: Segments,
    targets: Targets,
    errors: InputErrors,
    settings: PgdSettings | None = None,
) -> Generator[Progress, None, ErrorBudget]:
    """Find the band that the real track lies in with 95 %, station by station, and what it is made of.

    The plan and the figures are moved by 1 sigma, one after the other, and solved again. What the data
    leave open is added from what tracks usually do (`openness`), and is nearly all as a rule. Sources are
    taken to be independent and normal; a rounded figure lies anywhere within its rounding.

    Raises
    ------
    TargetError
        If limits, drop and known elevations contradict each other.
    """
    settings = settings or PgdSettings()
    case = _Case(centreline, segments, targets, settings)
    yield Progress(0.0, "the error budget")
    line = case.line()
    rows = line.stations
    length = float(rows[-1])
    # Name, share of plan length, and the two cases: moved up and down by 1 sigma.
    sources: list[tuple[str, float, _Case, _Case]] = []
    of_plan = {"digitising": errors.digitising / centreline.length}
    if not targets.unknown_scale:
        of_plan["calibration"] = errors.scale
    for name, share in of_plan.items():
        sources.append((name, share, case.with_plan(1 + share), case.with_plan(1 - share)))
    for name, field, rounding in (
        ("rounding of the length", "length", errors.length_rounding),
        ("rounding of the drop", "drop", errors.drop_rounding),
    ):
        sigma = rounding / math.sqrt(3)
        value = getattr(targets, field)
        up, down = (replace(case, targets=replace(targets, **{field: value + by})) for by in (sigma, -sigma))
        sources.append((name, 0.0, up, down))
    if targets.unknown_scale:
        more, less = (
            replace(case, settings=replace(settings, typical_swing=settings.typical_swing * (1 + by)))
            for by in (_SPREAD_OF_SWING, -_SPREAD_OF_SWING)
        )
        sources.append(("usual swing of the gradient", 0.0, more, less))

    shares: list[Share] = []
    elevation, gradient = np.zeros(len(rows)), np.zeros(len(rows))
    for number, (name, share, up, down) in enumerate(sources):
        yield Progress((number + 1) / (len(sources) + 2), "the error budget")
        moved = _moved_by(line, up, down, still=share == 0 and up == down)
        if targets.unknown_scale:
            share = moved.scale
        shares.append(
            Share(
                name,
                COVERED * share * length,
                COVERED * share,
                COVERED * _rms(moved.elevation),
                COVERED * _rms(moved.gradient),
            )
        )
        elevation += moved.elevation**2
        gradient += moved.gradient**2
    scale = length / centreline.length
    anchors = anchors_of(targets, centreline.length)
    swing = swing_about_stretches(rows, line.elevations, anchors, scale=scale)
    left = openness(anchors, swing=swing, scale=scale)
    open_elevation, open_gradient = (
        np.interp(rows, left.stations, values) for values in (left.elevation, left.gradient)
    )
    shares.append(
        Share("left open by the data", 0.0, 0.0, COVERED * _rms(open_elevation), COVERED * _rms(open_gradient))
    )
    total = Share(
        "all together",
        plan_length=_root(each.plan_length for each in shares),
        scale=_root(each.scale for each in shares),
        elevation=_root(each.elevation for each in shares),
        gradient=_root(each.gradient for each in shares),
    )
    half_elevation = COVERED * np.sqrt(elevation + open_elevation**2)
    half_gradient = COVERED * np.sqrt(gradient + open_gradient**2)
    sentence = _sentence(total, shares, rows, half_elevation) + _unknown(errors)
    return ErrorBudget(line, (*shares, total), rows, half_elevation, half_gradient, sentence)


@dataclass(frozen=True, eq=False)
class _Case:
    centreline: Centreline
    segments: Segments
    targets: Targets
    settings: PgdSettings

    def line(self) -> Centreline3D:
        solution = finish(pgd(self.centreline, self.segments, self.targets, self.settings))
        return make_centreline3d(self.centreline, self.segments, solution)

    def with_plan(self, factor: float) -> _Case:
        """Return the case with the plan, and the stations of known elevations on it, enlarged."""
        plan = self.centreline
        larger = Centreline(factor * plan.stations, factor * plan.points, factor * plan.raw_points)
        return _Case(larger, stretched(self.segments, larger.length), in_scale(self.targets, factor), self.settings)


@dataclass(frozen=True, eq=False)
class _Moved:
    elevation: FloatArray
    gradient: FloatArray
    scale: float


def _moved_by(line: Centreline3D, up: _Case, down: _Case, *, still: bool) -> _Moved:
    """Return by how much 1 sigma moves elevation and gradient at equal shares of the line, and the scale.

    Where one of both cannot be solved, the other is compared with the result.
    """
    rows = line.stations / line.stations[-1]
    found: list[Centreline3D] = []
    for case in () if still else (up, down):
        try:
            found.append(case.line())
        except TargetError:
            found.append(line)
    if not found:
        return _Moved(np.zeros(len(rows)), np.zeros(len(rows)), 0.0)
    one, other = found
    steps = max(1, sum(each is not line for each in found))
    share, share_of_other = (each.stations / each.stations[-1] for each in found)

    def half(values: FloatArray, others: FloatArray) -> FloatArray:
        apart = np.interp(rows, share, values) - np.interp(rows, share_of_other, others)
        size: FloatArray = np.abs(apart) / steps
        return size

    drawn, drawn_of_other = up.centreline.length, down.centreline.length
    factor, factor_of_other = one.stations[-1] / drawn, other.stations[-1] / drawn_of_other
    relative = abs(factor - factor_of_other) / steps / (line.stations[-1] / drawn)
    return _Moved(half(one.elevations, other.elevations), half(one.gradients, other.gradients), float(relative))


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _root(values: Iterable[float]) -> float:
    return math.sqrt(sum(value**2 for value in values))


def _unknown(errors: InputErrors) -> str:
    if not errors.unknown:
        return ""
    named = {"digitising": "the digitised line", "calibration": "the plan's scale"}
    what = " and ".join(named.get(name, name) for name in errors.unknown)
    return f" How exact {what} may be is not known and counts as no error: the real track may lie farther off."


def _sentence(total: Share, shares: list[Share], rows: FloatArray, elevation: FloatArray) -> str:
    worst = int(elevation.argmax())
    largest = max(shares, key=lambda each: each.elevation)
    length = float(rows[-1])
    most = "what the data leave open" if largest is shares[-1] else largest.source
    sentence = (
        f"With 95 % the plan length is {length:.1f} m ± {total.plan_length:.1f} m ({100 * total.scale:.2f} %), and the"
        f" elevation lies within ± {elevation[worst]:.1f} m of the result at {rows[worst]:.0f} m, where it is"
        f" least sure; most of that is {most}."
    )
    if total.plan_length > 0:
        worth = math.sqrt(2 * total.plan_length / length)
        sentence += (
            f" As 3D length, ± {total.plan_length:.1f} m are worth gradients that swing by {100 * worth:.1f} % about"
            " their mean: of smaller swings the length says nothing."
        )
    return sentence
