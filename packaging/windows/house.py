"""Where the parts of the repository lie, and what the packages of all systems share."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGING = HERE.parent
HOUSE = PACKAGING.parent

# They lie beside this folder; "packaging" itself is no package, for there is one of that name.
sys.path[1:1] = [str(PACKAGING), str(PACKAGING / "freeze"), str(PACKAGING / "notices")]
import contents  # noqa: E402
import identity  # noqa: E402
import make_notices  # noqa: E402
import python_parts  # noqa: E402
import runtime  # noqa: E402

__all__ = ["HERE", "HOUSE", "PACKAGING", "contents", "identity", "make_notices", "python_parts", "runtime"]
