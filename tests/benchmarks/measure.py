"""Seconds and peak memory of a call, each in a process of its own, and a table of rows."""

from __future__ import annotations

import multiprocessing
import resource
import time
from collections.abc import Callable
from typing import Any

Row = dict[str, Any]


def apart(function: Callable[..., Row], *arguments: Any) -> Row:
    """Call in a fresh process and add its peak memory, so that one row does not sit on another's."""
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        return pool.apply(_measured, (function, arguments))


def _measured(function: Callable[..., Row], arguments: tuple[Any, ...]) -> Row:
    row = function(*arguments)
    row["peak MB"] = round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    return row


def best_of(count: int, call: Callable[[], Any]) -> tuple[float, Any]:
    """Return the shortest of some wall times, s, and the last result."""
    best, result = float("inf"), None
    for _ in range(count):
        start = time.perf_counter()
        result = call()
        best = min(best, time.perf_counter() - start)
    return best, result


def print_table(title: str, rows: list[Row]) -> None:
    """Print rows under their names, aligned."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    cells = [names] + [[_text(row.get(name, "")) for name in names] for row in rows]
    widths = [max(len(row[column]) for row in cells) for column in range(len(names))]
    print(f"\n{title}")
    for row in cells:
        print("  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True)))


def _text(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
