"""What the program runs on: versions, system, folders. Nothing here needs Qt."""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import os
import platform
import sys
import tempfile
from pathlib import Path

import platformdirs

from bobdesk.files.new_file import new_file
from bobdesk.ui.resources import resource

# Modules and, where a module does not tell its version itself, their distributions.
_LIBRARIES = {
    "numpy": "numpy",
    "scipy": "scipy",
    "shapely": "shapely",
    "PIL": "Pillow",
    "pypdfium2": "pypdfium2",
    "resvg_py": "resvg_py",
    "msgspec": "msgspec",
    "defusedxml": "defusedxml",
    "platformdirs": "platformdirs",
    "click": "click",
    "pyqtgraph": "pyqtgraph",
}
# Not loaded here: ezdxf would look for fonts, and leave what it found in the user's home.
_OPTIONAL = ("ezdxf", "distributed")


def versions() -> dict[str, str | None]:
    """Return the versions of Python and of every library, which is loaded; of extras too, None if one is missing.

    Raises
    ------
    ImportError
        If a library is missing or cannot be loaded.
    """
    found: dict[str, str | None] = {"Python": platform.python_version()}
    for module, distribution in _LIBRARIES.items():
        found[distribution] = _version(module, distribution)
    for name in _OPTIONAL:
        found[name] = None if importlib.util.find_spec(name) is None else _told(name)
    return found


def system() -> dict[str, object]:
    """Return what is known of the system and of this process."""
    return {
        "platform": platform.platform(),
        "system": platform.system(),
        "release": platform.release(),
        "machine": platform.machine(),
        "processors": os.cpu_count(),
        "frozen": bool(getattr(sys, "frozen", False)),
        "executable": sys.executable,
        "arguments": sys.argv,
        "file_system_encoding": sys.getfilesystemencoding(),
        "has_standard_output": sys.stdout is not None,
        "qt_platform_asked": os.environ.get("QT_QPA_PLATFORM"),
    }


def folders(settings: Path, data: Path) -> dict[str, dict[str, object]]:
    """Return the folders that matter, and whether a file can be made in each, which leaves nothing behind.

    Parameters
    ----------
    settings, data
        The user's own; one that does not exist yet is not made: its nearest parent is tried.
    """
    places = {
        "program": resource().parent,
        "settings": settings,
        "data": data,
        "documents": Path(platformdirs.user_documents_dir()),
        "temporary": Path(tempfile.gettempdir()),
        "working": Path.cwd(),
    }
    return {name: _folder(place) for name, place in places.items()}


def _folder(place: Path) -> dict[str, object]:
    there = place
    while not there.is_dir() and there != there.parent:
        there = there.parent
    try:
        handle, path = new_file(there, prefix=".bobdesk-", suffix=".try")
        os.close(handle)
        path.unlink()
        writable = True
    except OSError:
        writable = False
    return {"path": str(place), "exists": place.is_dir(), "writable": writable}


def _version(module: str, distribution: str) -> str:
    loaded = importlib.import_module(module)
    told = getattr(loaded, "__version__", None)
    if isinstance(told, str):
        return told
    return _told(distribution)


def _told(distribution: str) -> str:
    try:
        return importlib.metadata.version(distribution)
    except importlib.metadata.PackageNotFoundError:
        return "unknown"  # a frozen program has the code but not always what tells its version
