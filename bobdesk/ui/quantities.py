"""Numbers as the user reads them: in the user's units and with the signs of the user's country.

Files never pass through here; they have metres, dots and no groups.
"""

from __future__ import annotations

import math

from PySide6.QtCore import QLocale, QObject, Signal

from bobdesk.ui.settings import Settings

_FEET = 0.3048
_NOTHING = "–"


class Quantities(QObject):
    """Lengths, gradients and plain numbers as text, and the factors that forms need.

    Signals
    -------
    changed
        Other units are wanted: show everything anew.
    """

    changed = Signal()

    def __init__(self, settings: Settings, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._settings = settings
        settings.changed.connect(self._on_setting)

    @property
    def length_unit(self) -> str:
        """Sign of the unit of length: "m" or "ft"."""
        return self._settings.length_unit

    @property
    def length_factor(self) -> float:
        """Shown units per metre."""
        return 1.0 if self._settings.length_unit == "m" else 1.0 / _FEET

    @property
    def gradient_unit(self) -> str:
        """Sign of the unit of gradients: "%" or "°"."""
        return "%" if self._settings.gradient_unit == "percent" else "°"

    def length(self, metres: float | None, digits: int = 1, *, unit: bool = True) -> str:
        """Return a length, such as "1,290.0 m"; a dash for None."""
        if metres is None or not math.isfinite(metres):
            return _NOTHING
        text = self.number(metres * self.length_factor, digits)
        return f"{text} {self.length_unit}" if unit else text

    def gradient(self, value: float | None, digits: int = 2, *, unit: bool = True) -> str:
        """Return a gradient, downhill positive, such as "9.31 %"; a dash for None."""
        if value is None or not math.isfinite(value):
            return _NOTHING
        text = self.number(self.shown_gradient(value), digits)
        return f"{text} {self.gradient_unit}" if unit else text

    def shown_gradient(self, value: float) -> float:
        """Return a gradient in the shown unit."""
        return 100 * value if self._settings.gradient_unit == "percent" else math.degrees(math.atan(value))

    def meant_gradient(self, shown: float) -> float:
        """Return the gradient that was typed in the shown unit."""
        return shown / 100 if self._settings.gradient_unit == "percent" else math.tan(math.radians(shown))

    def number(self, value: float | None, digits: int = 1) -> str:
        """Return a number with the signs of the user's country, and a real minus; a dash for None."""
        if value is None or not math.isfinite(value):
            return _NOTHING
        value = round(value, digits) + 0.0
        return QLocale().toString(value, "f", digits).replace("-", "−")

    def angle(self, radians: float | None, digits: int = 1) -> str:
        """Return an angle in degrees."""
        return _NOTHING if radians is None else f"{self.number(math.degrees(radians), digits)}°"

    def _on_setting(self, name: str) -> None:
        if name in ("length_unit", "gradient_unit", "language"):
            self.changed.emit()
