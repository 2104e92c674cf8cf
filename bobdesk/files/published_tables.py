"""Read the paper's tables, and write them beside ours."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.errors import InputError
from bobdesk.files.exporters.csv_flavours import FLAVOURS, text_cell, to_csv
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.track.published_study import METHODS, ComparedRow, PlanSource, PublishedFigures, PublishedRow, Remade

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline
    from bobdesk.alignment.segments import Segments

# Table 1 and the tables of the height weight do not name the number of segments: their figures are those of
# these rows of the tables by number of segments, or stand nearest to them.
_SEGMENTS = {"Whistler": 33, "Cesana": 21, "Nagano": 15, "Pyeongchang": 22}
# "tracks with real 2D centerline data (Whistler and Cesana tracks) and scaled 2D data (Nagano and Pyeongchang tracks)"
_SCALED = ("Nagano", "Pyeongchang")


def read_published(path: Path) -> tuple[PublishedRow, ...]:
    """Return every generated track of the paper, in the order of its tables.

    Raises
    ------
    InputError
        If the file cannot be used.
    """
    try:
        content = json.loads(path.read_bytes())
        return tuple(_rows(content))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: these are not the published tables: {error}") from error


def _rows(content: dict[str, Any]) -> list[PublishedRow]:
    actual = {track: _figures(row) for track, row in content["actual"].items()}
    found = [
        PublishedRow("table 1", track, _SEGMENTS[track], 1.0, actual[track], _figures(row), track in _SCALED)
        for track, row in content["table_1"].items()
    ]
    found += [
        PublishedRow("table 2", track, _SEGMENTS[track], 1.0, actual[track], _figures(row), True)
        for track, row in content["table_2_scaled_90_percent"].items()
    ]
    for track, rows in content["by_segment_count"].items():
        found += [
            PublishedRow("segments", track, int(count), 1.0, actual[track], _figures(row), track in _SCALED)
            for count, row in rows.items()
        ]
    for track, rows in content["by_height_weight_b"].items():
        found += [
            PublishedRow(
                "height weight", track, _SEGMENTS[track], float(b), actual[track], _figures(row), track in _SCALED
            )
            for b, row in rows.items()
        ]
    return found


def _figures(row: dict[str, Any]) -> PublishedFigures:
    return PublishedFigures(
        row["length_m"],
        row["height_difference_m"],
        row["mean_curvature_difference_per_m"],
        row["max_gradient"],
        row["mean_gradient"],
    )


def plan_source(line: ImportedLine) -> PlanSource:
    """Return a real plan as the tables are made again from it: divided into as many segments as a row asks for."""
    return partial(_segmented, fit_centreline(line.polyline))


def _segmented(plan: Centreline, count: int) -> tuple[Centreline, Segments]:
    return plan, detect_segments(plan, SegmentationSettings(count=count))


_FIGURES = (
    "length_m",
    "drop_m",
    "mean_gradient",
    "max_gradient",
    "curvature_difference_per_m",
    "length_percent",
    "drop_percent",
    "mean_gradient_percent",
)


def published_table(rows: Sequence[ComparedRow]) -> bytes:
    """Return one row for each of the paper's: targets, the paper's figures and deviations, and ours."""
    header = ["table", "track", "segments", "height_weight", "scale_unknown", "plan_length_m"]
    header += ["actual_length_m", "actual_drop_m", "actual_mean_gradient", "actual_max_gradient"]
    header += [f"paper_{name}" for name in _FIGURES]
    for method in METHODS:
        header += [*(f"{method}_{name}" for name in _FIGURES), f"{method}_scale", f"{method}_message"]
    return to_csv(header, [_cells(row) for row in rows], FLAVOURS["default"])


def deviations_of(row: PublishedRow, length: float, drop: float, mean_gradient: float) -> tuple[float, float, float]:
    """Return the deviations of length, height difference and mean gradient from the actual track, %."""
    wanted = (row.actual.length, row.actual.drop, row.actual.mean_gradient)
    first, second, third = (
        100 * (value / target - 1) for value, target in zip((length, drop, mean_gradient), wanted, strict=True)
    )
    return first, second, third


def ours_of(row: PublishedRow, ours: Remade) -> tuple[float, float, float] | None:
    """Return the deviations of one of our methods, %, or None where it failed."""
    if ours.found is None:
        return None
    return deviations_of(row, ours.found.length, ours.found.drop, ours.mean_gradient)


def _cells(compared: ComparedRow) -> list[str]:
    row = compared.row
    actual, paper = row.actual, row.generated
    cells = [row.table, row.track, str(row.segments), f"{row.height_weight:g}", "yes" if row.scaled else "no"]
    cells += [f"{compared.plan:.3f}", f"{actual.length:g}", f"{actual.drop:g}"]
    cells += [f"{actual.mean_gradient:g}", f"{actual.max_gradient:g}"]
    cells += [f"{paper.length:g}", f"{paper.drop:g}", f"{paper.mean_gradient:g}", f"{paper.max_gradient:g}"]
    cells += ["" if paper.curvature_difference is None else f"{paper.curvature_difference:g}"]
    cells += [f"{value:.3f}" for value in deviations_of(row, paper.length, paper.drop, paper.mean_gradient)]
    for ours in compared.ours:
        off, found = ours_of(row, ours), ours.found
        if off is None or found is None:
            cells += [""] * (len(_FIGURES) + 1)
        else:
            cells += [f"{found.length:.3f}", f"{found.drop:.3f}", f"{ours.mean_gradient:.6f}"]
            cells += [f"{found.max_gradient:.4f}", f"{found.mean_curvature_difference:.6f}"]
            cells += [f"{round(value, 3) + 0.0:.3f}" for value in off]
            cells.append(f"{ours.scale:.5f}")
        cells.append(text_cell(ours.message, FLAVOURS["default"]))
    return cells
