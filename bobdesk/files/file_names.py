"""Names of files that every system takes, since projects and results are handed on."""

from __future__ import annotations

import re

from bobdesk.files.atomic import is_windows_device

_NOT_IN_NAMES = re.compile(r'[<>:"/\\|?*\x00-\x1f]+')
_LONGEST = 120


def usable_name(text: str, ending: str = "") -> str:
    """Return a file's name made of any text, with an ending such as ".csv"; "" becomes "untitled".

    What Windows takes for parts of a path, for a device or for nothing (dots and spaces at the end) is replaced.
    """
    stem = _NOT_IN_NAMES.sub("-", text).strip().rstrip(". ")[:_LONGEST].rstrip(". ") or "untitled"
    return (f"_{stem}" if is_windows_device(stem + ending) else stem) + ending
