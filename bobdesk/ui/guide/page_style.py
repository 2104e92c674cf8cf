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
    QTextFrameFormat,
    QTextImageFormat,
    QTextLength,
    QTextTable,
    QTextTableCell,
    QTextTableCellFormat,
)

from bobdesk.ui.theme import colours

_LINE_HEIGHT = 130.0
# By the level of the heading: size beside the text's, space above and below beside it.
_HEADINGS = {1: (1.8, 0.2, 0.7), 2: (1.35, 1.5, 0.5), 3: (1.1, 1.1, 0.3)}
_PARAGRAPH = 0.65
_ITEM = 0.35
_CELL = 0.45
_FAINT = 130


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
        _style_block(document, block, size)
        block = block.next()
    _style_tables(document, document.rootFrame(), size)
    cursor.endEditBlock()


def pictures_of(document: QTextDocument) -> list[tuple[int, QTextImageFormat]]:
    """Return where the pictures of a page stand, and how each is shown."""
    found = []
    block = document.begin()
    while block.isValid():
        for start, _length, look in _fragments(block):
            if look.isImageFormat():
                found.append((start, QTextImageFormat(look.toImageFormat())))
        block = block.next()
    return found


def _style_block(document: QTextDocument, block: QTextBlock, size: float) -> None:
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
        # A picture is a line as high as itself, and needs no more.
        if block.text() != "\ufffc":
            shape.setLineHeight(_LINE_HEIGHT, QTextBlockFormat.LineHeightTypes.ProportionalHeight.value)
    if is_quote:
        shape.setBackground(QColor(of.accent_soft))
        shape.setLeftMargin(size)
        shape.setRightMargin(size)
    cursor.mergeBlockFormat(shape)
    for start, length, found in _fragments(block):
        if found.isImageFormat():
            continue
        if level:
            _instead(document, start, length, _heading(found, larger * size))
        elif found.isAnchor():
            _over_part(document, start, length, _link())
        elif found.fontFixedPitch() or found.fontFamilies() == ["monospace"]:
            _over_part(document, start, length, _code(size, in_text=not is_code))


def _fragments(block: QTextBlock) -> list[tuple[int, int, QTextCharFormat]]:
    found = []
    at = block.begin()
    while not at.atEnd():
        piece = at.fragment()
        if piece.isValid():
            found.append((piece.position(), piece.length(), piece.charFormat()))
        at += 1
    return found


def _instead(document: QTextDocument, start: int, length: int, look: QTextCharFormat) -> None:
    cursor = QTextCursor(document)
    cursor.setPosition(start)
    cursor.setPosition(start + length, QTextCursor.MoveMode.KeepAnchor)
    cursor.setCharFormat(look)


def _over_part(document: QTextDocument, start: int, length: int, look: QTextCharFormat) -> None:
    cursor = QTextCursor(document)
    cursor.setPosition(start)
    cursor.setPosition(start + length, QTextCursor.MoveMode.KeepAnchor)
    cursor.mergeCharFormat(look)


def _heading(before: QTextCharFormat, size: float) -> QTextCharFormat:
    look = QTextCharFormat(before)
    # It would win over the size.
    look.clearProperty(QTextFormat.Property.FontSizeAdjustment)
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
        ground = QColor(colours().border)
        ground.setAlpha(_FAINT)
        look.setBackground(QBrush(ground))
    return look


def _style_tables(document: QTextDocument, frame: QTextFrame, size: float) -> None:
    of = colours()
    for child in frame.childFrames():
        if isinstance(child, QTextTable):
            shape = child.format()
            shape.setBorder(0)
            shape.setCellPadding(_CELL * size * 1.6)
            shape.setCellSpacing(0)
            shape.setBottomMargin(size * 1.3)
            shape.setWidth(QTextLength(QTextLength.Type.PercentageLength, 100))
            child.setFormat(shape)
            for row in range(child.rows()):
                for column in range(child.columns()):
                    _style_cell(document, child.cellAt(row, column), is_head=row == 0, line=QColor(of.border))
        _style_tables(document, child, size)


def _style_cell(document: QTextDocument, cell: QTextTableCell, *, is_head: bool, line: QColor) -> None:
    look = QTextTableCellFormat(cell.format().toTableCellFormat())
    look.setBottomBorder(1.5 if is_head else 1)
    look.setBottomBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    look.setBottomBorderBrush(QBrush(line))
    cell.setFormat(look)
    block = cell.firstCursorPosition().block()
    alignment = QTextBlockFormat()
    alignment.setAlignment(Qt.AlignmentFlag.AlignLeft)
    QTextCursor(block).mergeBlockFormat(alignment)
