"""The left of the guide: a field to search with, and the list of pages or of what was found."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QFont, QKeyEvent
from PySide6.QtWidgets import QLabel, QLineEdit, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from bobdesk.ui.guide.find import GuideFinder, Hit, words_of
from bobdesk.ui.guide.pages import Page

_WHAT = Qt.ItemDataRole.UserRole


class GuideContents(QWidget):
    """Pages by group; while something is searched for, the places where it stands.

    Signals
    -------
    page_wanted
        Name of a page.
    hit_wanted
        A `Hit`.
    words_changed
        The words that are searched for, a tuple.
    """

    page_wanted = Signal(str)
    hit_wanted = Signal(object)
    words_changed = Signal(object)

    def __init__(self, pages: tuple[Page, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._pages = pages
        self._finder: GuideFinder | None = None
        self._shown = ""
        self.search = QLineEdit(self)
        self.search.setPlaceholderText(self.tr("Find in the guide"))
        self.search.setAccessibleName(self.tr("Find in the guide"))
        self.search.setToolTip(self.tr("Words that stand in one paragraph (Ctrl+F); Enter goes from place to place"))
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(self._on_typed)
        self.search.installEventFilter(self)
        self.list = QListWidget(self)
        self.list.setAccessibleName(self.tr("Contents of the guide"))
        self.list.setToolTip(self.tr("Pages of the guide"))
        self.list.setWordWrap(True)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setStyleSheet("QListView::item { padding: 4px 6px; }")
        self.list.itemActivated.connect(self._on_chosen)
        self.list.itemClicked.connect(self._on_chosen)
        self.found = QLabel(self)
        self.found.setProperty("kind", "muted")
        self.found.setWordWrap(True)
        self.found.setAccessibleName(self.tr("What was found"))
        self.setMinimumWidth(150)
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 10, 4, 10)
        column.setSpacing(8)
        column.addWidget(self.search)
        column.addWidget(self.found)
        column.addWidget(self.list, 1)
        self._list_pages()

    def show_page(self, name: str) -> None:
        """Mark a page as the one that is read."""
        self._shown = name
        if not self.words:
            self._mark_shown()

    @property
    def words(self) -> tuple[str, ...]:
        """The words that are searched for."""
        return words_of(self.search.text())

    def go_by(self, step: int) -> None:
        """Go to the next place that was found, or to the one before, and round again."""
        if self.words and self.list.count():
            row = (self.list.currentRow() + step) % self.list.count()
            self.list.setCurrentRow(row)
            self._on_chosen(self.list.item(row))

    def take_focus(self) -> None:
        """Let one type what to search for."""
        self.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.search.selectAll()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Enter and the arrows go from the field into what was found; Esc empties the field."""
        if watched is self.search and isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.go_by(-1 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1)
                return True
            if event.key() == Qt.Key.Key_Down:
                self.list.setFocus(Qt.FocusReason.OtherFocusReason)
                if self.list.currentRow() < 0:
                    self.list.setCurrentRow(0)
                return True
            if event.key() == Qt.Key.Key_Escape and self.search.text():
                self.search.clear()
                return True
        return super().eventFilter(watched, event)

    def _on_typed(self) -> None:
        words = self.words
        if words:
            if self._finder is None:
                self._finder = GuideFinder(self._pages)
            self._list_hits(self._finder.find(words))
        else:
            self._list_pages()
        self.words_changed.emit(words)

    def _list_pages(self) -> None:
        self.list.clear()
        self.found.hide()
        group = ""
        for page in self._pages:
            if page.group != group:
                group = page.group
                heading = QListWidgetItem(group)
                font = QFont(self.list.font())
                font.setBold(True)
                heading.setFont(font)
                heading.setFlags(Qt.ItemFlag.NoItemFlags)
                heading.setForeground(self.palette().placeholderText())
                self.list.addItem(heading)
            item = QListWidgetItem(page.title)
            item.setData(_WHAT, page.name)
            self.list.addItem(item)
        self._mark_shown()

    def _list_hits(self, hits: tuple[Hit, ...]) -> None:
        titles = {page.name: page.title for page in self._pages}
        self.list.clear()
        for hit in hits:
            where = titles[hit.page] if hit.heading == titles[hit.page] else f"{titles[hit.page]} › {hit.heading}"
            item = QListWidgetItem(where if hit.excerpt == hit.heading else f"{where}\n{hit.excerpt}")
            item.setData(_WHAT, hit)
            self.list.addItem(item)
        self.found.setText(
            self.tr("Found in {count} paragraphs").format(count=len(hits))
            if hits
            else self.tr("Nothing found. Try fewer or shorter words.")
        )
        self.found.show()

    def _mark_shown(self) -> None:
        for row in range(self.list.count()):
            if self.list.item(row).data(_WHAT) == self._shown:
                self.list.setCurrentRow(row)
                return

    def _on_chosen(self, item: QListWidgetItem) -> None:
        what = item.data(_WHAT)
        if isinstance(what, Hit):
            self.hit_wanted.emit(what)
        elif isinstance(what, str):
            self.page_wanted.emit(what)
