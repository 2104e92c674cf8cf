"""Seconds and memory of a trace by size of the picture, beside scikit-image's MCP on the same cost.

Run as ``python -m tests.benchmarks.tracing``.  The peer gets what our cheapest path gets, the ridge cost of
the work copy, and nothing else of the work; the rest of our time is the copy, the ridge and the fit.
"""

from __future__ import annotations

import multiprocessing
import resource
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from bobdesk.plan.cheapest_path import cheapest_path
from bobdesk.plan.ridge import step_cost
from bobdesk.plan.rough_way import rough_way
from bobdesk.plan.stages import at_once
from bobdesk.plan.trace import trace_line
from bobdesk.plan.work_copy import work_copy
from tests.benchmarks.measure import Row, print_table
from tests.plan.drawn_lines import Style, draw, random_track

SIZES = (2, 5, 10, 20, 40)


def _peak() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def drawing(path: Path, *, megapixels: float) -> None:
    """Write one drawn plan of this size, and its clicks, to `path`."""
    drawn = draw(random_track(1, curves=12), Style(width=2.0, grid=(190, 190, 190), noise=4), seed=1)
    factor = (megapixels * 1e6 / (drawn.pixels.shape[0] * drawn.pixels.shape[1])) ** 0.5
    size = (round(drawn.pixels.shape[1] * factor), round(drawn.pixels.shape[0] * factor))
    pixels = np.asarray(Image.fromarray(drawn.pixels).resize(size, Image.Resampling.BICUBIC))
    np.savez(path, pixels=pixels, clicks=(drawn.track[[0, -1]] + 0.5) * factor - 0.5)


def row(path: Path) -> Row:
    """Trace the plan at `path`; call in a fresh process for an honest peak."""
    with np.load(path) as plan:
        pixels, clicks = plan["pixels"], plan["clicks"]
    megapixels = pixels.shape[0] * pixels.shape[1] / 1e6
    loaded = _peak()
    wall, processor, longest = time.perf_counter(), time.process_time(), 0.0
    job = trace_line(pixels, clicks)
    while True:
        before = time.process_time()
        try:
            next(job)
        except StopIteration:
            break
        longest = max(longest, time.process_time() - before)
    result: Row = {
        "megapixels": megapixels,
        "seconds": time.perf_counter() - wall,
        "cpu_seconds": time.process_time() - processor,
        "longest_step_seconds": longest,
        "peak_mb": _peak(),
        "mb_per_megapixel": (_peak() - loaded) / megapixels,
    }
    copy = at_once(work_copy(pixels))
    score = at_once(rough_way(copy, copy.to_copy(clicks), reach=7.0, line="auto")).score
    cost = step_cost(score)
    ends = [(int(row), int(column)) for column, row in copy.to_copy(clicks)]
    before = time.process_time()
    at_once(cheapest_path(cost, score, ends))
    result["path_cpu_seconds"] = time.process_time() - before
    result["skimage_path_cpu_seconds"] = _peer(cost, ends)
    return result


def _peer(cost: Any, ends: list[tuple[int, int]]) -> float:
    """CPU seconds of MCP_Geometric from the first to the last of `ends`, or nan without scikit-image."""
    try:
        from skimage.graph import MCP_Geometric
    except ImportError:
        return float("nan")
    before = time.process_time()
    search = MCP_Geometric(cost.astype(np.float64))
    search.find_costs([ends[0]], [ends[-1]])
    search.traceback(ends[-1])
    return time.process_time() - before


def rows() -> list[Row]:
    """One row for each of SIZES, each measured in its own process."""
    context = multiprocessing.get_context("spawn")
    with tempfile.TemporaryDirectory() as folder, context.Pool(1, maxtasksperchild=1) as pool:
        table = []
        for size in SIZES:
            path = Path(folder) / f"{size}.npz"
            pool.apply(drawing, (path,), {"megapixels": size})
            table.append(pool.apply(row, (path,)))
        return table


if __name__ == "__main__":
    print_table("Tracing, by size of the picture", rows())
