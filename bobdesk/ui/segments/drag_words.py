"""The figures beside a boundary that is being dragged, on the plan and on the strips alike."""

from __future__ import annotations

from PySide6.QtCore import QObject

from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.boundary_drag import BoundaryDrag


class DragWords(QObject):
    """Writes station, and length, radius, turn angle and fit of both sides."""

    def __init__(self, desk: Desk, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._desk = desk

    def lines(self, drag: BoundaryDrag) -> list[str]:
        """Return a line for the station and one for each side."""
        unit = self._desk.quantities
        station = unit.length(drag.station, 2)
        lines = [self.tr("{station} (at the threshold)").format(station=station) if drag.snapped else station]
        for arrow, (segment, figures) in zip("◀▶", drag.sides(), strict=True):
            parts = [unit.length(segment.length)]
            if segment.kind == "curve":
                parts.append(f"R {unit.length(figures.radius)}")
            parts += [f"∠ {unit.angle(abs(figures.turn))}", f"± {unit.length(figures.deviation, 2)}"]
            lines.append(f"{arrow} " + "  ".join(parts))
        return lines
