"""Names of files may be 255 signs long: where they are shown, the window must not grow with them."""

from __future__ import annotations

import re

_LONGEST_WORD = 40
_NOWHERE_TO_BREAK = re.compile(rf"[^\s\u200b]{{{_LONGEST_WORD}}}(?=[^\s\u200b])")


def shortened(name: str, length: int = _LONGEST_WORD) -> str:
    """Return a name with its middle left out where it is longer than `length`: its ending is often what tells."""
    if len(name) <= length:
        return name
    tail = (length - 1) // 2
    return name[: length - 1 - tail] + "…" + name[len(name) - tail :]


def breakable(text: str) -> str:
    """Return a text whose very long words may be wrapped anywhere."""
    return _NOWHERE_TO_BREAK.sub("\\g<0>\u200b", text)
