"""What the list of runs shows: the paper's columns, as they are or as differences to one run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QObject, Qt

from bobdesk.project.runs import Run
from bobdesk.track.figures import Figures, deviations
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import dot
from bobdesk.ui.shown_result import ShownResult
from bobdesk.ui.solve.run_figures import actual_figures, mean_of, percent_text, signed
from bobdesk.ui.table_text import plain_number
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.headed_model import Index

OVERLAY, NAME = 0, 1
_LIMITS = {"max_gradient": "≤ ", "min_gradient": "≥ "}


@dataclass(frozen=True)
class _Figure:
    """A column of numbers.

    Attributes
    ----------
    heading, tip, unit
        Without a mark of a difference; the unit's sign, "" for a plain number.
    of_run
        In SI.
    to_shown, written
        In the user's unit, and as text.
    of_actual
        The same of the actual track's figures, None where it has none.
    target
        Name of the target or limit of it, as in `Targets`; "" where there is none.
    """

    heading: Callable[[], str]
    tip: str
    unit: Callable[[], str]
    of_run: Callable[[Run], float]
    to_shown: Callable[[float], float]
    written: Callable[[float], str]
    of_actual: Callable[[Figures], float] | None = None
    target: str = ""


class RunsModel(ColumnsModel):
    """A row for each run, then the targets, then the actual track if there is one.

    Beside a baseline every other row shows differences to it in all columns of numbers, which their headings say.

    Parameters
    ----------
    overlay, rename
        Draw a run beside the shown one, or not; give it another name. They return whether that was done.
    """

    def __init__(
        self,
        desk: Desk,
        shown: ShownResult,
        refuse: Callable[[str], object],
        *,
        overlay: Callable[[int, bool], bool],
        rename: Callable[[int, str], bool],
        parent: QObject,
    ) -> None:
        self._desk, self._shown = desk, shown
        self._overlay, self._rename = overlay, rename
        self._figures = self._all_figures()
        super().__init__(
            self._all_columns(), self._rows, refuse, is_faint=lambda row: row >= len(self._runs), parent=parent
        )

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return what a cell shows: of a run's name its colour too, and of a number how far off it is."""
        row, column = index.row(), index.column()
        is_run = 0 <= row < len(self._runs)
        if role == Qt.ItemDataRole.DecorationRole and column == NAME:
            return dot(self._shown.colour_of(self._runs[row])) if is_run else None
        if role == Qt.ItemDataRole.CheckStateRole and not is_run:
            return None
        if role == Qt.ItemDataRole.ToolTipRole and self._figure(column) is not None and row < self.rowCount():
            return self._cell_tip(row, column)
        return super().data(index, role)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return a heading, or its tip, which says what a difference is one to."""
        found = super().headerData(section, orientation, role)
        baseline = self._shown.baseline
        if role == Qt.ItemDataRole.ToolTipRole and found and baseline is not None and self._figure(section) is not None:
            return f"{found}\n" + self.tr("As the difference to {run}, whose own row alone is as it is").format(
                run=baseline.name
            )
        return found

    def name_of(self, row: int) -> str:
        """Return what a row is called."""
        if row < len(self._runs):
            return self._runs[row].name
        return self.tr("Targets") if row == len(self._runs) else self.tr("Actual track")

    def as_texts(self) -> list[list[str]]:
        """Return headings and rows for a spreadsheet; a heading says what its column's differences are to."""
        baseline, columns = self._shown.baseline, range(NAME + 1, self.columnCount())
        head = [self.headed()[NAME].heading()]
        for column in columns:
            figure = self._figure(column)
            heading = self.headed()[column].heading() if figure is None else figure.heading()
            if figure is not None and baseline is not None:
                heading = self.tr("{figure}, difference to {run}").format(figure=heading, run=baseline.name)
            head.append(heading)
        rows = [
            [self._copied_name(row), *(plain_number(self.headed()[column].text(row)) for column in columns)]
            for row in range(self.rowCount())
        ]
        return [head, *rows]

    def off_targets(self, run: Run) -> str:
        """Return in a sentence how far a run is off the targets that it was made for, in percent of them."""
        unit, off = self._desk.quantities, deviations(run.figures, run.inputs.targets)
        parts = [
            f"{name} {signed(percent_text(unit, value))}"
            for name, value in (
                (self.tr("length"), off.length),
                (self.tr("drop"), off.drop),
                (self.tr("mean gradient"), off.mean_gradient),
            )
            if value is not None
        ]
        return self.tr("{name} is off its targets by: {parts}.").format(name=run.name, parts=", ".join(parts))

    @property
    def _runs(self) -> tuple[Run, ...]:
        return self._desk.session.project.runs

    def _rows(self) -> int:
        project = self._desk.session.project
        return len(project.runs) + 1 + (project.actual is not None)

    def _figure(self, column: int) -> _Figure | None:
        at = column - NAME - 1
        return self._figures[at] if 0 <= at < len(self._figures) else None

    def _value(self, row: int, figure: _Figure) -> float | None:
        project = self._desk.session.project
        if row < len(project.runs):
            return figure.of_run(project.runs[row])
        if row == len(project.runs):
            found = getattr(project.limits if figure.target in _LIMITS else project.targets, figure.target or "length")
            return found if figure.target else None
        if project.actual is None or figure.of_actual is None:
            return None
        return figure.of_actual(actual_figures(project.actual))

    def _baseline_of(self, row: int) -> Run | None:
        """Return the run that a row shows differences to, None where it shows what is."""
        baseline = self._shown.baseline
        return None if row < len(self._runs) and self._runs[row] is baseline else baseline

    def _text(self, row: int, figure: _Figure) -> str:
        value = self._value(row, figure)
        if value is None:
            return ""
        sign = _LIMITS.get(figure.target, "") if row == len(self._runs) else ""
        baseline = self._baseline_of(row)
        return sign + (self._as_it_is(value, figure) if baseline is None else self._apart(value, baseline, figure))

    def _as_it_is(self, value: float, figure: _Figure) -> str:
        return figure.written(figure.to_shown(value))

    def _apart(self, value: float, baseline: Run, figure: _Figure) -> str:
        return signed(figure.written(figure.to_shown(value) - figure.to_shown(figure.of_run(baseline))))

    def _cell_tip(self, row: int, column: int) -> str:
        figure = self._figures[column - NAME - 1]
        value, unit = self._value(row, figure), figure.unit()
        lines = [figure.tip]
        if value is None:
            return figure.tip

        def with_unit(text: str) -> str:
            return f"{text} {unit}".strip()

        lines.append(f"{self.name_of(row)}: {with_unit(self._as_it_is(value, figure))}")
        if row < len(self._runs):
            run = self._runs[row]
            off = self._off(run, figure)
            if off is not None:
                target = self._as_it_is(getattr(run.inputs.targets, figure.target), figure)
                lines.append(
                    self.tr("{percent} from its target, {target}").format(
                        percent=signed(percent_text(self._desk.quantities, off)), target=with_unit(target)
                    )
                )
        baseline = self._baseline_of(row)
        if baseline is not None:
            apart = with_unit(self._apart(value, baseline, figure))
            lines.append(self.tr("{difference} from {run}").format(difference=apart, run=baseline.name))
        return "\n".join(lines)

    def _off(self, run: Run, figure: _Figure) -> float | None:
        """Return how far a run's figure is off its target, in percent, where the cell shows what the target means."""
        mean_is = self._desk.session.project.targets.mean_gradient_is
        if figure.target == "mean_gradient" and run.inputs.targets.mean_gradient_is != mean_is:
            return None
        found: float | None = getattr(deviations(run.figures, run.inputs.targets), figure.target, None)
        return found

    def _copied_name(self, row: int) -> str:
        baseline = self._shown.baseline
        name = self.name_of(row)
        if baseline is None or self._baseline_of(row) is not None:
            return name
        return self.tr("{run} (baseline, as it is)").format(run=name)

    def _mean(self, figures: Figures) -> float:
        return mean_of(figures, self._desk.session.project.targets.mean_gradient_is)

    def _all_figures(self) -> tuple[_Figure, ...]:
        unit = self._desk.quantities

        def of_line(
            heading: str, tip: str, value: Callable[[Figures], float], target: str, *, is_length: bool = False
        ) -> _Figure:
            def sign() -> str:
                return unit.length_unit if is_length else unit.gradient_unit

            return _Figure(
                lambda: f"{heading} {sign()}", tip, sign, lambda run: value(run.figures),
                (lambda metres: metres * unit.length_factor) if is_length else unit.shown_gradient,
                lambda shown: unit.number(shown, 2), value, target,
            )  # fmt: skip

        def plain(heading: str, tip: str, value: Callable[[Run], float], digits: int, sign: str = "") -> _Figure:
            return _Figure(
                lambda: f"{heading} {sign}".strip(), tip, lambda: sign, value, float,
                lambda shown: unit.number(shown, digits),
            )  # fmt: skip

        return (
            of_line(self.tr("Length"), self.tr("Length in space"), lambda of: of.length, "length", is_length=True),
            of_line(self.tr("Drop"), self.tr("Height difference"), lambda of: of.drop, "drop", is_length=True),
            of_line(
                self.tr("Mean"),
                self.tr("Mean gradient, by the definition of the targets"),
                self._mean,
                "mean_gradient",
            ),
            of_line(self.tr("Max"), self.tr("Largest gradient"), lambda of: of.max_gradient, "max_gradient"),
            of_line(self.tr("Min"), self.tr("Smallest gradient"), lambda of: of.min_gradient, "min_gradient"),
            _Figure(
                lambda: "|K2−K3| 1/m",
                self.tr("Mean difference between curvature in plan and in space"),
                lambda: "1/m",
                lambda run: run.figures.mean_curvature_difference,
                float,
                unit.short,
                lambda of: of.mean_curvature_difference,
            ),
            plain("f", self.tr("Factor from the plan to true size"), lambda run: run.scale * run.inputs.factor, 5),
            plain(self.tr("Iterations"), self.tr("How many iterations it took"), lambda run: float(run.nit), 0),
            plain(self.tr("Time"), self.tr("How long it took"), lambda run: run.seconds, 2, "s"),
        )

    def _all_columns(self) -> tuple[Column, ...]:
        unit = self._desk.quantities

        def marked(figure: _Figure) -> Column:
            def heading() -> str:
                return figure.heading() if self._shown.baseline is None else f"Δ {figure.heading()}"

            return Column(heading, figure.tip, lambda row: self._text(row, figure))

        return (
            Column(
                lambda: "",
                self.tr("Draw this run beside the shown one"),
                lambda _row: "",
                is_checked=lambda row: row < len(self._runs) and self._shown.is_overlaid(self._runs[row]),
                check=self._overlay,
                is_number=False,
            ),
            Column(
                lambda: self.tr("Run"),
                self.tr("Name of the run; click shows it, F2 renames it, Del deletes it"),
                self.name_of,
                self.name_of,
                self._rename,
                is_number=False,
            ),
            *(marked(figure) for figure in self._figures),
            Column(
                lambda: self.tr("Method"),
                self.tr("How the gradients were found, and for which start house"),
                lambda row: self._of_run(row, lambda run: f"{run.inputs.settings.method}, {run.target_set}"),
                is_number=False,
            ),
            Column(
                lambda: self.tr("End"),
                self.tr("Why the run ended"),
                lambda row: self._of_run(row, lambda run: unit.sentence(run.message)),
                is_number=False,
            ),
        )

    def _of_run(self, row: int, text: Callable[[Run], str]) -> str:
        return text(self._runs[row]) if row < len(self._runs) else ""
