"""A simple sled that runs down a line: its speed from energy, and the load it puts on the track."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from bobdesk.arrays import FloatArray, frozen
from bobdesk.errors import InputError
from bobdesk.track.centreline3d import Centreline3D

GRAVITY = 9.80665
_BLUNT = 1e-12


@dataclass(frozen=True)
class Sled:
    """What the model knows of a sled; the usual values are those of a four-man bob, and all can be changed.

    Attributes
    ----------
    mass
        Of sled and crew, kg. 630 is the largest that four-man bobs may have.
    drag_area
        Drag coefficient times front area, m²; an assumption, since federations keep theirs to themselves.
    friction
        Of runners on ice, a number; 0.0042 ± 0.0009 was measured by Poirier et al.
    start_speed
        With which the sled, its crew seated, passes the first station, m/s. The push is no part of the model.
    air_density
        kg/m³; 1.25 is that of air at 5 °C and sea level.

    References
    ----------
    L. Poirier, E. P. Lozowski, S. Maw, D. J. Stefanyshyn, R. I. Thompson, Experimental analysis of ice
    friction in the sport of bobsleigh, Sports Engineering 14 (2011) 67.
    """

    mass: float = 630.0
    drag_area: float = 0.12
    friction: float = 0.0042
    start_speed: float = 10.0
    air_density: float = 1.25


# Of each figure: the smallest and the largest that a sled may have.
SLED_RANGES = {
    "mass": (1.0, 10_000.0),
    "drag_area": (0.0, 10.0),
    "friction": (0.0, 1.0),
    "start_speed": (0.0, 100.0),
    "air_density": (0.0, 10.0),
}


@dataclass(frozen=True, eq=False)
class Ride:
    """How a sled runs, row by row of a line.

    Attributes
    ----------
    stations : (n,)
        In plan, m; up to where the sled comes to rest, if it does.
    speeds : (n,)
        Along the 3D line, m/s.
    lateral, load : (n,)
        Across the line, and of the track upon the sled, m/s².
    stops
        Whether the sled comes to rest on the way.
    """

    stations: FloatArray
    speeds: FloatArray
    lateral: FloatArray
    load: FloatArray
    stops: bool

    def __post_init__(self) -> None:
        for name in ("stations", "speeds", "lateral", "load"):
            object.__setattr__(self, name, frozen(getattr(self, name)))


def check_sled(sled: Sled) -> Sled:
    """Return the sled if each figure can be used.

    Raises
    ------
    InputError
        Otherwise; the sentence names the figure.
    """
    for field in fields(sled):
        low, high = SLED_RANGES[field.name]
        value = getattr(sled, field.name)
        if not low <= value <= high:
            name = field.name.replace("_", " ")
            raise InputError(f"the sled's {name} must lie between {low:g} and {high:g}, not {value:g}")
    return sled


def ride(line: Centreline3D, sled: Sled | None = None) -> Ride:
    """Let a sled run down a line without being steered or braked.

    From row to row the square of the speed u = v² obeys du/ds = 2 g sin θ - 2 μ N - (ρ CdA / m) u along the
    3D line; the load N = hypot(v² κ cos² θ, g cos θ) is taken from the middle of the step, the rest is solved
    exactly, so that a free fall has v² = 2 g h and a long slope the terminal speed, whatever the distance of the rows.
    κ is the curvature in plan, so that v² κ cos² θ is the acceleration across, as of the part of the speed that
    lies in the plan. The sled is a point on the centreline: in a banked curve it takes a higher and a longer way. What
    changes of the gradient add to the load is left out, since their lengths are BobDesk's and not the track's.

    Parameters
    ----------
    line
        In true size.
    sled
        The usual one without.

    Raises
    ------
    InputError
        If the sled has a figure that cannot be used.
    """
    sled = check_sled(sled or Sled())
    steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
    falls = -np.diff(line.points[:, 2])
    run = np.hypot(*np.diff(line.points[:, :2], axis=0).T)
    level = np.divide(run, steps, out=np.ones_like(run), where=steps > 0)
    bends = np.abs(line.plan_curvature)
    between = 0.5 * (bends[1:] + bends[:-1])
    drag = sled.air_density * sled.drag_area / sled.mass
    squares = np.zeros(len(steps) + 1)
    squares[0] = sled.start_speed**2
    last = len(steps)
    for index, (step, fall, flat, bend) in enumerate(
        zip(steps.tolist(), falls.tolist(), level.tolist(), between.tolist(), strict=True)
    ):
        before = float(squares[index])
        guess = max(_after(before, before, step, fall, flat, bend, drag, sled.friction), 0.0)
        after = _after(before, 0.5 * (before + guess), step, fall, flat, bend, drag, sled.friction)
        if after <= 0.0:
            last = index
            break
        squares[index + 1] = after
    rows = slice(0, last + 1)
    # At a row the line is as steep as the gradient says; cos² θ = 1 / (1 + gradient²).
    slope = 1.0 + line.gradients[rows] ** 2
    lateral = squares[rows] * bends[rows] / slope
    return Ride(
        stations=line.stations[rows],
        speeds=np.sqrt(squares[rows]),
        lateral=lateral,
        load=np.hypot(lateral, GRAVITY / np.sqrt(slope)),
        stops=last < len(steps),
    )


def _after(
    before: float, within: float, step: float, fall: float, flat: float, bend: float, drag: float, friction: float
) -> float:
    """Return the square of the speed after a step, m²/s²; `within` is that which the load is taken from."""
    load = math.hypot(within * bend * flat**2, GRAVITY * flat)
    gained = 2 * GRAVITY * fall - 2 * friction * load * step
    worn = drag * step
    # (1 - exp(-x)) / x, which is 1 without drag.
    share = 1.0 if worn < _BLUNT else -math.expm1(-worn) / worn
    return before * math.exp(-worn) + gained * share
