"""Shows one page of the guide in the colours of the theme, its pictures as wide as there is room."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSize, Qt, QTimer, QUrl, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QImageReader,
    QKeyEvent,
    QResizeEvent,
    QTextBlock,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextImageFormat,
    QWheelEvent,
)
from PySide6.QtWidgets import QFrame, QTextBrowser, QTextEdit, QWidget

from bobdesk.ui.guide.page_style import pictures_of, style_page
from bobdesk.ui.guide.pages import Page, keep_units, slug
from bobdesk.ui.theme import colours

# The pictures are taken at twice the size at which they are shown.
_PICTURE_SCALE = 2.0
_WIDEST_EM = 63.0
_MARGIN = 28.0
_REST_MS = 80


class GuideBrowser(QTextBrowser):
    """A page, with places in it that can be gone to and words that stand out.

    Parameters
    ----------
    folder
        Where the pages lie; pictures are named from there.

    Signals
    -------
    link_followed
        Where a link leads, as the page has it.
    """

    link_followed = Signal(str)

    def __init__(self, folder: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._folder = folder
        self._page: Page | None = None
        self._zoom = 1.0
        self._words: tuple[str, ...] = ()
        self._fitted: tuple[float, float] = (0.0, 0.0)
        self._at_top: int | None = None
        self.setOpenLinks(False)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setAccessibleName(self.tr("Page of the guide"))
        self.setToolTip("")
        self.anchorClicked.connect(lambda url: self.link_followed.emit(url.toString()))
        self.verticalScrollBar().actionTriggered.connect(self._let_go)
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(_REST_MS)
        self._rest.timeout.connect(self._fit)

    @property
    def page(self) -> Page | None:
        """The page that is shown."""
        return self._page

    @property
    def text_size(self) -> float:
        """Size of the text, points."""
        return self.font().pointSizeF() * 1.08 * self._zoom

    def show_page(self, page: Page) -> None:
        """Show the beginning of a page."""
        self._page = page
        self._at_top = None
        self._draw()
        self.moveCursor(QTextCursor.MoveOperation.Start)
        self.verticalScrollBar().setValue(0)

    def redraw(self, zoom: float | None = None) -> None:
        """Draw the page anew, in another size or in the colours of another theme; the place in it stays."""
        self._zoom = self._zoom if zoom is None else zoom
        bar = self.verticalScrollBar()
        share = bar.value() / max(bar.maximum(), 1)
        self._draw()
        bar.setValue(round(share * bar.maximum()))

    def go_to_heading(self, name: str) -> bool:
        """Scroll to a heading by its name in links; return whether there is one."""
        block = self.document().begin()
        while block.isValid():
            if block.blockFormat().headingLevel() and slug(block.text()) == name:
                self.go_to_block(block)
                return True
            block = block.next()
        return False

    def go_to_block(self, block: QTextBlock) -> None:
        """Scroll so that a block stands at the top, and put the cursor there."""
        cursor = QTextCursor(block)
        self.setTextCursor(cursor)
        self._at_top = block.blockNumber()
        top = self.document().documentLayout().blockBoundingRect(block).top()
        self.verticalScrollBar().setValue(round(top) - 8)

    def go_to_place(self, number: int, at: int) -> None:
        """Scroll so that a place in a block is seen with what stands before it."""
        block = self.document().findBlockByNumber(number)
        cursor = QTextCursor(block)
        cursor.setPosition(min(block.position() + at, block.position() + block.length() - 1))
        self.setTextCursor(cursor)
        bar = self.verticalScrollBar()
        bar.setValue(bar.value() + self.cursorRect().top() - self.viewport().height() // 3)

    def mark(self, words: tuple[str, ...]) -> None:
        """Let words stand out wherever they are in the page."""
        self._words = words
        of = colours()
        look = QTextCharFormat()
        look.setBackground(QColor(of.warning_border))
        look.setForeground(QColor(of.text))
        marks = []
        for word in words:
            found = self.document().find(word)
            while not found.isNull():
                one = QTextEdit.ExtraSelection()
                one.cursor, one.format = found, look
                marks.append(one)
                found = self.document().find(word, found)
        self.setExtraSelections(marks)

    def loadResource(self, kind: int, name: QUrl | str) -> object:
        """Return a picture of the page, drawn for the screen in the size in which it is shown."""
        if kind == QTextDocument.ResourceType.ImageResource.value:
            return self._picture(name if isinstance(name, str) else name.toString())
        return None

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Scroll; what was gone to need not stay at the top."""
        self._at_top = None
        super().wheelEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Scroll, and go from link to link; what was gone to need not stay at the top."""
        self._at_top = None
        super().keyPressEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit text and pictures once the size rests."""
        super().resizeEvent(event)
        self._rest.start()

    def _let_go(self) -> None:
        self._at_top = None

    def _draw(self) -> None:
        if self._page is None:
            return
        font = self.font()
        font.setPointSizeF(self.text_size)
        document = self.document()
        document.clear()
        document.setDefaultFont(font)
        document.setMarkdown(keep_units(self._page.text))
        style_page(document, self.text_size)
        self._fitted = (0.0, 0.0)
        self._fit()
        self.mark(self._words)

    def _fit(self) -> None:
        """Keep lines short enough to read, and pictures inside them."""
        room, ratio = float(self.viewport().width()), self.devicePixelRatioF()
        if self._page is None or (room, ratio) == self._fitted:
            return
        self._fitted = (room, ratio)
        column = min(room - 2 * _MARGIN, _WIDEST_EM * self.text_size)
        frame = self.document().rootFrame()
        shape = frame.frameFormat()
        shape.setLeftMargin(_MARGIN)
        shape.setRightMargin(max(_MARGIN, room - column - _MARGIN))
        shape.setTopMargin(_MARGIN * 0.7)
        shape.setBottomMargin(_MARGIN * 2)
        frame.setFrameFormat(shape)
        self._fit_pictures(column)
        if self._at_top is not None:
            self.go_to_block(self.document().findBlockByNumber(self._at_top))

    def _fit_pictures(self, column: float) -> None:
        for position, shape in pictures_of(self.document()):
            self._fit_picture(position, shape, column)

    def _fit_picture(self, position: int, shape: QTextImageFormat, column: float) -> None:
        size = self._size_of(shape.name())
        if size.isEmpty():
            return
        width = min(size.width() / _PICTURE_SCALE * max(self._zoom, 1.0), column)
        shape.setWidth(round(width))
        shape.setHeight(round(width * size.height() / size.width()))
        cursor = QTextCursor(self.document())
        cursor.setPosition(position)
        cursor.setPosition(position + 1, QTextCursor.MoveMode.KeepAnchor)
        cursor.setCharFormat(shape)
        image = QImage(str(self._folder / shape.name()))
        sharp = image.scaled(
            QSize(round(shape.width()), round(shape.height())) * self.devicePixelRatioF(),
            Qt.AspectRatioMode.IgnoreAspectRatio,
            Qt.TransformationMode.SmoothTransformation,
        )
        sharp.setDevicePixelRatio(self.devicePixelRatioF())
        self.document().addResource(QTextDocument.ResourceType.ImageResource.value, QUrl(shape.name()), sharp)

    def _size_of(self, name: str) -> QSize:
        return QImageReader(str(self._folder / name)).size()

    def _picture(self, name: str) -> QImage:
        return QImage(str(self._folder / name))
