"""What travels in the frozen program, and what does not."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

# Beside the modules of other distributions (see runtime.py): parts that nothing of ours reaches. pydoc, numpy.f2py and
# PySide6.QtOpenGL look like candidates and are not: scipy imports the first two, pyqtgraph the third.
EXCLUDED_MODULES = [
    "tkinter",
    "_tkinter",
    "turtle",
    "turtledemo",
    "idlelib",
    "lib2to3",
    "ensurepip",
    "venv",
    "test",
    "curses",
    "_curses",
    "readline",
    "PySide6.QtConcurrent",
    "PySide6.QtDBus",
    "PySide6.QtDesigner",
    "PySide6.QtHelp",
    "PySide6.QtPrintSupport",
    "PySide6.QtQml",
    "PySide6.QtQuick",
    "PySide6.QtQuickControls2",
    "PySide6.QtQuickTest",
    "PySide6.QtQuickWidgets",
    "PySide6.QtSql",
    "PySide6.QtTest",
    "PySide6.QtUiTools",
    "PySide6.QtXml",
    "pyqtgraph.examples",
    "pyqtgraph.opengl",
    "pyqtgraph.jupyter",
    "pyqtgraph.console",
    "scipy.cluster",
    "scipy.datasets",
    "scipy.differentiate",
    "scipy.fftpack",
    "scipy.io",
    "scipy.odr",
    "scipy.signal",
    "scipy.stats",
    "fontTools.cu2qu",
    "fontTools.designspaceLib",
    "fontTools.feaLib",
    "fontTools.merge",
    "fontTools.otlLib",
    "fontTools.qu2cu",
    "fontTools.subset",
    "fontTools.ufoLib",
    "fontTools.varLib",
    "PIL.ImageTk",
    "PIL._avif",
    "PIL._imagingtk",
    "numpy.conftest",
    "scipy.conftest",
    "shapely.conftest",
]

# Linux: what every desktop has and what must fit its drivers and its C++ runtime (X11, GL, fontconfig, glib, Wayland)
# comes from there, as the list of packages in packaging/linux says.
_SYSTEM_LIBRARIES = re.compile(
    r"""^(
    libstdc\+\+|libgcc_s|libX11|libX11-xcb|libXau|libXdmcp|libXext|libXrender|libbsd|libmd|
    libxcb\.so|libxcb-(dri\d|glx|present|randr|render|shape|shm|sync|xfixes|xkb)\.so|libxkbcommon|
    libfontconfig|libfreetype|libexpat|libharfbuzz|libgraphite2|libpng16|libbrotli|
    libGL|libEGL|libOpenGL|libdrm|libgbm|libwayland|
    libglib-2|libgobject-2|libgio-2|libgmodule-2|libgthread-2|libmount|libblkid|libselinux|libpcre2|
    libdbus-1|libsystemd|libgcrypt|libgpg-error|libcap|liblz4|libzstd|
    libgssapi_krb5|libkrb5|libk5crypto|libkeyutils|libcom_err|
    libgtk-3|libgdk|libatk|libatspi|libpango|libcairo|libepoxy|libpixman|libfribidi|libthai|libdatrie|libjpeg\.so|
    libX(cursor|damage|composite|fixes|i|inerama|randr)\.so
    )""",
    re.VERBOSE,
)
# Qt's plug-ins for television sets, databases, and on-screen keyboards, and the libraries that only these use.
_UNUSED_QT = re.compile(
    r"""
    /plugins/(egldeviceintegrations|networkinformation|generic|sqldrivers|qmltooling|designer|printsupport
      |platforminputcontexts/.*virtual
      |platforms/(lib)?q(eglfs|linuxfb|vnc|vkkhrdisplay|minimalegl|minimal|direct2d)
      |platformthemes/libqgtk3|imageformats/(lib)?qpdf|wayland-graphics-integration-server)
    |(lib)?Qt6?(Qml|Quick|VirtualKeyboard|Pdf|Sql|Egl|Test|Designer|Help|PrintSupport|ShaderTools|Labs)[A-Za-z]*[.\d]
    |(opengl32sw|d3dcompiler_47)\.dll
    """,
    re.VERBOSE | re.IGNORECASE,
)
_SOURCES_AND_TESTS = re.compile(r"/(tests?|testing/tests)/|\.(pyi|pyx|pxd|pxi|c|h|cpp|hpp|f|f90|a|lib)$")
# Texts of Qt's own dialogs; those of the program are in resources/translations.
_QT_TEXTS = re.compile(r"/translations/qtbase_[a-z]{2}(_[A-Z]{2})?\.qm$")
_NOT_SHIPPED = ("pictures",)  # of the README


def travels(destination: str) -> bool:
    """Return whether a file that PyInstaller found is to be in the frozen program.

    Parameters
    ----------
    destination
        Where it would lie, relative to the program's folder.
    """
    path = destination.replace("\\", "/")
    if "/translations/" in path and path.startswith("PySide6/"):
        return _QT_TEXTS.search(path) is not None
    if _UNUSED_QT.search(path) or _SOURCES_AND_TESTS.search(path):
        return False
    # A library in a wheel's own folder has a name of its own (libzstd-40ad5e7e.so) and is meant for that wheel.
    return not (sys.platform == "linux" and "/" not in path and _SYSTEM_LIBRARIES.match(path))


def resource_files() -> list[tuple[str, str]]:
    """Return source and target folder of every file of resources/ that the program comes with."""
    found = []
    for path in sorted((ROOT / "resources").rglob("*")):
        inside = path.relative_to(ROOT)
        hidden = any(part.startswith(".") or part == "__pycache__" for part in inside.parts)
        if path.is_file() and not hidden and inside.parts[1] not in _NOT_SHIPPED:
            found.append((str(path), str(inside.parent)))
    return found
