"""The works of others that come from PyPI, and Python itself."""

from __future__ import annotations

import json
import platform
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path, PurePath

import identity
import runtime
from part import Part, text_of

_LICENCES = identity.ROOT / "resources" / "licences"
# Distributions that bring no licence text along: whose text in resources/licences stands for it.
_WITHOUT_TEXT = {"pyside6-essentials": "LGPL-3.0", "shiboken6": "LGPL-3.0"}
# What the metadata call "LicenseRef-..." or in words.
SHORT = {
    "pyside6-essentials": "LGPL-3.0-only",
    "shiboken6": "LGPL-3.0-only",
    "shapely": "BSD-3-Clause; GEOS: LGPL-2.1-or-later",
    "resvg-py": "MIT; resvg: Apache-2.0 OR MIT",
    "pyinstaller": "GPL-2.0-or-later WITH Bootloader-exception",
}
_WORDS = ("licen", "copying", "notice")


def python_parts() -> Iterator[Part]:
    """Yield Python, each package that the program needs, by name, and PyInstaller, whose start program is in it."""
    yield python(platform.python_version())
    told = _told_by_pip_licenses()
    for name in (*runtime.runtime_distributions(), "pyinstaller"):
        of = told[name]
        licence, address = SHORT.get(name, of["License"]), "" if of["URL"] == "UNKNOWN" else of["URL"]
        yield Part(
            of["Name"],
            of["Version"],
            licence,
            address,
            tuple(texts_of(metadata.distribution(name))),
            packaged=name != "pyinstaller",
        )


def python(version: str) -> Part:
    """Return Python itself."""
    text = text_of(Path(sysconfig.get_path("stdlib"), "LICENSE.txt"))
    return Part("Python", version, "PSF-2.0", "https://www.python.org", (("LICENSE.txt", text),))


def _told_by_pip_licenses() -> dict[str, dict[str, str]]:
    call = [sys.executable, "-m", "piplicenses", "--from=mixed", "--with-urls", "--with-system", "--format=json"]
    done = subprocess.run(call, check=True, capture_output=True, text=True, encoding="utf-8")
    return {runtime.normalised(row["Name"]): row for row in json.loads(done.stdout)}


def texts_of(distribution: metadata.Distribution) -> Iterator[tuple[str, str]]:
    """Yield name and text of each licence file that a package brings, or what stands for them."""
    files, name = distribution.files or (), runtime.normalised(distribution.metadata["Name"])
    wanted = sorted((path for path in files if _is_licence(path) and path.locate().exists()), key=str)
    for path in wanted:
        shown = path.as_posix().split(".dist-info/")[-1].removeprefix("licenses/")
        yield shown, text_of(Path(path.locate()))
    for path in files:
        if "sboms" in path.parts and path.suffix == ".json":
            built_in = _components(Path(path.locate()))
            if built_in:
                yield f"what was built into it, by {path.name}", built_in
    if not wanted and name in _WITHOUT_TEXT:
        path = _LICENCES / f"{_WITHOUT_TEXT[name]}.txt"
        yield path.name, text_of(path)


def _components(bill: Path) -> str:
    """Return a line for each component in a wheel's own bill of materials."""
    lines = []
    for component in json.loads(bill.read_text(encoding="utf-8")).get("components", []):
        said = [of.get("expression") or of.get("license", {}).get("id", "") for of in component.get("licenses", [])]
        lines.append(" ".join([component["name"], component.get("version", ""), *said]).strip())
    return "\n".join(sorted(lines))


def _is_licence(path: PurePath) -> bool:
    if path.suffix.lower() not in ("", ".txt", ".md", ".rst", ".ijg", ".external"):
        return False
    in_their_folder = any(part.endswith(".dist-info") for part in path.parts) and "licenses" in path.parts
    return in_their_folder or any(word in path.name.lower() for word in _WORDS)
