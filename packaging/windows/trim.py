"""What of the wheels and of Python's library the program for Windows does without."""

from __future__ import annotations

import re

# Python's own library: what serves developers, other screens than Qt's, and other systems.
_LIBRARY = re.compile(
    r"^(test|idlelib|tkinter|turtledemo|ensurepip|lib2to3|distutils|venv|pydoc_data|msilib|curses|site-packages"
    r"|dist-packages|lib-dynload|config-.*|__pycache__)/"
    r"|/(tests?|__pycache__)/"
    r"|(^|/)_sysconfigdata|^(turtle|antigravity|this|crypt|pty|tty|sqlite3/.*|dbm/gnu|dbm/ndbm)\.py$"
)

_INTERPRETER = re.compile(r"^(api-ms-|tcl|tk|_tkinter|_msi|winsound|_sqlite3|sqlite3|vcruntime)", re.IGNORECASE)

_QT_PARTS = "Core|Gui|Widgets|Svg|Network|PrintSupport"
_QT_KEPT = re.compile(
    rf"PySide6/(__init__|_config|_git_pyside_version)\.py$"
    rf"|PySide6/support/"
    rf"|PySide6/Qt({_QT_PARTS}|OpenGL)\.pyd$"
    rf"|PySide6/Qt6({_QT_PARTS}|OpenGL)\.dll$"
    r"|PySide6/pyside6\.abi3\.dll$"
    r"|PySide6/plugins/(platforms/q(windows|offscreen|minimal)|imageformats/q(svg|jpeg|ico|gif|tiff|webp)|iconengines/qsvg"
    r"|styles/|tls/qschannel|networkinformation/)"
    r"|PySide6/translations/qtbase_(ar|ca|cs|da|de|en|es|fi|fr|he|hr|hu|it|ja|ko|lv|nl|nn|pl|pt_BR|ru|sk|sv|tr|uk|zh_CN|zh_TW)\.qm$"
)

_PACKAGES = re.compile(
    r"\.(pyi|pyx|pxd|pxi|c|cpp|cc|h|hpp|f|f90|lib|a|def|cmake|typed|obj|prl)$"
    r"|/tests?/|/testing/tests/"
    r"|^pyqtgraph/(examples|opengl|jupyter)/"
    r"|^(PySide6|shiboken6)/(typesystems|glue|include|doc|docs|scripts|metatypes|qml|lib|resources)/"
    r"|^shiboken6/(msvcp|vcruntime|concrt|vcomp|vccor|vcamp)"
    r"|^numpy/(_core/include|random/lib)/"
    r"|^PIL/_(avif|imagingtk)\.[^/]*pyd$"
    r"|\.dist-info/(RECORD|INSTALLER|REQUESTED)$",
    re.IGNORECASE,
)


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
    if _PACKAGES.search(name):
        return False
    return not name.startswith("PySide6/") or bool(_QT_KEPT.match(name))
