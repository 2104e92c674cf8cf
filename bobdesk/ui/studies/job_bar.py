"""The line of a window's job: begin, rest, stop, and how far it is."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QPushButton, QSizePolicy, QWidget

from bobdesk.ui.icons import icon
from bobdesk.ui.studies.icon_button import IconButton
from bobdesk.ui.theme import colours

_WHOLE = 1000


class JobBar(QWidget):
    """Shows what it is told; it knows of no job."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.main_button = QPushButton(self)
        self.main_button.setProperty("kind", "primary")
        self.stop_button = IconButton(self.tr("Stop"), self.tr("End the work; what is finished stays"), "stop", self)
        self.bar = QProgressBar(self)
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(8)
        self.bar.setFixedWidth(160)
        self.bar.setAccessibleName(self.tr("How far the work is"))
        self.said = QLabel(self)
        self.said.setTextFormat(Qt.TextFormat.PlainText)
        self.said.setWordWrap(True)
        self.said.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.said.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.said.setAccessibleName(self.tr("State of the work"))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(10)
        for widget in (self.main_button, self.stop_button, self.bar):
            row.addWidget(widget)
        row.addWidget(self.said, 1)
        self._icon = "run"
        self._draw()
        self.show_idle(self.tr("Solve"), "")

    def show_idle(self, text: str, tip: str, *, enabled: bool = True) -> None:
        """Show that nothing works, and what the button would begin."""
        self._show(text, tip, "run", enabled=enabled)
        self.stop_button.setEnabled(False)
        self.bar.hide()

    def show_work(self, text: str, tip: str, icon_name: str, *, enabled: bool = True) -> None:
        """Show that something works or rests, and what the button does with it."""
        self._show(text, tip, icon_name, enabled=enabled)
        self.stop_button.setEnabled(True)
        self.bar.show()

    def show_progress(self, fraction: float | None) -> None:
        """Show how far it is; None: nobody knows."""
        self.bar.setRange(0, 0 if fraction is None else _WHOLE)
        if fraction is not None:
            self.bar.setValue(round(_WHOLE * fraction))

    def say(self, sentence: str) -> None:
        """Say in a sentence how it stands."""
        self.said.setText(sentence)

    def changeEvent(self, event: QEvent) -> None:
        """Draw the icons in the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_icon"):
            self._draw()

    def _show(self, text: str, tip: str, icon_name: str, *, enabled: bool) -> None:
        self.main_button.setText(text)
        self.main_button.setAccessibleName(text)
        self.main_button.setToolTip(tip)
        self.main_button.setEnabled(enabled)
        # Told of its state some ten times a second, it would spend more on drawing the same icon than the rows take.
        if icon_name != self._icon:
            self._icon = icon_name
            self._draw()

    def _draw(self) -> None:
        self.main_button.setIcon(icon(self._icon, colours().on_accent))
