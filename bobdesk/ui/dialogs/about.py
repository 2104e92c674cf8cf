"""About: what this is, its versions, and the licences of all that it consists of."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QSize, Qt
from PySide6.QtGui import QFontDatabase, QGuiApplication
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QPlainTextEdit,
    QPushButton,
    QSplitter,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from bobdesk import __version__
from bobdesk.ui.icons import icon
from bobdesk.ui.licences import components, versions

_ICON = 64


class AboutDialog(QDialog):
    """Two pages: versions, licences."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("about")
        self.setWindowTitle(self.tr("About BobDesk"))
        self.tabs = QTabWidget()
        self.tabs.setAccessibleName(self.tr("About BobDesk"))
        self.tabs.setToolTip(self.tr("What the program is, which versions of its parts it uses, and their licences"))
        self.tabs.tabBar().setAccessibleName(self.tr("Pages"))
        self.tabs.addTab(self._versions_page(), self.tr("Versions"))
        self.tabs.addTab(self._licences_page(), self.tr("Licences"))
        self.copy_button = QPushButton(icon("copy"), self.tr("Copy versions"))
        self.copy_button.setToolTip(self.tr("Copy all versions, for a report of a fault"))
        self.copy_button.clicked.connect(self._copy)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.addButton(self.copy_button, QDialogButtonBox.ButtonRole.ActionRole)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(14)
        column.addLayout(self._head())
        column.addWidget(self.tabs, 1)
        column.addWidget(buttons)
        self.resize(960, 600)

    def _head(self) -> QHBoxLayout:
        sign = QLabel()
        sign.setPixmap(icon("bobdesk").pixmap(QSize(_ICON, _ICON)))
        sign.setAccessibleName("BobDesk")
        title = QLabel(f"BobDesk {__version__}")
        title.setProperty("kind", "title")
        below = QLabel(self.tr("From a track's plan to its 3D centreline. MIT licence."))
        below.setProperty("kind", "muted")
        below.setWordWrap(True)
        words = QVBoxLayout()
        words.setSpacing(2)
        words.addStretch(1)
        words.addWidget(title)
        words.addWidget(below)
        words.addStretch(1)
        head = QHBoxLayout()
        head.setSpacing(14)
        head.addWidget(sign)
        head.addLayout(words, 1)
        return head

    def _versions_page(self) -> QWidget:
        text = _text_field(versions())
        text.setAccessibleName(self.tr("Versions"))
        text.setToolTip(self.tr("Say these when you report a fault"))
        return _page(text)

    def _licences_page(self) -> QWidget:
        self._components = components()
        self.list = QListWidget()
        self.list.setAccessibleName(self.tr("Parts of the program"))
        self.list.setToolTip(self.tr("Choose a part to read its licence"))
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setStyleSheet("QListView::item { padding: 3px 4px; }")
        for one in self._components:
            name, comma, parts = one.name.partition(",")
            # the version is the library's, not that of what is in it
            self.list.addItem(f"{name} {one.version}{comma}{parts}" if one.version else one.name)
            self.list.item(self.list.count() - 1).setToolTip(one.licence)
        self.text = _text_field("")
        self.text.setAccessibleName(self.tr("Licence"))
        self.text.setToolTip(self.tr("The licence of the chosen part"))
        self.short = QLabel()
        self.short.setProperty("kind", "heading")
        self.short.setTextFormat(Qt.TextFormat.PlainText)
        self.short.setWordWrap(True)
        right = QWidget()
        column = QVBoxLayout(right)
        column.setContentsMargins(8, 0, 0, 0)
        column.addWidget(self.short)
        column.addWidget(self.text, 1)
        both = QSplitter()
        both.setChildrenCollapsible(False)
        both.addWidget(self.list)
        both.addWidget(right)
        both.setStretchFactor(1, 1)
        both.setSizes([300, 640])
        self.list.selectionModel().currentChanged.connect(self._show)
        self.list.setCurrentRow(0)
        return _page(both)

    def _show(self, current: QModelIndex) -> None:
        one = self._components[current.row()]
        self.short.setText(f"{one.name}: {one.licence}")
        self.text.setPlainText(one.text)

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(versions())
        self.copy_button.setText(self.tr("Copied"))


def _page(content: QWidget) -> QWidget:
    page = QWidget()
    column = QVBoxLayout(page)
    column.setContentsMargins(10, 10, 10, 10)
    column.addWidget(content)
    return page


def _text_field(text: str) -> QPlainTextEdit:
    field = QPlainTextEdit(text)
    field.setReadOnly(True)
    field.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
    field.setTabChangesFocus(True)
    font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    font.setPointSizeF(field.font().pointSizeF() * 0.95)
    field.setFont(font)
    field.setTextInteractionFlags(
        Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
    )
    return field
