"""Where the program's own files lie: icons, translations, samples."""

from __future__ import annotations

import sys
from pathlib import Path


def resource(*parts: str) -> Path:
    """Return a path below resources/, in a checkout, an installed package or the frozen program."""
    frozen = getattr(sys, "_MEIPASS", None)
    package = Path(__file__).resolve().parent.parent
    places = [Path(frozen) / "resources"] if isinstance(frozen, str) else []
    places += [package / "resources", package.parent / "resources"]
    for place in places:
        if place.is_dir():
            return place.joinpath(*parts)
    return places[-1].joinpath(*parts)
