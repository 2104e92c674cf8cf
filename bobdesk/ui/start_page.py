"""The window before there is a document: begin, go on, recover."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont, QKeySequence
from PySide6.QtWidgets import QFrame, QLabel, QMenu, QPushButton, QScrollArea, QVBoxLayout, QWidget

from bobdesk.files.recovery_store import Recoverable
from bobdesk.ui.guide.pages import FIRST_TRACK_PAGE
from bobdesk.ui.recent_entries import RecentEntry, unread_entry
from bobdesk.ui.samples import practice_picture, samples
from bobdesk.ui.settings import Settings
from bobdesk.ui.start_page_cards import BigButton, CardGrid
from bobdesk.ui.start_page_recovery import RecoveryBanner
from bobdesk.ui.widgets.flow_layout import FlowLayout
from bobdesk.ui.window_parts import Part

_WIDEST = 1180
_MARGIN = 72


class StartPage(QWidget):
    """What can be begun or gone on with.

    The recent projects' names are shown at once; `show_recent` adds what their files say, once they
    were read (`bobdesk.ui.recent_entries.recent_entry_steps`).

    Signals
    -------
    picture_wanted, coordinates_wanted
        A new project from a file that is yet to be chosen.
    sample_wanted
        Name of a sample's folder.
    project_wanted, forget_wanted
        Path of a recent project: to open, or to take off the list.
    recover_wanted, discard_wanted
        A `Recoverable`.
    guide_wanted
        Name of a page of the guide.
    practice_wanted
        The picture of a sample alone, to try one's hand at.
    """

    picture_wanted = Signal()
    coordinates_wanted = Signal()
    sample_wanted = Signal(str)
    project_wanted = Signal(Path)
    forget_wanted = Signal(Path)
    recover_wanted = Signal(object)
    discard_wanted = Signal(object)
    guide_wanted = Signal(str)
    practice_wanted = Signal()

    def __init__(self, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("start-page")
        self._settings = settings
        self._entries: dict[Path, RecentEntry] = {}
        content = QWidget()
        content.setMaximumWidth(_WIDEST)
        self._column = QVBoxLayout(content)
        self._column.setContentsMargins(_MARGIN, 56, 32, 32)
        self._column.setSpacing(4)
        self._add_title()
        self._column.addSpacing(22)
        self._add_buttons()
        self._column.addSpacing(22)
        self._recovery_place = QVBoxLayout()
        self._column.addLayout(self._recovery_place)
        self._banner: RecoveryBanner | None = None
        self._recent_title = QLabel(self.tr("Recent"))
        self._recent_title.setProperty("kind", "title")
        self._column.addWidget(self._recent_title)
        self._column.addSpacing(4)
        self.grid = CardGrid()
        self.grid.setAccessibleName(self.tr("Recent projects"))
        self.grid.wanted.connect(self.project_wanted)
        self.grid.forget.connect(self.forget_wanted)
        self.grid.left_upwards.connect(self.picture_button.setFocus)
        self._column.addWidget(self.grid)
        self._column.addSpacing(22)
        self._add_hint()
        self._column.addStretch(1)
        scroll = QScrollArea()
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        scroll.setWidget(content)
        scroll.setAlignment(Qt.AlignmentFlag.AlignLeft)
        self._scroll = scroll
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(scroll)
        self.setFocusProxy(self.picture_button)
        settings.changed.connect(self._on_setting)
        self._show_paths()

    def show_recent(self, entries: Sequence[RecentEntry]) -> None:
        """Show what the files of recent projects say; the list itself is the settings'."""
        self._entries = {entry.path: entry for entry in entries}
        self._show_paths()

    def show_recoverable(self, items: Sequence[Recoverable]) -> None:
        """Show what can be recovered, or nothing."""
        if self._banner is not None:
            self._recovery_place.removeWidget(self._banner)
            self._banner.hide()
            self._banner.deleteLater()
            self._banner = None
        if items:
            self._banner = RecoveryBanner(items)
            self._banner.recover.connect(self.recover_wanted)
            self._banner.discard.connect(self.discard_wanted)
            self._recovery_place.addWidget(self._banner)
            self._banner.show()
        self._recovery_place.setContentsMargins(0, 0, 0, 18 if items else 0)

    def parts(self) -> list[Part]:
        """Return the parts of the page that one key leads to, one after the other."""
        banner = () if self._banner is None else (self._banner,)
        return [tuple(self._buttons), banner, (self.grid,), (self.first_track,)]

    def _add_title(self) -> None:
        title = QLabel("BobDesk")
        font = QFont(title.font())
        font.setPointSizeF(font.pointSizeF() * 2.5)
        font.setWeight(QFont.Weight.Light)
        title.setFont(font)
        self._column.addWidget(title)
        below = QLabel(self.tr("From a track's plan to its 3D centreline"))
        below.setProperty("kind", "muted")
        self._column.addWidget(below)

    def _add_buttons(self) -> None:
        self.picture_button = BigButton(
            self.tr("New from picture…"), self.tr("scan, drawing, PDF, aerial"), "picture", primary=True
        )
        self.picture_button.clicked.connect(lambda: self.picture_wanted.emit())
        self.coordinates_button = BigButton(
            self.tr("New from coordinates…"), self.tr("CSV, DXF, GeoJSON, KML, GPX, OSM"), "coordinates"
        )
        self.coordinates_button.clicked.connect(lambda: self.coordinates_wanted.emit())
        self.sample_button = BigButton(self.tr("Open sample"), self.tr("a finished track to play with"), "sample")
        self.sample_button.clicked.connect(self._show_samples)
        self._buttons = [self.picture_button, self.coordinates_button, self.sample_button]
        row = FlowLayout(gap=10)
        for button in self._buttons:
            button.arrow.connect(lambda key, button=button: self._go(button, key))
            row.addWidget(button)
        self.sample_button.setVisible(bool(samples()))
        self._column.addLayout(row)

    def _add_hint(self) -> None:
        keys = QKeySequence(QKeySequence.StandardKey.Paste).toString(QKeySequence.SequenceFormat.NativeText)
        hint = QLabel(self.tr("or drop a file anywhere · {key} pastes a picture").format(key=keys))
        hint.setProperty("kind", "muted")
        hint.setWordWrap(True)
        self._column.addWidget(hint)
        self._column.addSpacing(10)
        self.first_track = QPushButton(self.tr("First track in ten minutes"))
        self.first_track.setProperty("kind", "link")
        self.first_track.setCursor(Qt.CursorShape.PointingHandCursor)
        self.first_track.setToolTip(self.tr("Opens the guide: from a picture to a 3D line in a file, step by step"))
        self.first_track.setAccessibleDescription(self.first_track.toolTip())
        self.first_track.clicked.connect(lambda: self.guide_wanted.emit(FIRST_TRACK_PAGE))
        self._column.addWidget(self.first_track, 0, Qt.AlignmentFlag.AlignLeft)

    def sample_menu(self) -> QMenu:
        """Return a menu of the samples, with the licence of each."""
        menu = QMenu(self)
        menu.setToolTipsVisible(True)
        for sample in samples():
            action = menu.addAction(sample.title)
            action.setObjectName(sample.name)
            if sample.licence:
                action.setText(f"{sample.title}\t{sample.licence}")
            action.setToolTip(sample.licence or self.tr("Made for BobDesk, free to use"))
            action.triggered.connect(lambda _checked=False, name=sample.name: self.sample_wanted.emit(name))
        if practice_picture() is not None:
            menu.addSeparator()
            practice = menu.addAction(self.tr("Practice picture: a plan alone, without line and result"))
            practice.setObjectName("practice_picture")
            practice.setToolTip(self.tr("The guide makes a track of it in ten minutes"))
            practice.triggered.connect(lambda _checked=False: self.practice_wanted.emit())
        return menu

    def _show_samples(self) -> None:
        menu = self.sample_menu()
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.popup(self.sample_button.mapToGlobal(self.sample_button.rect().bottomLeft()))

    def _show_paths(self) -> None:
        shown = [self._entries.get(path, unread_entry(path)) for path in self._settings.recent]
        self._recent_title.setVisible(bool(shown))
        self.grid.setVisible(bool(shown))
        self.grid.show_entries(shown)

    def _go(self, button: BigButton, key: int) -> None:
        at = self._buttons.index(button)
        if key == Qt.Key.Key_Left and at > 0:
            self._buttons[at - 1].setFocus(Qt.FocusReason.TabFocusReason)
        elif key == Qt.Key.Key_Right and at + 1 < len(self._buttons):
            self._buttons[at + 1].setFocus(Qt.FocusReason.TabFocusReason)
        elif key == Qt.Key.Key_Down and self.grid.cards:
            self.grid.cards[min(at, len(self.grid.cards) - 1)].setFocus(Qt.FocusReason.TabFocusReason)

    def _on_setting(self, name: str) -> None:
        if name == "recent":
            self._show_paths()
