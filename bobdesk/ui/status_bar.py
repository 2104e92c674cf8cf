"""The line at the bottom: what the tool does, where the cursor is, what runs, whether all is saved."""

from __future__ import annotations

import time

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QLabel, QProgressBar, QStatusBar, QToolButton, QWidget

from bobdesk.progress import Progress
from bobdesk.project import derive
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import icon
from bobdesk.ui.runner import Job
from bobdesk.ui.widgets.long_names import shortened

# Shorter work is over before one has read what it is.
_SHOW_AFTER_S = 0.3
_LOOK_EVERY_MS = 100


class StatusBar(QStatusBar):
    """Sentences at the left; coordinates, work and the saved mark at the right."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("status_bar")
        self._desk = desk
        self._job: Job | None = None
        self._tool = QLabel(self)
        self._tool.setAccessibleName(self.tr("What the tool does"))
        self._place = QLabel(self)
        self._place.setAccessibleName(self.tr("Position of the cursor"))
        self._plan = QLabel(self)
        self._plan.setProperty("kind", "muted")
        self._plan.setAccessibleName(self.tr("The plan"))
        self._doing = QLabel(self)
        self._bar = QProgressBar(self)
        self._bar.setMaximumWidth(140)
        self._bar.setMaximumHeight(14)
        self._bar.setTextVisible(False)
        self._bar.setAccessibleName(self.tr("Progress"))
        self._stop = QToolButton(self)
        self._stop.setText(self.tr("Stop"))
        self._stop.setToolTip(self.tr("Stop the work that is under way; nothing is changed"))
        self._stop.clicked.connect(self._on_stop)
        self._saved = QLabel(self)
        self._saved.setAccessibleName(self.tr("Saved or not"))
        for label in (self._tool, self._plan, self._doing):
            label.setMinimumWidth(1)  # the window may be narrower than its sentences; the tool tip has them whole
        self.addWidget(self._tool, 1)
        for widget in (self._place, self._plan, self._doing, self._bar, self._stop, self._saved):
            self.addPermanentWidget(widget)
        self._timer = QTimer(self)
        self._timer.setInterval(_LOOK_EVERY_MS)
        self._timer.timeout.connect(self._look)
        desk.runner.jobs_changed.connect(self._on_jobs)
        desk.session.state_changed.connect(self._show_saved)
        desk.session.changed.connect(self._show_plan)
        desk.picture.changed.connect(self._show_plan)
        desk.quantities.changed.connect(self._show_plan)
        self._look()
        self._show_saved()

    def say(self, sentence: str) -> None:
        """Show what the tool does now."""
        self._tool.setText(sentence)
        self._tool.setToolTip(sentence)

    def show_place(self, place: tuple[float, float] | None) -> None:
        """Show a position in plan units, in metres too where the scale is known; None empties it."""
        if place is None:
            self._place.clear()
            return
        number = self._desk.quantities.number
        project = self._desk.session.project
        if project.source is not None:
            self._place.setText(self._metres(*place))
            return
        text = self.tr("px {x}, {y}").format(x=number(place[0]), y=number(place[1]))
        found = derive.calibration(project).value
        if found is not None and found.scale_known:
            east, north = found.to_metres([place])[0]
            text += "   " + self._metres(float(east), float(north))
        self._place.setText(text)

    def _metres(self, east: float, north: float) -> str:
        length = self._desk.quantities.length
        return self.tr("x {east}  y {north}").format(east=length(east), north=length(north))

    def _show_plan(self) -> None:
        project = self._desk.session.project
        plan = project.picture or project.source
        parts = []
        if project.picture is not None:
            parts.append(shortened(project.picture.name))
            if project.picture.size_px is not None:
                width, height = project.picture.size_px
                number = self._desk.quantities.number
                parts.append(self.tr("{width} × {height} px").format(width=number(width, 0), height=number(height, 0)))
            found = derive.calibration(project).value
            if found is not None and found.scale_known:
                per_pixel = self._desk.quantities.length(found.metres_per_pixel, 4)
                parts.append(self.tr("{length}/px").format(length=per_pixel))
        elif project.source is not None:
            parts.append(shortened(project.source.name))
        self._plan.setText(" · ".join(parts))
        self._plan.setToolTip("" if plan is None else plan.name)

    def _show_saved(self) -> None:
        session = self._desk.session
        if not session.is_open:
            self._saved.clear()
            return
        saved = session.is_saved
        self._saved.setText(self.tr("● saved") if saved and session.path is not None else self.tr("○ not saved"))
        if saved and session.path is None:
            self._saved.setText("")
        self._saved.setProperty("kind", "good" if saved else "muted")
        self._saved.style().polish(self._saved)

    def _on_jobs(self) -> None:
        # A job may begin while the plan is being painted, and a progress bar paints at once: that would be within it.
        if not self._desk.runner.jobs:
            self._look()
        elif not self._timer.isActive():
            self._timer.start()

    def _look(self) -> None:
        jobs = self._desk.runner.jobs
        shown = [job for job in jobs if time.monotonic() - job.began > _SHOW_AFTER_S]
        if not jobs:
            self._timer.stop()
        # The youngest: what was begun before it may work for hours.
        job = shown[-1] if shown else None
        if job is not self._job:
            self._job = job
            if job is not None:
                job.progressed.connect(self._on_progress)
                self._doing.setText(shortened(job.title))
                self._bar.setRange(0, 0)
                self._stop.setIcon(icon("stop"))
        for widget in (self._doing, self._bar, self._stop):
            widget.setVisible(job is not None)

    def _on_progress(self, step: object) -> None:
        if isinstance(step, Progress) and self.sender() is self._job:
            self._bar.setRange(0, 1000)
            self._bar.setValue(round(1000 * step.fraction))
            self._doing.setText(step.doing)

    def _on_stop(self) -> None:
        if self._job is not None:
            self._job.when_user_stops()
