"""Where the parts of the repository lie, and the names that all packages share."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGING = HERE.parent
HOUSE = PACKAGING.parent

sys.path.insert(0, str(PACKAGING))
import identity  # noqa: E402 - it lies beside this folder, which is no package

__all__ = ["HERE", "HOUSE", "PACKAGING", "identity"]
