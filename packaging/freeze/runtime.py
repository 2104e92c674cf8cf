"""Which installed distributions the program needs at run time; all others stay out of the packages.

    python packaging/freeze/runtime.py       prints name and version of each

The environment that packages are built in also holds the tests' and the build's own tools. What travels is decided
here and not by what a library happens to find beside it, so that two environments give the same packages.
"""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parent.parent.parent
# Reading DXF drawings is worth its 12 MB to whoever has a track as a CAD drawing; clusters are for those who have pip.
EXTRAS = ("cad",)
# Imported by none of our ways, though required: fonts that ezdxf draws text with, and the time zones of Windows.
NOT_USED = frozenset({"tzdata"})


def normalised(name: str) -> str:
    """Return the name of a distribution as PyPI compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()


@cache
def runtime_distributions() -> tuple[str, ...]:
    """Return the normalised names of all distributions that the program needs, without its own, sorted.

    Raises
    ------
    importlib.metadata.PackageNotFoundError
        If one of them is not installed.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = [*project["dependencies"]]
    for extra in EXTRAS:
        wanted += project["optional-dependencies"][extra]
    found: dict[str, frozenset[str]] = {}
    pending = [(Requirement(text), "") for text in wanted]
    while pending:
        requirement, extra = pending.pop()
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": extra}):
            continue
        name = normalised(requirement.name)
        extras = frozenset(requirement.extras)
        if name in NOT_USED or (name in found and extras <= found[name]):
            continue
        found[name] = found.get(name, frozenset()) | extras
        for text in metadata.requires(name) or ():
            pending += [(Requirement(text), of) for of in (*extras, "")]
    return tuple(sorted(found))


def foreign_modules() -> tuple[str, ...]:
    """Return the top-level modules of all installed distributions that the program does not need, sorted."""
    wanted = {*runtime_distributions(), "bobdesk"}
    return tuple(
        sorted(
            module
            for module, owners in metadata.packages_distributions().items()
            if module.isidentifier() and not wanted & {normalised(owner) for owner in owners}
        )
    )


if __name__ == "__main__":
    for distribution in runtime_distributions():
        print(distribution, metadata.version(distribution))
