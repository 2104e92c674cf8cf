"""What of the wheels and of Python's library the program for Windows does without.

Modules that nothing of ours reaches are listed in packaging/freeze, for all systems; here is the rest of the wheels.
"""

from __future__ import annotations

import re

from house import contents

# Python's own library: what serves developers, other screens than Qt's, and other systems.
_LIBRARY = re.compile(
    r"^(test|idlelib|tkinter|turtledemo|ensurepip|lib2to3|distutils|venv|pydoc_data|msilib|curses|sqlite3|site-packages"
    r"|dist-packages|lib-dynload|config-.*|__pycache__)/"
    r"|/(tests?|__pycache__)/"
    r"|(^|/)_sysconfigdata|^(turtle|antigravity|this|crypt|pty|tty|dbm/gnu|dbm/ndbm)\.py$"
)
_INTERPRETER = re.compile(r"^(api-ms-|tcl|tk|_tkinter|_msi|winsound|_sqlite3|sqlite3|vcruntime)", re.IGNORECASE)

# Of Qt only what is named here goes along.
_QT_PARTS = "Core|Gui|Widgets|Svg|Network|OpenGL|OpenGLWidgets"
_QT_KEPT = re.compile(
    r"PySide6/((__init__|_config|_git_pyside_version)\.py"
    rf"|Qt({_QT_PARTS})\.pyd|Qt6({_QT_PARTS})\.dll|pyside6\.abi3\.dll"
    r"|plugins/(platforms/q(windows|offscreen)|imageformats/q(svg|jpeg|ico|gif|tiff|webp)|iconengines/qsvgicon"
    r"|styles/qmodernwindowsstyle|tls/qschannelbackend)\.dll"
    r"|translations/qtbase_[a-z]{2}(_[A-Z]{2})?\.qm"
    r"|support/.*|licenses/.*)"
)
_UNUSED = re.compile(
    r"\.(pyi|pyx|pxd|pxi|c|cpp|cc|h|hpp|f|f90|lib|a|def|cmake|typed|obj|prl)$"
    r"|/tests?/|/testing/tests/"
    r"|^shiboken6/(msvcp|vcruntime|concrt|vcomp|vccor|vcamp)"
    r"|\.dist-info/(INSTALLER|REQUESTED)$",
    re.IGNORECASE,
)
_UNREACHED = "|".join(re.escape(name.replace(".", "/")) for name in contents.EXCLUDED_MODULES)
_EXCLUDED = re.compile(rf"({_UNREACHED})[/.]")


def wants_library(name: str) -> bool:
    """Return whether a module of Python's library, such as `json/decoder.py`, goes along."""
    return not _LIBRARY.search(name)


def wants_interpreter(name: str) -> bool:
    """Return whether a DLL or extension module of the interpreter goes along.

    The C++ runtime is left to the newer one of the Qt wheel.
    """
    return not _INTERPRETER.match(name)


def wants_file(name: str) -> bool:
    """Return whether a file of a wheel, by its path below site-packages, goes along."""
    if _UNUSED.search(name) or _EXCLUDED.match(name):
        return False
    return not name.startswith("PySide6/") or bool(_QT_KEPT.fullmatch(name))
