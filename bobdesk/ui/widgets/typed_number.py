"""Numbers that a person types, with the signs of the person's country or with a plain dot."""

from __future__ import annotations

import math

from PySide6.QtCore import QLocale

from bobdesk.errors import InputError

_SPACES = (" ", "\u00a0", "\u202f", "\u2009", "\t")


def typed_number(text: str) -> float:
    """Return the number in `text`.

    The country's decimal sign and the dot are both understood. Where the two cannot be told apart (1.290
    in a country that groups by dots) nothing is guessed.

    Raises
    ------
    InputError
        If it is no number, or could be two.
    """
    plain = text.strip().replace("−", "-")
    for space in _SPACES:
        plain = plain.replace(space, "")
    if not plain:
        raise InputError("a number is missing")
    locale = QLocale()
    strict = QLocale(locale)
    strict.setNumberOptions(QLocale.NumberOption.RejectGroupSeparator)
    dotted = QLocale.c()
    # Only the dot is understood besides the country's own signs: 406,123 is no 406 thousands in Germany.
    dotted.setNumberOptions(QLocale.NumberOption.RejectGroupSeparator)
    readings = {value for value, good in (strict.toDouble(plain), dotted.toDouble(plain)) if good}
    grouped, is_grouped = locale.toDouble(plain)
    if is_grouped and locale.groupSeparator() in plain:
        readings.add(grouped)
    readings = {value for value in readings if math.isfinite(value)}
    if len(readings) == 1:
        return readings.pop()
    if readings:
        ways = sorted(readings)
        shown = " or ".join(locale.toString(value, "g", 12).replace(locale.groupSeparator(), "") for value in ways)
        raise InputError(f"{text.strip()} can be read as {shown}; write it without a sign between thousands")
    strict.setNumberOptions(QLocale.NumberOption.OmitGroupSeparator)
    raise InputError(f"'{text.strip()[:40]}' is not a number; write it like {strict.toString(1234.5, 'f', 1)}")


def number_to_edit(value: float | None, digits: int = 10) -> str:
    """Return a number as it stands in a field to be edited: all that counts, the country's decimal sign, no groups."""
    if value is None or not math.isfinite(value):
        return ""
    locale = QLocale()
    locale.setNumberOptions(QLocale.NumberOption.OmitGroupSeparator)
    # Twelve places after the sign are far below what any survey means; "g" alone would give 1e-05.
    text = f"{value:.{digits}g}"
    if "e" in text:
        text = f"{value:.12f}".rstrip("0").rstrip(".")
    decimals = len(text.partition(".")[2])
    return locale.toString(float(text), "f", decimals)
