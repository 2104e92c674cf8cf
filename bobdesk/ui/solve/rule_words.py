"""Design rules and findings in the user's words and units."""

from __future__ import annotations

from PySide6.QtCore import QObject

from bobdesk.errors import InputError
from bobdesk.track.design_rules import Finding, Quantity, Rule
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number

_MOST_STRETCHES = 6


class RuleWords(QObject):
    """Limits are shown in the unit of the user where there is one: metres or feet, per cent or degrees."""

    def __init__(self, quantities: Quantities, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._unit = quantities

    def quantity(self, quantity: Quantity) -> str:
        """Return what a quantity is called."""
        names: dict[Quantity, str] = {
            "length": self.tr("Length (3D)"),
            "mean gradient": self.tr("Mean gradient"),
            "gradient": self.tr("Gradient"),
            "speed": self.tr("Speed"),
            "acceleration": self.tr("Load"),
            "curves": self.tr("Number of curves"),
        }
        return names[quantity]

    def unit(self, rule: Rule) -> str:
        """Return the sign of the unit in which a rule is shown."""
        shown = {"m": self._unit.length_unit, "gradient": self._unit.gradient_unit, "curves": self.tr("curves")}
        return shown.get(rule.unit, rule.unit)

    def value(self, rule: Rule, value: float | None) -> str:
        """Return a value of a rule's quantity without its unit; "" for None."""
        if value is None:
            return ""
        digits = {"m": 1, "gradient": 2, "km/h": 1, "g": 2, "curves": 0}[rule.unit]
        return self._unit.number(self._shown(rule, value), digits)

    def limit(self, rule: Rule, value: float | None) -> str:
        """Return a limit with as many decimal places as it is meant with, without its unit; "" for None."""
        if value is None:
            return ""
        shown = f"{self._shown(rule, value):.6g}"
        return self._unit.number(float(shown), len(shown.partition(".")[2]) if "e" not in shown else 0)

    def to_edit(self, rule: Rule, value: float | None) -> str:
        """Return a limit as it stands in a field."""
        return "" if value is None else number_to_edit(self._shown(rule, value), 8)

    def typed(self, rule: Rule, text: str) -> float | None:
        """Return the limit that was typed; nothing is no limit.

        Raises
        ------
        InputError
            If it is no number.
        """
        if not text.strip():
            return None
        number = typed_number(text)
        if rule.unit == "m":
            return number / self._unit.length_factor
        if rule.unit == "gradient":
            return float(f"{self._unit.meant_gradient(number):.12g}")
        return number

    def station(self, station: float | None) -> str:
        """Return a station without its unit; "" for None."""
        return "" if station is None else self._unit.length(station, 0, unit=False)

    def station_to_edit(self, station: float | None) -> str:
        """Return a station as it stands in a field."""
        return "" if station is None else number_to_edit(station * self._unit.length_factor)

    def typed_station(self, text: str, field: str) -> float | None:
        """Return the station that was typed; an end may be left out.

        Raises
        ------
        InputError
            If it is no number.
        """
        if not text.strip():
            if field == "end":
                return None
            raise InputError(self.tr("the stretch of a rule needs a beginning"))
        return typed_number(text) / self._unit.length_factor

    def sentence(self, found: Finding) -> str:
        """Return a finding in a sentence, with its source."""
        rule = found.rule
        if found.value is None:
            said = self.tr("Not judged: {why}.").format(why=found.why)
        else:
            value = f"{self.value(rule, found.value)} {self.unit(rule)}"
            said = self.tr("Kept: {value}.") if found.verdict == "kept" else self.tr("Broken: {value}")
            said = said.format(value=value)
            if found.verdict == "broken":
                said += " " + self.stretches(found) + "."
        return f"{said} {self.said_of(rule)}"

    def limits(self, rule: Rule) -> str:
        """Return what a rule asks for, with its unit."""
        low, high = rule.lowest, rule.highest
        if low is None and high is None:
            return self.tr("no limit yet")
        if low == high:
            return f"{self.limit(rule, low)} {self.unit(rule)}"
        asked = [f"≥ {self.limit(rule, low)}"] if low is not None else []
        asked += [f"≤ {self.limit(rule, high)}"] if high is not None else []
        return f"{', '.join(asked)} {self.unit(rule)}"

    def stretches(self, found: Finding) -> str:
        """Return where a rule is broken."""
        shown = [
            f"{self._unit.length(start, 0, unit=False)}–{self._unit.length(end, 0)}"
            for start, end in found.stretches[:_MOST_STRETCHES]
        ]
        more = len(found.stretches) - len(shown)
        text = self.tr("at {places}").format(places=", ".join(shown))
        return text + (" " + self.tr("and {count} more").format(count=more) if more else "")

    def said_of(self, rule: Rule) -> str:
        """Return where a rule comes from."""
        return self.tr("Source: {source}.").format(source=rule.source.rstrip(".") or self.tr("none given"))

    def _shown(self, rule: Rule, value: float) -> float:
        if rule.unit == "m":
            return value * self._unit.length_factor
        return self._unit.shown_gradient(value) if rule.unit == "gradient" else value
