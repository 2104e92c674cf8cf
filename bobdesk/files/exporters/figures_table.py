"""The figures of a line as a table, and those of its segments below."""

from __future__ import annotations

from bobdesk.files.exporters.csv_flavours import FLAVOURS, text_cell, to_csv
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.figures import figures


def to_figures_table(line: Centreline3D, *, flavour: str = "default") -> bytes:
    """Return the columns figure, value, unit, segment, kind, name, one figure a row.

    A segment's name is the user's own text and written so that no spreadsheet takes it for a formula.
    """
    chosen = FLAVOURS[flavour]
    found = figures(line)
    rows = [
        _row("length", f"{found.length:.6f}", "m"),
        _row("drop", f"{found.drop:.6f}", "m"),
        _row("plan_length", f"{found.plan_length:.6f}", "m"),
        _row("mean_gradient_drop_per_length", f"{found.mean_gradient_drop_per_length:.9f}", "1"),
        _row("mean_gradient_drop_per_plan", f"{found.mean_gradient_drop_per_plan:.9f}", "1"),
        _row("mean_gradient_segments", f"{found.mean_gradient_segments:.9f}", "1"),
        _row("max_gradient", f"{found.max_gradient:.9f}", "1"),
        _row("min_gradient", f"{found.min_gradient:.9f}", "1"),
        _row("mean_curvature_difference", f"{found.mean_curvature_difference:.9f}", "1/m"),
    ]
    for number, segment in enumerate(line.segments, 1):
        about = [str(number), segment.kind, text_cell(segment.name, chosen)]
        gradient = float(line.segment_gradients[number - 1])
        for figure, value, unit in (
            ("segment_from", f"{segment.start:.6f}", "m"),
            ("segment_to", f"{segment.end:.6f}", "m"),
            ("segment_gradient", f"{gradient:.9f}", "1"),
        ):
            rows.append([figure, value, unit, *about])
    return to_csv(("figure", "value", "unit", "segment", "kind", "name"), rows, chosen)


def _row(figure: str, value: str, unit: str) -> list[str]:
    return [figure, value, unit, "", "", ""]
