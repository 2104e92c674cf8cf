"""Tables of what the data leave open: the error budget, its bands, the methods side by side, studies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from bobdesk.files.exporters.csv_flavours import FLAVOURS, text_cell, to_csv
from bobdesk.track.error_budget import ErrorBudget
from bobdesk.track.method_comparison import MethodRow
from bobdesk.track.missed import missed_text
from bobdesk.track.study import STUDY_COLUMNS, percent_text

_FLAVOUR = FLAVOURS["default"]
_WORDS = ("plan", "method", "known", "status", "missed", "message")


def budget_table(budget: ErrorBudget, *, flavour: str = "default") -> bytes:
    """Return one row a source: half widths of 95 % bands."""
    written = FLAVOURS[flavour]
    rows = [
        [
            text_cell(share.source, written),
            f"{share.plan_length:.4f}",
            f"{share.scale:.6f}",
            f"{share.elevation:.4f}",
            f"{share.gradient:.6f}",
        ]
        for share in budget.shares
    ]
    return to_csv(("source", "plan_length_m", "scale", "elevation_rms_m", "gradient_rms"), rows, written)


def error_band_table(budget: ErrorBudget) -> bytes:
    """Return elevation and gradient with the half widths of their 95 % bands, one row a station."""
    line = budget.line
    columns = np.column_stack([budget.stations, line.elevations, budget.elevation]) + 0.0
    ratios = np.column_stack([line.gradients, budget.gradient]).round(6) + 0.0
    rows = [
        [*(f"{value:.4f}" for value in metres), *(f"{value:.6f}" for value in others)]
        for metres, others in zip(columns.tolist(), ratios.tolist(), strict=True)
    ]
    return to_csv(("station_m", "z_m", "z_error_m", "gradient", "gradient_error"), rows, _FLAVOUR)


def methods_table(rows: Sequence[MethodRow]) -> bytes:
    """Return one row a method; figures that a failed one has not are empty."""
    header = (
        "method",
        "status",
        "missed",
        "objective",
        "length_m",
        "drop_m",
        "length_percent",
        "drop_percent",
        "mean_gradient_percent",
        "max_gradient",
        "iterations",
        "evaluations",
        "seconds",
        "message",
    )
    return to_csv(header, [_method_cells(row) for row in rows], _FLAVOUR)


def study_table(rows: Sequence[Sequence[str]]) -> bytes:
    """Return the rows of a study, one a cell."""
    return to_csv(STUDY_COLUMNS, [_study_cells(row) for row in rows], _FLAVOUR)


def _study_cells(row: Sequence[str]) -> list[str]:
    # Figures may be negative: guarded against formulas they would be text to a spreadsheet.
    return [
        text_cell(cell, _FLAVOUR) if name in _WORDS else cell for name, cell in zip(STUDY_COLUMNS, row, strict=True)
    ]


def _method_cells(row: MethodRow) -> list[str]:
    figures = [""] * 7
    if row.found is not None and row.off is not None:
        mean = row.off.mean_gradient
        figures = [
            f"{row.objective:.6g}",
            f"{row.found.length:.4f}",
            f"{row.found.drop:.4f}",
            percent_text(row.off.length),
            percent_text(row.off.drop),
            "" if mean is None else percent_text(mean),
            f"{row.found.max_gradient:.6f}",
        ]
    effort = [str(row.iterations), str(row.evaluations), f"{row.seconds:.4f}"]
    verdict = [row.verdict, text_cell(missed_text(row.missed), _FLAVOUR)]
    return [text_cell(row.method, _FLAVOUR), *verdict, *figures, *effort, text_cell(row.message, _FLAVOUR)]
