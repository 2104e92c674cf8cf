"""pgd against the published method, L-BFGS-B and SLSQP on one made track, in one run."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import Segment
from bobdesk.plan.polyline import polyline_from_points
from bobdesk.progress import finish
from bobdesk.solve.objective import PublishedObjective
from bobdesk.solve.pgd import pgd
from bobdesk.solve.published import published
from bobdesk.solve.second_opinions import second_opinion
from bobdesk.solve.settings import PublishedSettings, SecondOpinionSettings, Weights
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import figures
from tests.benchmarks.measure import Row, apart, best_of, print_table

WEIGHTS = Weights(1.0, 1.0, 1e4, 1e4)
SIZES = ((1_300, 29), (100_000, 300))


def made_track(stations: int, segments: int, seed: int = 1) -> tuple[np.ndarray, list[float]]:
    """Return a plan of straights and clothoid curves, points 1 m apart, and its boundaries, m."""
    rng = np.random.default_rng(seed)
    lengths = rng.uniform(0.5, 1.5, segments)
    lengths *= (stations - 1) / lengths.sum()
    edges = np.concatenate([[0.0], np.cumsum(lengths)])
    at = np.arange(stations) + 0.5
    index = np.minimum(np.searchsorted(edges, at, side="right") - 1, segments - 1)
    share = (at - edges[index]) / lengths[index]
    turns = rng.uniform(0.4, 2.0, segments) * rng.choice([-1.0, 1.0], segments)
    peak = np.where(np.arange(segments) % 2, turns / lengths / 0.75, 0.0)
    bends = peak[index] * np.clip(np.minimum(share, 1 - share) / 0.25, 0, 1)
    heading = np.cumsum(bends)
    points = np.cumsum(np.column_stack([np.cos(heading), np.sin(heading)]), axis=0)
    return points, edges[1:-1].tolist()


def solved(method: str, stations: int, count: int) -> Row:
    """Solve the made track by one method and return its row."""
    points, edges = made_track(stations, count)
    centreline = fit_centreline(polyline_from_points(points)[0], FitSettings())
    bounds = [0.0, *edges, centreline.length]
    segments = tuple(
        Segment("curve" if index % 2 else "straight", start, end) for index, (start, end) in enumerate(pairwise(bounds))
    )
    drop = 0.1 * centreline.length
    targets = Targets(1.0008 * float(np.hypot(centreline.length, drop)), drop, 0.1, "drop-per-plan")
    runs = {
        "pgd": lambda: finish(pgd(centreline, segments, targets)),
        "published": lambda: finish(published(centreline, segments, targets, PublishedSettings(WEIGHTS))),
        "L-BFGS-B": lambda: finish(
            second_opinion(centreline, segments, targets, "lbfgsb", SecondOpinionSettings(WEIGHTS))
        ),
        "SLSQP": lambda: finish(second_opinion(centreline, segments, targets, "slsqp", SecondOpinionSettings(WEIGHTS))),
        "SLSQP, numeric": lambda: finish(
            second_opinion(
                centreline, segments, targets, "slsqp", SecondOpinionSettings(WEIGHTS, numeric_derivatives=True)
            )
        ),
    }
    seconds, solution = best_of(3 if stations < 10_000 else 1, runs[method])
    found = figures(make_centreline3d(centreline, segments, solution))
    published_value = PublishedObjective(solution.profile, targets, WEIGHTS).terms(solution.gradients)
    value = (
        published_value.length**2
        + published_value.height**2
        + 1e4 * (published_value.curvature**2 + published_value.gradient**2)
    )
    return {
        "stations": stations,
        "segments": count,
        "method": method,
        "published J": value,
        "length %": 100 * (found.length / targets.length - 1),
        "drop %": 100 * (found.drop / targets.drop - 1),
        "iterations": solution.nit,
        "evaluations": solution.nfev,
        "seconds": seconds,
    }


def growth(stations: int, count: int) -> Row:
    """Time segmentation and pgd for one size."""
    points, _ = made_track(stations, count)
    polyline = polyline_from_points(points)[0]
    fit, centreline = best_of(1, lambda: fit_centreline(polyline, FitSettings()))
    find, segments = best_of(1, lambda: detect_segments(centreline, SegmentationSettings()))
    drop = 0.1 * centreline.length
    targets = Targets(1.0008 * float(np.hypot(centreline.length, drop)), drop)
    solve, solution = best_of(1, lambda: finish(pgd(centreline, segments, targets)))
    return {
        "stations": stations,
        "segments found": len(segments),
        "fit s": fit,
        "detect s": find,
        "pgd s": solve,
        "pgd µs / station": 1e6 * solve / stations,
        "iterations": solution.nit,
    }


def main() -> None:
    """Print both tables."""
    rows = []
    for stations, count in SIZES:
        slow = stations > 10_000
        for method in ("pgd", "published", "L-BFGS-B", "SLSQP", "SLSQP, numeric"):
            if not (slow and method == "SLSQP, numeric"):  # some hours
                rows.append(apart(solved, method, stations, count))
        peer = next(row["seconds"] for row in reversed(rows) if row["method"].startswith("SLSQP"))
        for row in rows:
            if row["stations"] == stations:
                row["× of the last peer"] = row["seconds"] / peer
    print_table("Solvers on one made track (weights 1, 1, 1e4, 1e4)", rows)
    sizes = ((1_300, 29), (5_000, 60), (25_000, 120), (100_000, 300))
    print_table("Growth with the size of the track", [apart(growth, *size) for size in sizes])


if __name__ == "__main__":
    main()
