"""The columns of the published tables made again."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication

from bobdesk.files.published_tables import deviations_of, ours_of
from bobdesk.track.published_study import METHODS, ComparedRow, Remade
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.studies.rows_table import RowsColumn

_DIGITS = 3
_FIGURES = 3


def published_columns(unit: Quantities) -> tuple[RowsColumn, ...]:
    """Return the columns: the paper's row, its deviations, those of the published method here, and ours."""
    named = (
        (
            QCoreApplication.translate("PublishedColumns", "Paper"),
            QCoreApplication.translate("PublishedColumns", "what the paper publishes"),
        ),
        (
            QCoreApplication.translate("PublishedColumns", "Published"),
            QCoreApplication.translate("PublishedColumns", "the published method, run here"),
        ),
        (
            QCoreApplication.translate("PublishedColumns", "pgd"),
            QCoreApplication.translate("PublishedColumns", "the recommended method"),
        ),
    )
    figures = (
        (
            QCoreApplication.translate("PublishedColumns", "length %"),
            QCoreApplication.translate("PublishedColumns", "Deviation of the length from the actual track's"),
        ),
        (
            QCoreApplication.translate("PublishedColumns", "drop %"),
            QCoreApplication.translate(
                "PublishedColumns", "Deviation of the height difference from the actual track's"
            ),
        ),
        (
            QCoreApplication.translate("PublishedColumns", "mean %"),
            QCoreApplication.translate(
                "PublishedColumns", "Deviation of the mean gradient (over the segments) from the actual track's"
            ),
        ),
    )

    def number(
        heading: str, tip: str, value: Callable[[ComparedRow], float | None], digits: int = _DIGITS
    ) -> RowsColumn:
        def text(row: ComparedRow) -> str:
            found = value(row)
            return "" if found is None else unit.number(found, digits)

        return RowsColumn(lambda: heading, tip, text, value)

    def words(heading: str, tip: str, text: Callable[[ComparedRow], str]) -> RowsColumn:
        return RowsColumn(lambda: heading, tip, text, is_number=False)

    deviations = tuple(
        number(f"{who}\n{figure}", f"{tip}: {long}", _deviation(source, at))
        for source, (who, long) in enumerate(named)
        for at, (figure, tip) in enumerate(figures)
    )
    scales = tuple(
        number(
            f"{named[1 + at][0]}\nf",
            QCoreApplication.translate("PublishedColumns", "Scale factor that was found, where the plan has no scale"),
            _scale(at),
            4,
        )
        for at in range(len(METHODS))
    )
    return (
        words(
            QCoreApplication.translate("PublishedColumns", "Table"),
            QCoreApplication.translate("PublishedColumns", "Of the paper"),
            lambda row: {
                "segments": QCoreApplication.translate("PublishedColumns", "by segments"),
                "height weight": QCoreApplication.translate("PublishedColumns", "by height weight"),
            }.get(row.row.table, row.row.table),
        ),
        words(
            QCoreApplication.translate("PublishedColumns", "Track"),
            QCoreApplication.translate("PublishedColumns", "Which track"),
            lambda row: row.row.track,
        ),
        number(
            QCoreApplication.translate("PublishedColumns", "Segments"),
            QCoreApplication.translate("PublishedColumns", "How many segments"),
            lambda row: row.row.segments,
            0,
        ),
        number(
            "b", QCoreApplication.translate("PublishedColumns", "Height weight"), lambda row: row.row.height_weight, 1
        ),
        *deviations,
        *scales,
        RowsColumn(
            lambda: QCoreApplication.translate("PublishedColumns", "Plan") + " " + unit.length_unit,
            QCoreApplication.translate(
                "PublishedColumns", "Length of the plan that was used; of the drawing, where it has no scale"
            ),
            lambda row: unit.length(row.plan, 1, unit=False),
            lambda row: row.plan,
        ),
        words(
            QCoreApplication.translate("PublishedColumns", "End of pgd"),
            QCoreApplication.translate("PublishedColumns", "What cannot be met, and by how much"),
            lambda row: _of(row, 1).message,
        ),
    )


def problem_of(row: ComparedRow) -> str:
    """Return why a method failed on a row; "" where none did."""
    return "; ".join(f"{ours.method}: {ours.message}" for ours in row.ours if ours.found is None)


def _of(row: ComparedRow, method: int) -> Remade:
    return row.ours[method]


def _deviation(source: int, figure: int) -> Callable[[ComparedRow], float | None]:
    """Return a function for a figure's deviation: of the paper (0), or of our methods (1 on)."""

    def value(row: ComparedRow) -> float | None:
        if source == 0:
            paper = row.row.generated
            return deviations_of(row.row, paper.length, paper.drop, paper.mean_gradient)[figure]
        found = ours_of(row.row, _of(row, source - 1))
        return None if found is None else found[figure]

    return value


def _scale(method: int) -> Callable[[ComparedRow], float | None]:
    return lambda row: _of(row, method).scale if row.row.scaled and _of(row, method).found is not None else None
