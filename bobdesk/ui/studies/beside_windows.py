"""The windows beside the main one: each is made when it is first wanted, and all end with the main one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from bobdesk.ui.desk import Desk

if TYPE_CHECKING:
    from bobdesk.ui.studies.beside_window import BesideWindow

Name = Literal["methods", "study", "published"]


class BesideWindows(QObject):
    """Methods side by side, studies, the published tables.

    Parameters
    ----------
    data_folder
        Where finished rows of studies are kept.

    Signals
    -------
    made
        A window, before it is shown for the first time.
    """

    made = Signal(QWidget)

    def __init__(self, desk: Desk, data_folder: Path, parent: QObject) -> None:
        super().__init__(parent)
        self._desk, self._data_folder = desk, data_folder
        self._made: dict[Name, BesideWindow] = {}

    def open(self, name: Name) -> BesideWindow:
        """Show a window, as it was left."""
        if name not in self._made:
            self._made[name] = self._make(name)
            self.made.emit(self._made[name])
        self._made[name].open()
        return self._made[name]

    def close(self) -> None:
        """End all of them, and what they work at."""
        for window in self._made.values():
            window.leave()
        self._made.clear()

    def _make(self, name: Name) -> BesideWindow:
        # Imported here, so that the main window is shown before they are loaded.
        if name == "methods":
            from bobdesk.ui.studies.methods_window import MethodsWindow

            return MethodsWindow(self._desk)
        if name == "study":
            from bobdesk.ui.studies.study_window import StudyWindow

            return StudyWindow(self._desk, self._data_folder / "studies")
        from bobdesk.ui.studies.published_window import PublishedWindow

        return PublishedWindow(self._desk)
