"""The path data of SVG, cut into numbers and bent into points; a tokenizer of our own with limits."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.errors import InputError

# "*+" never gives a blank back, so that many of them cost no more than one pass.
_BLANKS = re.compile(r"[\s,]*+")
_TOKEN = re.compile(r"[\s,]*+(?:([MmZzLlHhVvCcSsQqTtAa])|([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?))")
_NUMBERS_OF = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_MOST_STEPS = 200
_LARGEST = 1e12  # beyond it a path is at its end
_SMALLEST_RADIUS = 1e-12
TOO_MANY = "the drawing has too many pieces; leave only the track in it"


@dataclass(frozen=True)
class Piece:
    """A straight (2 control points) or a cubic Bezier curve (4) of a path, x + iy each."""

    points: tuple[complex, ...]


def subpaths(text: str, *, name: str, budget: int) -> list[list[Piece]]:
    """Return the pieces of each subpath in the `d` attribute of a path.

    Parameters
    ----------
    text
        As in SVG 1.1, 8.3; what follows an error is left out, as the standard wants it.
    budget
        The most commands there may be.

    Raises
    ------
    InputError
        If there are more.
    """
    found: list[list[Piece]] = []
    for starts, piece in _pieces(text, name, budget):
        if starts or not found:
            found.append([])
        found[-1].append(piece)
    return found


def points_of(pieces: list[Piece], *, tolerance: float) -> FloatArray:
    """Return the points of a subpath, (n, 2), at most `tolerance` off its curves."""
    points: list[FloatArray] = [np.array([pieces[0].points[0]])]
    for piece in pieces:
        control = np.array(piece.points)
        if len(control) == 2:
            points.append(control[1:])
            continue
        # The second differences bound how far a chord is off: max |B''| / 8 per squared step.
        bend = 6 * float(np.abs(np.diff(control, 2)).max())
        steps = min(_MOST_STEPS, max(1, math.ceil(math.sqrt(bend / (8 * tolerance)))))
        t = np.arange(1, steps + 1) / steps
        u = 1 - t
        points.append(u**3 * control[0] + 3 * u * u * t * control[1] + 3 * u * t * t * control[2] + t**3 * control[3])
    chain = np.concatenate(points)
    return np.column_stack([chain.real, chain.imag])


def numbers(text: str, *, most: int) -> list[float]:
    """Return the numbers at the start of a list such as `points`, at most `most`."""
    result: list[float] = []
    position = 0
    while len(result) < most and (found := _number(text, position)):
        value, position = found
        result.append(value)
    return result


def _commands(text: str) -> Iterator[tuple[str, list[float]]]:
    """Yield each command with its numbers; numbers that follow at once repeat the command."""
    position, command = 0, ""
    while match := _TOKEN.match(text, position):
        if match[1]:
            command, position = match[1], match.end()
            if command in "Zz":
                yield command, []
                continue
        elif not command or command in "Zz":
            return
        values: list[float] = []
        for index in range(_NUMBERS_OF[command.upper()]):
            found = _flag(text, position) if command in "Aa" and index in (3, 4) else None
            found = found or _number(text, position)
            if found is None:
                return
            value, position = found
            values.append(value)
        yield command, values
        command = {"M": "L", "m": "l"}.get(command, command)


def _number(text: str, position: int) -> tuple[float, int] | None:
    match = _TOKEN.match(text, position)
    if not match or not match[2]:
        return None
    value = float(match[2])
    return (value, match.end()) if abs(value) <= _LARGEST else None


def _flag(text: str, position: int) -> tuple[float, int] | None:
    """Read a flag of an arc: 0 or 1, which need no blank after them."""
    if blanks := _BLANKS.match(text, position):
        position = blanks.end()
    return (float(text[position]), position + 1) if text[position : position + 1] in ("0", "1") else None


def _pieces(text: str, name: str, budget: int) -> Iterator[tuple[bool, Piece]]:
    here = start = mirror = 0j
    last, starts = "", True
    for count, (command, values) in enumerate(_commands(text)):
        if count >= budget:
            raise InputError(f"{name}: {TOO_MANY}")
        kind = command.upper()
        base = here if command.islower() else 0j
        pairs = [base + complex(x, y) for x, y in zip(values[0::2], values[1::2], strict=False)]
        if kind == "M":
            here = start = pairs[0]
            last, starts = kind, True
            continue
        control: list[complex] = []
        if kind == "Z":
            control = [here, start] if here != start else []
        elif kind == "L":
            control = [here, pairs[0]]
        elif kind == "H":
            control = [here, complex(base.real + values[0], here.imag)]
        elif kind == "V":
            control = [here, complex(here.real, base.imag + values[0])]
        elif kind == "C":
            control = [here, *pairs]
        elif kind == "S":
            control = [here, mirror if last in "CS" else here, *pairs]
        elif kind in "QT":
            bend = pairs[0] if kind == "Q" else (mirror if last in "QT" else here)
            control = [here, here + (bend - here) * 2 / 3, pairs[-1] + (bend - pairs[-1]) * 2 / 3, pairs[-1]]
        else:
            end = base + complex(values[5], values[6])
            for piece in _arc(here, end, values):
                yield starts, piece
                starts = False
            here, last = end, kind
            continue
        if control:
            yield starts, Piece(tuple(control))
            here = control[-1]
        # After "Z" the next piece begins a subpath of its own at the same place.
        starts, last = kind == "Z", kind
        if kind in "CS":
            mirror = 2 * here - control[2]
        elif kind in "QT":
            mirror = 2 * here - bend


def _arc(start: complex, end: complex, values: list[float]) -> list[Piece]:
    """Return an elliptic arc as cubic curves of at most 45 degrees (SVG 1.1, F.6; 1e-6 of the radius)."""
    rx, ry, turn = (
        abs(values[0]),
        abs(values[1]),
        complex(math.cos(math.radians(values[2])), math.sin(math.radians(values[2]))),
    )
    if start == end:
        return []
    if min(rx, ry) < _SMALLEST_RADIUS:
        return [Piece((start, end))]
    half = (start - end) / 2 / turn
    half = complex(half.real / rx, half.imag / ry)
    size = abs(half)
    grown = max(size, 1.0)
    rx, ry, half, size = rx * grown, ry * grown, half / grown, size / grown
    sideways = math.sqrt(max(0.0, 1 / size**2 - 1)) * (-1 if values[3] == values[4] else 1)
    centre = sideways * complex(half.imag, -half.real)
    first, last = half - centre, -half - centre
    begin = math.atan2(first.imag, first.real)
    sweep = math.remainder(math.atan2(last.imag, last.real) - begin, math.tau)
    if values[4] and sweep < 0:
        sweep += math.tau
    elif not values[4] and sweep > 0:
        sweep -= math.tau
    middle = (start + end) / 2 + complex(centre.real * rx, centre.imag * ry) * turn
    count = max(1, math.ceil(abs(sweep) / (math.pi / 4)))
    step = sweep / count
    reach = 4 / 3 * math.tan(step / 4)

    def place(on_circle: complex) -> complex:
        return middle + complex(on_circle.real * rx, on_circle.imag * ry) * turn

    pieces = []
    here = start
    for index in range(count):
        a, b = begin + index * step, begin + (index + 1) * step
        one, two = complex(math.cos(a), math.sin(a)), complex(math.cos(b), math.sin(b))
        there = end if index == count - 1 else place(two)
        pieces.append(Piece((here, place(one + reach * 1j * one), place(two - reach * 1j * two), there)))
        here = there
    return pieces
