"""What can be done to the scale from menu, key and button alike."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QWidget

from bobdesk.errors import InputError
from bobdesk.project import edits
from bobdesk.project.project import Project
from bobdesk.ui.actions.action import Action
from bobdesk.ui.desk import Desk
from bobdesk.ui.questions import Questions

_LIMIT_BYTES = 10_000_000
_SUFFIX = ".points"


class ScaleActions(QObject):
    """Control points from and to QGIS, and the selected one.

    Parameters
    ----------
    window
        Over which file dialogs open.
    """

    def __init__(self, desk: Desk, window: QWidget) -> None:
        super().__init__(window)
        self._desk = desk
        self._window = window
        self._questions = Questions(desk.settings, window)

    def table(self) -> tuple[Action, ...]:
        """Return the rows for menus and keys."""
        return (
            Action(
                "remove-control-point",
                self.tr("Remove Control &Point"),
                self.remove_selected,
                icon="delete",
                tip=self.tr("Take the selected control point away"),
                menu="Plan",
                group="scale",
                enabled=self.can_remove,
            ),
            Action(
                "load-points",
                self.tr("&Load Control Points…"),
                self.load_by_dialog,
                icon="load",
                tip=self.tr("Take control points from a QGIS .points file in the place of those there are"),
                menu="Plan",
                group="scale",
                enabled=self.can_load,
            ),
            Action(
                "save-points",
                self.tr("&Save Control Points…"),
                self.save_by_dialog,
                icon="save",
                tip=self.tr("Write the control points as a QGIS .points file"),
                menu="Plan",
                group="scale",
                enabled=self.can_save,
            ),
        )

    def can_load(self) -> bool:
        """Whether there is a picture on which points can lie."""
        return self._desk.session.project.picture is not None

    def can_save(self) -> bool:
        """Whether there are control points."""
        return bool(self._desk.session.project.control_points)

    def can_remove(self) -> bool:
        """Whether a control point is selected."""
        index = self._desk.selection.control_point
        return index is not None and index < len(self._desk.session.project.control_points)

    def remove_selected(self) -> None:
        """Take the selected control point away."""
        index = self._desk.selection.control_point
        if index is None or not self.can_remove():
            return
        self._desk.selection.control_point = None
        self._desk.session.apply(
            self.tr("Remove control point"), lambda project: edits.remove_control_point(project, index)
        )

    def load_by_dialog(self) -> None:
        """Ask for a file and take its control points."""
        name, _ = QFileDialog.getOpenFileName(
            self._window,
            self.tr("Load Control Points"),
            self._desk.settings.folder("points"),
            self.tr("QGIS control points (*.points);;All files (*)"),
        )
        if name:
            self._desk.settings.set_folder("points", Path(name).parent)
            self.load(Path(name))

    def save_by_dialog(self) -> None:
        """Ask for a file and write the control points into it."""
        picture = self._desk.session.project.picture
        name = Path(picture.name).stem if picture is not None else "plan"
        filters = self.tr("QGIS control points (*.points)")
        path = self._questions.file_to_save("points", self.tr("Save Control Points"), name, filters, _SUFFIX)
        if path is not None:
            self.save(path)

    def load(self, path: Path) -> bool:
        """Take the control points of a file; return whether they could be taken."""
        from bobdesk.plan.qgis_points import parse_qgis_points

        try:
            found = parse_qgis_points(_text_of(path), name=path.name)
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        if not found.points:
            self._desk.notices.error(self.tr("{name} holds no control points.").format(name=path.name))
            return False

        def taken(project: Project) -> Project:
            return edits.scale_by_points(edits.set_control_points(project, found.points))

        self._desk.selection.control_point = None
        if not self._desk.session.apply(self.tr("Load control points"), taken):
            return False
        text = self.tr("{count} control points were taken from {name}; Undo brings the old ones back.")
        self._desk.notices.note(text.format(count=len(found.points), name=path.name))
        return True

    def save(self, path: Path) -> bool:
        """Write the control points; return whether that was done."""
        from bobdesk.files.atomic import write_atomic
        from bobdesk.plan.qgis_points import format_qgis_points

        try:
            write_atomic(path, format_qgis_points(self._desk.session.project.control_points).encode())
        except InputError as error:
            self._desk.notices.error(str(error))
            return False
        self._desk.notices.note(self.tr("The control points were written to {name}.").format(name=path.name))
        return True


def _text_of(path: Path) -> str:
    try:
        if not path.is_file():
            raise InputError(f"There is no file {path.name}.")
        if path.stat().st_size > _LIMIT_BYTES:
            raise InputError(f"{path.name} is too large for a file of control points.")
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError(f"{path.name} cannot be read: {(error.strerror or str(error)).lower()}.") from error
