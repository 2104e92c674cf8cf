"""Start Qt, on sound versions only, with or without a screen."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, cast

from bobdesk.errors import InputError

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

# PySide6 6.12 drops a reference to True at every Signal.emit() on Python < 3.12; after some 500 of
# them the process aborts.
_UNSOUND_FROM = (6, 12)
_SOUND_PYTHON = (3, 12)


def refuse_unsound_versions(python: tuple[int, ...], qt: str) -> None:
    """Refuse a pair of Python and PySide6 that is known to abort.

    Raises
    ------
    InputError
        For PySide6 6.12 or newer on Python 3.11 or older.
    """
    version = tuple(int(part) for part in qt.split(".")[:2])
    if python[:2] < _SOUND_PYTHON and version >= _UNSOUND_FROM:
        raise InputError(
            f"PySide6 {qt} crashes on Python {python[0]}.{python[1]}; install 'PySide6-Essentials<6.12',"
            " or use Python 3.12 or newer"
        )


def application_without_screen() -> QApplication:
    """Return the running QApplication, or start one that needs no screen.

    Raises
    ------
    InputError
        If Qt's system libraries are missing.
    """
    try:
        import PySide6

        refuse_unsound_versions(sys.version_info[:3], PySide6.__version__)
        from PySide6.QtWidgets import QApplication
    except ImportError as error:
        raise InputError(
            f"a picture cannot be drawn, since a system library of Qt is missing ({error});"
            " on Debian: apt-get install libegl1 libgl1 libxkbcommon0 libdbus-1-3 libfontconfig1 fonts-dejavu-core"
        ) from error
    running = QApplication.instance()
    if running is not None:
        return cast("QApplication", running)
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    return QApplication(["bobdesk"])
