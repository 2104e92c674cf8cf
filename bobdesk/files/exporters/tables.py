"""The tables that BobDesk writes: the 3D line, segments, and the envelope."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from bobdesk.alignment.segments import Segments
from bobdesk.arrays import FloatArray
from bobdesk.files.exporters.csv_flavours import FLAVOURS, Flavour, text_cell, to_csv
from bobdesk.plan.traced_line import Trace
from bobdesk.solve.envelope import Envelope
from bobdesk.track.centreline3d import Centreline3D

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline

LINE_COLUMNS = (
    "station_m",
    "s_m",
    "x_m",
    "y_m",
    "z_m",
    "heading_rad",
    "gradient",
    "curvature_plan_per_m",
    "curvature_per_m",
    "segment",
    "kind",
)


def line_table(line: Centreline3D, *, flavour: str = "default") -> bytes:
    """Return LINE.csv; the flavour `xyz` holds x, y and z alone."""
    chosen = FLAVOURS[flavour]
    if flavour == "xyz":
        rows = [[f"{value:.6f}" for value in point] for point in line.points.tolist()]
        return to_csv(("x_m", "y_m", "z_m"), rows, chosen)
    # Adding 0 turns -0.0 into 0.0.
    metres = np.column_stack([line.stations, line.slope_lengths, line.points]) + 0.0
    ratios = np.column_stack([line.headings, line.gradients, line.plan_curvature, line.curvature])
    ratios = np.round(ratios, 9) + 0.0
    kinds = [segment.kind for segment in line.segments]
    table = []
    for lengths, others, segment in zip(metres.tolist(), ratios.tolist(), line.segment_of.tolist(), strict=True):
        cells = [f"{value:.6f}" for value in lengths]
        cells.extend(f"{value:.9f}" for value in others)
        table.append([*cells, str(segment + 1), kinds[segment]])
    return to_csv(LINE_COLUMNS, table, chosen)


def segments_table(centreline: Centreline, segments: Segments, *, flavour: Flavour | None = None) -> bytes:
    """Return SEGMENTS.csv; a straight has no radius, and names and locks have columns only where there are any."""
    from bobdesk.alignment.segment_figures import segment_figures  # here, for it needs scipy

    chosen = flavour or FLAVOURS["default"]
    marked = any(segment.name or segment.locked for segment in segments)
    rows = []
    for number, segment in enumerate(segments, 1):
        found = segment_figures(centreline, segment)
        radius = "" if found.radius is None or not math.isfinite(found.radius) else f"{found.radius:.3f}"
        rows.append(
            [str(number), segment.kind, f"{segment.start:.3f}", f"{segment.end:.3f}", radius, f"{found.turn:.6f}"]
        )
        if marked:
            rows[-1] += [text_cell(segment.name, chosen), "yes" if segment.locked else ""]
    header = ("segment", "kind", "from_m", "to_m", "radius_m", "turn_rad")
    return to_csv((*header, "name", "locked") if marked else header, rows, chosen)


def trace_table(metres: FloatArray, trace: Trace) -> bytes:
    """Return PLAN.csv of a trace: metres, pixels, and how sure each point is."""
    columns = np.column_stack([metres, trace.points, trace.confidence]) + 0.0
    rows = [
        [f"{x:.4f}", f"{y:.4f}", f"{px:.3f}", f"{py:.3f}", f"{sure:.3f}"] for x, y, px, py, sure in columns.tolist()
    ]
    return to_csv(("x_m", "y_m", "px", "py", "confidence"), rows, FLAVOURS["default"])


def envelope_table(band: Envelope) -> bytes:
    """Return E.csv."""
    rows = [
        [f"{value:.6f}" for value in row]
        for row in np.column_stack([band.stations, band.lowest, band.highest]).tolist()
    ]
    return to_csv(("station_m", "z_min_m", "z_max_m"), rows, FLAVOURS["default"])
