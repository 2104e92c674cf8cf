"""An axis whose numbers have the signs of the user's country."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

from PySide6.QtCore import QLocale


def locale_axis(side: str) -> Any:
    """Return a pyqtgraph axis for "left", "bottom" and so on; pyqtgraph is imported only now."""
    return _axis_class()(orientation=side)


@cache
def _axis_class() -> Any:
    import pyqtgraph

    class LocaleAxis(pyqtgraph.AxisItem):  # type: ignore[misc]
        def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
            decimals = max(0, math.ceil(-math.log10(spacing * scale) - 1e-6)) if spacing * scale > 0 else 0
            locale = QLocale()
            return [locale.toString(value * scale, "f", decimals).replace("-", "−") for value in values]

    return LocaleAxis
