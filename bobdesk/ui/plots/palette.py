"""The colours of drawings: told apart by colour-blind people, and never by colour alone."""

from __future__ import annotations

STRAIGHT = "#1f77d0"
CURVE = "#e8743b"
PROFILE = "#1f77d0"
BAND = "#1f77d0"
KNOWN = "#333333"
LIMIT = "#c62f2f"
CURVE_SHADE = (232, 116, 59, 26)
BAND_SHADE = (31, 119, 208, 40)
PAPER, INK, FAINT = "#ffffff", "#222222", "#8a8f98"
