"""Start, rest, step and stop a run, and how far it is."""

from __future__ import annotations

from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QLabel, QProgressBar, QPushButton

from bobdesk.project.project import Project
from bobdesk.ui.icons import icon
from bobdesk.ui.solving import solving_of
from bobdesk.ui.theme import colours
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part


class RunPart(Part):
    """One button runs, pauses and resumes; what is out of date is said above it."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Run"))
        self.heading.hide()
        self.solving = solving_of(self.desk)
        self.state = panel.add_label("", "warning", self.column)
        flow = panel.add_buttons(self.column)
        self.run_button = QPushButton(self)
        self.run_button.setProperty("kind", "primary")
        flow.addWidget(self.run_button)
        self.step_button = panel.button(flow, self.tr("Step"), self.tr("Do one iteration and rest"), "step")
        self.stop_button = panel.button(
            flow, self.tr("Stop"), self.tr("End this run with its best iterate (Shift+F5)"), "stop"
        )
        self.queue_button = panel.button(
            flow,
            self.tr("Queue another"),
            self.tr("Solve the project as it is now once this run has ended (F5)"),
            "plus",
        )
        self.drop_button = panel.button(
            flow, self.tr("Drop the waiting"), self.tr("Let none of the waiting runs begin"), "close"
        )
        self.bar = QProgressBar(self)
        self.bar.setRange(0, 0)
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(6)
        self.bar.setAccessibleName(self.tr("A run is at work"))
        self.column.addWidget(self.bar)
        self.progress: QLabel = panel.add_label("", "", self.column)
        self.progress.setAccessibleName(self.tr("How far the run is"))
        self.run_button.clicked.connect(self._on_run)
        self.step_button.clicked.connect(self.solving.step)
        self.stop_button.clicked.connect(self.solving.stop)
        self.queue_button.clicked.connect(self.solving.run)
        self.drop_button.clicked.connect(self.solving.drop_waiting)
        self.solving.changed.connect(self._show)
        self.solving.advanced.connect(self._say_progress)
        self.desk.quantities.changed.connect(self._say_progress)
        self._show()

    def refresh(self, project: Project) -> None:
        """Say whether the shown result is out of date, and how its run ended."""
        from bobdesk.project.derive_runs import why_out_of_date

        run = project.run
        why = None if run is None else why_out_of_date(project, run)
        if run is None or why is None:
            self.state.hide()
        else:
            self.state.setText(
                self.tr("! {name} is out of date: {why}. F5 solves again.").format(name=run.name, why=why)
            )
            self.state.show()
        self._say_progress()

    def changeEvent(self, event: QEvent) -> None:
        """Draw the icon in the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "bar"):
            self._show()

    def _on_run(self) -> None:
        if not self.solving.is_running:
            self.solving.run()
        elif self.solving.is_paused:
            self.solving.resume()
        else:
            self.solving.pause()

    def _show(self) -> None:
        running, paused = self.solving.is_running, self.solving.is_paused
        if not running:
            text, name, tip = self.tr("Run"), "run", self.tr("Find the gradients (F5)")
        elif paused:
            text, name, tip = self.tr("Resume"), "run", self.tr("Go on with this run")
        else:
            text, name, tip = self.tr("Pause"), "pause", self.tr("Let this run rest; nothing is lost")
        self.run_button.setText(text)
        self.run_button.setIcon(icon(name, colours().on_accent))
        self.run_button.setAccessibleName(text)
        self.run_button.setToolTip(tip)
        self.stop_button.setEnabled(running)
        self.step_button.setEnabled(not running or paused)
        self.queue_button.setVisible(running)
        self.drop_button.setVisible(self.solving.waiting > 0)
        policy = self.bar.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.bar.setSizePolicy(policy)
        self.bar.setVisible(running and not paused)
        self._say_progress()

    def _say_progress(self) -> None:
        record = self.solving.record
        number = self.desk.quantities.number
        if record is not None and record.newest is not None:
            text = self.tr("{name}: iteration {count}, J {value}").format(
                name=self.solving.name,
                count=number(record.newest.number, 0),
                value=self.desk.quantities.short(record.newest.objective),
            )
            if self.solving.is_paused:
                text += ", " + self.tr("paused")
            elif self.solving.rate:
                text += ", " + self.tr("{rate} iterations a second").format(rate=number(self.solving.rate, 0))
            if self.solving.waiting:
                text += ", " + self.tr("{count} waiting").format(count=self.solving.waiting)
        elif self.solving.is_running:
            text = self.tr("{name} begins …").format(name=self.solving.name)
        else:
            run = self.desk.session.project.run
            if run is None:
                text = self.tr("No result yet.")
            else:
                text = self.tr("{name}: {message} {count} iterations in {seconds} s.").format(
                    name=run.name,
                    message=self.desk.quantities.sentence(run.message),
                    count=number(run.nit, 0),
                    seconds=number(run.seconds, 2),
                )
        self.progress.setText(text)
