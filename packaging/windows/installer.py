"""setup.exe out of the folder that it installs."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from house import HERE, HOUSE, identity
from interpreter import STEM
from launchers import version_of_four
from PIL import Image

_SIDE_PX, _SIDE_COLOUR = (328, 628), "#e6edf5"
# What is alike lies together: a fifth less for setup.exe than by folder.
_ALIKE = (".exe", ".dll", ".pyd", ".zip", ".pyc", ".py")


def write_setup(
    tree: Path, setup: Path, icons: Path, work: Path, sign: str = "", *, version: str = identity.VERSION
) -> None:
    """Write setup.exe.

    Parameters
    ----------
    tree
        The folder that is installed.
    sign
        A command that signs the file whose path it is given last; "" leaves setup.exe and uninstaller unsigned.
    """
    listed = work / "files.nsh"
    listed.write_text("\n".join(instructions(tree)) + "\n", encoding="utf-8")
    setup.parent.mkdir(parents=True, exist_ok=True)
    names = {
        **defined(version),
        "SIZE_KB": str(sum(path.stat().st_size for path in tree.rglob("*") if path.is_file()) // 1024),
        "LICENCE_FILE": str(HOUSE / "LICENSE"),
        "SIDE_PICTURE": str(write_side_picture(icons, work)),
        "ICON": str(icons / f"{identity.PROGRAM}.ico"),
        "FILES": str(listed),
        "OUT": str(setup),
    }
    if sign:
        names["SIGN"] = sign
    command = [
        "makensis",
        "-V2",
        "-WX",
        "-INPUTCHARSET",
        "UTF8",
        *(f"-D{name}={value}" for name, value in names.items()),
    ]
    environment = {**os.environ, "SOURCE_DATE_EPOCH": str(identity.source_date_epoch())}
    if subprocess.run([*command, str(HERE / "installer.nsi")], env=environment, check=False).returncode:
        sys.exit("makensis could not make setup.exe.")


def write_side_picture(icons: Path, work: Path) -> Path:
    """Write the picture beside the last page, at twice the size of 96 dots an inch, and return its path."""
    sign = (
        Image.open(icons / f"{identity.PROGRAM}-256.png").convert("RGBA").resize((160, 160), Image.Resampling.LANCZOS)
    )
    picture = Image.new("RGB", _SIDE_PX, _SIDE_COLOUR)
    picture.paste(sign, ((_SIDE_PX[0] - sign.width) // 2, _SIDE_PX[1] // 6), sign)
    path = work / "side.bmp"
    picture.save(path)
    # The date of each file goes along.
    os.utime(path, (identity.source_date_epoch(),) * 2)
    return path


def defined(version: str) -> dict[str, str]:
    """Return the names that the installer's script takes from the place that all packages share."""
    return {
        "NAME": identity.NAME,
        "VERSION": version,
        "VERSION_DOTS": ".".join(map(str, version_of_four(version))),
        "AUTHORS": identity.AUTHORS,
        "COPYRIGHT": identity.COPYRIGHT,
        "SUMMARY": identity.SUMMARY,
        "SUFFIX": identity.FILE_SUFFIX,
        "FILE_TYPE_NAME": identity.FILE_TYPE_NAME,
        "MIME_TYPE": identity.MIME_TYPE,
        "PROGID": identity.FILE_TYPE_PROGID,
        "EXECUTABLE": identity.WINDOWS_EXECUTABLE,
        "LIBRARY_NAME": f"{STEM}.dll",
    }


def instructions(tree: Path) -> Iterator[str]:
    """Yield NSIS' instructions that install every file; "runtime" arrives as "runtime.new"."""
    files = sorted((path for path in tree.rglob("*") if path.is_file()), key=_order)
    folder = None
    for path in files:
        parts = path.relative_to(tree).parts
        if parts[0] == "runtime":
            parts = ("runtime.new", *parts[1:])
        if parts[:-1] != folder:
            folder = parts[:-1]
            yield 'SetOutPath "{}"'.format("\\".join(("$INSTDIR", *folder)))
        yield f'File "{str(path).replace("$", "$$")}"'


def _order(path: Path) -> tuple[int, str]:
    return (_ALIKE.index(path.suffix) if path.suffix in _ALIKE else len(_ALIKE), path.as_posix())
