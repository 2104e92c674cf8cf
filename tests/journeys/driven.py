"""Starts the real program, and answers where things are on the screen; it never does anything by itself.

usage: python -m tests.journeys.driven SOCKET [ARGUMENT …]
"""

from __future__ import annotations

import json
import sys
import traceback
from typing import Any

from PySide6.QtCore import QObject, QPoint, QPointF
from PySide6.QtNetwork import QLocalServer, QLocalSocket
from PySide6.QtWidgets import QApplication, QWidget


def main() -> int:
    socket, arguments = sys.argv[1], sys.argv[2:]
    from bobdesk.ui import application

    class Watched(application.MainWindow):
        def __init__(self, *args: Any) -> None:
            super().__init__(*args)
            self.answers = Answers(self, socket)

    application.MainWindow = Watched
    sys.argv = ["bobdesk", *arguments]
    from bobdesk.__main__ import main as program

    return program()


class Answers(QObject):
    """Evaluates one expression a line, and answers with JSON: the journeys look, and act by mouse and keys alone."""

    def __init__(self, window: Any, socket: str) -> None:
        super().__init__(window)
        self._window = window
        self._server = QLocalServer(self)
        self._server.newConnection.connect(self._on_connection)
        if not self._server.listen(socket):
            raise OSError(self._server.errorString())

    def _on_connection(self) -> None:
        connection = self._server.nextPendingConnection()
        connection.readyRead.connect(lambda: self._on_question(connection))

    def _on_question(self, connection: QLocalSocket) -> None:
        while connection.canReadLine():
            question = bytes(connection.readLine().data()).decode()
            try:
                names = {
                    "window": self._window,
                    "desk": self._window.desk,
                    "project": self._window.desk.session.project,
                    "widget": self.widget,
                    "middle": self.middle,
                    "plan": self.plan,
                    "texts": self.texts,
                }
                answer = {"is": eval(question, names)}
            except Exception:  # noqa: BLE001
                answer = {"failed": traceback.format_exc()}
            connection.write(json.dumps(answer, default=str).encode() + b"\n")
            connection.flush()

    def widget(self, name: str) -> QWidget:
        """Return a visible widget by object name, or by accessible name or text."""
        everything = [child for top in QApplication.topLevelWidgets() for child in [top, *top.findChildren(QWidget)]]
        for child in everything:
            called = {child.objectName(), child.accessibleName()}
            if hasattr(child, "text") and callable(child.text):
                called.add(str(child.text()).replace("&", ""))
            if name in called and child.isVisible():
                return child
        raise LookupError(f"no visible widget is called {name}")

    def middle(self, name: str) -> list[int]:
        """Return the middle of a widget on the screen."""
        found = self.widget(name)
        place = found.mapToGlobal(QPoint(found.width() // 2, found.height() // 2))
        return [place.x(), place.y()]

    def plan(self, x: float, y: float) -> list[float]:
        """Return where a picture pixel is on the screen."""
        view = self._window.view
        inside = view.viewportTransform().map(QPointF(x, y))
        corner = view.viewport().mapToGlobal(QPoint(0, 0))
        return [corner.x() + inside.x(), corner.y() + inside.y()]

    def texts(self) -> list[str]:
        """Return all texts that labels show, for sentences that must be on the screen."""
        return [
            str(child.text())
            for top in QApplication.topLevelWidgets()
            for child in top.findChildren(QWidget)
            if child.isVisible() and hasattr(child, "text") and callable(child.text) and child.text()
        ]


if __name__ == "__main__":
    sys.exit(main())
