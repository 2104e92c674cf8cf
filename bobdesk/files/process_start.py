"""How long a helper process may take to start, before it has read anything."""

from __future__ import annotations

import sys

# Virus scanners of Windows look into every library at a program's first start, and a process starts as slowly then.
START_S = 20.0 if sys.platform == "win32" else 0.0
