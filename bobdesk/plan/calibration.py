"""Calibration: pixels become metres by one scale, one rotation and one shift, with y flipped once."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.plan.control_points import KnownDistance
from bobdesk.plan.world import PixelToWorld

_INCH_M = 0.0254
_SQUARE_WITHIN = 1e-3  # of a pixel's side; a plan of 1,300 m is then off by at most a metre
_SQUARE_DPI_WITHIN = 0.005  # a page drawn into whole pixels may be off by one in a few hundred


@dataclass(frozen=True, eq=False)
class Calibration:
    """A similarity from pixels (x right, y down) to metres (y up).

    Attributes
    ----------
    metres_per_pixel
        Scale, m/px; 1 where the scale is unknown.
    rotation_rad
        Direction of the picture's x axis in the metres' axes, anticlockwise from their x.
    origin_m
        Metres (x, y) of the centre of the top left pixel.
    scale_known
        False if nobody knows the scale: lengths are then in pixels, to be multiplied by the unknown
        scale factor f.
    scale_sigma
        1 sigma of `metres_per_pixel`, m/px; None where no estimate is possible.
    """

    metres_per_pixel: float
    rotation_rad: float = 0.0
    origin_m: tuple[float, float] = (0.0, 0.0)
    scale_known: bool = True
    scale_sigma: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.metres_per_pixel) and self.metres_per_pixel > 0):
            raise InputError(f"The scale must be a positive number of metres per pixel, not {self.metres_per_pixel:g}.")

    @property
    def _factor(self) -> complex:
        return cmath.rect(self.metres_per_pixel, self.rotation_rad)

    def to_metres(self, points_px: npt.ArrayLike) -> FloatArray:
        """Return the metres (n, 2), y up, of the pixel positions `points_px` (n, 2), y down."""
        pixels = _points(points_px)
        turned = self._factor * (pixels[:, 0] - 1j * pixels[:, 1])
        return np.column_stack([turned.real + self.origin_m[0], turned.imag + self.origin_m[1]])

    def to_pixels(self, points_m: npt.ArrayLike) -> FloatArray:
        """Return the pixel positions (n, 2), y down, of the points `points_m` (n, 2) in metres, y up."""
        metres = _points(points_m) - self.origin_m
        turned = (metres[:, 0] + 1j * metres[:, 1]) / self._factor
        return np.column_stack([turned.real, -turned.imag])


def _points(values: npt.ArrayLike) -> FloatArray:
    points = np.asarray(values, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"expected points of shape (n, 2), got {points.shape}")
    return points


def unknown_scale() -> Calibration:
    """Return the calibration of a picture whose scale nobody knows: 1 pixel counts as 1."""
    return Calibration(1.0, scale_known=False)


def calibration_from_scale(metres_per_pixel: float) -> Calibration:
    """Return the calibration with this scale; origin at pixel (0, 0), axes the picture's."""
    return Calibration(metres_per_pixel)


def calibration_from_drawing_scale(dpi: tuple[float, float] | None, *, one_to: float) -> Calibration:
    """Return the calibration of a scan or page with `dpi` of a drawing at the scale 1 : `one_to`.

    Raises
    ------
    InputError
        If the dpi is unknown or differs along x and y, or the scale is not positive.
    """
    if dpi is None:
        raise InputError("The picture does not say its dpi, so the scale of the drawing alone does not help.")
    if abs(dpi[0] / dpi[1] - 1) > _SQUARE_DPI_WITHIN:
        raise InputError(f"The pixels are not square ({dpi[0]:g} × {dpi[1]:g} dpi); save the picture again.")
    if not (math.isfinite(one_to) and one_to > 0):
        raise InputError(f"A drawing scale is 1 : a positive number, not 1 : {one_to:g}.")
    return Calibration(_INCH_M / math.sqrt(dpi[0] * dpi[1]) * one_to)


def calibration_from_world(world: PixelToWorld, *, name: str) -> Calibration:
    """Return the calibration that a world file or GeoTIFF tags give at once.

    Parameters
    ----------
    world
        Position of the pixels, in metres.
    name
        What to call the file in a sentence.

    Raises
    ------
    InputError
        If pixels are not square (by more than 0.1 %), sheared, or mirrored.
    """
    a, b, c, d, e, f = world.coefficients
    factor = complex(a - e, b + d) / 2  # of x - iy
    mirrored = complex(a + e, d - b) / 2  # of x + iy
    if abs(mirrored) > abs(factor):
        raise InputError(
            f"{name} says that the picture is mirrored, which would swap left and right curves; check its signs."
        )
    if abs(mirrored) > _SQUARE_WITHIN / 2 * abs(factor):
        raise InputError(
            f"{name} says that the pixels are not square or are sheared ({math.hypot(a, d):g} m by "
            f"{math.hypot(b, e):g} m); save the picture again with square pixels."
        )
    return Calibration(abs(factor), cmath.phase(factor), (c, f))


def plan_length_sigma(calibration: Calibration, length_m: float) -> float | None:
    """Return 1 sigma of a plan length in metres that follows from the scale's, or None without one.

    The tracing of the line has an error of its own that is not in it.
    """
    if calibration.scale_sigma is None:
        return None
    return length_m * calibration.scale_sigma / calibration.metres_per_pixel


@dataclass(frozen=True)
class DistanceCheck:
    """A distance that took no part in the calibration, beside what the plan gives; metres."""

    name: str
    plan_m: float
    known_m: float

    @property
    def difference_m(self) -> float:
        """Plan minus known, metres."""
        return self.plan_m - self.known_m

    @property
    def difference_percent(self) -> float:
        """Plan minus known, percent of the known distance."""
        return 100 * self.difference_m / self.known_m


def check_distances(calibration: Calibration, distances: Iterable[KnownDistance]) -> tuple[DistanceCheck, ...]:
    """Return each distance beside what `calibration` makes of its clicks.

    Raises
    ------
    InputError
        If the scale is unknown.
    """
    if not calibration.scale_known:
        raise InputError("The scale is unknown, so there is nothing to check a distance against.")
    return tuple(
        DistanceCheck(known.name, known.length_px * calibration.metres_per_pixel, known.length_m) for known in distances
    )
