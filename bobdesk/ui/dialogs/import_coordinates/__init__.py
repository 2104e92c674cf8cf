"""Look at a file of coordinates before it is taken in."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QDialog, QWidget

from bobdesk.ui.desk import Desk

if TYPE_CHECKING:
    from bobdesk.files.importers.imported_line import ImportedLine


def look_at_coordinates(
    desk: Desk, path: Path, *, as_actual: bool, parent: QWidget | None
) -> tuple[ImportedLine, bool] | None:
    """Show what a file holds, and how it is read.

    Parameters
    ----------
    as_actual
        The file is wanted as the actual track, so it needs elevations.

    Returns
    -------
    line, keep_elevations
        What was read, and whether its elevations are to be kept as the actual track; None when the user does not
        want it.
    """
    from bobdesk.ui.dialogs.import_coordinates.dialog import ImportDialog

    dialog = ImportDialog(path, desk, as_actual=as_actual, parent=parent)
    try:
        accepted = dialog.exec() == QDialog.DialogCode.Accepted
        line = dialog.line
        return (line, dialog.keeps_elevations) if accepted and line is not None else None
    finally:
        dialog.deleteLater()
