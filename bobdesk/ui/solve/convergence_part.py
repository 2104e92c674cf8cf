"""The way of the run at work, or of the run that is shown, to look at and to scrub through."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, QSize, Qt
from PySide6.QtGui import QColor, QHideEvent, QIcon, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QCheckBox, QToolButton

from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.ui.plots.convergence import ConvergencePlot, colour_of_series, style_of_series
from bobdesk.ui.plots.convergence_data import ConvergenceData
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.solving import solving_of
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part

_AT_FIRST = ("objective", "length", "drop", "optimality")


class ConvergencePart(Part):
    """The plot, what is drawn in it, and the figures of the iterate under its cursor."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Convergence"))
        self.solving = solving_of(self.desk)
        self.shown = shown_result_of(self.desk)
        self.plot = ConvergencePlot(self)
        self.plot.setToolTip(
            self.tr("Click or drag: show that iterate. Wheel: zoom. Right drag: pan. Double click: show everything")
        )
        self.column.addWidget(self.plot)
        self._boxes: dict[str, QToolButton] = {}
        self._series_flow = panel.add_buttons(self.column)
        for name, text, tip in (
            ("objective", self.tr("J"), self.tr("The objective that is minimised in this stage")),
            ("length", self.tr("length, %"), self.tr("Deviation of the length from its target")),
            ("drop", self.tr("drop, %"), self.tr("Deviation of the height difference from its target")),
            ("optimality", self.tr("optimality"), self.tr("How far the iterate is from an optimum")),
            ("step", self.tr("step"), self.tr("Length of the step")),
            ("scale", self.tr("f"), self.tr("Factor on the plan")),
            ("length term", self.tr("a·eL²"), self.tr("Term of the length in the published objective")),
            ("height term", self.tr("b·eH²"), self.tr("Term of the height in the published objective")),
            ("other terms", self.tr("c·eK² + d·eg²"), self.tr("Terms of curvature and mean gradient")),
        ):
            button = QToolButton(self)
            button.setText(text)
            button.setToolTip(tip)
            button.setAccessibleName(tip)
            button.setCheckable(True)
            button.setProperty("kind", "chip")
            button.setChecked(name in _AT_FIRST)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            button.setIconSize(QSize(22, 10))
            button.toggled.connect(self._on_series)
            self._series_flow.addWidget(button)
            self._boxes[name] = button
        self.follow_box = QCheckBox(self.tr("Follow the run"), self)
        self.follow_box.setChecked(True)
        self.follow_box.setToolTip(
            self.tr("Show all iterates and the line of the newest one as they come, or hold the view")
        )
        self.follow_box.setAccessibleName(self.follow_box.text())
        self.column.addWidget(self.follow_box)
        self.reading = panel.add_label("", "muted", self.column)
        self._live: tuple[object, ConvergenceData] | None = None
        self._of_run: tuple[Run, ConvergenceData] | None = None
        self.plot.chosen.connect(self._on_chosen)
        self.plot.held.connect(self._on_held)
        self.follow_box.toggled.connect(self._on_follow)
        self.solving.advanced.connect(self._show)
        self.solving.changed.connect(self._show)
        self.desk.session.changed.connect(self._on_changed)
        self._show_icons()
        self._on_series()
        self._show()

    def changeEvent(self, event: QEvent) -> None:
        """Take the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "reading"):
            self._show_icons()
            self.plot.update()

    def hideEvent(self, event: QHideEvent) -> None:
        """Show the result again: nothing else says that strips and view in space show an iterate."""
        super().hideEvent(event)
        if not event.spontaneous() and self.shown.scrubbed is not None:
            self.plot.mark(None)
            self.shown.scrub(None)
            self._show()

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.run is not after.run:
            self._show()

    def _on_series(self, _on: bool = True) -> None:
        self.plot.show_series(name for name, button in self._boxes.items() if button.isChecked())

    def _show(self) -> None:
        record, inputs = self.solving.record, self.solving.inputs
        if record is not None and inputs is not None:
            if self._live is None or self._live[0] is not record:
                self._live = (record, ConvergenceData(inputs))
            data = self._live[1]
            data.add(record.rows(data.count))
            self.plot.show_data(data, record.stages, may_scrub=False)
            self._show_terms(data)
            self._read(None)
            return
        self._live = None
        run = self.desk.session.project.run
        if run is None:
            self._of_run = None
            self.plot.show_data(None, (), may_scrub=False)
            self._read(None)
            return
        if self._of_run is None or self._of_run[0].layout is not run.layout:
            data = ConvergenceData(run.inputs)
            of_session = self.solving.record_of(run)
            data.add(run.history if of_session is None else of_session.rows())
            self._of_run = (run, data)
        self.plot.show_data(self._of_run[1], run.stages, may_scrub=True)
        self._show_terms(self._of_run[1])
        self._read(self.plot.cursor_number, has_lines=run.iterates is not None)

    def _show_terms(self, data: ConvergenceData) -> None:
        for name in ("length term", "height term", "other terms"):
            self._boxes[name].setVisible(data.has_terms)

    def _on_chosen(self, number: int) -> None:
        run = self.desk.session.project.run
        if run is None or self.solving.is_running:
            return
        kept = run.iterates
        if kept is not None:
            row = kept.nearest(number)
            self.plot.mark(int(kept.numbers[row]))
            self.shown.scrub(None if row == len(kept.table) - 1 else row)
        else:
            self.plot.mark(number)
        self._read(self.plot.cursor_number, has_lines=kept is not None)

    def _read(self, number: int | None, *, has_lines: bool = True) -> None:
        """Say the figures of the marked iterate in words."""
        data = self.plot.data
        self.reading.setVisible(data is not None)
        if data is None or not data.count:
            return
        row = data.count - 1 if number is None else data.nearest(number)
        number_text, short = self.desk.quantities.number, self.desk.quantities.short
        text = self.tr(
            "Iterate {number} of {last}: J {objective}, length off by {length} %, drop off by {drop} %, f {scale}"
        )
        said = text.format(
            number=number_text(float(data.numbers[row]), 0),
            last=number_text(float(data.numbers[-1]), 0),
            objective=short(data.values("objective")[row]),
            length=short(data.values("length")[row]),
            drop=short(data.values("drop")[row]),
            scale=number_text(float(data.values("scale")[row]), 5),
        )
        if number is not None and not has_lines:
            said += ". " + self.tr("The lines of this run's iterates are not in its file; F5 solves again.")
        self.reading.setText(said)

    def _on_follow(self, on: bool) -> None:
        if on:
            self.plot.follow()
        else:
            self.plot.hold()
        self.shown.follow(on)

    def _on_held(self, held: bool) -> None:
        with QSignalBlocker(self.follow_box):
            self.follow_box.setChecked(not held)

    def _show_icons(self) -> None:
        for name, button in self._boxes.items():
            pixmap = QPixmap(44, 20)
            pixmap.setDevicePixelRatio(2)
            pixmap.fill(Qt.GlobalColor.transparent)
            painter = QPainter(pixmap)
            painter.setPen(QPen(QColor(colour_of_series(name)), 2, style_of_series(name)))
            painter.drawLine(0, 5, 22, 5)
            painter.end()
            button.setIcon(QIcon(pixmap))
