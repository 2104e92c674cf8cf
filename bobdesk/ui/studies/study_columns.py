"""The columns of a study's rows on the screen."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication

from bobdesk.track.missed import MET_WITHIN
from bobdesk.track.study_choices import NO_SET
from bobdesk.track.study_pivot import Row, label_of, number_of, value_of
from bobdesk.ui.plots.study_drawings import number_text
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.studies.rows_table import RowsColumn


def study_columns(unit: Quantities) -> tuple[RowsColumn, ...]:
    """Return the columns; a cell that failed has no figures."""

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
        return QCoreApplication.translate("StudyColumns", "none") if text == NO_SET else text

    def status(row: Row) -> str:
        return {
            "met": "✓ " + QCoreApplication.translate("StudyColumns", "met"),
            "not met": "! " + unit.sentence(value_of(row, "missed")),
            "failed": QCoreApplication.translate("StudyColumns", "failed"),
        }.get(value_of(row, "status"), value_of(row, "status"))

    def segments(row: Row) -> str:
        found = value_of(row, "segments")
        return found or label_of(row, "segments")

    return (
        words(
            QCoreApplication.translate("StudyColumns", "Plan"),
            QCoreApplication.translate("StudyColumns", "Which plan"),
            lambda row: value_of(row, "plan"),
        ),
        RowsColumn(
            lambda: QCoreApplication.translate("StudyColumns", "Segments"),
            QCoreApplication.translate("StudyColumns", "How many segments"),
            segments,
            lambda row: int(segments(row)) if segments(row).isdecimal() else None,
        ),
        figure(
            lambda: "b",
            QCoreApplication.translate("StudyColumns", "Height weight of the published objective"),
            "height_weight",
            number_text,
        ),
        words(
            QCoreApplication.translate("StudyColumns", "Method"),
            QCoreApplication.translate("StudyColumns", "How it was solved"),
            lambda row: value_of(row, "method"),
        ),
        words(
            QCoreApplication.translate("StudyColumns", "Known"),
            QCoreApplication.translate("StudyColumns", "Known elevations besides the plan's own"),
            known,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Length %"),
            QCoreApplication.translate("StudyColumns", "Deviation of the length from its target"),
            "length_percent",
            percent,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Drop %"),
            QCoreApplication.translate("StudyColumns", "Deviation of the height difference from its target"),
            "drop_percent",
            percent,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Mean %"),
            QCoreApplication.translate("StudyColumns", "Deviation of the mean gradient from its target"),
            "mean_gradient_percent",
            percent,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Max") + " " + unit.gradient_unit,
            QCoreApplication.translate("StudyColumns", "Largest gradient"),
            "max_gradient",
            lambda value: unit.gradient(value, unit=False),
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "z RMS") + " " + unit.length_unit,
            QCoreApplication.translate("StudyColumns", "Error of the elevation against the actual track"),
            "z_rms_m",
            length,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Objective J"),
            QCoreApplication.translate("StudyColumns", "The published objective; it counts rises like falls"),
            "objective",
            number_text,
        ),
        figure(
            lambda: "f",
            QCoreApplication.translate("StudyColumns", "Factor from the plan to true size"),
            "scale",
            lambda value: unit.number(value, 5),
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Length") + " " + unit.length_unit,
            QCoreApplication.translate("StudyColumns", "3D length"),
            "length_m",
            length,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Drop") + " " + unit.length_unit,
            QCoreApplication.translate("StudyColumns", "Height difference"),
            "drop_m",
            length,
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Iterations"),
            QCoreApplication.translate("StudyColumns", "How many iterations it took"),
            "iterations",
            lambda value: unit.number(value, 0),
        ),
        figure(
            lambda: QCoreApplication.translate("StudyColumns", "Evaluations"),
            QCoreApplication.translate("StudyColumns", "How often the objective was worked out"),
            "evaluations",
            lambda value: unit.number(value, 0),
        ),
        words(
            QCoreApplication.translate("StudyColumns", "Targets"),
            QCoreApplication.translate(
                "StudyColumns", "Whether the line meets the targets within {within} %, whatever its method says"
            ).format(within=unit.short(100 * MET_WITHIN)),
            status,
        ),
        words(
            QCoreApplication.translate("StudyColumns", "End"),
            QCoreApplication.translate("StudyColumns", "Why it ended, as the method sees it"),
            lambda row: value_of(row, "message"),
        ),
    )
