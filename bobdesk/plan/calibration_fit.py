"""The calibration that fits control points and known distances best, and how well it does."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from bobdesk.errors import InputError
from bobdesk.plan.calibration import Calibration
from bobdesk.plan.control_points import ControlPoint, KnownDistance

_Complex = npt.NDArray[np.complex128]
# Clicks closer together than this cannot carry a scale.
_SMALLEST_SPREAD_PX = 1.0
# Points are called mirrored if a mirrored fit leaves less than this share of the squared residuals, and
# the straight one leaves over 1 % of the squared spread: bad clicks alone do neither.
_MIRRORED_SHARE, _MIRRORED_MISFIT = 0.01, 0.01


@dataclass(frozen=True)
class PointResidual:
    """Where a control point was clicked, minus where its known position falls.

    Attributes
    ----------
    name, used
        As in the control point.
    dx_m, dy_m, norm_m
        Metres, y up.
    dx_px, dy_px, norm_px
        Pixels, y down: how far the click lies to the right of and below the known position.
    """

    name: str
    used: bool
    dx_m: float
    dy_m: float
    norm_m: float
    dx_px: float
    dy_px: float
    norm_px: float


@dataclass(frozen=True)
class DistanceResidual:
    """A fitted distance: what the plan gives, what is known, and plan minus known; metres."""

    name: str
    used: bool
    plan_m: float
    known_m: float
    difference_m: float


@dataclass(frozen=True)
class Worst:
    """The point or distance whose removal improves the fit most.

    `rms_without_m` is the RMS after its removal; None if nothing would be left to judge by.
    """

    name: str
    rms_without_m: float | None


@dataclass(frozen=True, eq=False)
class CalibrationFit:
    """A fitted calibration and its quality.

    Attributes
    ----------
    calibration
        With `scale_sigma` set where an estimate is possible.
    points, distances
        A residual for each one given, in the same order; those not used have one as well.
    degrees_of_freedom
        Measured numbers minus fitted ones; 0 means that everything fits whatever the errors are.
    rms_m, rms_px
        Root of the mean squared residual over what was used (a point's is the distance between click
        and known position, a distance's the difference); None at 0 degrees of freedom, where it is 0
        without meaning anything.
    click_sigma_px
        1 sigma of a click along x or y that the residuals suggest, corrected for the degrees of
        freedom; None at 0.
    worst
        None at 0 degrees of freedom.
    """

    calibration: Calibration
    points: tuple[PointResidual, ...]
    distances: tuple[DistanceResidual, ...]
    degrees_of_freedom: int
    rms_m: float | None
    rms_px: float | None
    click_sigma_px: float | None
    worst: Worst | None


@dataclass(frozen=True)
class _Solution:
    factor: complex  # metres = factor * (x - iy) + shift
    shift: complex
    squares: float  # squared residuals of points, and half those of distances
    spread: float  # what the scale's sigma is divided by, squared
    freedom: int
    mean_square: float  # over points and distances: both have twice the variance of a click's coordinate

    @property
    def rms_m(self) -> float | None:
        return math.sqrt(self.mean_square) if self.freedom > 0 else None


def fit_calibration(points: Sequence[ControlPoint] = (), *, distances: Sequence[KnownDistance] = ()) -> CalibrationFit:
    """Return the calibration that fits the used `points` and `distances` best, by least squares.

    Every click is taken as equally exact and the known metres as exact. Then a distance, between two
    clicks, has twice the variance of a coordinate, and weighs half as much. Minimised over the scale s,
    the rotation and the shift in closed form:

        sum |w - s u z - t|² + 1/2 sum (s L - d)²,   z = x - iy in pixels, w = X + iY in metres, |u| = 1

    One point and distances give scale and shift; distances alone the scale: the metres' origin then is
    pixel (0, 0) and the axes are the picture's.

    Raises
    ------
    InputError
        If there is too little, all points coincide, or they are mirrored.

    References
    ----------
    B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions", J. Opt. Soc.
    Am. A 4 (1987) 629, in two dimensions where a complex number does for the rotation.
    """
    used_points = [point for point in points if point.used]
    used_distances = [known for known in distances if known.used]
    z, w, length_px, length_m = _arrays(used_points, used_distances)
    _check_enough(z, w, length_px)
    solution = _solve(z, w, length_px, length_m)
    scale = abs(solution.factor)
    freedom = solution.freedom
    sigma_m = math.sqrt(solution.squares / freedom) if freedom > 0 else None
    calibration = Calibration(
        scale,
        cmath.phase(solution.factor),
        (solution.shift.real, solution.shift.imag),
        scale_sigma=None if sigma_m is None else sigma_m / math.sqrt(solution.spread),
    )
    return CalibrationFit(
        calibration=calibration,
        points=tuple(_point_residual(point, solution) for point in points),
        distances=tuple(_distance_residual(known, scale) for known in distances),
        degrees_of_freedom=freedom,
        rms_m=solution.rms_m,
        rms_px=None if solution.rms_m is None else solution.rms_m / scale,
        click_sigma_px=None if sigma_m is None else sigma_m / scale,
        worst=_worst(used_points, used_distances, solution) if freedom > 0 else None,
    )


def switched(points: Sequence[ControlPoint], *, index: int, used: bool) -> tuple[ControlPoint, ...]:
    """Return `points` with the one at `index` switched on or off."""
    return tuple(replace(point, used=used) if at == index else point for at, point in enumerate(points))


def _arrays(
    points: Sequence[ControlPoint], distances: Sequence[KnownDistance]
) -> tuple[_Complex, _Complex, npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    z = np.array([complex(point.x_px, -point.y_px) for point in points], dtype=np.complex128)
    w = np.array([complex(point.x_m, point.y_m) for point in points], dtype=np.complex128)
    length_px = np.array([known.length_px for known in distances], dtype=np.float64)
    length_m = np.array([known.length_m for known in distances], dtype=np.float64)
    return z, w, length_px, length_m


def _check_enough(z: _Complex, w: _Complex, length_px: npt.NDArray[np.float64]) -> None:
    if len(z) + len(length_px) == 0:
        raise InputError("A calibration needs two control points or one known distance.")
    if len(z) == 1 and len(length_px) == 0:
        raise InputError("One control point gives no scale; add a second one or a known distance.")
    if len(z) < 2:
        return
    if np.ptp(z.real) < _SMALLEST_SPREAD_PX and np.ptp(z.imag) < _SMALLEST_SPREAD_PX:
        raise InputError("All control points lie at the same place in the picture; choose some far apart.")
    if np.ptp(w.real) == 0 and np.ptp(w.imag) == 0:
        raise InputError("All control points have the same position in metres; check what was typed in.")
    if len(z) < 3:
        return
    from_pixels, from_metres = z - z.mean(), w - w.mean()
    spread = float(np.vdot(from_metres, from_metres).real)
    size = float(np.vdot(from_pixels, from_pixels).real)
    straight = spread - abs(np.vdot(from_pixels, from_metres)) ** 2 / size
    mirrored = spread - abs(np.dot(from_pixels, from_metres)) ** 2 / size
    if straight > _MIRRORED_MISFIT * spread and mirrored < _MIRRORED_SHARE * straight:
        raise InputError(
            "The control points are mirrored: left and right, or east and north, are swapped; check that the "
            "metres are given as east and north and that the picture is not a mirror image."
        )


def _solve(
    z: _Complex, w: _Complex, length_px: npt.NDArray[np.float64], length_m: npt.NDArray[np.float64]
) -> _Solution:
    count = len(z)
    centre_z, centre_w = (complex(z.mean()), complex(w.mean())) if count else (0j, 0j)
    from_pixels, from_metres = z - centre_z, w - centre_w
    product = complex(np.vdot(from_pixels, from_metres))
    spread = float(np.vdot(from_pixels, from_pixels).real) + float(length_px @ length_px) / 2
    direction = product / abs(product) if count >= 2 and product != 0 else 1.0 + 0j
    scale = (abs(product) + float(length_px @ length_m) / 2) / spread if spread > 0 else 0.0
    if not scale > 0:
        raise InputError(
            "The control points give no scale: their places in the picture have nothing to do with their metres."
        )
    factor = scale * direction
    of_points = float(np.sum(np.abs(from_metres - factor * from_pixels) ** 2))
    of_distances = float(np.sum((scale * length_px - length_m) ** 2))
    fitted = 4 if count >= 2 else 3 if count == 1 else 1
    total = count + len(length_px)
    return _Solution(
        factor=factor,
        shift=centre_w - factor * centre_z,
        squares=of_points + of_distances / 2,
        spread=spread,
        freedom=2 * count + len(length_px) - fitted,
        mean_square=(of_points + of_distances) / total,
    )


def _point_residual(point: ControlPoint, solution: _Solution) -> PointResidual:
    clicked = solution.factor * complex(point.x_px, -point.y_px) + solution.shift
    metres = clicked - complex(point.x_m, point.y_m)
    pixels = metres / solution.factor
    return PointResidual(
        name=point.name,
        used=point.used,
        dx_m=metres.real,
        dy_m=metres.imag,
        norm_m=abs(metres),
        dx_px=pixels.real,
        dy_px=-pixels.imag,
        norm_px=abs(pixels),
    )


def _distance_residual(known: KnownDistance, scale: float) -> DistanceResidual:
    plan = scale * known.length_px
    return DistanceResidual(known.name, known.used, plan, known.length_m, plan - known.length_m)


def _worst(points: Sequence[ControlPoint], distances: Sequence[KnownDistance], solution: _Solution) -> Worst | None:
    """Return what spoils the fit most: what remains without it has the smallest variance.

    That is the largest residual after allowing for how strongly a point far out pulls the fit to itself.
    """
    found: list[tuple[float, Worst]] = []
    for index in range(len(points) + len(distances)):
        at = index - len(points)
        fewer_points = [*points[:index], *points[index + 1 :]] if at < 0 else list(points)
        fewer_distances = [*distances[:at], *distances[at + 1 :]] if at >= 0 else list(distances)
        arrays = _arrays(fewer_points, fewer_distances)
        try:
            _check_enough(arrays[0], arrays[1], arrays[2])
            without = _solve(*arrays)
        except InputError:
            continue
        name = (points[index] if at < 0 else distances[at]).name
        if without.freedom > 0:
            found.append((without.squares / without.freedom, Worst(name, without.rms_m)))
    if found:
        return min(found, key=lambda pair: pair[0])[1]
    sizes = [(_point_residual(point, solution).norm_m, point.name) for point in points]
    scale = abs(solution.factor)
    sizes += [(abs(_distance_residual(known, scale).difference_m), known.name) for known in distances]
    return Worst(max(sizes)[1], None)
