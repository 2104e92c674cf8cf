"""Ask for the length of a distance between two places, beside the click."""

from __future__ import annotations

from typing import Literal

from PySide6.QtCore import QCoreApplication, QPointF
from PySide6.QtWidgets import QWidget

from bobdesk.plan.control_points import KnownDistance
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.popup import Field, Popup

Place = tuple[float, float]


def give_distance(
    desk: Desk, host: QWidget, beside: QPointF, start: Place, end: Place, what: Literal["known", "check"]
) -> Popup:
    """Open the form; the distance is stored when a length is given.

    Parameters
    ----------
    host
        What the form lies on.
    beside
        Place of the form on it.
    start, end
        Picture pixels.
    what
        A known distance makes the scale, a check distance only checks it.
    """
    quantities = desk.quantities
    if what == "known":
        title = QCoreApplication.translate("GiveDistance", "Known distance")
        label = QCoreApplication.translate("GiveDistance", "Add known distance")
    else:
        title = QCoreApplication.translate("GiveDistance", "Check distance")
        label = QCoreApplication.translate("GiveDistance", "Add check distance")

    def taken(values: list[float]) -> bool:
        return desk.session.apply(label, lambda before: _with(before, start, end, values[0] / factor, what))

    factor = quantities.length_factor
    field = Field(
        QCoreApplication.translate("GiveDistance", "Length in plan"),
        round(_guess(desk.session.project, start, end) * factor, 3),
        quantities.length_unit,
        least=0.0,
    )
    return Popup(host, beside, title, [field], taken)


def _with(project: Project, start: Place, end: Place, length: float, what: Literal["known", "check"]) -> Project:
    from bobdesk.project import edits

    known = KnownDistance(start, end, length, "")
    if what == "check":
        return edits.add_check_distance(project, known)
    return edits.add_known_distance(project, known)


def _guess(project: Project, start: Place, end: Place) -> float:
    """Return the length by the scale there is, m; 0 without one."""
    from bobdesk.project import derive

    found = derive.calibration(project).value
    if found is None or not found.scale_known:
        return 0.0
    return KnownDistance(start, end, 1.0).length_px * found.metres_per_pixel
