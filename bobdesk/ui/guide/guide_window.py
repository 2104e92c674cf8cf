"""The window of the guide: contents at the left, a page at the right."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QSize, Qt, QUrl
from PySide6.QtGui import QAction, QCloseEvent, QDesktopServices, QGuiApplication, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QMainWindow, QSizePolicy, QSplitter, QToolBar, QWidget

from bobdesk.errors import InputError
from bobdesk.ui.guide.browser import GuideBrowser
from bobdesk.ui.guide.contents import GuideContents
from bobdesk.ui.guide.find import Hit
from bobdesk.ui.guide.pages import FIRST_PAGE, Page, split_link
from bobdesk.ui.icons import icon
from bobdesk.ui.settings import Settings

_SIZE = QSize(1040, 760)
_LEAST = QSize(480, 320)
_CONTENTS_WIDTH = 270
_SAID_MS = 6000
_ZOOMS = (0.8, 0.9, 1.0, 1.15, 1.3, 1.5, 1.75, 2.0, 2.5)


@dataclass(frozen=True)
class _Seen:
    page: str
    scrolled: int


class GuideWindow(QMainWindow):
    """Stands beside the program's window and is no dialog of it: one reads and works at the same time.

    Parameters
    ----------
    pages
        The guide, its first page first.
    folder
        Where its pictures are named from.
    """

    def __init__(self, pages: tuple[Page, ...], folder: Path, settings: Settings) -> None:
        super().__init__()
        self.setObjectName("guide_window")
        self.setWindowTitle(self.tr("User's guide"))
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self._pages = {page.name: page for page in pages}
        self._folder = folder
        self._settings = settings
        self._behind: list[_Seen] = []
        self._ahead: list[_Seen] = []
        self._zoom = _ZOOMS.index(1.0)
        self.browser = GuideBrowser(folder, self)
        self.contents = GuideContents(pages, self)
        self._icons: list[tuple[QAction, str]] = []
        self._make_tool_bar()
        both = QSplitter(self)
        both.setChildrenCollapsible(False)
        both.addWidget(self.contents)
        both.addWidget(self.browser)
        both.setStretchFactor(0, 1)
        both.setStretchFactor(1, 3)
        both.setSizes([_CONTENTS_WIDTH, _SIZE.width() - _CONTENTS_WIDTH])
        self.setCentralWidget(both)
        self.contents.page_wanted.connect(self.go_to)
        self.contents.hit_wanted.connect(self._go_to_hit)
        self.contents.words_changed.connect(self.browser.mark)
        self.browser.link_followed.connect(self._follow)
        self.setMinimumSize(_LEAST)
        screen = QGuiApplication.primaryScreen()
        self.resize(_SIZE if screen is None else _SIZE.boundedTo(screen.availableSize()))
        geometry = settings.bytes_of("guide_geometry")
        if not geometry.isEmpty():
            self.restoreGeometry(geometry)
        self._show(FIRST_PAGE)

    def go_to(self, place: str) -> None:
        """Show a page, or a heading in one: "solve.md#known-elevations"."""
        name, heading = split_link(place)
        name = name or self._page_name()
        if name not in self._pages:
            return
        if self.isVisible():
            self._leave()
        if name != self._page_name():
            self._show(name)
        if not (heading and self.browser.go_to_heading(heading)):
            self.browser.verticalScrollBar().setValue(0)

    def back(self) -> None:
        """Show what was read before."""
        self._turn(self._behind, self._ahead)

    def forward(self) -> None:
        """Show what was gone back from."""
        self._turn(self._ahead, self._behind)

    def zoom_by(self, step: int) -> None:
        """Make text and pictures larger or smaller."""
        self._zoom = max(0, min(len(_ZOOMS) - 1, self._zoom + step))
        self.browser.redraw(_ZOOMS[self._zoom])

    def zoom_back(self) -> None:
        """Give text and pictures their usual size."""
        self.zoom_by(_ZOOMS.index(1.0) - self._zoom)

    def save_as_pdf(self) -> None:
        """Ask where, and write all pages for printing."""
        from bobdesk.files.atomic import write_atomic
        from bobdesk.ui.guide.paper import guide_pdf
        from bobdesk.ui.questions import Questions

        questions = Questions(self._settings, self)
        path = questions.file_to_save("export", self.tr("Save the guide"), self._pdf_name(), "PDF (*.pdf)", ".pdf")
        questions.deleteLater()
        if path is None:
            return
        content = guide_pdf(tuple(self._pages.values()), self._folder, self.windowTitle())
        try:
            write_atomic(path, content)
        except InputError as error:
            self.statusBar().showMessage(str(error))
            return
        self.statusBar().showMessage(self.tr("Written to {name}.").format(name=path.name), _SAID_MS)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc ends the search, and then closes the window."""
        if event.key() != Qt.Key.Key_Escape:
            super().keyPressEvent(event)
        elif self.contents.search.text():
            self.contents.search.clear()
        else:
            self.close()

    def changeEvent(self, event: QEvent) -> None:
        """Take the colours of another theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_icons"):
            for action, name in self._icons:
                action.setIcon(icon(name))
            self.browser.redraw()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remember size and place."""
        self._settings.set_bytes("guide_geometry", self.saveGeometry())
        super().closeEvent(event)

    def _make_tool_bar(self) -> None:
        bar = QToolBar(self.tr("Guide"), self)
        bar.setMovable(False)
        bar.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        bar.setIconSize(QSize(20, 20))
        bar.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
        self.addToolBar(Qt.ToolBarArea.TopToolBarArea, bar)
        add = partial(self._add, bar)
        self.back_action = add(self.tr("Back"), "previous", self.back, "Alt+Left", "Back")
        self.forward_action = add(self.tr("Forward"), "next", self.forward, "Alt+Right", "Forward")
        add(self.tr("First page"), "help", lambda: self.go_to(FIRST_PAGE), "Alt+Home")
        room = QWidget(bar)
        room.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        bar.addWidget(room)
        add(self.tr("Save the guide as PDF…"), "save-as", self.save_as_pdf, "Ctrl+S")
        add(self.tr("Smaller"), "zoom-out", lambda: self.zoom_by(-1), "Ctrl+-")
        add(self.tr("Larger"), "zoom-in", lambda: self.zoom_by(1), "Ctrl++", "Ctrl+=")
        self._key(self.tr("Usual size"), self.zoom_back, "Ctrl+0")
        self._key(self.tr("Find in the guide"), self.contents.take_focus, "Ctrl+F")
        self._key(self.tr("Next place found"), lambda: self.contents.go_by(1), "F3")
        self._key(self.tr("Place found before"), lambda: self.contents.go_by(-1), "Shift+F3")
        self._key(self.tr("Close the guide"), self.close, "Ctrl+W")
        self._key(self.tr("Contents or page"), self._other_side, "F6")

    def _add(self, bar: QToolBar, text: str, icon_name: str, do: Callable[[], object], *keys: str) -> QAction:
        action = self._key(text, do, *keys)
        action.setIcon(icon(icon_name))
        self._icons.append((action, icon_name))
        bar.addAction(action)
        button = bar.widgetForAction(action)
        button.setAccessibleName(text)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        return action

    def _key(self, text: str, do: Callable[[], object], *keys: str) -> QAction:
        action = QAction(text, self)
        portable = QKeySequence.SequenceFormat.PortableText
        action.setShortcuts([QKeySequence(key, portable) for key in keys])
        action.setToolTip(f"{text} ({action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)})")
        action.triggered.connect(lambda _checked: do())
        self.addAction(action)
        return action

    def _other_side(self) -> None:
        side = self.contents.list if self.browser.hasFocus() else self.browser
        side.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _follow(self, link: str) -> None:
        if split_link(link)[0] in (*self._pages, ""):
            self.go_to(link)
        elif link.startswith(("https://", "mailto:")):
            QDesktopServices.openUrl(QUrl(link))

    def _go_to_hit(self, hit: Hit) -> None:
        self._leave()
        if hit.page != self._page_name():
            self._show(hit.page)
        self.browser.go_to_place(hit.block, hit.at)

    def _page_name(self) -> str:
        page = self.browser.page
        return "" if page is None else page.name

    def _leave(self) -> None:
        """Keep the place that is being read, so that Back finds it."""
        seen = _Seen(self._page_name(), self.browser.verticalScrollBar().value())
        if not self._behind or self._behind[-1] != seen:
            self._behind.append(seen)
        self._ahead.clear()
        self._refresh()

    def _turn(self, take: list[_Seen], keep: list[_Seen]) -> None:
        if take:
            keep.append(_Seen(self._page_name(), self.browser.verticalScrollBar().value()))
            seen = take.pop()
            if seen.page != self._page_name():
                self._show(seen.page)
            self.browser.verticalScrollBar().setValue(seen.scrolled)
        self._refresh()

    def _pdf_name(self) -> str:
        return self.tr("BobDesk guide") + ".pdf"

    def _show(self, name: str) -> None:
        self.browser.show_page(self._pages[name])
        self.contents.show_page(name)
        self._refresh()

    def _refresh(self) -> None:
        self.back_action.setEnabled(bool(self._behind))
        self.forward_action.setEnabled(bool(self._ahead))
