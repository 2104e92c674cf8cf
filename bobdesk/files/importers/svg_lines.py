"""Lines from an SVG drawing: its paths and polylines, with the transforms they stand in."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import MOST_PATHS, line_from_paths
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.importers.svg_path import TOO_MANY, Piece, numbers, points_of, subpaths
from bobdesk.files.importers.xml_stream import Attributes, listen
from bobdesk.plan.polyline import LARGEST_COORDINATE

_HIDDEN = frozenset({"defs", "clipPath", "symbol", "mask", "marker", "pattern"})
_LEFT_OUT = frozenset({"line", "rect", "circle", "ellipse", "polygon", "use", "text", "image"})
_TRANSFORM = re.compile(r"(matrix|translate|scale|rotate|skewX|skewY)\s{0,9}\(([^()]{0,400})\)")
_MOST_PIECES = 300_000
_MOST_TRANSFORMS = 5_000_000  # characters
_FLATNESS = 2e-5  # of the drawing's extent

# x' = a x + c y + e, y' = b x + d y + f
Matrix = tuple[float, float, float, float, float, float]
_IDENTITY: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


def read_svg_lines(data: bytes, *, name: str) -> ImportedLine:
    """Read the longest path or polyline of an SVG drawing; the drawing's unit is taken for a metre.

    Raises
    ------
    InputError
        If it is damaged, over a limit, or holds no such line.
    """
    found = _Svg(name)
    listen(data, found, name=name)
    notes = ["the drawing's unit was taken for a metre; say the scale if it is another"]
    if found.left_out:
        what = (
            "shape that is no path or polyline was"
            if found.left_out == 1
            else "shapes that are no paths or polylines were"
        )
        notes.append(f"{found.left_out:,} {what} left out")
    return line_from_paths(found.paths(), name=name, notes=tuple(notes))


class _Svg:
    text_of: frozenset[str] = frozenset()

    def __init__(self, name: str) -> None:
        self.left_out = 0
        self._lines: list[list[Piece]] = []
        self._count = 0
        self._name = name
        self._matrices: list[Matrix] = [_IDENTITY]
        self._hidden = 0
        self._transformed = 0

    def start(self, tag: str, attributes: Attributes) -> None:
        style = (attributes.get("style") or "").replace(" ", "")
        if self._hidden or tag in _HIDDEN or attributes.get("display") == "none" or "display:none" in style:
            self._hidden += 1
        transform = attributes.get("transform")
        here = self._matrices[-1]
        self._transformed += len(transform or "")
        if self._transformed > _MOST_TRANSFORMS:
            raise InputError(f"{self._name}: {TOO_MANY}")
        self._matrices.append(here if transform is None else _product(here, _matrix(transform)))
        if self._hidden:
            return
        lines: list[list[Piece]] = []
        if tag == "path":
            lines = subpaths(attributes.get("d") or "", name=self._name, budget=_MOST_PIECES - self._count)
        elif tag == "polyline":
            values = numbers(attributes.get("points") or "", most=2 * (_MOST_PIECES - self._count + 2))
            spots = [complex(x, y) for x, y in zip(values[0::2], values[1::2], strict=False)]
            lines = [[Piece(pair) for pair in pairwise(spots)]] if len(spots) > 1 else []
        elif tag in _LEFT_OUT:
            self.left_out += 1
        for line in lines:
            self._lines.append([_moved(piece, self._matrices[-1]) for piece in line])
            self._count += len(line)
        if self._count > _MOST_PIECES or len(self._lines) > MOST_PATHS:
            raise InputError(f"{self._name}: {TOO_MANY}")

    def end(self, tag: str, text: str) -> None:
        self._matrices.pop()
        if self._hidden:
            self._hidden -= 1

    def paths(self) -> list[FloatArray]:
        """Return all lines as points, y up."""
        spots = np.array([spot for line in self._lines for piece in line for spot in piece.points], dtype=complex)
        if not len(spots):
            return []
        if not (np.isfinite(spots).all() and np.abs(spots).max() < LARGEST_COORDINATE):
            raise InputError(f"{self._name}: a coordinate of the drawing is not a finite number below 100,000,000")
        extent = max(float(np.ptp(spots.real)), float(np.ptp(spots.imag)), 1e-9)
        paths = [points_of(line, tolerance=_FLATNESS * extent) for line in self._lines]
        return [path * (1.0, -1.0) for path in paths]


def _moved(piece: Piece, matrix: Matrix) -> Piece:
    a, b, c, d, e, f = matrix
    return Piece(tuple(complex(a * p.real + c * p.imag + e, b * p.real + d * p.imag + f) for p in piece.points))


def _product(left: Matrix, right: Matrix) -> Matrix:
    a, b, c, d, e, f = left
    k, l, m, n, o, p = right  # noqa: E741 - the letters go on
    return (a * k + c * l, b * k + d * l, a * m + c * n, b * m + d * n, a * o + c * p + e, b * o + d * p + f)


def _matrix(text: str) -> Matrix:
    """Return the product of the transforms in an attribute; those that are none are left out."""
    result = _IDENTITY
    for kind, content in _TRANSFORM.findall(text):
        values = numbers(content, most=6)
        step = _step(kind, values)
        if step is not None:
            result = _product(result, step)
    return result


def _step(kind: str, values: list[float]) -> Matrix | None:
    if kind == "matrix" and len(values) == 6:
        return (values[0], values[1], values[2], values[3], values[4], values[5])
    if kind == "translate" and values:
        return (1, 0, 0, 1, values[0], values[1] if len(values) > 1 else 0)
    if kind == "scale" and values:
        return (values[0], 0, 0, values[1] if len(values) > 1 else values[0], 0, 0)
    if kind == "skewX" and values:
        return (1, 0, math.tan(math.radians(values[0])), 1, 0, 0)
    if kind == "skewY" and values:
        return (1, math.tan(math.radians(values[0])), 0, 1, 0, 0)
    if kind == "rotate" and values:
        cosine, sine = math.cos(math.radians(values[0])), math.sin(math.radians(values[0]))
        turned: Matrix = (cosine, sine, -sine, cosine, 0, 0)
        if len(values) < 3:
            return turned
        x, y = values[1], values[2]
        return _product(_product((1, 0, 0, 1, x, y), turned), (1, 0, 0, 1, -x, -y))
    return None
