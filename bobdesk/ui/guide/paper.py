"""The whole guide on paper, as a PDF."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QSizeF, QUrl
from PySide6.QtGui import (
    QFont,
    QImage,
    QPageLayout,
    QPageSize,
    QPdfWriter,
    QTextBlockFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
)

from bobdesk import __version__
from bobdesk.ui.guide.page_style import pictures_of, style_page
from bobdesk.ui.guide.pages import Page, keep_units
from bobdesk.ui.theme import on_paper

_DPI = 96
_TEXT_PT = 10.0
_PICTURE_SCALE = 2.0
# A picture shares its page with what is said about it.
_HIGHEST = 0.42


def guide_pdf(pages: tuple[Page, ...], folder: Path, title: str) -> bytes:
    """Return all pages in A4, each beginning on a sheet of its own.

    Parameters
    ----------
    folder
        Where the pictures are named from.
    """
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setPageSize(QPageSize(QPageSize.PageSizeId.A4))
    writer.setPageMargins(QMarginsF(20, 18, 20, 18), QPageLayout.Unit.Millimeter)
    writer.setResolution(_DPI)
    writer.setTitle(title)
    writer.setCreator(f"BobDesk {__version__}")
    size = QSizeF(writer.pageLayout().paintRectPixels(_DPI).size())
    document = QTextDocument()
    font = QFont(document.defaultFont())
    font.setPointSizeF(_TEXT_PT)
    document.setDefaultFont(font)
    document.setPageSize(size)
    document.setMarkdown(keep_units("\n\n".join(page.text for page in pages)))
    with on_paper():
        style_page(document, _TEXT_PT)
    _fit_pictures(document, folder, size)
    _begin_pages(document)
    document.setPageSize(size)
    document.print_(writer)
    buffer.close()
    return bytes(buffer.data().data())


def _fit_pictures(document: QTextDocument, folder: Path, page: QSizeF) -> None:
    for position, shape in pictures_of(document):
        image = QImage(str(folder / shape.name()))
        if image.isNull():
            continue
        width = min(
            image.width() / _PICTURE_SCALE, page.width(), _HIGHEST * page.height() * image.width() / image.height()
        )
        shape.setWidth(round(width))
        shape.setHeight(round(width * image.height() / image.width()))
        document.addResource(QTextDocument.ResourceType.ImageResource.value, QUrl(shape.name()), image)
        cursor = QTextCursor(document)
        cursor.setPosition(position)
        cursor.setPosition(position + 1, QTextCursor.MoveMode.KeepAnchor)
        cursor.setCharFormat(shape)


def _begin_pages(document: QTextDocument) -> None:
    shape = QTextBlockFormat()
    shape.setPageBreakPolicy(QTextFormat.PageBreakFlag.PageBreak_AlwaysBefore)
    block = document.begin().next()
    while block.isValid():
        if block.blockFormat().headingLevel() == 1:
            QTextCursor(block).mergeBlockFormat(shape)
        block = block.next()
