"""What the strips show beside the chosen run: the run at work, other runs, actual track, 3D curvature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt

from bobdesk.arrays import FloatArray
from bobdesk.project.project import ActualTrack, Project
from bobdesk.project.runs import Run
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.solve.known_on_strip import KnownOnStrip
from bobdesk.ui.strips.contents import Curve, without_spikes

if TYPE_CHECKING:
    from bobdesk.track.centreline3d import Centreline3D
    from bobdesk.ui.strips.strip_stack import StripStack

_SHOWN, _ACTUAL, _SPACE = "shown", "actual", "in space"


class ResultStrips(QObject):
    """Feeds a stack of strips; every line is laid over the line in plan as it is now, at equal shares."""

    def __init__(self, desk: Desk, stack: StripStack) -> None:
        super().__init__(stack)
        self._desk = desk
        self._stack = stack
        self._shown = shown_result_of(desk)
        self._now = alignment_now(desk)
        self._overlays = 0
        self._was_live = False
        self._shown.changed.connect(self._draw)
        self._now.changed.connect(self._draw)
        desk.session.changed.connect(self._on_changed)
        KnownOnStrip(desk, stack)
        stack.installEventFilter(self)
        self._draw()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Draw in the colours of another palette."""
        if event.type() == QEvent.Type.PaletteChange:
            self._stack.gradient.follow()
            self._stack.elevation.follow()
            self._draw()
        return super().eventFilter(watched, event)

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.actual is not after.actual:
            self._draw()

    def _stations(self, line: Centreline3D) -> FloatArray:
        length = float(line.stations[-1])
        value = self._now.value
        shown = length if value is None else value.line.length
        stations: FloatArray = line.stations * (shown / length)
        return stations

    def _draw(self) -> None:
        line = self._shown.line
        differs = line is not None and (self._shown.is_live or self._shown.scrubbed is not None)
        stack = self._stack
        if line is not None and differs:
            stations = self._stations(line)
            colour = self._shown.colour
            stack.gradient.set_curve(_SHOWN, Curve(stations, line.gradients, colour, 2.0))
            stack.elevation.set_curve(_SHOWN, Curve(stations, line.elevations, colour, 2.0))
        else:
            stack.gradient.set_curve(_SHOWN, None)
            stack.elevation.set_curve(_SHOWN, None)
        space = None
        if line is not None:
            space = Curve(
                self._stations(line), np.abs(line.curvature), "preview", 1.0, Qt.PenStyle.DashLine, counts=False,
                column="curvature_3d_per_m",
            )  # fmt: skip
        stack.curvature.set_curve(_SPACE, space)
        if self._shown.is_live and self._was_live:
            return  # all else stays as it is while a run works
        self._was_live = self._shown.is_live
        self._draw_overlays()
        self._draw_actual(line)

    def _draw_overlays(self) -> None:
        overlays: list[tuple[Run, Centreline3D]] = self._shown.overlays
        for index in range(max(len(overlays), self._overlays)):
            key = f"overlay {index}"
            gradient = elevation = None
            if index < len(overlays):
                run, line = overlays[index]
                stations, colour = self._stations(line), self._shown.colour_of(run)
                gradient = Curve(stations, line.gradients, colour, 1.2, column=f"gradient_{run.name}")
                elevation = Curve(stations, line.elevations, colour, 1.2, column=f"elevation_m_{run.name}")
            self._stack.gradient.set_curve(key, gradient)
            self._stack.elevation.set_curve(key, elevation)
        self._overlays = len(overlays)

    def _draw_actual(self, line: Centreline3D | None) -> None:
        actual = self._desk.session.project.actual
        value = self._now.value
        length = value.line.length if value is not None else (0.0 if line is None else float(line.stations[-1]))
        gradient = elevation = None
        if actual is not None and length > 0:
            stations, elevations, gradients = actual_profile(actual, length)
            gradient = Curve(
                stations, gradients, "measure", 1.2, Qt.PenStyle.DashLine,
                # Surveyed lines have spikes, which would press all else flat.
                counted=without_spikes(stations, gradients), column="actual_gradient",
            )  # fmt: skip
            elevation = Curve(
                stations, elevations, "measure", 1.2, Qt.PenStyle.DashLine,
                counted=without_spikes(stations, elevations), column="actual_elevation_m",
            )  # fmt: skip
        self._stack.gradient.set_curve(_ACTUAL, gradient)
        self._stack.elevation.set_curve(_ACTUAL, elevation)


def actual_profile(actual: ActualTrack, length: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return stations, elevations and gradients of the actual track, laid over a plan of another length, m."""
    points = actual.points
    plan = np.hypot(*np.diff(points[:, :2], axis=0).T)
    stations = np.concatenate([[0.0], np.cumsum(plan)])
    keep = np.concatenate([[True], plan > 1e-9])
    stations, elevations = stations[keep], points[keep, 2] - points[:, 2].min()
    gradients = -np.gradient(elevations, stations)
    return stations * (length / stations[-1]), elevations, gradients
