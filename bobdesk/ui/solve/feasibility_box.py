"""A sentence in a box that says by sign, word and colour whether all is well."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QVBoxLayout, QWidget

from bobdesk.ui.theme import colours
from bobdesk.ui.widgets.flow_layout import FlowLayout

BoxKind = Literal["good", "doubt", "waiting"]


class FeasibilityBox(QFrame):
    """Keeps its room while a new answer is worked out, and is faint until then."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("feasibility")
        self._kind: BoxKind = "waiting"
        self._is_current = True
        self._sheet = ""
        self._sentence = QLabel(self)
        self._sentence.setWordWrap(True)
        self._sentence.setTextFormat(Qt.TextFormat.PlainText)
        self._sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._links = QWidget(self)
        self._flow = FlowLayout(self._links, gap=8)
        self._offers: tuple[str, ...] = ()
        column = QVBoxLayout(self)
        column.setContentsMargins(9, 7, 9, 7)
        column.setSpacing(4)
        column.addWidget(self._sentence)
        column.addWidget(self._links)
        self.setAccessibleName(self.tr("Whether the figures can be met"))
        self._restyle()

    @property
    def sentence(self) -> str:
        """What is said."""
        return self._sentence.text()

    @property
    def buttons(self) -> list[QPushButton]:
        """What is offered."""
        found = [self._flow.itemAt(index) for index in range(self._flow.count())]
        widgets = [item.widget() for item in found if item is not None]
        return [widget for widget in widgets if isinstance(widget, QPushButton)]

    def say(
        self,
        kind: BoxKind,
        sentence: str,
        offers: Iterable[tuple[str, Callable[[], object]]] = (),
        *,
        is_current: bool = True,
    ) -> None:
        """Show a sentence and a link for each offer."""
        sign = {"good": "✓ ", "doubt": "! ", "waiting": ""}[kind]
        sentence = sentence[:1].upper() + sentence[1:]
        self._sentence.setText(f"{sign}{sentence}")
        self.setAccessibleDescription(sentence)
        self._kind, self._is_current = kind, is_current
        while (item := self._flow.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        for text, do in offers:
            button = QPushButton(text, self._links)
            button.setAccessibleName(text)
            button.setToolTip(self.tr("{offer}: one step that Undo takes back").format(offer=text))
            button.clicked.connect(lambda _checked=False, do=do: do())
            self._flow.addWidget(button)
            button.show()
        self._links.setVisible(self._flow.count() > 0)
        self._restyle()

    def changeEvent(self, event: QEvent) -> None:
        """Take the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._restyle()

    def _restyle(self) -> None:
        of = colours()
        text, back, border = {
            "good": (of.good, of.good_soft, of.good),
            "doubt": (of.warning, of.warning_soft, of.warning_border),
            "waiting": (of.muted, of.window, of.border),
        }[self._kind]
        words = of.text if self._kind == "good" and self._is_current else text
        sheet = (
            f"#feasibility {{ background: {back}; border: 1px solid {border}; border-radius: 4px; }}"
            f"#feasibility QLabel {{ color: {words if self._is_current else of.muted}; }}"
        )
        # A sheet changes the palette, which asks for this again.
        if sheet != self._sheet:
            self._sheet = sheet
            self.setStyleSheet(sheet)
