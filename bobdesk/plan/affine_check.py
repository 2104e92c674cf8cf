"""A check whether the picture is stretched or sheared: an affine fit beside the calibration."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bobdesk.errors import InputError
from bobdesk.plan.control_points import ControlPoint

# Points are in one line if their spread across it is under this share of the spread along it.
_THINNEST = 0.01


@dataclass(frozen=True)
class AffineCheck:
    """What an affine fit says of the picture.

    Attributes
    ----------
    scale_x, scale_y
        Metres per pixel along the picture's x and y.
    scale_ratio
        `scale_y` / `scale_x`; 1 for an undistorted picture.
    shear_rad
        By how much the picture's axes deviate from a right angle on the ground, radians.
    degrees_of_freedom
        Two for each point minus six.
    rms_m
        Root mean square of the points' residuals; None at 0 degrees of freedom.
    chance
        Probability that clicking errors alone make the affine fit better than the similarity by as much
        as it is (F test); under 0.05 the picture is probably distorted. None at 0 degrees of freedom.
    """

    scale_x: float
    scale_y: float
    scale_ratio: float
    shear_rad: float
    degrees_of_freedom: int
    rms_m: float | None
    chance: float | None


def check_affine(points: Sequence[ControlPoint]) -> AffineCheck:
    """Return the affine fit through the used `points`, of which there must be three or more.

    Raises
    ------
    InputError
        If there are fewer than three, they lie in one line, or they are mirrored.
    """
    used = [point for point in points if point.used]
    if len(used) < 3:
        raise InputError("To tell whether the picture is stretched takes three control points or more.")
    # y is flipped here, once, as in the calibration.
    pixels = np.array([(point.x_px, -point.y_px) for point in used], dtype=np.float64)
    metres = np.array([(point.x_m, point.y_m) for point in used], dtype=np.float64)
    pixels -= pixels.mean(axis=0)
    metres -= metres.mean(axis=0)
    along, across = np.linalg.svd(pixels, compute_uv=False)
    if across <= _THINNEST * along:
        raise InputError(
            "The control points lie in one line, so they cannot tell whether the picture is stretched across "
            "it; add one beside the line."
        )
    matrix = np.linalg.lstsq(pixels, metres, rcond=None)[0].T
    if np.linalg.det(matrix) <= 0:
        raise InputError("The control points are mirrored or have no extent in metres; check their positions.")
    squares = float(np.sum((metres - pixels @ matrix.T) ** 2))
    freedom = 2 * len(used) - 6
    scale_x, scale_y = (float(size) for size in np.linalg.norm(matrix, axis=0))
    between = float(matrix[:, 0] @ matrix[:, 1]) / (scale_x * scale_y)
    return AffineCheck(
        scale_x=scale_x,
        scale_y=scale_y,
        scale_ratio=scale_y / scale_x,
        shear_rad=math.asin(max(-1.0, min(1.0, between))),
        degrees_of_freedom=freedom,
        rms_m=math.sqrt(squares / len(used)) if freedom > 0 else None,
        chance=_chance(pixels, metres, squares, freedom) if freedom > 0 else None,
    )


def _chance(
    pixels: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    metres: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    squares: float,
    freedom: int,
) -> float:
    """Return the F test's probability for the two numbers that the affine fit has more.

    With two degrees of freedom above, the F distribution's tail is (1 + 2 F / freedom)^(-freedom / 2).
    """
    z, w = pixels @ (1, 1j), metres @ (1, 1j)
    similar = float(np.vdot(w, w).real) - float(np.abs(np.vdot(z, w))) ** 2 / float(np.vdot(z, z).real)
    gain = max(similar - squares, 0.0)
    # Rounding alone is no distortion: coordinates of exact data leave squares of 1e-24.
    floor = 1e-20 * float(np.vdot(w, w).real)
    return float((1 + (gain / max(squares, floor))) ** (-freedom / 2)) if gain > floor else 1.0
