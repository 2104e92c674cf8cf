"""The gradient strip and the elevation strip: what the chosen run has found."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QWidget

from bobdesk.arrays import FloatArray
from bobdesk.project import derive
from bobdesk.project.derive_runs import why_out_of_date
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.strips.contents import Curve, Level, Marks
from bobdesk.ui.strips.run_profile import RunProfile, run_profile_later
from bobdesk.ui.strips.station_axis import StationAxis
from bobdesk.ui.strips.strip import Strip

RUN = "run"
KNOWN = "known"
POSSIBLE, LIKELY = "possible", "likely"


class ProfileStrip(Strip):
    """What both have in common: they follow the chosen run and lay it over the line as it is now."""

    def __init__(self, desk: Desk, axis: StationAxis, title: str, parent: QWidget | None = None) -> None:
        super().__init__(axis, desk.quantities, title, parent)
        self._desk = desk
        self._later = run_profile_later(desk)
        self._now = alignment_now(desk)
        self._later.changed.connect(self.follow)
        self._now.changed.connect(self._on_line)
        desk.session.changed.connect(self._on_changed)
        self._line: object = None

    @property
    def profile(self) -> RunProfile | None:
        """The chosen run's profile."""
        found = self._later.value
        return found if isinstance(found, RunProfile) and self._desk.session.project.run is not None else None

    @property
    def stations(self) -> FloatArray | None:
        """Stations of the profile on the line as it is now, m."""
        profile = self.profile
        if profile is None:
            return None
        length = profile.length if self._now.value is None else self._now.value.line.length
        return length * profile.shares

    @property
    def run_colour(self) -> str:
        """The one colour of the chosen run."""
        run = self._desk.session.project.run
        return "accent" if run is None else shown_result_of(self._desk).colour_of(run)

    def follow(self) -> None:
        """Show the chosen run."""

    def out_of_date(self) -> str:
        """Return a word of warning if the run is out of date."""
        project = self._desk.session.project
        if project.run is None or why_out_of_date(project, project.run) is None:
            return ""
        return self.tr("out of date")

    def _on_line(self) -> None:
        line = None if self._now.value is None else self._now.value.line
        if line is not self._line:
            self._line = line
            self.follow()

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.limits != after.limits or before.known_elevations is not after.known_elevations:
            self.follow()


class GradientStrip(ProfileStrip):
    """Gradient by station, with its limits dashed."""

    def __init__(self, desk: Desk, axis: StationAxis, parent: QWidget | None = None) -> None:
        super().__init__(desk, axis, "", parent)
        self.title = self.tr("Gradient")
        self.setAccessibleName(self.title)
        self.unit = self._unit
        self.to_shown = self._to_shown
        self.from_shown = desk.quantities.meant_gradient
        desk.quantities.changed.connect(self.follow)
        self.set_empty(self.tr("The gradient is shown here after a run (step 5)."))
        self.follow()

    def readout(self, station: float | None) -> str:
        """Return the gradient at a station."""
        stations, profile = self.stations, self.profile
        if stations is None or profile is None or station is None:
            return self.out_of_date()
        found = self._desk.quantities.gradient(float(np.interp(station, stations, profile.gradients)))
        return " · ".join(part for part in (self.out_of_date(), found) if part)

    def follow(self) -> None:
        """Show the chosen run and the limits."""
        stations, profile = self.stations, self.profile
        if stations is None or profile is None:
            for key in (RUN,):
                self.set_curve(key, None)
            for key in ("lowest", "highest"):
                self.set_level(key, None)
            return
        self.set_curve(RUN, Curve(stations, profile.gradients, self.run_colour, 1.6, column="gradient"))
        limits, unit = self._desk.session.project.limits, self._desk.quantities
        low, high = float(profile.gradients.min()), float(profile.gradients.max())
        room = 0.5 * max(high - low, 0.02)
        texts = (self.tr("lowest {value}"), self.tr("highest {value}"))
        for key, limit, text in zip(
            ("lowest", "highest"), (limits.min_gradient, limits.max_gradient), texts, strict=True
        ):
            # A limit far away from all gradients would only press them flat.
            near = low - room <= limit <= high + room
            self.set_level(key, Level(limit, text.format(value=unit.gradient(limit, 1)), counts=near))

    def _unit(self) -> str:
        return self._desk.quantities.gradient_unit

    def _to_shown(self, values: FloatArray) -> FloatArray:
        return 100 * values if self._unit() == "%" else np.degrees(np.arctan(values))


class ElevationStrip(ProfileStrip):
    """Elevation by station, with known elevations as diamonds."""

    def __init__(self, desk: Desk, axis: StationAxis, parent: QWidget | None = None) -> None:
        super().__init__(desk, axis, "", parent)
        self.title = self.tr("Elevation")
        self.setAccessibleName(self.title)
        self.unit = self._unit
        self.to_shown = self._to_shown
        self.from_shown = self._from_shown
        self.set_empty(self.tr("The elevation is shown here after a run (step 5)."))
        self.follow()

    def readout(self, station: float | None) -> str:
        """Return the elevation at a station."""
        parts = [self.out_of_date()]
        stations, profile = self.stations, self.profile
        if stations is not None and profile is not None and station is not None:
            height = self._desk.quantities.length(float(np.interp(station, stations, profile.elevations)))
            likely = self.bands.get(LIKELY)
            if likely is not None:
                half = 0.5 * float(np.interp(station, likely.stations, likely.high - likely.low))
                height += f" ± {self._desk.quantities.length(half)}"
            parts.append(height)
        if station is not None and POSSIBLE in self.bands:
            band, unit = self.bands[POSSIBLE], self._desk.quantities
            low, high = (float(np.interp(station, band.stations, edge)) for edge in (band.low, band.high))
            parts.append(
                self.tr("possible {low} to {high}").format(low=unit.length(low, unit=False), high=unit.length(high))
            )
        elif KNOWN in self.marks:
            parts.append(self.tr("◇ known elevation"))
        return " · ".join(part for part in parts if part)

    def follow(self) -> None:
        """Show the chosen run and the known elevations."""
        stations, profile = self.stations, self.profile
        if stations is None or profile is None:
            self.set_curve(RUN, None)
        else:
            self.set_curve(RUN, Curve(stations, profile.elevations, self.run_colour, 1.6, column="elevation_m"))
        project = self._desk.session.project
        known = project.known_elevations
        if not known:
            self.set_marks(KNOWN, None)
            return
        factor = derive.plan_factor(project)
        places = factor * np.array([one.station for one in known])
        self.set_marks(KNOWN, Marks(places, np.array([one.elevation for one in known]), is_draggable=True))

    def _unit(self) -> str:
        return self._desk.quantities.length_unit

    def _to_shown(self, values: FloatArray) -> FloatArray:
        return values * self._desk.quantities.length_factor

    def _from_shown(self, shown: float) -> float:
        return shown / self._desk.quantities.length_factor
