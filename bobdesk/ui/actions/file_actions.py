"""The File menu."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject

from bobdesk.ui.actions.action import Action
from bobdesk.ui.documents import Documents
from bobdesk.ui.plans import Plans
from bobdesk.ui.session import Session


class FileActions(QObject):
    """New, open, save, import, quit."""

    def __init__(
        self, session: Session, documents: Documents, plans: Plans, quit_window: Callable[[], object], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._documents = documents
        self._plans = plans
        self._quit = quit_window

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (
            Action(
                "new",
                self.tr("&New project"),
                self._documents.new,
                ("Ctrl+N",),
                "new",
                self.tr("Close this project and begin another one"),
                "File",
                "open",
                enabled=self._is_open,
            ),
            Action(
                "new_from_picture",
                self.tr("New from &picture…"),
                self._plans.new_from_picture,
                ("Ctrl+Shift+N",),
                "picture",
                self.tr("Begin with a scan, drawing, PDF or aerial picture of the plan"),
                "File",
                "open",
            ),
            Action(
                "open",
                self.tr("&Open project…"),
                self._documents.open,
                ("Ctrl+O",),
                "open",
                self.tr("Open a project that was saved"),
                "File",
                "open",
            ),
            Action(
                "save",
                self.tr("&Save"),
                self._documents.save,
                ("Ctrl+S",),
                "save",
                self.tr("Save the project"),
                "File",
                "save",
                enabled=self._is_open,
            ),
            Action(
                "save_as",
                self.tr("Save &as…"),
                self._documents.save_as,
                ("Ctrl+Shift+S",),
                "save-as",
                self.tr("Save the project under another name"),
                "File",
                "save",
                enabled=self._is_open,
            ),
            Action(
                "import_coordinates",
                self.tr("&Import coordinates…"),
                self._plans.new_from_coordinates,
                ("Ctrl+I",),
                "import",
                self.tr("Begin with a plan in metres: CSV, DXF, GeoJSON, KML, GPX, OSM, SVG"),
                "File",
                "import",
            ),
            Action(
                "compare_with_file",
                self.tr("&Compare with a file…"),
                self._plans.compare_with_file,
                (),
                "table",
                self.tr("Lay the actual track, from a file with elevations, beside the results"),
                "File",
                "import",
                enabled=self._is_open,
            ),
            Action(
                "close",
                self.tr("&Close project"),
                self._documents.new,
                ("Ctrl+W",),
                "close",
                self.tr("Close the project and go to the start page"),
                "File",
                "end",
                enabled=self._is_open,
            ),
            Action(
                "quit",
                self.tr("&Quit"),
                self._quit,
                ("Ctrl+Q",),
                "",
                self.tr("Leave BobDesk"),
                "File",
                "end",
                role="quit",
            ),
        )

    def _is_open(self) -> bool:
        return self._session.is_open
