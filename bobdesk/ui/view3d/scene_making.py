"""What is drawn of a 3D line, in words and units of the user."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject

from bobdesk.arrays import FloatArray
from bobdesk.project.project import ActualTrack
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.view3d.colouring import Colouring, Figure, colouring
from bobdesk.ui.view3d.scene import Scene, Thread

if TYPE_CHECKING:
    from bobdesk.track.centreline3d import Centreline3D


def actual_elevations(line: Centreline3D, actual: ActualTrack) -> FloatArray:
    """Return the actual track's elevation at each row, (n,), m, at equal shares of the plan lengths."""
    points = actual.points
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points[:, :2], axis=0).T))])
    shares = line.stations / line.stations[-1]
    elevations: FloatArray = np.interp(shares, stations / stations[-1], points[:, 2] - points[:, 2].min())
    return elevations


class SceneMaking(QObject):
    """Makes scenes."""

    def __init__(self, quantities: Quantities, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._unit = quantities

    def scene(
        self,
        line: Centreline3D,
        figure: Figure,
        *,
        actual: ActualTrack | None = None,
        threads: tuple[Thread, ...] = (),
        segments: tuple[int, ...] = (),
        station: float | None = None,
        has_drop_lines: bool = True,
    ) -> Scene:
        """Return what is drawn of a line.

        Parameters
        ----------
        figure
            What the colours stand for; deviations need the actual track.
        segments
            Indices of selected segments.
        station
            Of the cursor, m.
        """
        found = self._colouring(line, figure, actual)
        curves = np.array([segment.kind == "curve" for segment in line.segments])
        cursor = None
        if station is not None and 0 <= station <= line.stations[-1]:
            cursor = np.array([np.interp(station, line.stations, line.points[:, axis]) for axis in range(3)])
        show = self._shown
        return Scene(
            points=line.points,
            colouring=found,
            is_curve=curves[line.segment_of],
            is_selected=np.isin(line.segment_of, segments),
            threads=threads,
            has_drop_lines=has_drop_lines,
            start=self.tr("Start {elevation}").format(elevation=self._unit.length(float(line.elevations[0]))),
            finish=self.tr("Finish {elevation}").format(elevation=self._unit.length(float(line.elevations[-1]))),
            low=show(found.figure, found.low),
            high=show(found.figure, found.high),
            title=self._title(found.figure),
            cursor=cursor,
            floor=min(float(line.elevations.min()), 0.0),
        )

    def _colouring(self, line: Centreline3D, figure: Figure, actual: ActualTrack | None) -> Colouring:
        if figure == "deviation" and actual is not None:
            return colouring("deviation", line.elevations - actual_elevations(line, actual))
        if figure == "curvature":
            return colouring("curvature", line.plan_curvature)
        if figure == "elevation":
            return colouring("elevation", line.elevations)
        return colouring("gradient", line.gradients)

    def _shown(self, figure: Figure, value: float) -> str:
        if figure == "gradient":
            return self._unit.gradient(value, 1)
        if figure == "curvature":
            return f"{self._unit.number(value, 4)} 1/m"
        return self._unit.length(value, 1)

    def _title(self, figure: Figure) -> str:
        return {
            "gradient": self.tr("Gradient"),
            "curvature": self.tr("Curvature, left positive"),
            "elevation": self.tr("Elevation"),
            "deviation": self.tr("Elevation less the actual track's"),
        }[figure]
