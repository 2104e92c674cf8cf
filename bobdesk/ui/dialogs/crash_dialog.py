"""The dialog after a fault: the work is kept, and what can be done now."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFontDatabase, QGuiApplication, QShowEvent
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from bobdesk.ui.fault_report import report
from bobdesk.ui.icons import icon

_MOST_TRACES = 10
_DETAILS_HEIGHT = 240
_NARROWEST = 560


class CrashDialog(QDialog):
    """One dialog for all faults until it is closed.

    Attributes
    ----------
    wants_to_leave
        Whether a copy shall be saved and the program end.
    """

    def __init__(self, trace: str, sentence: str, *, kept: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("crash")
        self.setWindowTitle(self.tr("Something went wrong"))
        self.setModal(True)
        self.wants_to_leave = False
        self._traces = [trace]
        self._not_shown = 0
        self._sentence = QLabel(sentence)
        self._sentence.setProperty("kind", "muted")
        self._details = QPlainTextEdit()
        self._make_details()
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 18, 20, 16)
        column.setSpacing(12)
        column.addLayout(self._head(kept=kept))
        column.addWidget(self._details, 1)
        column.addLayout(self._make_buttons())
        self._show_traces()

    def showEvent(self, event: QShowEvent) -> None:
        """Be wide enough for the sentences, and for the buttons in every language."""
        super().showEvent(event)
        self._fit()

    def add(self, trace: str) -> None:
        """Take a further fault into the report."""
        if trace in self._traces or len(self._traces) >= _MOST_TRACES:
            self._not_shown += 1
        else:
            self._traces.append(trace)
        self._show_traces()

    @property
    def report(self) -> str:
        """What "Copy report" copies."""
        more = [] if not self._not_shown else [f"({self._not_shown} more)"]
        return report("\n\n".join([*self._traces, *more]))

    def _head(self, *, kept: bool) -> QHBoxLayout:
        sign = QLabel()
        sign.setPixmap(icon("error").pixmap(QSize(32, 32)))
        sign.setAccessibleName(self.tr("Error"))
        title = QLabel(self.tr("BobDesk has made a mistake."))
        title.setProperty("kind", "title")
        if kept:
            text = self.tr("Your work is kept in a recovery copy. You can go on; save soon, and look at the last edit.")
        else:
            text = self.tr("The recovery copy could not be written. Save your work now, under another name if need be.")
        words = QLabel(text)
        words.setWordWrap(True)
        self._sentence.setWordWrap(True)
        self._sentence.setTextFormat(Qt.TextFormat.PlainText)
        beside = QVBoxLayout()
        beside.setSpacing(6)
        for label in (title, words, self._sentence):
            beside.addWidget(label)
        head = QHBoxLayout()
        head.setSpacing(14)
        head.addWidget(sign, 0, Qt.AlignmentFlag.AlignTop)
        head.addLayout(beside, 1)
        return head

    def _make_details(self) -> None:
        self._details.setReadOnly(True)
        self._details.setTabChangesFocus(True)
        self._details.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._details.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._details.setAccessibleName(self.tr("Details"))
        self._details.setToolTip(self.tr("What happened, for those who mend the program"))
        self._details.setMinimumHeight(_DETAILS_HEIGHT)
        self._details.hide()

    def _make_buttons(self) -> QHBoxLayout:
        self.details_button = self._button(self.tr("Show details"), self.tr("What went wrong, for a report"))
        self.details_button.setCheckable(True)
        self.details_button.toggled.connect(self._on_details)
        self.copy_button = self._button(
            self.tr("Copy report"), self.tr("Copy versions and details; your folders are not in it")
        )
        self.copy_button.clicked.connect(self._copy)
        self.leave_button = self._button(
            self.tr("Save a copy and quit"), self.tr("End now; the next start offers the recovery copy")
        )
        self.leave_button.clicked.connect(self._leave)
        self.continue_button = self._button(self.tr("Continue"), self.tr("Go on working"))
        self.continue_button.setProperty("kind", "primary")
        self.continue_button.setDefault(True)
        self.continue_button.clicked.connect(self.accept)
        row = QHBoxLayout()
        row.addWidget(self.details_button)
        row.addWidget(self.copy_button)
        row.addStretch(1)
        row.addWidget(self.leave_button)
        row.addWidget(self.continue_button)
        return row

    def _button(self, text: str, tip: str) -> QPushButton:
        button = QPushButton(text)
        button.setToolTip(tip)
        button.setAutoDefault(False)
        return button

    def _show_traces(self) -> None:
        self._details.setPlainText(self.report)

    def _on_details(self, shown: bool) -> None:
        self._details.setVisible(shown)
        self.details_button.setText(self.tr("Hide details") if shown else self.tr("Show details"))
        self._fit()
        self.adjustSize()

    def _fit(self) -> None:
        layout = self.layout()
        if layout is not None:
            self.setMinimumWidth(max(_NARROWEST, layout.totalMinimumSize().width()))

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(self.report)
        self.copy_button.setText(self.tr("Copied"))

    def _leave(self) -> None:
        self.wants_to_leave = True
        self.accept()
