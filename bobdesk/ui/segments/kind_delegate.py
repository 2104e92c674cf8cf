"""The kind of a segment in a table: a chip with its line and its word, and a list to choose from."""

from __future__ import annotations

from PySide6.QtCore import QAbstractItemModel, QModelIndex, QPersistentModelIndex, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen
from PySide6.QtWidgets import QComboBox, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from bobdesk.ui.strips.contents import shade

Index = QModelIndex | QPersistentModelIndex
_LINE = 14.0


class KindDelegate(QStyledItemDelegate):
    """Told apart by word, by the drawn line (flat and thin, bent and thick) and by colour.

    Parameters
    ----------
    kinds
        Both kinds, as they are stored and as they are shown.
    """

    def __init__(self, kinds: tuple[tuple[str, str], ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._kinds = kinds

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Draw the chip."""
        kind = index.data(Qt.ItemDataRole.EditRole)
        word = str(index.data() or "")
        painter.save()
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(option.rect, shade("selected_row"))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(option.font)
        height = min(option.fontMetrics.height() + 3, option.rect.height() - 4)
        width = option.fontMetrics.horizontalAdvance(word) + _LINE + 22
        box = QRectF(option.rect.left() + 4, option.rect.center().y() - height / 2 + 0.5, width, height)
        colour = "curve" if kind == "curve" else "straight"
        painter.setPen(QPen(shade(colour), 1))
        painter.setBrush(shade(colour, 44))
        painter.drawRoundedRect(box, height / 2, height / 2)
        self._draw_line(painter, QPointF(box.left() + 8, box.center().y()), colour)
        painter.setPen(shade("text"))
        words = box.adjusted(_LINE + 14, 0, 0, 0)
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, word)
        painter.restore()

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """Return the size of the longest chip."""
        widest = max(option.fontMetrics.horizontalAdvance(word) for _, word in self._kinds)
        return QSize(round(widest + _LINE + 34), option.fontMetrics.height() + 8)

    def createEditor(self, parent: QWidget, _option: QStyleOptionViewItem, _index: Index) -> QWidget:
        """Return the list of kinds."""
        box = QComboBox(parent)
        for kind, word in self._kinds:
            box.addItem(word, kind)

        def done(_row: int) -> None:
            self.commitData.emit(box)
            self.closeEditor.emit(box)

        box.activated.connect(done)
        return box

    def setEditorData(self, editor: QWidget, index: Index) -> None:
        """Show the kind that it is."""
        assert isinstance(editor, QComboBox)
        editor.setCurrentIndex(editor.findData(index.data(Qt.ItemDataRole.EditRole)))

    def setModelData(self, editor: QWidget, model: QAbstractItemModel, index: Index) -> None:
        """Take the kind that was chosen."""
        assert isinstance(editor, QComboBox)
        model.setData(index, editor.currentData(), Qt.ItemDataRole.EditRole)

    def _draw_line(self, painter: QPainter, at: QPointF, colour: str) -> None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if colour == "straight":
            painter.setPen(QPen(shade(colour), 1.6))
            painter.drawLine(at, at + QPointF(_LINE, 0))
            return
        bow = QPainterPath(at + QPointF(0, 3))
        bow.quadTo(at + QPointF(_LINE / 2, -7), at + QPointF(_LINE, 3))
        painter.setPen(QPen(shade(colour), 3.0, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawPath(bow)
