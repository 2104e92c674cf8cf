"""Save what a window beside the main one shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication

from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic

if TYPE_CHECKING:
    from bobdesk.ui.studies.beside_window import BesideWindow


def save_file(window: BesideWindow, make: Callable[[], bytes], name: str, suffix: str) -> bool:
    """Ask where and write a file; return whether that was done, and say so or why not.

    Parameters
    ----------
    make
        Returns the bytes.
    name
        What is proposed, with its ending.
    suffix
        The ending, with its dot.
    """
    filters = f"{suffix[1:].upper()} (*{suffix})"
    path = window.questions.file_to_save("export", window.windowTitle(), name.replace("/", "-"), filters, suffix)
    if path is None:
        return False
    try:
        write_atomic(path, make())
    except InputError as error:
        window.desk.notices.error(str(error))
        return False
    window.desk.notices.note(QCoreApplication.translate("Saving", "Written to {name}.").format(name=path.name))
    return True
