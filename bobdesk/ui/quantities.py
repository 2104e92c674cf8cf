"""Numbers as the user reads them: in the user's units and with the signs of the user's country.

Files never pass through here; they have metres, dots and no groups.
"""

from __future__ import annotations

import math
import re

from PySide6.QtCore import QLocale, QObject, Signal

from bobdesk.ui.settings import Settings

_FEET = 0.3048
_NOTHING = "–"
# A number with points and groups as in English, which is no part of a word or of a larger number.
_NUMBER = re.compile(
    r"(?<![\w.,/\\+−-])(?P<number>[−-]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?)(?![\w/\\]|[.,]\d)(?P<unit> m\b(?!/))?"
)


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

    def short(self, value: float | None, digits: int = 3) -> str:
        """Return a number of any size with so many digits in all, such as "8.01e−07"; a dash for None and NaN."""
        if value is None or math.isnan(value):
            return _NOTHING
        if math.isinf(value):
            return "∞" if value > 0 else "−∞"
        return QLocale().toString(value, "g", digits).replace("-", "−").replace("E", "e")

    def sentence(self, text: str) -> str:
        """Return a sentence of a solver with its numbers as the user writes them, and metres in the user's unit.

        Not for sentences with names in them: a name keeps its dots.
        """
        return _NUMBER.sub(self._rewritten, text)

    def _rewritten(self, found: re.Match[str]) -> str:
        written = found["number"].replace(",", "").replace("−", "-")
        digits = len(written.partition(".")[2])
        value = float(written)
        return self.length(value, digits) if found["unit"] else self.number(value, digits)

    def angle(self, radians: float | None, digits: int = 1) -> str:
        """Return an angle in degrees."""
        return _NOTHING if radians is None else f"{self.number(math.degrees(radians), digits)}°"

    def _on_setting(self, name: str) -> None:
        if name in ("length_unit", "gradient_unit", "language"):
            self.changed.emit()
