"""`bobdesk [FILE]`: the window."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from bobdesk.errors import InputError


def wants_window(arguments: Sequence[str], commands: Iterable[str]) -> bool:
    """Return whether the arguments name no command, but nothing or one file.

    A word that is neither a command nor a file is taken for a mistyped command, unless it looks like a
    path: "chek", but not "plan.png".
    """
    if not arguments:
        return True
    first = arguments[0]
    if len(arguments) > 1 or first.startswith("-") or first in commands:
        return False
    return bool(Path(first).suffix) or len(Path(first).parts) > 1 or Path(first).exists()


def open_window(file: str | None) -> int:
    """Open the window, on a project, picture or coordinates, and return the exit status.

    Raises
    ------
    InputError
        If there is no screen, or Qt's system libraries are missing.
    """
    try:
        from bobdesk.ui.application import has_screen, start
    except ImportError as error:
        raise InputError(
            f"the window cannot be opened, since a library is missing ({error}); on Debian: apt-get install"
            " libegl1 libgl1 libxkbcommon-x11-0 libdbus-1-3 libfontconfig1 libxcb-cursor0 libxcb-icccm4"
            " libxcb-keysyms1 libxcb-shape0 libxcb-xinerama0 libxcb-image0 libxcb-render-util0 libxcb-randr0"
        ) from error
    if not has_screen():
        raise InputError("there is no screen to open a window on; `bobdesk --help` lists the commands without one")
    return start(None if file is None else Path(file))
