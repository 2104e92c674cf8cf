"""What is drawn of a study's rows: tables of colours and charts, with their words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QCoreApplication, QLocale

from bobdesk.track.study_choices import AUTOMATIC, NO_SET
from bobdesk.track.study_pivot import AXES, FIGURES, Curve, PivotCell, Row, curves, number_of, pivot, varied
from bobdesk.ui.plots.chart import Chart, Series
from bobdesk.ui.plots.heat_map import HeatCell, HeatMap

_NOTHING = 5e-6
_DIGITS = 4


def figure_titles() -> dict[str, str]:
    """Return the figures' names with their units."""
    return dict(
        zip(
            FIGURES,
            (
                QCoreApplication.translate("StudyDrawings", "Deviation of the length (%)"),
                QCoreApplication.translate("StudyDrawings", "Deviation of the height difference (%)"),
                QCoreApplication.translate("StudyDrawings", "Deviation of the mean gradient (%)"),
                QCoreApplication.translate("StudyDrawings", "Error of the elevation, RMS (m)"),
                QCoreApplication.translate("StudyDrawings", "Largest gradient (m/m)"),
                QCoreApplication.translate("StudyDrawings", "Mean difference of curvatures (1/m)"),
                QCoreApplication.translate("StudyDrawings", "Published objective J"),
                QCoreApplication.translate("StudyDrawings", "Scale factor f"),
                QCoreApplication.translate("StudyDrawings", "Iterations"),
                QCoreApplication.translate("StudyDrawings", "Evaluations"),
            ),
            strict=True,
        )
    )


def axis_titles() -> dict[str, str]:
    """Return the axes' names."""
    return dict(
        zip(
            AXES,
            (
                QCoreApplication.translate("StudyDrawings", "Plan"),
                QCoreApplication.translate("StudyDrawings", "Number of segments"),
                QCoreApplication.translate("StudyDrawings", "Height weight b"),
                QCoreApplication.translate("StudyDrawings", "Method"),
                QCoreApplication.translate("StudyDrawings", "Known elevations"),
            ),
            strict=True,
        )
    )


def heat_map(rows: Sequence[Row], down: Sequence[str], across: Sequence[str], figure: str, *, title: str) -> HeatMap:
    """Return a figure as a table of colours, the darker the further from zero."""
    table = pivot(rows, down, across, figure)
    worst = [abs(cell.worst) for cell in table.cells.values() if cell.worst is not None]
    low, high = min(worst, default=0.0), max(worst, default=0.0)
    return HeatMap(
        title,
        tuple(", ".join(_words(labels, down)) for labels in table.down),
        tuple(tuple(_words(labels, across)) or ("",) for labels in table.across),
        {at: _heat_cell(cell, low, high) for at, cell in table.cells.items()},
    )


def chart(rows: Sequence[Row], axis: str, figure: str, *, title: str) -> Chart:
    """Return a figure over an axis, a curve for each combination of what else is varied."""
    labels, found = curves(rows, axis, figure)
    others = [each for each in varied([row for row in rows if number_of(row, figure) is not None]) if each != axis]
    are_numbers = axis in ("segments", "height_weight") and all(_is_number(label) for label in labels)
    at = np.array([float(label) for label in labels] if are_numbers else range(len(labels)), dtype=float)
    ticks = tuple(zip(at.tolist(), (_word(label, axis, short=True) for label in labels), strict=True))
    series = tuple(_series(number, curve, at, others) for number, curve in enumerate(found))
    return Chart(title, axis_titles()[axis], figure_titles()[figure], series, ticks)


def _series(number: int, curve: Curve, at: np.ndarray, others: Sequence[str]) -> Series:
    values = [np.nan if value is None else value for value in curve.values]
    return Series(", ".join(_words(curve.name, others)), at, np.array(values), number)


def _heat_cell(cell: PivotCell, low: float, high: float) -> HeatCell:
    worst = cell.worst
    lines = []
    if len(cell.numbers) > 1:
        lines.append(
            QCoreApplication.translate(
                "StudyDrawings", "Rows in this place: {count}; the one furthest from zero is shown"
            ).format(count=len(cell.numbers))
        )
        lines.append("; ".join(number_text(number) for number in cell.numbers[:12]))
    if cell.failed:
        lines.append(
            QCoreApplication.translate("StudyDrawings", "Could not be solved: {count}").format(count=cell.failed)
        )
    if worst is None:
        text = QCoreApplication.translate("StudyDrawings", "failed") if cell.failed else "–"
        return HeatCell(text, None, "\n".join(lines))
    share = 0.0 if high <= low else (abs(worst) - low) / (high - low)
    return HeatCell(number_text(worst), share, "\n".join(lines))


def number_text(number: float) -> str:
    """Return a number with four digits that count, and with the signs of the user's country."""
    if abs(number) < _NOTHING:
        return "0"
    text = QLocale().toString(number, "g", _DIGITS)
    group = QLocale().groupSeparator()
    return text.replace(group, "").replace("-", "−") if group else text.replace("-", "−")


def _words(labels: Sequence[str], axes: Sequence[str]) -> list[str]:
    return [word for label, axis in zip(labels, axes, strict=True) if (word := _word(label, axis))]


def _word(label: str, axis: str, *, short: bool = False) -> str:
    if axis == "segments":
        if label == AUTOMATIC:
            return QCoreApplication.translate("StudyDrawings", "automatic")
        if short:
            return label
        if label == "1":
            return QCoreApplication.translate("StudyDrawings", "1 segment")
        return QCoreApplication.translate("StudyDrawings", "{count} segments").format(count=label)
    if axis == "height_weight" and label:
        number = QLocale().toString(float(label), "g", 6)
        return number if short else f"b = {number}"
    if axis == "known" and label == NO_SET:
        return (
            QCoreApplication.translate("StudyDrawings", "none known")
            if not short
            else QCoreApplication.translate("StudyDrawings", "none")
        )
    if axis == "known" and label and not short:
        return QCoreApplication.translate("StudyDrawings", "known {elevations}").format(elevations=label)
    return label


def _is_number(label: str) -> bool:
    try:
        float(label)
    except ValueError:
        return False
    return True
