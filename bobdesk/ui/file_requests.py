"""Files that the system asks the running program to open: a double click in macOS's Finder comes as an event."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtGui import QFileOpenEvent
from PySide6.QtWidgets import QApplication

_LOOK_EVERY_MS = 200


class Application(QApplication):
    """Qt's application that takes such events; they may come before there is a window, and while it asks something."""

    def __init__(self, arguments: Sequence[str]) -> None:
        super().__init__(list(arguments))
        self.requests = FileRequests(self)

    def event(self, event: QEvent) -> bool:
        """Take the wish for a file; everything else goes its usual way."""
        if isinstance(event, QFileOpenEvent):
            path = event.url().toLocalFile() if event.url().isLocalFile() else event.file()
            if path:
                self.requests.add(Path(path))
                return True
        return super().event(event)


class FileRequests(QObject):
    """Wishes for files, in their order: each is handed on when the window is there and asks nothing."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._waiting: deque[Path] = deque()
        self._open: Callable[[Path], object] | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._look)

    def add(self, path: Path) -> None:
        """Have a file opened soon."""
        self._waiting.append(path)
        self._wait(0)

    def hand_to(self, window: QObject, open_file: Callable[[Path], object]) -> None:
        """Have files opened by `open_file` from now on, until the window goes."""
        self._open = open_file
        window.destroyed.connect(self._forget)
        self._wait(0)

    def _wait(self, milliseconds: int) -> None:
        if self._waiting and self._open is not None:
            self._timer.start(milliseconds)

    def _look(self) -> None:
        # A question that is answered below another one would be answered blindly.
        if QApplication.activeModalWidget() is not None or self._open is None:
            self._wait(_LOOK_EVERY_MS)
            return
        path = self._waiting.popleft()
        # Opening may ask, and does not come back before the answer: the next file waits for that, too.
        self._wait(_LOOK_EVERY_MS)
        self._open(path)

    def _forget(self) -> None:
        self._open = None
        self._timer.stop()
