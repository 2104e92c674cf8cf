"""The columns of the methods side by side."""

from __future__ import annotations

import math
from collections.abc import Callable

from PySide6.QtCore import QCoreApplication

from bobdesk.files.method_run import MethodResult
from bobdesk.track.missed import MET_WITHIN, missed_text
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.studies.rows_table import RowsColumn

_PERCENT_DIGITS = 4


def methods_columns(unit: Quantities, title_of: Callable[[MethodResult], str]) -> tuple[RowsColumn, ...]:
    """Return the columns; failed methods have figures in none."""

    def number(
        heading: str, tip: str, value: Callable[[MethodResult], float | None], show: Callable[[float], str]
    ) -> RowsColumn:
        def key(result: MethodResult) -> float | None:
            found = value(result)
            return None if found is None or not math.isfinite(found) else found

        def text(result: MethodResult) -> str:
            found = key(result)
            return "" if found is None else show(found)

        return RowsColumn(lambda: heading, tip, text, key)

    def off(name: str) -> Callable[[MethodResult], float | None]:
        return lambda result: None if result.row.off is None else getattr(result.row.off, name)

    def percent(value: float) -> str:
        return unit.number(value, _PERCENT_DIGITS)

    def whole(value: float) -> str:
        return unit.number(value, 0)

    def verdict(result: MethodResult) -> str:
        row = result.row
        if row.verdict == "met":
            return "✓ " + QCoreApplication.translate("MethodsColumns", "met")
        return "! " + unit.sentence(missed_text(row.missed)) if row.missed else ""

    return (
        RowsColumn(
            lambda: QCoreApplication.translate("MethodsColumns", "Method"),
            QCoreApplication.translate("MethodsColumns", "How the gradients were found"),
            title_of,
            is_number=False,
        ),
        RowsColumn(
            lambda: QCoreApplication.translate("MethodsColumns", "Targets"),
            QCoreApplication.translate(
                "MethodsColumns", "Whether the line meets the targets within {within} %, whatever its method says"
            ).format(within=unit.short(100 * MET_WITHIN)),
            verdict,
            is_number=False,
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Objective J"),
            QCoreApplication.translate(
                "MethodsColumns",
                "The published objective, whatever the method itself makes small; it counts rises like falls",
            ),
            lambda result: result.row.objective,
            lambda value: unit.short(value, 4),
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Length %"),
            QCoreApplication.translate("MethodsColumns", "Deviation of the length from its target"),
            off("length"),
            percent,
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Drop %"),
            QCoreApplication.translate("MethodsColumns", "Deviation of the height difference from its target"),
            off("drop"),
            percent,
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Mean gradient %"),
            QCoreApplication.translate(
                "MethodsColumns", "Deviation of the mean gradient from its target, where it is one"
            ),
            off("mean_gradient"),
            percent,
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Iterations"),
            QCoreApplication.translate("MethodsColumns", "How many iterations it took"),
            lambda result: result.row.iterations,
            whole,
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Evaluations"),
            QCoreApplication.translate("MethodsColumns", "How often the objective was worked out"),
            lambda result: result.row.evaluations,
            whole,
        ),
        number(
            QCoreApplication.translate("MethodsColumns", "Time s"),
            QCoreApplication.translate("MethodsColumns", "Seconds on this computer"),
            lambda result: result.row.seconds,
            lambda value: unit.number(value, 3),
        ),
        RowsColumn(
            lambda: QCoreApplication.translate("MethodsColumns", "End"),
            QCoreApplication.translate("MethodsColumns", "Why it ended, as the method sees it"),
            lambda result: result.row.message,
            is_number=False,
        ),
    )
