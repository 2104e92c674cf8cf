"""What the data leave open, followed for the whole window: the band, random profiles, advice, the error budget."""

from __future__ import annotations

from collections.abc import Generator
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from bobdesk.project.project import Project
from bobdesk.ui.derived import DerivedLater
from bobdesk.ui.desk import Desk
from bobdesk.ui.solve.feasibility_part import inputs_of

if TYPE_CHECKING:
    from bobdesk.project.derive_open import OpenBand, OpenProfiles
    from bobdesk.solve.next_elevation import NextElevation
    from bobdesk.track.error_budget import ErrorBudget

# Of what can be shown: its name in the settings, and whether it is shown at first.
SHOWN_AT_FIRST = {"band": True, "profiles": False, "error_band": False}


class OpenData(QObject):
    """Works out what is wanted, in the background, each time that something which it follows from is changed.

    Signals
    -------
    changed
        One of the values, or what is shown, is another one.
    """

    changed = Signal()

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self._wants_advice = False
        self._wants_budget = False
        self._followers: dict[str, DerivedLater] = {}
        for name, title, work, inputs in (
            ("band", self.tr("Finding the band"), _band, self._inputs_of_band),
            ("profiles", self.tr("Drawing profiles at random"), _profiles, self._inputs_of_profiles),
            ("advice", self.tr("Finding where one more elevation helps"), _advice, self._inputs_of_advice),
            ("budget", self.tr("Working out the error budget"), _budget, self._inputs_of_budget),
        ):
            follower = DerivedLater(desk, title, work, inputs, self)
            follower.changed.connect(self.changed)
            self._followers[name] = follower

    @property
    def band(self) -> OpenBand | None:
        """The band, if it is shown and known."""
        found: OpenBand | None = self._followers["band"].value
        return found

    @property
    def profiles(self) -> OpenProfiles | None:
        """Profiles at random, if they are shown and known."""
        found: OpenProfiles | None = self._followers["profiles"].value
        return found

    @property
    def advice(self) -> NextElevation | None:
        """Where one more known elevation would help most, if that was asked."""
        found: NextElevation | None = self._followers["advice"].value
        return found

    @property
    def budget(self) -> ErrorBudget | None:
        """The error budget, if it was asked for."""
        found: ErrorBudget | None = self._followers["budget"].value
        return found

    def problem(self, name: str) -> str | None:
        """Return why there is no band, profiles, advice or budget."""
        return self._followers[name].problem

    def is_current(self, name: str) -> bool:
        """Return whether one of them is that of the document as it is now."""
        return self._followers[name].is_current

    def is_shown(self, name: str) -> bool:
        """Return whether the strips show the band, the profiles or the error band."""
        return self._desk.settings.flag(f"open_{name}", SHOWN_AT_FIRST[name])

    def show(self, name: str, on: bool) -> None:
        """Let the strips show one of them, or not."""
        self._desk.settings.set_flag(f"open_{name}", on)
        self._look_again()

    def want_advice(self, on: bool) -> None:
        """Follow where one more known elevation would help most, or no longer."""
        self._wants_advice = on
        self._look_again()

    def want_budget(self, on: bool) -> None:
        """Follow the error budget for its table, or no longer."""
        self._wants_budget = on
        self._look_again()

    @property
    def wants_advice(self) -> bool:
        """Whether advice is asked for."""
        return self._wants_advice

    def _look_again(self) -> None:
        for follower in self._followers.values():
            follower.look_again()
        self.changed.emit()

    def _inputs_of_band(self, project: Project) -> tuple[object, ...] | None:
        return self._inputs(project) if self.is_shown("band") else None

    def _inputs_of_profiles(self, project: Project) -> tuple[object, ...] | None:
        return self._inputs(project) if self.is_shown("profiles") else None

    def _inputs_of_advice(self, project: Project) -> tuple[object, ...] | None:
        known = inputs_of(project)
        if known is None or not self._wants_advice:
            return None
        # What would be measured is taken from the result.
        return (*known, None if project.run is None else project.run.layout)

    def _inputs_of_budget(self, project: Project) -> tuple[object, ...] | None:
        if not (self._wants_budget or self.is_shown("error_band")):
            return None
        known = inputs_of(project)
        return None if known is None else (*known, project.plan_error)

    def _inputs(self, project: Project) -> tuple[object, ...] | None:
        known = inputs_of(project)
        if known is None or project.calibration.way != "unknown":
            return known
        # The factor that a run has found counts.
        return (*known, None if project.run is None else project.run.layout)


def open_data_of(desk: Desk) -> OpenData:
    """Return the one `OpenData` that all parts of a window share."""
    name = "open data"
    found = desk.session.findChild(OpenData, name)
    if found is None:
        found = OpenData(desk, desk.session)
        found.setObjectName(name)
    return found


def _band(project: Project) -> Generator[Any, None, OpenBand]:
    from bobdesk.project.derive_open import open_band

    return open_band(project)


def _profiles(project: Project) -> Generator[Any, None, OpenProfiles]:
    from bobdesk.project.derive_open import open_profiles

    return open_profiles(project)


def _advice(project: Project) -> Generator[Any, None, NextElevation]:
    from bobdesk.project.derive_open import advice

    return advice(project)


def _budget(project: Project) -> Generator[Any, None, ErrorBudget]:
    from bobdesk.project.derive_open import budget

    return budget(project)
