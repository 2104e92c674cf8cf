"""What can be seen of the folder that setup.exe installs without running anything."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

from machine import TrialError, say

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from house import HOUSE
from pe import PortableExecutable, executables

# What every Windows 10 of version 1809 or newer has, and Qt, Python and the libraries ask for.
_WINDOWS = re.compile(
    r"(api-ms-win-|ext-ms-win-).*|"
    r"(advapi32|authz|bcrypt|bcryptprimitives|combase|comctl32|comdlg32|crypt32|d2d1|d3d9|d3d11|d3d12|dnsapi|dwmapi|dwrite"
    r"|dxgi|gdi32|icuuc|imm32|iphlpapi|kernel32|mpr|msvcrt|ncrypt|netapi32|normaliz|ntdll|ole32|oleaut32|powrprof|psapi"
    r"|rpcrt4|secur32|setupapi|shcore|shell32|shlwapi|ucrtbase|uiautomationcore|user32|userenv|usp10|uxtheme|version"
    r"|winhttp|winmm|ws2_32|wtsapi32)\.dll|winspool\.drv"
)
# Made by the Python Software Foundation; the C++ runtime beside them is Microsoft's and comes with Qt.
_PYTHON = re.compile(r"(python311|libcrypto-3|libssl-3|libffi-8)\.dll|\w+\.pyd")


def look_into(tree: Path) -> None:
    """Look for libraries that are missing, signatures that do not hold, and traces of the machine that built it.

    Raises
    ------
    TrialError
        If there is one.
    """
    _libraries(tree)
    _signatures(tree / "runtime")
    _traces(tree)


def _libraries(tree: Path) -> None:
    there = {path.name.lower() for path in executables(tree)}
    missing: dict[str, str] = {}
    for path in executables(tree):
        for library in PortableExecutable(path).imports():
            if library not in there and not _WINDOWS.fullmatch(library):
                missing[library] = path.name
    if missing:
        raise TrialError(f"missing: {', '.join(f'{library} (for {asks})' for library, asks in missing.items())}")
    say(f"{len(list(executables(tree)))} programs and libraries: all that they ask for is there or Windows' own")


def _signatures(runtime: Path) -> None:
    count = 0
    for path in sorted(runtime.iterdir()):
        if not _PYTHON.fullmatch(path.name):
            continue
        command = ["osslsigncode", "verify", "-ignore-crl", "-in", str(path)]
        said = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False).stdout
        if "Signature verification: ok" not in said or "/CN=Python Software Foundation" not in said:
            raise TrialError(f"{path.name} is not signed by the Python Software Foundation")
        count += 1
    if count < 15:
        raise TrialError(f"only {count} files of Python are there")
    say(f"{count} files of Python: signed by the Python Software Foundation, signatures and time stamps verified")


def _traces(tree: Path) -> None:
    words = [str(place).encode() for place in {HOUSE, Path(sys.prefix), Path(sys.base_prefix), Path.home()}]
    common = {b"/", b"/usr", b"/usr/local", b"/root"}
    for path in sorted(tree.rglob("*")):
        data = path.read_bytes() if path.is_file() else b""
        if any(word in data for word in words if word not in common):
            raise TrialError(f"{path.relative_to(tree)} tells where it was made")
