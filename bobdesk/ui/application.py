"""Start the program with its window, and end it in the right order."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import PySide6
from PySide6.QtCore import QEvent, QLibraryInfo, QLocale, QTimer, QTranslator
from PySide6.QtGui import QImageReader
from PySide6.QtWidgets import QApplication

from bobdesk import APPLICATION_ID, __version__
from bobdesk.files.recovery import user_data_folder
from bobdesk.ui.crash import CrashGuard
from bobdesk.ui.file_requests import Application
from bobdesk.ui.icons import icon
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.qt import refuse_unsound_versions
from bobdesk.ui.resources import resource
from bobdesk.ui.settings import Settings
from bobdesk.ui.theme import ThemeFollower
from bobdesk.ui.updates.updates import updates_of

_QT_IMAGES_MB = 4096


def make_application(arguments: Sequence[str]) -> Application:
    """Return the application, with its names and limits."""
    refuse_unsound_versions(sys.version_info[:3], PySide6.__version__)
    application = Application(["bobdesk", *arguments])
    application.setApplicationName("BobDesk")
    application.setApplicationDisplayName("BobDesk")
    application.setApplicationVersion(__version__)
    application.setDesktopFileName(APPLICATION_ID)
    QImageReader.setAllocationLimit(_QT_IMAGES_MB)
    return application


def install_language(application: QApplication, language: str) -> None:
    """Translate the window's texts and Qt's own, as far as there are translations; "" is the system's language."""
    locale = QLocale(language) if language else QLocale.system()
    QLocale.setDefault(locale)
    for name, folder in (
        ("qtbase", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)),
        ("bobdesk", str(resource("translations"))),
    ):
        translator = QTranslator(application)
        if translator.load(locale, name, "_", folder):
            application.installTranslator(translator)


def start(path: Path | None) -> int:
    """Show the window, open `path` in it, and return the exit status when it is closed."""
    application = make_application([])
    settings = Settings()
    install_language(application, settings.language)
    ThemeFollower(application, settings)
    application.setWindowIcon(icon("bobdesk"))
    window = MainWindow(settings, user_data_folder())
    guard = CrashGuard(window.documents.keeper.keep_now, window.leave, window)
    guard.install()
    window.show()
    if path is not None:
        QTimer.singleShot(0, window, partial(window.open_file, path))
    application.requests.hand_to(window, window.open_file)
    QTimer.singleShot(0, window, window.warm_up)
    updates = updates_of(window.desk)
    if updates is not None:
        updates.ask_later()
    status = application.exec()
    if updates is not None:
        updates.drop()
    guard.uninstall()
    settings.write()
    # The window goes before the application, or Qt's own objects end in the wrong order.
    window.deleteLater()
    application.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    return status


def has_screen() -> bool:
    """Return whether a window can be shown at all."""
    if sys.platform != "linux" or os.environ.get("QT_QPA_PLATFORM"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
