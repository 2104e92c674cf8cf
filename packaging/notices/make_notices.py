"""Third-party notices, licence texts and a bill of materials: `python packaging/notices/make_notices.py OUT [TREE]`.

Leaves in the folder OUT:

    THIRD-PARTY-NOTICES.txt   every part that is not BobDesk's, with version, licence, address and texts
    LGPL-3.0.txt, GPL-3.0.txt the licences of Qt and PySide6, whose wheels bring none along
    LICENSE.txt               BobDesk's own
    bobdesk.cdx.json          the same parts for programs, as CycloneDX

Listed are the packages that the program needs at run time (packaging/freeze/runtime.py), whatever else is installed,
and what the frozen program takes from elsewhere: Python, PyInstaller's start program, and, where TREE names a program
frozen on Debian or a relative, the system's libraries in it.
"""

from __future__ import annotations

import platform
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "freeze")]
import bill  # noqa: E402
import identity  # noqa: E402
import python_parts  # noqa: E402
import system_parts  # noqa: E402
from part import Part  # noqa: E402

_RULE = "=" * 100
_HEAD = f"""{identity.NAME} {identity.VERSION}: notices of third parties

{identity.NAME} itself is under the MIT licence ({identity.COPYRIGHT}). It comes with the works below, each under
its own licence.

Qt and PySide6. {identity.NAME} uses the Qt framework, PySide6 and shiboken6 under the GNU Lesser General Public
License, version 3 (LGPL-3.0.txt and GPL-3.0.txt lie beside this file). They are unchanged, and libraries of their own:
in the program's folder, below PySide6 and shiboken6. You may replace them by other versions of the same interface, and
you may take them apart to find faults in what you changed. Their source is at https://code.qt.io, under the version in
the table below; Qt is Copyright The Qt Company Ltd. and other contributors.
GEOS in shapely.libs is under the GNU Lesser General Public License, version 2.1, on the same terms.

"""


def parts(tree: Path | None) -> list[Part]:
    """Return all works of others in the program, and in `tree` if there is one."""
    return [*python_parts.python_parts(), *(system_parts.system_parts(tree) if tree is not None else ())]


def notices(found: list[Part]) -> str:
    """Return the text for people."""
    width = max(len(part.name) for part in found) + 2
    across = max(len(part.version) for part in found) + 2
    lines = [_HEAD, f"{'Work':{width}}{'Version':{across}}Licence", ""]
    lines += [f"{part.name:{width}}{part.version:{across}}{part.licence}" for part in found]
    for part in found:
        lines += ["", "", _RULE, f"{part.name} {part.version}", part.licence, *([part.address] if part.address else [])]
        for name, text in part.texts:
            lines += [_RULE, f"{part.name}: {name}", "", text.strip().replace("\r\n", "\n")]
    return "\n".join(lines) + "\n"


def make(folder: Path, tree: Path | None) -> None:
    """Write all files into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    found = parts(tree)
    without = [part.name for part in found if not part.texts]
    if without:
        raise SystemExit(f"there is no licence text of {', '.join(without)}")
    (folder / "THIRD-PARTY-NOTICES.txt").write_text(notices(found), encoding="utf-8", newline="\n")
    licences = identity.ROOT / "resources" / "licences"
    for name in ("LGPL-3.0.txt", "GPL-3.0.txt"):
        shutil.copyfile(licences / name, folder / name)
    shutil.copyfile(identity.ROOT / "LICENSE", folder / "LICENSE.txt")
    bill.write(folder / "bobdesk.cdx.json", [part for part in found if not part.packaged])


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    if len(sys.argv) == 3 and platform.system() != "Linux":
        sys.exit("what a program took from the system can be told on Linux only")
    make(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) == 3 else None)
