"""A sentence in a panel that wants to be seen, with what can be done about it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QVBoxLayout, QWidget

from bobdesk.ui.widgets.flow_layout import FlowLayout

Remedies = Iterable[tuple[str, Callable[[], object]]]


class NoticeBox(QFrame):
    """Hidden until there is something to say."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("kind", "notice")
        self.setObjectName("noticeBox")
        self._sentence = QLabel(self)
        self._sentence.setWordWrap(True)
        self._links = QWidget(self)
        self._flow = FlowLayout(self._links, gap=10)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.setSpacing(2)
        column.addWidget(self._sentence)
        column.addWidget(self._links)
        self.hide()

    @property
    def sentence(self) -> str:
        """What is said; "" while nothing is."""
        return self._sentence.text()

    def say(self, sentence: str, remedies: Remedies = ()) -> None:
        """Show a sentence and a link for each remedy; "" hides the box."""
        self._sentence.setText(sentence)
        while (item := self._flow.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        for text, do in remedies:
            button = QPushButton(text, self._links)
            button.setProperty("kind", "link")
            button.setAccessibleName(text)
            button.clicked.connect(lambda _checked=False, do=do: do())
            self._flow.addWidget(button)
            button.show()
        self._links.setVisible(self._flow.count() > 0)
        self.setVisible(bool(sentence))
