"""Gradient and elevation of the chosen run by station of the plan, as the strips and the table show them."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from bobdesk.arrays import FloatArray
from bobdesk.project.project import Project
from bobdesk.ui.derived import DerivedLater
from bobdesk.ui.desk import Desk


@dataclass(frozen=True, eq=False)
class RunProfile:
    """A run's profile.

    Attributes
    ----------
    shares : (n,)
        Stations as shares of the line, 0 to 1, so that a line of another scale can be laid over it.
    elevations, gradients : (n,)
        m, and downhill positive.
    length
        Of the plan in true size, m.
    """

    shares: FloatArray
    elevations: FloatArray
    gradients: FloatArray
    length: float


def run_profile_later(desk: Desk) -> DerivedLater:
    """Return the one follower of the chosen run's profile in a window; its value is a `RunProfile`."""
    name = "run profile later"
    found = desk.session.findChild(DerivedLater, name)
    if found is None:
        title = QCoreApplication.translate("RunProfile", "Reading the result")
        found = DerivedLater(desk, title, _profile, _inputs, desk.session)
        found.setObjectName(name)
    return found


def _inputs(project: Project) -> tuple[object, ...] | None:
    return None if project.run is None else (project.run,)


def _profile(project: Project) -> RunProfile:
    from bobdesk.project.derive_runs import run_line

    assert project.run is not None
    line = run_line(project.run)
    length = float(line.stations[-1])
    return RunProfile(line.stations / length, line.elevations, line.gradients, length)
