"""The band, the advice where to measure, and the error budget: seconds, and how good they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import envelope, grid_of, smooth_envelope
from bobdesk.solve.next_elevation import next_elevation
from bobdesk.solve.profile_sampling import sample_profiles
from bobdesk.solve.targets import KnownElevation, Targets
from tests.benchmarks.measure import Row, best_of
from tests.solve.made_plans import REAL_LINES, RealLine, plan_of, real_line, run_pgd
from tests.track.made_truth import covered, made_truth

TRACKS = 40


def band_rows() -> list[Row]:
    """Time the bands of a track of 1,500 m on a grid of 10 m."""
    targets = Targets(1510.0, 120.0, known=(KnownElevation(400.0, 80.0), KnownElevation(900.0, 40.0, 1.0)))
    anchors = anchors_of(targets, 1500.0)
    grid = grid_of(anchors)
    jobs = {
        "band, limits alone": lambda: envelope(grid, anchors, targets),
        "band, change of gradient bounded": lambda: finish(smooth_envelope(anchors, targets, largest_change=0.002)),
        "where one more elevation helps": lambda: finish(next_elevation(anchors, targets)),
        "200 profiles at random": lambda: finish(sample_profiles(anchors, targets)),
        "200 smooth profiles at random": lambda: finish(sample_profiles(anchors, targets, largest_change=0.002)),
    }
    return [{"what": name, "ms": 1000 * best_of(3, job)[0]} for name, job in jobs.items()]


def advice_rows() -> list[Row]:
    """Compare three advised known elevations with three evenly spaced ones, RMS of z in % of the drop."""
    lines = {name: real_line(name) for name in REAL_LINES}
    for seed in range(12):
        truth = made_truth(seed)
        lines[f"made {seed}"] = RealLine(truth.stations, truth.plan, truth.elevations)
    found: list[Row] = []
    for name, true in lines.items():
        centreline, segments = plan_of(true.plan)
        targets = true.targets()
        stations = []
        for _ in range(3):
            line = run_pgd(centreline, segments, targets).line
            anchors = anchors_of(targets, centreline.length)
            advice = finish(next_elevation(anchors, targets, estimate=(line.stations, line.elevations)))
            at = advice.station / centreline.length * true.stations[-1]
            item = KnownElevation(advice.station, float(np.interp(at, true.stations, true.elevations)))
            targets = replace(targets, known=(*targets.known, item))
            stations.append(round(advice.station))
        even = true.rms_percent(run_pgd(centreline, segments, true.targets(known=3)).line)
        advised = true.rms_percent(run_pgd(centreline, segments, targets).line)
        none = true.rms_percent(run_pgd(centreline, segments, true.targets()).line)
        found.append({"line": name, "none": none, "3 evenly": even, "3 advised": advised, "at m": stations})
    real = len(REAL_LINES)
    return [*found[:real], _summed("real", found[:real]), *found[real:], _summed("made", found[real:])]


def _summed(kind: str, rows: list[Row]) -> Row:
    ratio = float(np.exp(np.mean([np.log(row["3 advised"] / row["3 evenly"]) for row in rows])))
    better = sum(row["3 advised"] < 0.999 * row["3 evenly"] for row in rows)
    worse = sum(row["3 advised"] > 1.001 * row["3 evenly"] for row in rows)
    return {"line": f"{kind}: {better} better, {worse} worse", "3 advised": ratio, "at m": "mean ratio"}


def coverage_rows() -> list[Row]:
    """Return how often the truth of made tracks lies in the 95 % bands of the error budget."""
    found: list[Row] = []
    for name, conditions in (
        ("plan, length, drop", {}),
        ("and 3 known elevations", {"known": 3}),
        ("scale unknown", {"unknown_scale": True}),
    ):
        shares = np.mean([covered(seed, **conditions)[1:] for seed in range(TRACKS)], axis=0)
        length, z, gradient = (100 * shares).tolist()
        found.append({"given": name, "tracks": TRACKS, "plan length %": length, "z %": z, "gradient %": gradient})
    return found
