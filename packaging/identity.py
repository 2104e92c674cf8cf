"""Names, versions and the file type, in one place for the packages of all systems.

    python packaging/identity.py                  prints NAME='value' lines for a shell: eval "$(...)"
    python packaging/identity.py VERSION          prints one value
    python packaging/identity.py fill FILE        prints a template with every @NAME@ replaced

Version and application id are the program's own, from `bobdesk/__init__.py`. Needs nothing but Python.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
import time
from email.utils import formatdate
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def _from_program(name: str) -> str:
    text = (ROOT / "bobdesk" / "__init__.py").read_text(encoding="utf-8")
    found = re.search(rf'^{name} = "([^"]+)"$', text, re.MULTILINE)
    if found is None:
        raise SystemExit(f"bobdesk/__init__.py does not say its {name}")
    return found[1]


VERSION = _from_program("__version__")
# Reverse DNS, as AppStream and macOS want it. It must stay the same for ever once a version has been published.
APP_ID = _from_program("APPLICATION_ID")

DEVELOPER_ID = APP_ID.rpartition(".")[0]

NAME = "BobDesk"  # shown to people
PROGRAM = "bobdesk"  # typed and installed
GENERIC_NAME = "Bobsleigh track reconstruction"
SUMMARY = "From the plan of a bobsleigh track to a 3D centreline"
DESCRIPTION = (
    "BobDesk turns the 2D plan of a bobsleigh, luge or skeleton track into a 3D centreline for simulation. It traces"
    " the line in a picture, finds its straights and curves, says whether length and height difference can hold"
    " together, and solves for the gradient of every segment."
)
AUTHORS = "The BobDesk authors"
COPYRIGHT = "Copyright 2026 The BobDesk authors"
LICENCE = "MIT"
KEYWORDS = "bobsleigh;luge;skeleton;track;centreline;plan;simulation;"
# Who answers for the packages, as "Name <address>"; whoever publishes them says so. ".invalid" is nobody's for ever.
MAINTAINER = os.environ.get("BOBDESK_MAINTAINER", f"{AUTHORS} <authors@bobdesk.invalid>")

# The file type of a project: a ZIP whose first entry is project.json. "x-": not registered with IANA.
FILE_SUFFIX = "bobdesk"
FILE_TYPE_NAME = "BobDesk project"
MIME_TYPE = "application/x-bobdesk"
MIME_ICON = MIME_TYPE.replace("/", "-")
FILE_FIRST_ENTRY = "project.json"
FILE_TYPE_UTI = f"{APP_ID}.project"  # macOS
FILE_TYPE_PROGID = f"{NAME}.Project.1"  # Windows
WINDOWS_EXECUTABLE = f"{NAME}.exe"  # without a console
WINDOWS_CONSOLE = f"commands/{PROGRAM}.exe"  # in a folder of its own: names differ by more than capitals there
MACOS_MINIMUM = "13.0"

# Where the program asks for newer versions, if its user wants that: an https address that answers as GitHub does for
# the latest release of a repository. Empty: packages do not offer it. What a package manager installs never does.
RELEASE_FEED = os.environ.get("BOBDESK_RELEASE_FEED", "")


def source_date_epoch() -> int:
    """Return the date of what is built, seconds: that of the commit, unless SOURCE_DATE_EPOCH says another.

    Without a repository it is the newest date of the program's own files.
    """
    said = os.environ.get("SOURCE_DATE_EPOCH")
    if said:
        return int(said)
    try:
        done = subprocess.run(
            ["git", "-C", str(ROOT), "log", "-1", "--format=%ct"], capture_output=True, text=True, check=True
        )
        return int(done.stdout)
    except (OSError, subprocess.CalledProcessError, ValueError):
        return max(int(path.stat().st_mtime) for path in (ROOT / "bobdesk").rglob("*.py"))


def values() -> dict[str, str]:
    """Return all names above in capitals with their values, and SOURCE_DATE_EPOCH, DATE and DATE_RFC."""
    found = {name: value for name, value in globals().items() if name.isupper() and isinstance(value, str)}
    date = source_date_epoch()
    day = time.gmtime(date)
    return found | {
        "SOURCE_DATE_EPOCH": str(date),
        "DATE": time.strftime("%Y-%m-%d", day),
        "DATE_RFC": formatdate(date),
    }


def fill(template: str) -> str:
    """Return a template with every @NAME@ replaced by its value.

    Raises
    ------
    KeyError
        If there is no value of a name.
    """
    known = values()
    return re.sub(r"@([A-Z_]+)@", lambda found: known[found[1]], template)


def main(arguments: list[str]) -> int:
    sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # type: ignore[union-attr]
    match arguments:
        case []:
            print("\n".join(f"{name}={shlex.quote(value)}" for name, value in sorted(values().items())))
        case ["fill", path]:
            print(fill(Path(path).read_text(encoding="utf-8")), end="")
        case [name] if name in values():
            print(values()[name])
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
