"""Pictures of tracks drawn at known places: supersampled, in many styles, with labels, grids and grain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFilter
from scipy.spatial import cKDTree

Array = npt.NDArray[np.float64]
Colour = tuple[int, int, int]


def clothoid_track(pieces: list[tuple[float, float, float]], *, heading: float = 0.0, step: float = 0.5) -> Array:
    """Integrate pieces (length, curvature at start, curvature at end), pixels, to points (n, 2) from 0,0."""
    curvature = np.concatenate(
        [np.linspace(first, last, max(2, round(length / step)), endpoint=False) for length, first, last in pieces]
    )
    angle = heading + np.concatenate([[0.0], np.cumsum(curvature) * step])
    middle = 0.5 * (angle[1:] + angle[:-1])
    moves = step * np.column_stack([np.cos(middle), np.sin(middle)])
    return np.concatenate([np.zeros((1, 2)), np.cumsum(moves, axis=0)])


def random_track(seed: int, *, curves: int = 12, loop: bool = False, radius: float = 45.0) -> Array:
    """Straights and curves with clothoids; with `loop`, one turns by 280 degrees and crosses itself."""
    rng = np.random.default_rng(seed)
    pieces: list[tuple[float, float, float]] = [(60.0, 0.0, 0.0)]
    heading, side = 0.0, 1.0
    for index in range(curves):
        if loop and index == curves // 2:
            k = side / 55.0
            turn = np.deg2rad(280.0)
            pieces += [(25.0, 0.0, k), (turn / abs(k) - 25.0, k, k), (25.0, k, 0.0), (130.0, 0.0, 0.0)]
            heading += side * turn
            continue
        turn = np.deg2rad(rng.uniform(25, 80))
        side = -np.sign(np.sin(heading)) if abs(np.sin(heading)) > 0.6 else rng.choice([-1.0, 1.0])
        k = side / (radius * rng.uniform(0.7, 2.0))
        ramp = min(20.0, 0.4 * turn / abs(k))
        pieces += [(ramp, 0.0, k), (max(1.0, turn / abs(k) - ramp), k, k), (ramp, k, 0.0)]
        pieces.append((rng.uniform(10, 60), 0.0, 0.0))
        heading += side * turn
    return clothoid_track(pieces)


def looped_track(turn: float, *, radius: float = 55.0, side: float = 1.0) -> Array:
    """A curve, a loop that turns by `turn` degrees, more than 180, and crosses itself, and another curve."""
    angle, k = np.deg2rad(turn), side / radius
    ramp = 0.4 * radius
    lead = radius / np.tan(0.5 * (angle - np.pi)) + ramp + 60.0
    bend = [(60.0, 0.0, 0.0), (20.0, 0.0, side / 60), (27.0, side / 60, side / 60), (20.0, side / 60, 0.0)]
    loop = [(lead, 0.0, 0.0), (ramp, 0.0, k), (angle * radius - ramp, k, k), (ramp, k, 0.0), (lead, 0.0, 0.0)]
    return clothoid_track([*bend, *loop, *bend[1:], bend[0]], heading=0.4)


@dataclass(frozen=True)
class Style:
    """How a track is drawn; widths in pixels."""

    width: float = 2.0
    colour: Colour = (20, 20, 20)
    paper: Colour = (245, 244, 240)
    double: float = 0.0  # distance of two edges of `width`
    fill: Colour | None = None
    dash: tuple[float, float] | None = None
    second_colour: Colour | None = None  # the line changes to it along its way
    grid: Colour | None = None
    grid_width: float = 1.0
    grid_angle: float = 0.0
    labels: int = 12
    ticks: bool = False
    patches: tuple[Colour, ...] = ()
    noise: float = 0.0
    blur: float = 0.0
    shade: float = 0.0


@dataclass(frozen=True)
class Drawn:
    """A picture (h, w, 3) uint8 and the track in it (n, 2), pixels."""

    pixels: npt.NDArray[np.uint8]
    track: Array


_FINE = 4


def _stroke(draw: ImageDraw.ImageDraw, points: Array, *, width: float, colour: Colour) -> None:
    """Draw a stroke of fine pixels as one quad an edge, with round joints."""
    fine = (points + 0.5) * _FINE - 0.5
    half = 0.5 * width * _FINE
    way = np.diff(fine, axis=0)
    way /= np.maximum(np.hypot(*way.T), 1e-9)[:, None]
    side = half * np.column_stack([-way[:, 1], way[:, 0]])
    for a, b, n in zip(fine[:-1], fine[1:], side, strict=True):
        draw.polygon([tuple(p) for p in (a + n, b + n, b - n, a - n)], fill=colour)
    if half > 2:
        for x, y in fine[1:-1]:
            draw.ellipse([x - half, y - half, x + half, y + half], fill=colour)


def _offset(points: Array, distance: float) -> Array:
    way = np.gradient(points, axis=0)
    way /= np.hypot(*way.T)[:, None]
    return points + distance * np.column_stack([-way[:, 1], way[:, 0]])


def _dashes(points: Array, dash: tuple[float, float]) -> list[Array]:
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    starts = np.arange(0.0, along[-1], sum(dash))
    parts = [points[(along >= start) & (along <= start + dash[0])] for start in starts]
    return [part for part in parts if len(part) > 1]


def draw(track: Array, style: Style, *, seed: int = 0, margin: float = 60.0) -> Drawn:
    """Draw `track` with all that `style` asks for; the picture is as large as the track and a margin."""
    rng = np.random.default_rng(seed)
    track = track - track.min(axis=0) + margin + 0.37
    width, height = (int(v) for v in track.max(axis=0) + margin)
    picture = Image.new("RGB", (width * _FINE, height * _FINE), style.paper)
    pen = ImageDraw.Draw(picture)
    for index in range(30 if style.patches else 0):
        x, y = rng.uniform(0, [width, height]) * _FINE
        corners = [
            (x + _FINE * r * np.cos(a), y + _FINE * r * np.sin(a))
            for a, r in zip(np.sort(rng.uniform(0, 6.28, 9)), rng.uniform(20, 110, 9), strict=True)
        ]
        pen.polygon(corners, fill=style.patches[index % len(style.patches)])
    if style.grid:
        reach = float(np.hypot(width, height))
        c, s = np.cos(style.grid_angle), np.sin(style.grid_angle)
        for offset in np.arange(-reach, reach, 97.0):
            for ux, uy in ((c, s), (-s, c)):
                middle = np.array([width / 2, height / 2]) + offset * np.array([-uy, ux])
                ends = np.array([middle - reach * np.array([ux, uy]), middle + reach * np.array([ux, uy])])
                _stroke(pen, ends, width=style.grid_width, colour=style.grid)
    parts = _dashes(track, style.dash) if style.dash else [track]
    for part in parts:
        if style.double or style.fill:
            # An outline and what is in it, piece by piece: at a crossing the later part lies on top.
            outer = style.double + style.width if style.double else style.width
            for first in range(0, len(part) - 1, 60):
                piece = part[max(0, first - 4) : first + 62]
                _stroke(pen, piece, width=outer, colour=style.colour)
                inner = part[max(0, first - 12) : first + 63]
                fill = style.fill or style.paper
                edge = style.width if style.double else 1.5
                _stroke(pen, inner, width=outer - 2 * edge, colour=fill)
        elif style.second_colour:
            middle = len(part) // 2
            _stroke(pen, part[: middle + 1], width=style.width, colour=style.colour)
            _stroke(pen, part[middle:], width=style.width, colour=style.second_colour)
        else:
            _stroke(pen, part, width=style.width, colour=style.colour)
    _furniture(pen, track, style, rng)
    small = picture.resize((width, height), Image.Resampling.BOX)
    if style.blur:
        small = small.filter(ImageFilter.GaussianBlur(style.blur))
    values = np.asarray(small, dtype=np.float64)
    if style.shade:
        values *= 1 - style.shade * np.linspace(0, 1, width)[None, :, None]
    if style.noise:
        values += rng.normal(0, style.noise, values.shape)
    return Drawn(np.clip(values + 0.5, 0, 255).astype(np.uint8), track)


def _furniture(pen: ImageDraw.ImageDraw, track: Array, style: Style, rng: np.random.Generator) -> None:
    """Labels with leaders, ticks across the line."""
    for index in range(style.labels):
        at = int((index + 0.5) / style.labels * (len(track) - 1))
        beside = _offset(track[max(0, at - 2) : at + 3], rng.choice([-1.0, 1.0]) * 14.0)[2 if at >= 2 else at]
        x, y = (beside + 0.5) * _FINE
        pen.text((x, y), f"K{index + 1}", fill=(20, 20, 20), font_size=11 * _FINE)
        if index % 3 == 0:
            _stroke(pen, np.array([track[at], beside]), width=1.0, colour=(20, 20, 20))
    if style.ticks:
        for at in range(100, len(track) - 100, 150):
            piece = track[at - 2 : at + 3]
            ends = np.array([_offset(piece, 6.0)[2], _offset(piece, -6.0)[2]])
            _stroke(pen, ends, width=1.2, colour=style.colour)


def exact_line(points: Array, *, width: float, size: tuple[int, int]) -> npt.NDArray[np.uint8]:
    """A black stroke on white (h, w), each pixel grey by its exact distance from the line (butt ends)."""
    height, columns = size
    y, x = np.mgrid[0:height, 0:columns]
    dense = np.column_stack(
        [np.interp(np.arange(0, len(points) - 1, 0.1), np.arange(len(points)), points[:, k]) for k in (0, 1)]
    )
    distance, _ = cKDTree(dense).query(np.column_stack([x.ravel(), y.ravel()]))
    covered = np.clip(0.5 * width + 0.5 - distance, 0, 1)
    return (255 * (1 - covered)).round().astype(np.uint8).reshape(size)
