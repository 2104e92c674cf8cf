"""The cards of the start page: large buttons, and recent projects with a picture of their line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QPoint, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QFont,
    QFontMetricsF,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import QAbstractButton, QMenu, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from bobdesk.ui.icons import icon
from bobdesk.ui.line_picture import paint_line
from bobdesk.ui.recent_entries import RecentEntry
from bobdesk.ui.theme import colours
from bobdesk.ui.when import Moments
from bobdesk.ui.widgets.flow_layout import FlowLayout

_ROUND = 6.0
_ARROWS = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down)


class Card(QAbstractButton):
    """A button that draws a rounded card and says where the arrow keys lead."""

    arrow = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter clicks as Space does; arrows go to the neighbour."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        elif event.key() in _ARROWS:
            self.arrow.emit(event.key())
        else:
            super().keyPressEvent(event)

    def paint_ground(self, painter: QPainter, *, primary: bool = False) -> None:
        """Draw the card itself: under the mouse and with the focus its border stands out."""
        of = colours()
        ground = of.accent if primary else of.accent_soft if self.isDown() else of.base
        line = of.accent if primary or self.underMouse() or self.hasFocus() else of.border
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(QColor(ground))
        painter.setPen(QPen(QColor(line), 1))
        place = QRectF(self.rect()).adjusted(1.5, 1.5, -1.5, -1.5)
        painter.drawRoundedRect(place, _ROUND, _ROUND)
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(of.text if primary else of.accent), 2))
            painter.drawRoundedRect(place.adjusted(-0.5, -0.5, 0.5, 0.5), _ROUND, _ROUND)

    def _font(self, *, bold: bool = False, smaller: bool = False) -> QFont:
        font = QFont(self.font())
        font.setBold(bold)
        if smaller:
            font.setPointSizeF(font.pointSizeF() * 0.92)
        return font


class BigButton(Card):
    """A large button: icon, title, and a line that says more."""

    def __init__(self, title: str, sentence: str, icon_name: str, *, primary: bool = False) -> None:
        super().__init__()
        self.setText(title)
        self._sentence, self._icon_name, self._primary = sentence, icon_name, primary
        self.setAccessibleName(title.removesuffix("…"))
        self.setAccessibleDescription(sentence)
        self.setToolTip(f"{title.removesuffix('…')}: {sentence}")
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """As large as both lines need."""
        title = QFontMetricsF(self._font(bold=True))
        more = QFontMetricsF(self._font(smaller=True))
        width = max(title.horizontalAdvance(self.text()), more.horizontalAdvance(self._sentence))
        return QSize(round(width) + 78, round(title.height() + more.height()) + 36)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw it."""
        of = colours()
        painter = QPainter(self)
        self.paint_ground(painter, primary=self._primary)
        drawing = icon(self._icon_name, of.on_accent if self._primary else None)
        drawing.paint(painter, 20, (self.height() - 24) // 2, 24, 24)
        title, more = self._font(bold=True), self._font(smaller=True)
        height = QFontMetricsF(title).height() + QFontMetricsF(more).height() + 2
        top = (self.height() - height) / 2
        painter.setFont(title)
        painter.setPen(QColor(of.on_accent if self._primary else of.text))
        painter.drawText(QRectF(58, top, self.width() - 60, height), Qt.AlignmentFlag.AlignTop, self.text())
        painter.setFont(more)
        painter.setPen(QColor(of.on_accent if self._primary else of.muted))
        painter.drawText(QRectF(58, top, self.width() - 60, height), Qt.AlignmentFlag.AlignBottom, self._sentence)
        painter.end()


class RecentCard(Card):
    """A recent project.

    Signals
    -------
    forget
        It shall be taken off the list.
    """

    forget = Signal(Path)

    def __init__(self, entry: RecentEntry, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.entry = entry
        self._moments = Moments(self)
        self.setText(entry.name)
        self.setAccessibleName(entry.name)
        self.setAccessibleDescription(self.below)
        self.setToolTip(str(entry.path))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    @property
    def below(self) -> str:
        """The line under the name: when, and how far the work is."""
        if self.entry.modified is None or self.entry.state == "damaged":
            return self._state()
        when = self._moments.text(self.entry.modified)
        return " · ".join(part for part in (when, self._state()) if part)

    def sizeHint(self) -> QSize:
        """The same for all, in proportion to the font."""
        lines = QFontMetricsF(self._font(bold=True)).height() + QFontMetricsF(self._font(smaller=True)).height()
        return QSize(round(QFontMetricsF(self.font()).averageCharWidth() * 26) + 28, round(lines) + 112)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer to take it off the list."""
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction(icon("open"), self.tr("Open"), self.click)
        menu.addAction(icon("close"), self.tr("Remove from the list"), self._forget)
        menu.popup(event.globalPos())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Delete takes it off the list; the file stays."""
        if event.key() == Qt.Key.Key_Delete:
            self._forget()
        elif event.key() == Qt.Key.Key_Menu:
            self.contextMenuEvent(
                QContextMenuEvent(QContextMenuEvent.Reason.Keyboard, QPoint(), self.mapToGlobal(self.rect().center()))
            )
        else:
            super().keyPressEvent(event)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw line, name and state."""
        of = colours()
        is_there = self.entry.state not in ("missing", "damaged")
        painter = QPainter(self)
        self.paint_ground(painter)
        bold, small = self._font(bold=True), self._font(smaller=True)
        name_height, below_height = QFontMetricsF(bold).height(), QFontMetricsF(small).height()
        inner = QRectF(self.rect()).adjusted(14, 14, -14, -12)
        picture = inner.adjusted(2, 2, -2, -(name_height + below_height + 10))
        if len(self.entry.line) > 1:
            paint_line(painter, picture, self.entry.line, of.trace if is_there else of.muted)
        else:
            name = "picture" if self.entry.state == "plan" else "warning" if not is_there else "sample"
            drawing = icon(name, of.muted)
            drawing.paint(painter, picture.center().toPoint().x() - 16, picture.center().toPoint().y() - 16, 32, 32)
        painter.setFont(bold)
        painter.setPen(QColor(of.text if is_there else of.muted))
        self._write(painter, inner, inner.bottom() - name_height - below_height - 1, self.text())
        painter.setFont(small)
        painter.setPen(QColor(of.muted if is_there else of.error))
        self._write(painter, inner, inner.bottom() - below_height, self.below)
        painter.end()

    def _write(self, painter: QPainter, inner: QRectF, top: float, text: str) -> None:
        metrics = painter.fontMetrics()
        shown = metrics.elidedText(text, Qt.TextElideMode.ElideRight, int(inner.width()))
        painter.drawText(QRectF(inner.left(), top, inner.width(), metrics.height()), Qt.AlignmentFlag.AlignLeft, shown)

    def _forget(self) -> None:
        self.forget.emit(self.entry.path)

    def _state(self) -> str:
        return {
            "empty": self.tr("empty"),
            "plan": self.tr("plan"),
            "line": self.tr("centreline"),
            "segments": self.tr("segments"),
            "solved": self.tr("solved"),
            "out of date": self.tr("out of date"),
            "damaged": self.tr("cannot be read"),
            "missing": self.tr("not found"),
            "unknown": "",
        }[self.entry.state]


class CardGrid(QWidget):
    """Recent projects in as many columns as there is room for.

    Signals
    -------
    wanted, forget
        A project's path.
    left_upwards
        The arrow keys go further up than the first row.
    """

    wanted = Signal(Path)
    forget = Signal(Path)
    left_upwards = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.cards: list[RecentCard] = []
        self._cells: list[QWidget] = []
        self._flow = FlowLayout(self, gap=10)

    def show_entries(self, entries: Sequence[RecentEntry]) -> None:
        """Show other projects; the one with the focus keeps it."""
        focused = next((card.entry.path for card in self.cards if card.hasFocus()), None)
        for cell in self._cells:
            self._flow.removeWidget(cell)
            cell.hide()
            cell.deleteLater()
        self.cards, self._cells = [], []
        for entry in entries:
            card = RecentCard(entry)
            card.clicked.connect(lambda _checked=False, path=entry.path: self.wanted.emit(path))
            card.forget.connect(self.forget)
            card.arrow.connect(lambda key, card=card: self._go(card, key))
            self.cards.append(card)
            self._cells.append(self._cell(card))
            self._flow.addWidget(self._cells[-1])
            self._cells[-1].show()
        for card in self.cards:
            if card.entry.path == focused:
                card.setFocus()

    def _cell(self, card: RecentCard) -> QWidget:
        if card.entry.state != "missing":
            card.setParent(self)
            return card
        cell = QWidget(self)
        column = QVBoxLayout(cell)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(card)
        remove = QPushButton(self.tr("Remove from the list"))
        remove.setProperty("kind", "link")
        remove.setCursor(Qt.CursorShape.PointingHandCursor)
        remove.setAccessibleDescription(card.entry.name)
        remove.setToolTip(self.tr("The file is not where it was; nothing is deleted"))
        remove.clicked.connect(lambda: self.forget.emit(card.entry.path))
        column.addWidget(remove, 0, Qt.AlignmentFlag.AlignHCenter)
        return cell

    def _go(self, card: RecentCard, key: int) -> None:
        columns = sum(cell.y() == self._cells[0].y() for cell in self._cells)
        step = {
            Qt.Key.Key_Left: -1,
            Qt.Key.Key_Right: 1,
            Qt.Key.Key_Up: -columns,
            Qt.Key.Key_Down: columns,
        }[Qt.Key(key)]
        there = self.cards.index(card) + step
        if 0 <= there < len(self.cards):
            self.cards[there].setFocus(Qt.FocusReason.TabFocusReason)
        elif key == Qt.Key.Key_Up:
            self.left_upwards.emit()
