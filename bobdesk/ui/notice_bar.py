"""The sentences to the user, stacked above the plan view, newest first; what is more than a few lines is scrolled."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QAccessible, QAccessibleEvent, QHideEvent, QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from bobdesk.ui.banner import Banner
from bobdesk.ui.icons import icon
from bobdesk.ui.notices import Notice, Notices, Remedy
from bobdesk.ui.widgets.long_names import breakable

_MOST_SHOWN = 4
_MOST_LINES = 7
_NOTE_LASTS_MS = 6000


class NoticeRow(Banner):
    """One notice.

    Signals
    -------
    done
        It was closed, or is a note whose time is over.
    """

    done = Signal()

    def __init__(self, notice: Notice, parent: QWidget | None = None) -> None:
        super().__init__(notice.weight, parent)
        self.notice = notice
        self.setAccessibleName(notice.sentence)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(_NOTE_LASTS_MS)
        self._timer.timeout.connect(self._on_time)

        sentence = QLabel(breakable(notice.sentence))
        sentence.setTextFormat(Qt.TextFormat.PlainText)
        sentence.setWordWrap(True)
        sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        sentence.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.row.addWidget(sentence, 1)
        links = QHBoxLayout()
        links.setSpacing(10)
        for remedy in notice.remedies:
            links.addWidget(self._link(remedy))
        self.row.addLayout(links)
        self.close_button = QToolButton()
        self.close_button.setAutoRaise(True)
        self.close_button.setIconSize(QSize(14, 14))
        self.close_button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.close_button.setToolTip(self.tr("Close this notice"))
        self.close_button.setAccessibleName(self.tr("Close this notice"))
        self.close_button.clicked.connect(self.done)
        self.row.addWidget(self.close_button, 0, Qt.AlignmentFlag.AlignTop)
        self._draw_close()

    def renew(self) -> None:
        """Have the note's time begin again."""
        if self.notice.weight == "note" and not self.notice.stays and self.isVisible():
            self._timer.start()

    def rest(self) -> None:
        """Stop the clock for good: the row is thrown away."""
        self._timer.stop()

    def showEvent(self, event: QShowEvent) -> None:
        """Begin a note's time when it can be read."""
        super().showEvent(event)
        self.renew()

    def hideEvent(self, event: QHideEvent) -> None:
        """No clock runs for what cannot be read."""
        self._timer.stop()
        super().hideEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc closes the notice that the keyboard is in."""
        if event.key() == Qt.Key.Key_Escape:
            self.done.emit()
        else:
            super().keyPressEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        """Follow the palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "close_button"):
            self._draw_close()

    def _link(self, remedy: Remedy) -> QPushButton:
        link = QPushButton(remedy.text)
        link.setProperty("kind", "link")
        link.setCursor(Qt.CursorShape.PointingHandCursor)
        link.setToolTip(remedy.text)
        link.setAutoDefault(False)
        link.clicked.connect(lambda: self._remedied(remedy))
        return link

    def _remedied(self, remedy: Remedy) -> None:
        # first away with it: what the remedy does may tell of something new
        self.done.emit()
        remedy.do()

    def _on_time(self) -> None:
        focus = QApplication.focusWidget()
        if self.underMouse() or (focus is not None and self.isAncestorOf(focus)):
            self._timer.start()
        else:
            self.done.emit()

    def _draw_close(self) -> None:
        self.close_button.setIcon(icon("close"))


class NoticeBar(QWidget):
    """Shows at most four notices; it is hidden while there are none."""

    def __init__(self, notices: Notices, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("notice-bar")
        self.setAccessibleName(self.tr("Notices"))
        self._rows: list[NoticeRow] = []
        inside = QWidget()
        inside.installEventFilter(self)
        self._stack = QVBoxLayout(inside)
        self._stack.setContentsMargins(6, 6, 6, 6)
        self._stack.setSpacing(4)
        self._scrolled = QScrollArea(self)
        self._scrolled.setFrameShape(QFrame.Shape.NoFrame)
        self._scrolled.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._scrolled.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scrolled.setWidgetResizable(True)
        self._scrolled.setWidget(inside)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.hide()
        notices.told.connect(self.show_notice)

    @property
    def shown(self) -> tuple[Notice, ...]:
        """The notices that are shown, newest first."""
        return tuple(row.notice for row in self._rows)

    def show_notice(self, notice: Notice) -> None:
        """Put a notice at the top; one of the same kind gives way to it."""
        for row in [row for row in self._rows if row.notice.kind == notice.kind]:
            self._drop(row)
        while len(self._rows) >= _MOST_SHOWN:
            notes = [row for row in self._rows if row.notice.weight == "note"]
            self._drop((notes or self._rows)[-1])
        row = NoticeRow(notice, self)
        row.done.connect(lambda: self._drop(row))
        self._rows.insert(0, row)
        self._stack.insertWidget(0, row)
        row.show()
        self.show()
        self._fit()
        self._scrolled.verticalScrollBar().setValue(0)
        self._set_tab_order()
        _announce(row)

    def leave_document(self) -> None:
        """Close what was said of the document until now; what stays until it is closed concerns the program."""
        for row in tuple(self._rows):
            if not row.notice.stays:
                self._drop(row)

    def clear(self) -> None:
        """Close all notices."""
        for row in tuple(self._rows):
            self._drop(row)

    def _drop(self, row: NoticeRow) -> None:
        if row not in self._rows:
            return
        focus = QApplication.focusWidget()
        had_focus = focus is not None and row.isAncestorOf(focus)
        self._rows.remove(row)
        row.rest()
        self._stack.removeWidget(row)
        if had_focus and self._rows:
            self._rows[0].close_button.setFocus()
        row.hide()
        row.deleteLater()
        self.setVisible(bool(self._rows))
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the notices when their letters or buttons become known."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._fit()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Be as high as the sentences are in another width."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Be as high as the notices, but never so high that the plan goes out of sight."""
        self._stack.activate()
        needed = self._stack.heightForWidth(self.width()) if self._stack.hasHeightForWidth() else 0
        needed = max(needed, self._stack.minimumSize().height())
        self.setFixedHeight(min(needed, _MOST_LINES * self.fontMetrics().lineSpacing()))
        # Not by a layout: Qt wants room for scroll bars, which is more than one short sentence needs.
        self._scrolled.setGeometry(self.rect())

    def _set_tab_order(self) -> None:
        for before, after in zip(self._rows, self._rows[1:], strict=False):
            first = after.findChildren(QPushButton)
            QWidget.setTabOrder(before.close_button, first[0] if first else after.close_button)


def _announce(row: QObject) -> None:
    """Have a screen reader say the notice, wherever the focus is."""
    QAccessible.updateAccessibility(QAccessibleEvent(row, QAccessible.Event.Alert))
