"""Tells of a newer version: when the user asks, and once a day at the start if the user has chosen that."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, QUrl
from PySide6.QtGui import QDesktopServices

from bobdesk import __version__
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Remedy
from bobdesk.ui.updates.release_feed import Release, feed_address, is_newer

if TYPE_CHECKING:
    from bobdesk.ui.updates.feed_reader import FeedReader

# Long after the first paint, when what the first trace needs is loaded, too.
_AFTER_START_MS = 20_000
_EVERY_S = 24 * 3600


class Updates(QObject):
    """Asks the feed and says what it answers, in notices; nothing is fetched and nothing installed.

    Parameters
    ----------
    address
        Of the feed.
    """

    def __init__(self, desk: Desk, address: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._address = address
        self._reader: FeedReader | None = None
        self._is_asked_by_user = False
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.ask_if_due)

    @property
    def is_busy(self) -> bool:
        """Whether an answer is still to come."""
        return self._reader is not None

    def ask(self) -> None:
        """Ask now; every answer is told."""
        self._is_asked_by_user = True
        self._ask()

    def ask_later(self) -> None:
        """Ask some time after the start, if the user has chosen that and a day has passed."""
        self._timer.start(_AFTER_START_MS)

    def ask_if_due(self) -> None:
        """Ask if the user has chosen that and a day has passed; only a newer version is told, once."""
        settings = self._desk.settings
        since = time.time() - settings.updates_asked
        if settings.asks_for_updates and not 0 <= since < _EVERY_S:
            self._ask()

    def drop(self) -> None:
        """Ask no more, and want no answer: the window closes."""
        self._timer.stop()
        if self._reader is not None:
            self._reader.drop()
        self._end()

    def _ask(self) -> None:
        if self._reader is not None:
            return
        # Loaded when it is needed: most never ask.
        from bobdesk.ui.updates.feed_reader import FeedReader

        reader = FeedReader(self)
        reader.answered.connect(self._on_answer)
        reader.failed.connect(self._on_failed)
        self._reader = reader
        self._desk.settings.updates_asked = time.time()
        reader.ask(self._address)

    def _on_answer(self, release: Release) -> None:
        by_user = self._end()
        settings = self._desk.settings
        if is_newer(release.version, __version__):
            if by_user or settings.updates_told != release.version:
                settings.updates_told = release.version
                self._tell(release)
        elif by_user:
            self._desk.notices.note(
                self.tr("This is the newest version of BobDesk, {version}.").format(version=__version__)
            )

    def _on_failed(self, sentence: str) -> None:
        if self._end():
            self._desk.notices.warn(self.tr("No newer version could be looked for: {reason}").format(reason=sentence))

    def _end(self) -> bool:
        """Put the reader away and return whether the user has asked."""
        reader, self._reader = self._reader, None
        if reader is not None:
            reader.deleteLater()
        by_user, self._is_asked_by_user = self._is_asked_by_user, False
        return by_user

    def _tell(self, release: Release) -> None:
        self._desk.notices.offer(
            self.tr("BobDesk {version} is out; this is {own}.").format(version=release.version, own=__version__),
            Remedy(self.tr("Show what is new"), partial(QDesktopServices.openUrl, QUrl(release.page))),
        )


def updates_of(desk: Desk) -> Updates | None:
    """Return the one `Updates` of a window, None where there is nobody to ask."""
    found = desk.session.findChild(Updates, "updates")
    if found is not None:
        return found
    address = feed_address()
    if not address:
        return None
    made = Updates(desk, address, desk.session)
    made.setObjectName("updates")
    return made
