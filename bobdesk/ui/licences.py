"""The versions and licences of all that the program consists of."""

from __future__ import annotations

import platform
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path, PurePath

from PySide6.QtCore import qVersion

from bobdesk import __version__
from bobdesk.ui.resources import resource
from bobdesk.ui.samples import samples

# distribution, what it is called, its licence in short, texts in resources/licences where it has none of its own
_LIBRARIES: tuple[tuple[str, str, str, tuple[str, ...]], ...] = (
    ("PySide6-Essentials", "Qt and PySide6", "LGPL-3.0", ("LGPL-3.0", "GPL-3.0")),
    ("shiboken6", "shiboken6", "LGPL-3.0", ("LGPL-3.0",)),
    ("numpy", "NumPy", "BSD-3-Clause", ("BSD-3-Clause",)),
    ("scipy", "SciPy", "BSD-3-Clause", ("BSD-3-Clause",)),
    ("shapely", "Shapely, with GEOS", "BSD-3-Clause, LGPL-2.1", ("BSD-3-Clause",)),
    ("pyqtgraph", "PyQtGraph", "MIT", ()),
    ("Pillow", "Pillow", "MIT-CMU", ()),
    ("pypdfium2", "pypdfium2, with PDFium", "BSD-3-Clause or Apache-2.0", ("BSD-3-Clause", "Apache-2.0")),
    ("click", "Click", "BSD-3-Clause", ("BSD-3-Clause",)),
    ("resvg-py", "resvg-py, with resvg", "MIT or Apache-2.0", ()),
    ("defusedxml", "defusedxml", "PSF-2.0", ()),
    ("msgspec", "msgspec", "BSD-3-Clause", ("BSD-3-Clause",)),
    ("platformdirs", "platformdirs", "MIT", ()),
    ("ezdxf", "ezdxf", "MIT", ()),
    ("distributed", "Dask distributed", "BSD-3-Clause", ("BSD-3-Clause",)),
)
_QT_NOTICE = (
    "BobDesk uses the Qt framework and PySide6 under the GNU Lesser General Public License, version 3. They are used"
    " unchanged, as libraries of their own that you may replace by other versions. Their source is at"
    " https://code.qt.io.\nQt: Copyright The Qt Company Ltd. and other contributors.\n\n"
)
_WORDS = ("licen", "copying", "notice")
_LONGEST_TEXT = 400_000


@dataclass(frozen=True)
class Component:
    """A part of the program that has a licence.

    Attributes
    ----------
    name
        For a person.
    version
        "" for what has none.
    licence
        In short.
    text
        All that the licence says.
    """

    name: str
    version: str
    licence: str
    text: str


def components() -> tuple[Component, ...]:
    """Return BobDesk, the libraries that are installed, and the samples."""
    own = Component("BobDesk", __version__, "MIT", _bundled("BobDesk"))
    libraries = [found for row in _LIBRARIES if (found := _library(*row)) is not None]
    with_files = [
        Component(sample.title, "", sample.licence or "free to use", _texts(sample.folder)) for sample in samples()
    ]
    return (own, *libraries, *with_files)


def versions() -> str:
    """Return one line for each version that a report of a fault should name."""
    lines = [
        f"BobDesk {__version__}",
        f"Python {platform.python_version()} ({platform.python_implementation()}, {platform.machine()})",
        f"Qt {qVersion()}",
        f"System {platform.system()} {platform.release()}",
    ]
    for distribution, _name, _licence, _texts_of in _LIBRARIES:
        version = _version(distribution)
        if version:
            lines.append(f"{distribution} {version}")
    return "\n".join(lines)


def _library(distribution: str, name: str, licence: str, bundled: tuple[str, ...]) -> Component | None:
    version = _version(distribution)
    if not version:
        return None
    text = _own_texts(distribution) or "\n\n".join(_bundled(one) for one in bundled)
    if distribution == "PySide6-Essentials":
        text = _QT_NOTICE + text
    return Component(name, version, licence, text)


def _version(distribution: str) -> str:
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return ""


def _own_texts(distribution: str) -> str:
    found = metadata.files(distribution) or []
    wanted = sorted(
        (path for path in found if path.suffix.lower() not in (".py", ".pyc", ".pyi") and _is_licence(path)),
        key=lambda path: (len(path.parts), str(path)),
    )
    parts = []
    for path in wanted:
        try:
            parts.append(f"— {path.name} —\n\n{path.read_text(encoding='utf-8').strip()}")
        except (OSError, UnicodeDecodeError):
            continue
    return "\n\n\n".join(parts)[:_LONGEST_TEXT]


def _is_licence(path: PurePath) -> bool:
    in_their_folder = any(part.endswith(".dist-info") for part in path.parts) and "licenses" in path.parts
    return in_their_folder or any(word in path.name.lower() for word in _WORDS)


def _bundled(name: str) -> str:
    return _read((resource("licences", f"{name}.txt"),))


def _texts(folder: Path) -> str:
    return _read((folder / "SOURCE.md", folder / "LICENSE.txt"))


def _read(paths: Iterable[Path]) -> str:
    parts = []
    for path in paths:
        try:
            parts.append(path.read_text(encoding="utf-8").strip())
        except (OSError, UnicodeDecodeError):
            continue
    return "\n\n".join(parts)
