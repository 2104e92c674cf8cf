"""The steps along the top: done, next, out of date; entered at any time; one line on what to do."""

from __future__ import annotations

from collections.abc import Generator

from PySide6.QtCore import QEvent, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.project.steps import Amount, Part, Step, StepName, StepState, Told, steps
from bobdesk.ui.desk import Desk
from bobdesk.ui.runner import Job
from bobdesk.ui.theme import colours

STEPS: tuple[StepName, ...] = ("Plan", "Scale", "Centreline", "Segments", "Solve", "Export")
# Typing and dragging end before the steps are looked at again.
_REST_MS = 120
_NARROW = 1000


def _look_steps(project: Project) -> Generator[Progress, None, tuple[Step, ...]]:
    yield Progress(0.0, "Looking at the steps")
    return steps(project)


class StepsBar(QWidget):
    """Six buttons and a sentence.

    Signals
    -------
    chosen
        Name of the step that the user wants to see.
    """

    chosen = Signal(str)

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("steps_bar")
        self._desk = desk
        self._shown: StepName = "Plan"
        self._steps: tuple[Step, ...] = ()
        self._job: Job | None = None
        self._buttons: dict[StepName, QToolButton] = {}
        self._with_words: list[QToolButton] = []
        self._is_narrow = False
        self._group = QButtonGroup(self)
        self._sentence = QLabel(self)
        self._sentence.setProperty("kind", "muted")
        self._sentence.setWordWrap(True)
        self._sentence.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._sentence.setAccessibleName(self.tr("What to do in this step"))
        row = QHBoxLayout()
        row.setSpacing(6)
        for name in STEPS:
            row.addWidget(self._button(name))
        row.addStretch(1)
        self._right = row
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 6, 10, 6)
        column.setSpacing(4)
        column.addLayout(row)
        column.addWidget(self._sentence)
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(_REST_MS)
        self._rest.timeout.connect(self._look)
        desk.session.changed.connect(self._on_changed)
        desk.quantities.changed.connect(self._on_units)
        self._restyle()
        self._say()

    @property
    def shown(self) -> StepName:
        """The step whose panel is shown."""
        return self._shown

    def add_at_right(self, button: QToolButton, *, words: bool) -> None:
        """Add a button at the right end, such as Undo; `words` shows its text where there is room."""
        self._right.addWidget(button)
        if words:
            self._with_words.append(button)
        self._fit()

    def show_step(self, name: StepName) -> None:
        """Mark a step as the one whose panel is shown."""
        self._shown = name
        self._buttons[name].setChecked(True)
        for other, button in self._buttons.items():
            # One stop of the Tab key for all six; from there the arrows go on.
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus if other == name else Qt.FocusPolicy.ClickFocus)
        self._restyle()
        self._say()

    def title_of(self, name: StepName) -> str:
        """Return what a step is called on the screen."""
        return self._titles()[name]

    def take_focus(self) -> None:
        """Give the keyboard to the step that is shown."""
        self._buttons[self._shown].setFocus(Qt.FocusReason.ShortcutFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Left and right go from step to step."""
        by = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        if by is None:
            super().keyPressEvent(event)
            return
        at = STEPS.index(self._shown) + by
        if 0 <= at < len(STEPS):
            self.chosen.emit(STEPS[at])
            self.take_focus()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Sit closer, and leave words out, in a narrow window."""
        super().resizeEvent(event)
        if (self.width() < _NARROW) is not self._is_narrow:
            self._is_narrow = not self._is_narrow
            self._fit()
            self._restyle()

    def changeEvent(self, event: QEvent) -> None:
        """Take the colours of another theme."""
        if event.type() == QEvent.Type.PaletteChange and self._buttons:
            self._restyle()
        super().changeEvent(event)

    def _button(self, name: StepName) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(f"step_{name.lower()}")
        button.setCheckable(True)
        button.setCursor(Qt.CursorShape.PointingHandCursor)
        button.setIconSize(QSize(16, 16))
        button.clicked.connect(lambda _checked, name=name: self.chosen.emit(name))
        self._group.addButton(button)
        self._buttons[name] = button
        return button

    def _fit(self) -> None:
        for button in self._with_words:
            button.setToolButtonStyle(
                Qt.ToolButtonStyle.ToolButtonIconOnly
                if self._is_narrow
                else Qt.ToolButtonStyle.ToolButtonTextBesideIcon
            )

    def _titles(self) -> dict[StepName, str]:
        return {
            "Plan": self.tr("Plan"),
            "Scale": self.tr("Scale"),
            "Centreline": self.tr("Centreline"),
            "Segments": self.tr("Segments"),
            "Solve": self.tr("Solve"),
            "Export": self.tr("Export"),
        }

    def _states(self) -> dict[StepState, tuple[str, str]]:
        """Sign and words of each state: never told by colour alone."""
        return {
            "done": ("✓ ", self.tr("done")),
            "next": ("", self.tr("next")),
            "later": ("", self.tr("later")),
            "out of date": ("! ", self.tr("out of date")),
        }

    def _restyle(self) -> None:
        of = colours()
        colour_of = {"done": of.good, "next": of.text, "later": of.muted, "out of date": of.warning}
        padding = 5 if self._is_narrow else 12
        found = {step.name: step for step in self._steps}
        titles, states = self._titles(), self._states()
        for number, name in enumerate(STEPS, start=1):
            step = found.get(name)
            state: StepState = "later" if step is None else step.state
            sign, words = states[state]
            button = self._buttons[name]
            button.setText(f"{sign}{number} {titles[name]}")
            sentence = "" if step is None else step.said(self._shown_part)
            button.setToolTip(f"{titles[name]}: {words}. {sentence}".strip())
            button.setAccessibleName(self.tr("Step {number}, {title}").format(number=number, title=titles[name]))
            button.setAccessibleDescription(f"{words}. {sentence}")
            weight = "700" if state in ("next", "out of date") else "500"
            button.setStyleSheet(
                f"QToolButton {{ border: 1px solid transparent; border-radius: 13px; padding: 4px {padding}px;"
                f" color: {colour_of[state]}; font-weight: {weight}; background: transparent; }}"
                f"QToolButton:hover {{ background: {of.accent_soft}; }}"
                f"QToolButton:focus {{ border-color: {of.accent}; }}"
                f"QToolButton:checked {{ background: {of.accent}; color: {of.on_accent}; font-weight: 700; }}"
                f"QToolButton:checked:focus {{ border: 2px solid {of.text}; }}"
            )

    def _say(self) -> None:
        for step in self._steps:
            if step.name == self._shown:
                self._sentence.setText(step.said(self._shown_part))

    def _shown_part(self, part: Part) -> str:
        unit = self._desk.quantities
        if isinstance(part, Amount):
            return unit.length(part.value, part.digits) if part.is_length else unit.number(part.value, part.digits)
        return unit.sentence(part.text) if isinstance(part, Told) else part

    def _on_units(self) -> None:
        self._restyle()
        self._say()

    def _on_changed(self, _before: Project, _after: Project) -> None:
        self._rest.start()

    def _look(self) -> None:
        """Look at the project in the background: segments of a long line take their time."""
        if self._job is not None:
            self._job.stop()
        project = self._desk.session.project

        def done(found: tuple[Step, ...]) -> None:
            self._job = None
            self._steps = found
            self._restyle()
            self._say()

        self._job = self._desk.runner.start(self.tr("Looking at the steps"), lambda: _look_steps(project), done=done)
