"""Plans known by mathematics: the curvature by station is given, the points follow from it."""

from pathlib import Path

import numpy as np

from bobdesk.alignment.centreline import Centreline, fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.plan.polyline import Polyline

DATA = Path(__file__).parent.parent / "data"
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(6)


def drive(pieces, *, step=1.0):
    """Return points, every `step` metres at most, of a line of linear pieces of curvature.

    Each piece is (length, curvature at its start, curvature at its end); the integrals of the
    heading's cosine and sine are taken by Gauss's rule, exact to 1e-12 m for these steps.
    """
    points = [np.zeros(2)]
    turned = 0.0
    for length, first, last in pieces:
        edges = np.linspace(0.0, length, max(1, int(np.ceil(length / step - 1e-9))) + 1)
        half = 0.5 * np.diff(edges)
        at = 0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * _NODES
        heading = turned + first * at + 0.5 * (last - first) / length * at**2
        moves = np.stack([np.cos(heading) @ _WEIGHTS, np.sin(heading) @ _WEIGHTS], axis=1) * half[:, None]
        points.extend(points[-1] + np.cumsum(moves, axis=0))
        turned += 0.5 * (first + last) * length
    return np.array(points)


def curve(*, length, radius, ramp, left):
    """Return the pieces of a clothoid, an arc and a clothoid back."""
    bend = (1 if left else -1) / radius
    return [(ramp, 0.0, bend), (length - 2 * ramp, bend, bend), (ramp, bend, 0.0)]


def made_pieces(seed, *, curves=8):
    """Return the pieces of a random track of straights and curves of 18 to 45 m radius."""
    rng = np.random.default_rng(seed)
    pieces = [(60.0, 0.0, 0.0)]
    for number in range(curves):
        length, ramp = rng.uniform(30, 60), rng.uniform(5, 10)
        pieces += curve(length=length, radius=rng.uniform(18, 45), ramp=ramp, left=number % 2 == 0)
        pieces.append((rng.uniform(20, 50), 0.0, 0.0))
    return pieces


def made_plan(seed, *, curves=8, step=1.0):
    """Return the points of a random track."""
    return drive(made_pieces(seed, curves=curves), step=step)


def fitted(points, *, spacing=1.0, wavelength=15.0) -> Centreline:
    return fit_centreline(Polyline(points), FitSettings(spacing, wavelength))


def circle(radius, *, turn=2 * np.pi, count):
    angles = np.linspace(0.0, turn, count)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def correlated_noise(count, *, sigma, rms, seed):
    """Return white noise smoothed by a Gaussian of `sigma` rows and brought to `rms`, (count, 2)."""
    noise = np.random.default_rng(seed).standard_normal((count, 2))
    if sigma:
        reach = np.arange(-4 * int(sigma), 4 * int(sigma) + 1)
        kernel = np.exp(-0.5 * (reach / sigma) ** 2)
        padded = np.pad(noise, ((len(reach) // 2,) * 2, (0, 0)), mode="edge")
        noise = np.column_stack([np.convolve(column, kernel, mode="valid") for column in padded.T])
    return rms * noise / np.sqrt((noise**2).mean(axis=0))
