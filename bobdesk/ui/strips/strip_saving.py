"""Save a strip in a file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMenu, QWidget

from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import icon
from bobdesk.ui.questions import Questions
from bobdesk.ui.strips.strip import Strip
from bobdesk.ui.strips.strip_export import strip_csv, strip_png, strip_svg


class StripSaving(QObject):
    """Asks where, and writes."""

    def __init__(self, desk: Desk, parent: QWidget) -> None:
        super().__init__(parent)
        self._desk = desk
        self._questions = Questions(desk.settings, parent)

    def fill_menu(self, menu: QMenu, strip: Strip) -> None:
        """Add what can be saved of a strip."""
        menu.addAction(icon("picture"), self.tr("Save as PNG…"), lambda: self.ask(strip, ".png"))
        menu.addAction(icon("picture"), self.tr("Save as SVG…"), lambda: self.ask(strip, ".svg"))
        table = menu.addAction(icon("table"), self.tr("Save the numbers as CSV…"), lambda: self.ask(strip, ".csv"))
        table.setEnabled(any(curve.column for curve in strip.curves.values()))

    def ask(self, strip: Strip, ending: str) -> None:
        """Ask where, and save."""
        title = self.tr("Save {strip}").format(strip=strip.title)
        path = self._questions.file_to_save("export", title, strip.title.lower(), f"*{ending}", ending)
        if path is not None:
            self.save(strip, path, ending)

    def save(self, strip: Strip, path: Path, ending: str) -> bool:
        """Write a strip; return whether that worked, and say so if not."""
        make: dict[str, Callable[[Strip], bytes]] = {".png": strip_png, ".svg": strip_svg, ".csv": strip_csv}
        try:
            write_atomic(path, make[ending](strip))
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        self._desk.notices.note(self.tr("Saved as {name}").format(name=path.name))
        return True
