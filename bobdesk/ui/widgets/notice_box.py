"""A sentence in a panel that wants to be seen, with what can be done about it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QVBoxLayout, QWidget

from bobdesk.ui.widgets.flow_layout import FlowLayout

Remedies = Sequence[tuple[str, Callable[[], object]]]
_MOST_REMEDIES = 3


class NoticeBox(QFrame):
    """Hidden until there is something to say."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("kind", "notice")
        self._sentence = QLabel(self)
        self._sentence.setWordWrap(True)
        self._remedies: Remedies = ()
        self._holder = QWidget(self)
        flow = FlowLayout(self._holder, gap=10)
        # Made once: later ones would come last in the order of the Tab key.
        self.links = tuple(QPushButton(self._holder) for _ in range(_MOST_REMEDIES))
        for index, link in enumerate(self.links):
            link.setProperty("kind", "link")
            link.clicked.connect(partial(self._do, index))
            link.hide()
            flow.addWidget(link)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.setSpacing(2)
        column.addWidget(self._sentence)
        column.addWidget(self._holder)
        self.hide()

    @property
    def sentence(self) -> str:
        """What is said; "" while nothing is."""
        return self._sentence.text()

    def say(self, sentence: str, remedies: Remedies = ()) -> None:
        """Show a sentence and a link for each remedy, three at most; "" hides the box."""
        self._sentence.setText(sentence)
        self._remedies = remedies
        for index, link in enumerate(self.links):
            link.setVisible(index < len(remedies))
            if index < len(remedies):
                link.setText(remedies[index][0])
                link.setAccessibleName(remedies[index][0])
        self._holder.setVisible(bool(remedies))
        self.setVisible(bool(sentence))

    def _do(self, index: int, _checked: bool = False) -> None:
        self._remedies[index][1]()
