"""Made tracks with a true elevation, and what a hand with a picture and a table of figures makes of them."""

from dataclasses import dataclass

import numpy as np

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.plan.polyline import Polyline
from bobdesk.progress import finish
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.error_budget import error_budget
from bobdesk.track.input_errors import input_errors
from tests.alignment.made_lines import made_plan

CLICKS, NOISE, SCALE_SIGMA, WAVELENGTH = 6.0, 0.15, 0.001, 20.0


@dataclass(frozen=True)
class Truth:
    """Stations, plan and elevations of a track, m, each metre; and its figures."""

    stations: np.ndarray
    plan: np.ndarray
    elevations: np.ndarray
    length: float


def made_truth(seed):
    """Return a track of 16 curves whose gradient changes every 20 to 70 m, and slowly along the whole line."""
    rng = np.random.default_rng(seed)
    plan = made_plan(seed, curves=16, step=0.5)
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(plan, axis=0).T))])
    ends = np.cumsum(rng.uniform(20, 70, 100))
    phase = rng.uniform(0, 2 * np.pi)
    levels = 0.095 + 0.015 * np.sin(2 * np.pi * ends / 900 + phase) + 0.032 * rng.standard_normal(100)
    raw = np.clip(levels, 0.01, 0.2)[np.searchsorted(ends, stations)]
    # Transitions of some 15 m, and a run out that is level.
    kernel = np.hanning(33)[1:-1]
    gradients = np.convolve(np.pad(raw, 15, mode="edge"), kernel / kernel.sum(), mode="valid")
    gradients *= np.clip((stations[-1] - stations) / 30, 0, 1)
    falls = 0.5 * (gradients[1:] + gradients[:-1]) * np.diff(stations)
    heights = np.concatenate([np.cumsum(falls[::-1])[::-1], [0.0]])
    length = float(np.linalg.norm(np.diff(np.column_stack([plan, heights]), axis=0), axis=1).sum())
    return Truth(stations, plan, heights, length)


def covered(seed, *, known=0, unknown_scale=False):
    """Digitise a made track; return the budget, and the shares of length, elevation and gradient that lie inside."""
    truth = made_truth(seed)
    rng = np.random.default_rng(1000 + seed)
    total = truth.stations[-1]
    at = np.linspace(0, total, round(total / CLICKS) + 1)
    clicks = np.column_stack([np.interp(at, truth.stations, column) for column in truth.plan.T])
    clicks[1:-1] += NOISE * rng.standard_normal((len(at) - 2, 2))
    clicks *= 0.9 if unknown_scale else 1 + SCALE_SIGMA * rng.standard_normal()
    line = fit_centreline(Polyline(clicks), FitSettings(1.0, WAVELENGTH))
    places = np.linspace(0, 1, known + 2)[1:-1]
    heights = np.interp(places * total, truth.stations, truth.elevations)
    items = tuple(
        KnownElevation(float(place * line.length), round(float(height), 1), 0.05)
        for place, height in zip(places, heights, strict=True)
    )
    targets = Targets(
        round(truth.length, 1), round(float(truth.elevations[0]), 1), known=items, unknown_scale=unknown_scale
    )
    errors = input_errors(line, targets, vertices=len(clicks), wavelength=WAVELENGTH, scale=SCALE_SIGMA)
    found = finish(error_budget(line, detect_segments(line), targets, errors))
    share = found.stations / found.stations[-1] * total
    apart = found.line.elevations - np.interp(share, truth.stations, truth.elevations)
    true_gradients = np.interp(share, truth.stations, -np.gradient(truth.elevations, truth.stations))
    inside = np.abs(apart) <= found.elevation + 1e-9
    steep = np.abs(found.line.gradients - true_gradients) <= found.gradient
    length = abs(found.stations[-1] - total) <= found.shares[-1].plan_length
    return found, float(length), float(inside.mean()), float(steep.mean())
