"""The folder that setup.exe installs: interpreter, packages, the program itself."""

from __future__ import annotations

import os
import py_compile
import re
import shutil
import time
import zipfile
from collections.abc import Iterable
from pathlib import Path

from interpreter import compile_file, write_interpreter
from trim import wants_file

# One C++ runtime for all: the newest, beside python311.dll, whose folder is searched first.
_CPP_RUNTIME = ("vcruntime140.dll", "vcruntime140_1.dll", "msvcp140.dll", "msvcp140_1.dll", "msvcp140_2.dll")


def write_runtime(runtime: Path, interpreter: Path, packages: Iterable[Path], epoch: int) -> None:
    """Write the folder `runtime`: the interpreter, and site-packages with all wheels in it.

    Parameters
    ----------
    interpreter
        The wheel that brings the interpreter's DLLs.
    packages
        The program's wheel and those that it needs.
    epoch
        The date of everything, seconds since 1970.
    """
    shutil.rmtree(runtime, ignore_errors=True)
    site = runtime / "site-packages"
    site.mkdir(parents=True)
    write_interpreter(interpreter, runtime, time.gmtime(epoch)[:6])
    for wheel in packages:
        with zipfile.ZipFile(wheel) as archive:
            unpack(archive, site)
            if wheel.name.lower().startswith("pyside6"):
                for name in _CPP_RUNTIME:
                    (runtime / name).write_bytes(archive.read(f"PySide6/{name}"))
    shutil.copy(Path(__file__).with_name("launch.py"), runtime / "launch.py")
    compile_packages(runtime)


def unpack(archive: zipfile.ZipFile, site: Path) -> None:
    """Unpack what is wanted of a wheel."""
    for name in archive.namelist():
        place = re.sub(r"^[^/]+\.data/(purelib|platlib)/", "", name)
        if name.endswith("/") or ".data/" in place or not wants_file(place):
            continue
        target = site / place
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(archive.read(name))


def compile_packages(runtime: Path) -> None:
    """Compile every module: the program's folder may not be writable, and the first start is no slower."""
    for source in sorted(runtime.rglob("*.py")):
        try:
            compile_file(source, source.relative_to(runtime).as_posix())
        except py_compile.PyCompileError as error:
            # Some packages bring templates that are no Python.
            print(f"not compiled: {source.relative_to(runtime)}: {error.exc_value}")


def date_everything(folder: Path, epoch: int) -> None:
    """Give every file and folder one date."""
    for path in sorted(folder.rglob("*"), reverse=True):
        os.utime(path, (epoch, epoch))
