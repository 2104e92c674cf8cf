"""The result that all parts of the window show together: the run at work, one of its iterates, or a finished run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary, WeakSet

from PySide6.QtCore import QObject, Signal

from bobdesk.errors import InputError
from bobdesk.project.layout import Layout
from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest
from bobdesk.ui.solving import solving_of
from bobdesk.ui.theme import colours

if TYPE_CHECKING:
    from bobdesk.track.centreline3d import Centreline3D


def _drawn(run: Run) -> Centreline3D:
    from bobdesk.project.derive_runs import run_line

    return run_line(run)


class ShownResult(QObject):
    """Which runs are drawn, in which colours, and their lines as they are ready.

    Runs are known by their layout, which stays the same object when a run is renamed.

    Signals
    -------
    changed
        Another line, or another choice of lines, is to be drawn.
    """

    changed = Signal()

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._solving = solving_of(desk)
        self._drawings: WeakKeyDictionary[Layout, Centreline3D] = WeakKeyDictionary()
        self._numbers: WeakKeyDictionary[Layout, int] = WeakKeyDictionary()
        self._next_number = 0
        self._overlaid: WeakSet[Layout] = WeakSet()
        self._baseline: Layout | None = None
        self._scrubbed: int | None = None
        self._scrubbed_line: tuple[Layout, int, Centreline3D] | None = None
        self._follows = True
        self._live: tuple[int, Centreline3D] | None = None
        self._newest = Newest(desk.runner, self.tr("Drawing the results"), self)
        self._newest.answered.connect(self._on_drawn)
        desk.session.changed.connect(self._on_changed)
        desk.session.document_changed.connect(self._forget)
        self._solving.advanced.connect(self._on_advanced)
        self._solving.changed.connect(self._on_solving)
        self._ask()

    @property
    def run(self) -> Run | None:
        """The finished run that is shown."""
        return self._desk.session.project.run

    @property
    def is_live(self) -> bool:
        """Whether the run at work is shown."""
        return self._follows and self._solving.is_running and self._live is not None

    @property
    def line(self) -> Centreline3D | None:
        """The 3D line to be drawn first."""
        if self.is_live and self._live is not None:
            return self._live[1]
        run = self.run
        if run is None:
            return None
        found = self._drawings.get(run.layout)
        if found is None or self._scrubbed is None:
            return found
        return self._line_of_iterate(run, self._scrubbed)

    def _line_of_iterate(self, run: Run, row: int) -> Centreline3D:
        from bobdesk.project.derive_runs import iterate_line

        held = self._scrubbed_line
        if held is None or held[0] is not run.layout or held[1] != row:
            held = (run.layout, row, iterate_line(run, row))
            self._scrubbed_line = held
        return held[2]

    @property
    def colour(self) -> str:
        """Of the line that is drawn first; a run at work has the colour that it keeps."""
        if self.is_live or self.run is None:
            return _colour(self._next_number)
        return self.colour_of(self.run)

    def line_of_run(self, run: Run) -> Centreline3D | None:
        """Return a run's line if it is worked out already."""
        return self._drawings.get(run.layout)

    def colour_of(self, run: Run) -> str:
        """Return the one colour of a run."""
        number = self._numbers.get(run.layout)
        if number is None:
            number, self._next_number = self._next_number, self._next_number + 1
            self._numbers[run.layout] = number
        return _colour(number)

    def is_overlaid(self, run: Run) -> bool:
        """Return whether a run is drawn beside the shown one."""
        return run.layout in self._overlaid

    def overlay(self, run: Run, on: bool) -> None:
        """Draw a run beside the shown one, or no longer."""
        (self._overlaid.add if on else self._overlaid.discard)(run.layout)
        self._ask()
        self.changed.emit()

    @property
    def overlays(self) -> list[tuple[Run, Centreline3D]]:
        """Runs that are drawn beside the shown one, as far as they are worked out."""
        shown = self.run
        found = []
        for run in self._desk.session.project.runs:
            if run.layout not in self._overlaid or (run is shown and not self.is_live):
                continue
            line = self.line_of_run(run)
            if line is not None:
                found.append((run, line))
        return found

    @property
    def baseline(self) -> Run | None:
        """The run that the others are compared with."""
        for run in self._desk.session.project.runs:
            if run.layout is self._baseline:
                return run
        return None

    def set_baseline(self, run: Run | None) -> None:
        """Compare the others with a run, or with none."""
        self._baseline = None if run is None else run.layout
        self._ask()
        self.changed.emit()

    def scrub(self, row: int | None) -> None:
        """Show an iterate of the finished run in the place of its end: a row of its `iterates`."""
        if row != self._scrubbed:
            self._scrubbed = row
            self.changed.emit()

    @property
    def scrubbed(self) -> int | None:
        """Row of the iterate that is shown in the place of a run's end."""
        return self._scrubbed

    def follow(self, on: bool) -> None:
        """Show the run at work, or hold what is shown."""
        self._follows = on
        self.changed.emit()

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.runs is after.runs and before.chosen_run == after.chosen_run and before.actual is after.actual:
            return
        if before.run is None or after.run is None or before.run.layout is not after.run.layout:
            self._scrubbed = None
        self._ask()
        self.changed.emit()

    def _on_advanced(self) -> None:
        record = self._solving.record
        if not self._follows or record is None or record.newest is None:
            return
        if self._live is not None and self._live[0] == record.count:
            return
        try:
            line = self._solving.newest_line()
        except InputError:
            return
        if line is not None:
            self._live = (record.count, line)
            self.changed.emit()

    def _on_solving(self) -> None:
        if not self._solving.is_running and self._live is not None:
            self._live = None
            self.changed.emit()

    def _forget(self) -> None:
        self._newest.drop()
        self._live, self._scrubbed, self._scrubbed_line, self._baseline = None, None, None, None
        self._overlaid.clear()
        self._numbers.clear()
        self._next_number = 0

    def _wanted(self) -> list[Run]:
        shown, baseline = self.run, self.baseline
        runs = [run for run in (shown, baseline) if run is not None]
        return runs + [run for run in self._desk.session.project.runs if run.layout in self._overlaid]

    def _ask(self) -> None:
        missing = [run for run in self._wanted() if run.layout not in self._drawings]
        for run in self._desk.session.project.runs:
            self.colour_of(run)
        if missing:
            self._newest.ask(lambda: [(run.layout, _drawn(run)) for run in missing])

    def _on_drawn(self, found: Any) -> None:
        for layout, drawing in found:
            self._drawings[layout] = drawing
        self.changed.emit()


def _colour(number: int) -> str:
    palette = colours().runs
    return palette[number % len(palette)]


def shown_result_of(desk: Desk) -> ShownResult:
    """Return the one `ShownResult` that all parts of a window share."""
    found = desk.session.findChild(ShownResult, "shown result")
    if found is not None:
        return found
    made = ShownResult(desk, desk.session)
    made.setObjectName("shown result")
    return made
