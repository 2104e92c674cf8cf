"""What the decimal places of a figure say of how exactly it is meant."""

from __future__ import annotations

from decimal import Decimal


def half_unit(figure: float) -> float:
    """Return half a unit of the last decimal place that a figure has: 0.05 for 149.3, 0.5 for 1278."""
    exponent = Decimal(repr(float(figure))).normalize().as_tuple().exponent
    return 0.5 * 10.0 ** min(int(exponent), 0)
