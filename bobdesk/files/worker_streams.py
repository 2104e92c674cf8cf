"""The pipes of a helper process, alike on all systems."""

from __future__ import annotations

import os
import sys
from typing import IO


def worker_streams() -> tuple[IO[bytes], IO[bytes]]:
    """Return the way in and the way out for bytes as they are; what libraries print goes to standard error instead.

    The streams of `sys` are not asked: there are none in a program without a console, which has its pipes all the same.
    """
    if sys.platform == "win32":
        import msvcrt

        # Else line ends would be changed, and a byte 26 would be the end.
        for number in (0, 1):
            msvcrt.setmode(number, os.O_BINARY)
    request = os.fdopen(os.dup(0), "rb")
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return request, answer
