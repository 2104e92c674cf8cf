"""The curvature strip: fitted curve, raw one behind it, and the threshold as a line that can be dragged."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QWidget

from bobdesk.arrays import FloatArray
from bobdesk.sentences import as_sentence
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.automatic_operations import automatic_operations
from bobdesk.ui.strips.contents import Curve, Level
from bobdesk.ui.strips.station_axis import StationAxis
from bobdesk.ui.strips.strip import Strip

# As far down as four decimals show it, here and in the panel's field.
_LEAST, _MOST = 1e-4, 1.0
THRESHOLD = "threshold"


class CurvatureStrip(Strip):
    """Follows the alignment; the size of the curvature, since one threshold parts straight from curve."""

    def __init__(self, desk: Desk, axis: StationAxis, parent: QWidget | None = None) -> None:
        super().__init__(axis, desk.quantities, "", parent)
        self.title = self.tr("Curvature")
        self.setAccessibleName(self.title)
        self._desk = desk
        self._now = alignment_now(desk)
        self._automatic = automatic_operations(desk)
        self._drawn_line: object = None
        self.starts_at_zero = True
        self.unit = self._unit
        self.to_shown = self._to_shown
        self.from_shown = self._from_shown
        self._now.changed.connect(self._follow)
        desk.quantities.changed.connect(self._label)
        self.level_dragged.connect(self._on_level_dragged)
        self.level_dropped.connect(self._on_level_dropped)
        self.level_cancelled.connect(self._on_level_cancelled)
        self._follow()

    def readout(self, station: float | None) -> str:
        """Return the radius at a station in words."""
        known = self._now.value
        if known is None or station is None:
            return ""
        bend = float(np.interp(station, known.line.stations, known.bends))
        radius = known.radius_at(station)
        shown = self._desk.quantities.number(abs(bend) / self._desk.quantities.length_factor, 4)
        if radius is None:
            return self.tr("{curvature} {unit} · straight").format(curvature=shown, unit=self._unit())
        side = self.tr("left") if radius > 0 else self.tr("right")
        return self.tr("{curvature} {unit} · radius {radius} {side}").format(
            curvature=shown, unit=self._unit(), radius=self._desk.quantities.length(abs(radius)), side=side
        )

    def _follow(self) -> None:
        value = self._now.value
        if value is None:
            self.set_curve("raw", None)
            self.set_curve("fitted", None)
            self.set_level(THRESHOLD, None)
            self.set_empty(
                as_sentence(self._now.problem) or self.tr("The curvature is shown here once there is a line.")
            )
            self._drawn_line = None
            return
        if value.line is not self._drawn_line:
            self._drawn_line = value.line
            stations = value.line.stations
            self.set_curve(
                "raw",
                Curve(
                    stations, np.abs(value.raw_bends), "muted", 1.0, alpha=90, counts=False,
                    column="raw_curvature_per_m",
                ),
            )  # fmt: skip
            self.set_curve("fitted", Curve(stations, np.abs(value.bends), "text", column="curvature_per_m"))
        self._label()
        self.update()

    def _label(self) -> None:
        threshold = self._now.threshold
        if threshold is None:
            return
        shown = self._desk.quantities.number(threshold / self._desk.quantities.length_factor, 4)
        is_automatic = self._desk.session.project.segmentation.threshold is None and not self._now.is_trying_threshold
        text = (
            self.tr("threshold {value} {unit} (automatic) ⇕") if is_automatic else self.tr("threshold {value} {unit} ⇕")
        )
        level = Level(threshold, text.format(value=shown, unit=self._unit()), is_draggable=True)
        if level != self.levels.get(THRESHOLD):
            self.set_level(THRESHOLD, level)

    def _on_level_dragged(self, _key: str, value: float) -> None:
        self._automatic.preview_threshold(_kept(value))

    def _on_level_dropped(self, _key: str, value: float) -> None:
        self._automatic.change_settings(threshold=_kept(value))

    def _on_level_cancelled(self, _key: str) -> None:
        self._automatic.drop_preview()

    def _unit(self) -> str:
        return f"1/{self._desk.quantities.length_unit}"

    def _to_shown(self, values: FloatArray) -> FloatArray:
        return values / self._desk.quantities.length_factor

    def _from_shown(self, shown: float) -> float:
        return shown * self._desk.quantities.length_factor


def _kept(threshold: float) -> float:
    """Return a threshold that is allowed, with four digits that count."""
    return float(f"{min(max(threshold, _LEAST), _MOST):.3g}")
