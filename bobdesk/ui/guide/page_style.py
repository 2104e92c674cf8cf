"""How a page of the guide looks: sizes, spaces and colours laid over what Qt reads from Markdown."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QFontDatabase,
    QTextBlock,
    QTextBlockFormat,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFrame,
    QTextLength,
    QTextTable,
)

from bobdesk.ui.theme import colours

_LINE_HEIGHT = 130.0
# By the level of the heading: size beside the text's, space above and below beside it.
_HEADINGS = {1: (1.8, 0.2, 0.7), 2: (1.35, 1.5, 0.5), 3: (1.1, 1.1, 0.3)}
_PARAGRAPH = 0.65
_ITEM = 0.35
_CELL = 0.45


def style_page(document: QTextDocument, size: float) -> None:
    """Give a page that was read from Markdown its look.

    Parameters
    ----------
    size
        Of the text, points.
    """
    cursor = QTextCursor(document)
    cursor.beginEditBlock()
    block = document.begin()
    while block.isValid():
        _style_block(block, size)
        block = block.next()
    _style_tables(document.rootFrame(), size)
    cursor.endEditBlock()
    document.setUndoRedoEnabled(False)


def _style_block(block: QTextBlock, size: float) -> None:
    of = colours()
    cursor = QTextCursor(block)
    shape = QTextBlockFormat()
    level = block.blockFormat().headingLevel()
    larger, above, below = _HEADINGS[min(level, 3)] if level else (1.0, 0.0, 0.0)
    in_table = cursor.currentTable() is not None
    is_quote = block.blockFormat().hasProperty(QTextFormat.Property.BlockQuoteLevel)
    is_code = block.blockFormat().hasProperty(QTextFormat.Property.BlockCodeFence)
    if level:
        shape.setTopMargin(above * size * 1.6)
        shape.setBottomMargin(below * size * 1.6)
    elif is_code:
        shape.setBackground(QColor(of.alternate))
        shape.setLeftMargin(size)
    elif in_table:
        shape.setTopMargin(0)
        shape.setBottomMargin(0)
    else:
        below = _ITEM if block.textList() is not None else _PARAGRAPH
        shape.setTopMargin(0)
        shape.setBottomMargin(below * size * 1.6)
        shape.setLineHeight(_LINE_HEIGHT, QTextBlockFormat.LineHeightTypes.ProportionalHeight.value)
    if is_quote:
        shape.setBackground(QColor(of.accent_soft))
        shape.setLeftMargin(size)
        shape.setRightMargin(size)
    cursor.mergeBlockFormat(shape)
    if level:
        _over(block, _heading(larger * size))
    for start, length, found in _fragments(block):
        if found.isImageFormat():
            continue
        if found.isAnchor():
            _over_part(document_of(block), start, length, _link())
        elif found.fontFixedPitch() or found.fontFamilies() == ["monospace"]:
            _over_part(document_of(block), start, length, _code(size, in_text=not is_code))


def document_of(block: QTextBlock) -> QTextDocument:
    """Return the document that a block is of."""
    document = block.document()
    assert document is not None
    return document


def _fragments(block: QTextBlock) -> list[tuple[int, int, QTextCharFormat]]:
    found = []
    at = block.begin()
    while not at.atEnd():
        piece = at.fragment()
        if piece.isValid():
            found.append((piece.position(), piece.length(), piece.charFormat()))
        at += 1
    return found


def _over(block: QTextBlock, look: QTextCharFormat) -> None:
    _over_part(document_of(block), block.position(), block.length() - 1, look)


def _over_part(document: QTextDocument, start: int, length: int, look: QTextCharFormat) -> None:
    cursor = QTextCursor(document)
    cursor.setPosition(start)
    cursor.setPosition(start + length, QTextCursor.MoveMode.KeepAnchor)
    cursor.mergeCharFormat(look)


def _heading(size: float) -> QTextCharFormat:
    look = QTextCharFormat()
    look.setProperty(QTextFormat.Property.FontSizeAdjustment, 0)
    look.setFontPointSize(size)
    look.setFontWeight(QFont.Weight.DemiBold)
    return look


def _link() -> QTextCharFormat:
    look = QTextCharFormat()
    look.setForeground(QBrush(QColor(colours().accent)))
    look.setFontUnderline(True)
    return look


def _code(size: float, *, in_text: bool) -> QTextCharFormat:
    look = QTextCharFormat()
    fixed = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    look.setFontFamilies([fixed.family(), "monospace"])
    look.setFontPointSize(size * 0.95)
    if in_text:
        look.setBackground(QBrush(QColor(colours().selected_row if colours().is_dark else colours().alternate)))
    return look


def _style_tables(frame: QTextFrame, size: float) -> None:
    of = colours()
    for child in frame.childFrames():
        if isinstance(child, QTextTable):
            shape = child.format()
            shape.setBorder(1)
            shape.setBorderCollapse(True)
            shape.setBorderBrush(QBrush(QColor(of.border)))
            shape.setCellPadding(_CELL * size * 1.6)
            shape.setCellSpacing(0)
            shape.setBottomMargin(size * 1.3)
            shape.setWidth(QTextLength(QTextLength.Type.PercentageLength, 100))
            child.setFormat(shape)
            for column in range(child.columns()):
                cell = child.cellAt(0, column)
                head = cell.format()
                head.setBackground(QBrush(QColor(of.window)))
                cell.setFormat(head)
                for block in _blocks_between(child.document(), cell.firstPosition(), cell.lastPosition()):
                    alignment = QTextBlockFormat()
                    alignment.setAlignment(Qt.AlignmentFlag.AlignLeft)
                    QTextCursor(block).mergeBlockFormat(alignment)
        _style_tables(child, size)


def _blocks_between(document: QTextDocument, first: int, last: int) -> list[QTextBlock]:
    found = []
    block = document.findBlock(first)
    while block.isValid() and block.position() <= last:
        found.append(block)
        block = block.next()
    return found
