"""The packages that the program needs to run, one a line, as pyproject.toml has them: for pip.

python packaging/macos/requirements.py
"""

from __future__ import annotations

import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
EXTRAS = ("cad",)


def requirements() -> list[str]:
    """Return the requirements of the program and of the extras that travel with it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found = [*project["dependencies"]]
    for extra in EXTRAS:
        found += project["optional-dependencies"][extra]
    return found


if __name__ == "__main__":
    print("\n".join(requirements()))
