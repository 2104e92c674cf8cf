"""Where a picture's pixels lie in the world, as its own tags or a world file say it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bobdesk.errors import InputError

# A pixel smaller than this, with coordinates on the globe, can only be counted in degrees:
# no scanner or aeroplane gives a tenth of a millimetre of ground per pixel.
_LARGEST_DEGREES_PER_PIXEL = 1e-3


@dataclass(frozen=True)
class PixelToWorld:
    """The six numbers that turn a pixel into world coordinates.

    ``x_world = x_per_column * column + x_per_row * row + x_origin`` and the same for y; columns and
    rows count from the centre of the top left pixel (0, 0), rows downwards.

    References
    ----------
    ESRI world file: lines A, D, B, E, C, F; C and F are the centre of the top left pixel.
    """

    x_per_column: float
    x_per_row: float
    x_origin: float
    y_per_column: float
    y_per_row: float
    y_origin: float

    def at(self, column: float, row: float) -> tuple[float, float]:
        """Return the world coordinates (x, y) of the pixel position (`column`, `row`)."""
        return (
            self.x_per_column * column + self.x_per_row * row + self.x_origin,
            self.y_per_column * column + self.y_per_row * row + self.y_origin,
        )

    @property
    def coefficients(self) -> tuple[float, float, float, float, float, float]:
        """The six numbers in the order of the fields."""
        return (
            self.x_per_column,
            self.x_per_row,
            self.x_origin,
            self.y_per_column,
            self.y_per_row,
            self.y_origin,
        )


def checked_world(world: PixelToWorld, *, name: str) -> PixelToWorld:
    """Return `world` if it can place a picture in metres.

    Raises
    ------
    InputError
        If a number is missing or infinite, pixels have no area, or the unit is the degree.
    """
    numbers = world.coefficients
    if not all(math.isfinite(number) and abs(number) < 1e12 for number in numbers):
        raise InputError(f"{name} gives the picture no usable position: one of its numbers is out of range.")
    determinant = world.x_per_column * world.y_per_row - world.x_per_row * world.y_per_column
    size = max(abs(number) for number in (numbers[0], numbers[1], numbers[3], numbers[4]))
    if size == 0 or abs(determinant) < 1e-9 * size * size:
        raise InputError(f"{name} gives the picture no usable position: its pixels have no area.")
    on_the_globe = abs(world.x_origin) <= 360 and abs(world.y_origin) <= 90
    if size < _LARGEST_DEGREES_PER_PIXEL and on_the_globe:
        raise InputError(
            f"{name} counts in degrees of longitude and latitude, not in metres; save the picture in a "
            "projected coordinate system such as UTM, or calibrate it by control points."
        )
    return world


def turned_world(world: PixelToWorld, *, orientation: int, width: int, height: int) -> PixelToWorld:
    """Return `world` for the picture after its EXIF turn.

    World files and tags speak of the pixels as stored; the turned picture's pixel (x, y) is the stored
    pixel (column, row) found here.

    Parameters
    ----------
    orientation
        EXIF orientation, 1 to 8; 1 changes nothing.
    width, height
        Size of the picture as stored, in pixels.
    """
    right, bottom = width - 1, height - 1
    # column = a x + b y + c, row = d x + e y + f
    stored = {
        2: (-1, 0, right, 0, 1, 0),
        3: (-1, 0, right, 0, -1, bottom),
        4: (1, 0, 0, 0, -1, bottom),
        5: (0, 1, 0, 1, 0, 0),
        6: (0, 1, 0, -1, 0, bottom),
        7: (0, -1, right, -1, 0, bottom),
        8: (0, -1, right, 1, 0, 0),
    }.get(orientation)
    if stored is None:
        return world
    a, b, c, d, e, f = stored
    x_origin, y_origin = world.at(c, f)
    return PixelToWorld(
        x_per_column=world.x_per_column * a + world.x_per_row * d,
        x_per_row=world.x_per_column * b + world.x_per_row * e,
        x_origin=x_origin,
        y_per_column=world.y_per_column * a + world.y_per_row * d,
        y_per_row=world.y_per_column * b + world.y_per_row * e,
        y_origin=y_origin,
    )
