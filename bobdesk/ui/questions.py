"""The questions that the window asks before something could be lost, and its file dialogs."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QPushButton, QWidget

from bobdesk.files.file_names import usable_name
from bobdesk.ui.settings import Settings
from bobdesk.ui.widgets.long_names import breakable

SaveAnswer = Literal["save", "discard", "cancel"]
PlanAnswer = Literal["new", "replace", "cancel"]
ChangedAnswer = Literal["overwrite", "save as", "cancel"]
PROJECT_SUFFIX = ".bobdesk"
PICTURE_SUFFIXES = (
    ".png",
    ".jpg",
    ".jpeg",
    ".tif",
    ".tiff",
    ".webp",
    ".bmp",
    ".gif",
    ".svg",
    ".pdf",
)


class Questions(QObject):
    """Asks the user; tests put another one in its place.

    Parameters
    ----------
    window
        Over which the questions appear.
    """

    def __init__(self, settings: Settings, window: QWidget) -> None:
        super().__init__(window)
        self._settings = settings
        self._window = window

    def save_changes(self, name: str) -> SaveAnswer:
        """Ask what shall become of changes that are not saved."""
        box = self._box(self.tr("Save the changes to {name}?").format(name=name))
        box.setInformativeText(self.tr("Without saving, the changes since the last save are lost."))
        save = box.addButton(self.tr("Save"), QMessageBox.ButtonRole.AcceptRole)
        discard = box.addButton(self.tr("Don't save"), QMessageBox.ButtonRole.DestructiveRole)
        cancel = box.addButton(self.tr("Cancel"), QMessageBox.ButtonRole.RejectRole)
        pressed = self._pressed(box, default=save, escape=cancel)
        return "save" if pressed is save else "discard" if pressed is discard else "cancel"

    def where_to_put_plan(self, name: str, *, is_meant: bool = True) -> PlanAnswer:
        """Ask whether a plan begins a new project or takes the place of the open one's.

        `is_meant` is False where another project was opened while the plan was being read.
        """
        words = (
            self.tr("This project has a plan already. What shall {name} be?")
            if is_meant
            else self.tr("Another project was opened while {name} was being read. What shall it be?")
        )
        box = self._box(words.format(name=name))
        box.setInformativeText(
            self.tr("Here it takes the place of plan, line and control points; Undo brings them back.")
        )
        new = box.addButton(self.tr("The plan of a new project"), QMessageBox.ButtonRole.AcceptRole)
        replace = box.addButton(self.tr("The plan of this project"), QMessageBox.ButtonRole.ActionRole)
        cancel = box.addButton(self.tr("Cancel"), QMessageBox.ButtonRole.RejectRole)
        pressed = self._pressed(box, default=new, escape=cancel)
        return "new" if pressed is new else "replace" if pressed is replace else "cancel"

    def open_elsewhere(self, name: str) -> bool:
        """Say that a project is open in another window; return whether a copy shall be opened."""
        box = self._box(self.tr("{name} is open in another window of BobDesk.").format(name=name))
        box.setInformativeText(
            self.tr("Two windows would overwrite each other's work. A copy can be opened and saved under another name.")
        )
        copy = box.addButton(self.tr("Open a copy"), QMessageBox.ButtonRole.AcceptRole)
        cancel = box.addButton(self.tr("Cancel"), QMessageBox.ButtonRole.RejectRole)
        return self._pressed(box, default=cancel, escape=cancel) is copy

    def changed_on_disk(self, name: str) -> ChangedAnswer:
        """Ask what to do with a file that another program has changed since it was opened."""
        box = self._box(self.tr("{name} has been changed on the disk since it was opened here.").format(name=name))
        overwrite = box.addButton(self.tr("Overwrite it"), QMessageBox.ButtonRole.DestructiveRole)
        save_as = box.addButton(self.tr("Save under another name…"), QMessageBox.ButtonRole.AcceptRole)
        cancel = box.addButton(self.tr("Cancel"), QMessageBox.ButtonRole.RejectRole)
        pressed = self._pressed(box, default=save_as, escape=cancel)
        return "overwrite" if pressed is overwrite else "save as" if pressed is save_as else "cancel"

    def overwrite(self, name: str) -> bool:
        """Say that a file is there already; return whether it shall be replaced."""
        box = self._box(self.tr("{name} is there already.").format(name=name))
        overwrite = box.addButton(self.tr("Overwrite it"), QMessageBox.ButtonRole.DestructiveRole)
        cancel = box.addButton(self.tr("Cancel"), QMessageBox.ButtonRole.RejectRole)
        return self._pressed(box, default=cancel, escape=cancel) is overwrite

    def stop_work(self, text: str, consequence: str) -> bool:
        """Say what is at work and what becomes of it; return whether it shall be stopped."""
        box = self._box(text)
        box.setInformativeText(consequence)
        stop = box.addButton(self.tr("Stop and close"), QMessageBox.ButtonRole.AcceptRole)
        stay = box.addButton(self.tr("Go on"), QMessageBox.ButtonRole.RejectRole)
        return self._pressed(box, default=stay, escape=stay) is stop

    def files_to_open(self, purpose: str, title: str, filters: str) -> list[Path]:
        """Ask for any number of files to read."""
        chosen, _ = QFileDialog.getOpenFileNames(self._window, title, self._settings.folder(purpose), filters)
        if chosen:
            self._settings.set_folder(purpose, Path(chosen[0]).parent)
        return [Path(name) for name in chosen]

    def file_to_open(self, purpose: str, title: str, filters: str) -> Path | None:
        """Ask for a file to read; `purpose` remembers the folder."""
        chosen, _ = QFileDialog.getOpenFileName(self._window, title, self._settings.folder(purpose), filters)
        if not chosen:
            return None
        self._settings.set_folder(purpose, Path(chosen).parent)
        return Path(chosen)

    def file_to_save(self, purpose: str, title: str, name: str, filters: str, suffix: str) -> Path | None:
        """Ask for a file to write; the suffix is added where it is missing, and overwriting is asked for.

        A proposed `name` becomes one that every system takes, whatever the project is called.
        """
        name = usable_name(name.removesuffix(suffix), suffix)
        folder = self._settings.folder(purpose)
        proposed = str(Path(folder) / name) if folder else name
        dialog = QFileDialog(self._window, title, proposed, filters)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix(suffix.removeprefix("."))
        dialog.selectFile(name)
        accepted = dialog.exec()
        files = dialog.selectedFiles()
        dialog.deleteLater()
        if not accepted or not files:
            return None
        self._settings.set_folder(purpose, Path(files[0]).parent)
        return Path(files[0])

    def project_filter(self) -> str:
        """Filter of file dialogs for projects."""
        return self.tr("BobDesk projects") + f" (*{PROJECT_SUFFIX})"

    def picture_filter(self) -> str:
        """Filter of file dialogs for pictures."""
        patterns = " ".join(f"*{suffix}" for suffix in PICTURE_SUFFIXES)
        return self.tr("Pictures and drawings") + f" ({patterns});;" + self.tr("All files") + " (*)"

    def _box(self, text: str) -> QMessageBox:
        box = QMessageBox(self._window)
        box.setIcon(QMessageBox.Icon.Question)
        box.setWindowTitle(self.tr("BobDesk"))
        box.setText(breakable(text))
        box.setTextFormat(Qt.TextFormat.PlainText)
        return box

    def _pressed(self, box: QMessageBox, *, default: QPushButton, escape: QPushButton) -> object:
        box.setDefaultButton(default)
        box.setEscapeButton(escape)
        box.exec()
        pressed = box.clickedButton()
        box.deleteLater()
        return pressed
