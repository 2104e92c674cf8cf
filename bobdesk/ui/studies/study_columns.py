"""The columns of a study's rows on the screen."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication

from bobdesk.track.study_choices import NO_SET
from bobdesk.track.study_pivot import Row, label_of, number_of, value_of
from bobdesk.ui.plots.study_drawings import number_text
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.studies.rows_table import RowsColumn


def study_columns(unit: Quantities) -> tuple[RowsColumn, ...]:
    """Return the columns; a cell that failed has no figures."""
    tr = QCoreApplication.translate

    def figure(heading: Callable[[], str], tip: str, column: str, show: Callable[[float], str]) -> RowsColumn:
        def text(row: Row) -> str:
            found = number_of(row, column)
            return "" if found is None else show(found)

        return RowsColumn(heading, tip, text, lambda row: number_of(row, column))

    def words(heading: str, tip: str, text: Callable[[Row], str]) -> RowsColumn:
        return RowsColumn(lambda: heading, tip, text, is_number=False)

    def length(value: float) -> str:
        return unit.length(value, 2, unit=False)

    def percent(value: float) -> str:
        return unit.number(value, 4)

    def known(row: Row) -> str:
        text = value_of(row, "known")
        return tr("StudyColumns", "none") if text == NO_SET else text

    def status(row: Row) -> str:
        return {
            "met": tr("StudyColumns", "met"),
            "stopped": tr("StudyColumns", "stopped"),
            "not met": tr("StudyColumns", "not met"),
            "failed": tr("StudyColumns", "failed"),
        }.get(value_of(row, "status"), value_of(row, "status"))

    def segments(row: Row) -> str:
        found = value_of(row, "segments")
        return found or label_of(row, "segments")

    return (
        words(tr("StudyColumns", "Plan"), tr("StudyColumns", "Which plan"), lambda row: value_of(row, "plan")),
        RowsColumn(
            lambda: tr("StudyColumns", "Segments"), tr("StudyColumns", "How many segments"), segments,
            lambda row: int(segments(row)) if segments(row).isdecimal() else None,
        ),
        figure(
            lambda: "b", tr("StudyColumns", "Height weight of the published objective"), "height_weight", number_text
        ),
        words(
            tr("StudyColumns", "Method"), tr("StudyColumns", "How it was solved"), lambda row: value_of(row, "method")
        ),
        words(
            tr("StudyColumns", "Known"), tr("StudyColumns", "Known elevations besides the plan's own"), known
        ),
        figure(
            lambda: tr("StudyColumns", "Length %"),
            tr("StudyColumns", "Deviation of the length from its target"), "length_percent", percent,
        ),
        figure(
            lambda: tr("StudyColumns", "Drop %"),
            tr("StudyColumns", "Deviation of the height difference from its target"), "drop_percent", percent,
        ),
        figure(
            lambda: tr("StudyColumns", "Mean %"),
            tr("StudyColumns", "Deviation of the mean gradient from its target"), "mean_gradient_percent", percent,
        ),
        figure(
            lambda: tr("StudyColumns", "Max") + " " + unit.gradient_unit, tr("StudyColumns", "Largest gradient"),
            "max_gradient", lambda value: unit.gradient(value, unit=False),
        ),
        figure(
            lambda: tr("StudyColumns", "z RMS") + " " + unit.length_unit,
            tr("StudyColumns", "Error of the elevation against the actual track"), "z_rms_m", length,
        ),
        figure(
            lambda: tr("StudyColumns", "Objective J"), tr("StudyColumns", "The published objective"), "objective",
            number_text,
        ),
        figure(lambda: "f", tr("StudyColumns", "Factor from the plan to true size"), "scale",
               lambda value: unit.number(value, 5)),
        figure(
            lambda: tr("StudyColumns", "Length") + " " + unit.length_unit, tr("StudyColumns", "3D length"), "length_m",
            length,
        ),
        figure(
            lambda: tr("StudyColumns", "Drop") + " " + unit.length_unit, tr("StudyColumns", "Height difference"),
            "drop_m", length,
        ),
        figure(
            lambda: tr("StudyColumns", "Iterations"), tr("StudyColumns", "How many iterations it took"), "iterations",
            lambda value: unit.number(value, 0),
        ),
        figure(
            lambda: tr("StudyColumns", "Evaluations"),
            tr("StudyColumns", "How often the objective was worked out"), "evaluations",
            lambda value: unit.number(value, 0),
        ),
        words(tr("StudyColumns", "Targets"), tr("StudyColumns", "Whether the targets are met"), status),
        words(tr("StudyColumns", "End"), tr("StudyColumns", "Why it ended"), lambda row: value_of(row, "message")),
    )  # fmt: skip
