"""The real main window, opened so that nobody sees it, with settings and copies of its own."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType

import PySide6
from PySide6.QtCore import QEvent, QEventLoop, QMessageLogContext, Qt, QtMsgType, qInstallMessageHandler, qVersion
from PySide6.QtGui import QFontMetricsF, QGuiApplication, QImageReader
from PySide6.QtNetwork import QSslSocket
from PySide6.QtWidgets import QApplication

from bobdesk.ui.application import install_language, make_application
from bobdesk.ui.icons import icon
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.notices import Notice
from bobdesk.ui.selftest.record import SelfTestError
from bobdesk.ui.settings import Settings
from bobdesk.ui.theme import ThemeFollower

_PATIENCE_S = 90.0
_LOOK_EVERY_S = 0.005
_SIZE = (1400, 900)
_UNSEEN_ANYWAY = ("offscreen", "minimal")
_MOST_MESSAGES = 50


class UnseenWindow:
    """Qt and the window, with what they complain about.

    Parameters
    ----------
    folder
        For settings and recovery copies, in place of the user's.

    Attributes
    ----------
    window : MainWindow
    messages : dict of str to int
        What Qt has printed, and how often.
    """

    def __init__(self, folder: Path) -> None:
        self._faults: list[str] = []
        self._errors: list[str] = []
        self.messages: dict[str, int] = {}
        self._hooks = (sys.excepthook, sys.unraisablehook)
        # What fails in a slot is given to these, and nobody is asked.
        sys.excepthook = self._on_fault
        sys.unraisablehook = lambda told: self._on_fault(told.exc_type, told.exc_value, told.exc_traceback)
        qInstallMessageHandler(self._on_message)
        running = QApplication.instance()
        self.application = running if isinstance(running, QApplication) else make_application([])
        settings = Settings(folder / "settings.ini")
        install_language(self.application, settings.language)
        self._theme = ThemeFollower(self.application, settings)
        self.application.setWindowIcon(icon("bobdesk"))
        self.settings = settings
        self.window = MainWindow(settings, folder / "data")
        self.window.desk.notices.told.connect(self._on_notice)
        self.window.resize(*_SIZE)
        if QGuiApplication.platformName() not in _UNSEEN_ANYWAY:
            self.window.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
        self.window.show()

    def until(self, true: Callable[[], bool], what: str) -> None:
        """Let the window work until something is true.

        Raises
        ------
        SelfTestError
            If it does not become true, or the window complains meanwhile.
        """
        give_up = time.monotonic() + _PATIENCE_S
        while True:
            self.application.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 50)
            self.check()
            if true():
                return
            if time.monotonic() > give_up:
                raise SelfTestError(f"{what}: that has not come about within {_PATIENCE_S:g} s")
            time.sleep(_LOOK_EVERY_S)

    def until_quiet(self) -> None:
        """Let the window work until nothing is under way in the background."""
        self.until(lambda: not self.window.desk.runner.jobs, "the window comes to rest")

    def check(self) -> None:
        """Raise what the window has complained about.

        Raises
        ------
        SelfTestError
            For a fault in the program, or a sentence that the user would have been shown as an error.
        """
        if self._faults:
            raise SelfTestError(f"a fault in the program: {self._faults[0]}")
        if self._errors:
            raise SelfTestError(f"the window says: {self._errors[0]}")

    def check_letters(self) -> None:
        """Raise if Qt found no font, in which case every letter is the same box.

        Raises
        ------
        SelfTestError
            If so.
        """
        metrics = QFontMetricsF(self.application.font())
        if metrics.horizontalAdvance("i") == metrics.horizontalAdvance("W"):
            raise SelfTestError("there is no font: every letter would be shown as the same box")

    def shown(self) -> dict[str, object]:
        """Return what Qt says of itself and of the screens."""
        screens = [
            {
                "name": screen.name(),
                "size": [screen.size().width(), screen.size().height()],
                "device_pixel_ratio": screen.devicePixelRatio(),
                "dots_per_inch": screen.logicalDotsPerInch(),
            }
            for screen in QGuiApplication.screens()
        ]
        return {
            "qt": qVersion(),
            "pyside6": PySide6.__version__,
            "platform_plugin": QGuiApplication.platformName(),
            "font": self.application.font().family(),
            "picture_formats_of_qt": sorted(
                bytes(kind.data()).decode() for kind in QImageReader.supportedImageFormats()
            ),
            "screens": screens,
            # What newer versions are asked for with.
            "tls": QSslSocket.activeBackend() if QSslSocket.supportsSsl() else None,
        }

    def save_picture(self, path: Path) -> None:
        """Write the window as a picture.

        Raises
        ------
        SelfTestError
            If that does not work.
        """
        if not self.window.grab().save(str(path)):
            raise SelfTestError(f"{path}: the picture of the window cannot be written")

    def close(self) -> None:
        """Close the window as the user does, once all is saved.

        Raises
        ------
        SelfTestError
            If it does not close.
        """
        if not self.window.close():
            raise SelfTestError("the window does not close")
        self._end()
        self.check()

    def abandon(self) -> None:
        """Close the window after a failure, without a question."""
        self.window.leave()
        self._end()

    def _end(self) -> None:
        self.settings.write()
        self.window.deleteLater()
        self.application.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        qInstallMessageHandler(None)
        sys.excepthook, sys.unraisablehook = self._hooks

    def _on_notice(self, notice: Notice) -> None:
        if notice.weight == "error":
            self._errors.append(notice.sentence)

    def _on_fault(self, kind: type[BaseException], value: BaseException | None, trace: TracebackType | None) -> None:
        at = trace
        while at is not None and at.tb_next is not None:
            at = at.tb_next
        place = "" if at is None else f" ({at.tb_frame.f_code.co_filename}:{at.tb_lineno})"
        self._faults.append(f"{kind.__name__}: {value}{place}")

    def _on_message(self, _kind: QtMsgType, _context: QMessageLogContext, text: str) -> None:
        if text in self.messages or len(self.messages) < _MOST_MESSAGES:
            self.messages[text] = self.messages.get(text, 0) + 1
