"""Make setup.exe for Windows, on Linux: `make windows`, or python packaging/windows/build.py [OUT [WORK]].

Leaves BobDesk-VERSION-setup.exe in OUT (dist), and beside it a list of all downloads with their checksums. WORK
(build/windows) keeps the downloads and the folder that is installed. The environment variable SIGN is a command that
signs the file whose path it is given as its last word.
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from house import HERE, HOUSE, PACKAGING, identity
from installer import write_setup
from interpreter import GCC
from launchers import WINDRES, write_launchers
from notices import write_notices
from tree import date_everything, write_runtime
from wheels import INTERPRETER, PYTHON, download, download_interpreter, sha256

LARGEST_SETUP_MB = 70


def main() -> None:
    out = Path(sys.argv[1] if len(sys.argv) > 1 else "dist").resolve()
    work = Path(sys.argv[2] if len(sys.argv) > 2 else "build/windows").resolve()
    refuse_without_tools()
    sign = os.environ.get("SIGN", "")
    tree, sums = put_together(work, sign)

    print("Packing setup.exe (two to ten minutes) ...", flush=True)
    setup = out / f"{identity.NAME}-{identity.VERSION}-setup.exe"
    write_setup(tree, setup, work / "icons", work, sign)
    (out / f"{setup.stem}-downloads.sha256").write_text("\n".join(sums) + "\n", encoding="ascii")
    size = setup.stat().st_size / 1e6
    print(f"{setup} ({size:.1f} MB{'' if sign else ', not signed'})\nsha256 {sha256(setup)}")
    if size > LARGEST_SETUP_MB:
        sys.exit(f"setup.exe is larger than {LARGEST_SETUP_MB} MB.")


def put_together(work: Path, sign: str) -> tuple[Path, list[str]]:
    """Return the folder that setup.exe is to install, in `work`, and the checksums of all that was downloaded."""
    epoch = identity.source_date_epoch()
    tree, icons = work / identity.NAME, work / "icons"
    shutil.rmtree(tree, ignore_errors=True)

    print("Downloading the packages for Windows ...", flush=True)
    packages = download(HOUSE, work / "wheels")
    interpreter = download_interpreter(work / "interpreter")
    own = own_wheel(work / "own", epoch)

    print("Putting the program together ...", flush=True)
    write_runtime(tree / "runtime", interpreter, [*packages, own], epoch)
    if identity.RELEASE_FEED:
        # The program offers to look for newer versions where it finds this.
        feed = tree / "runtime" / "site-packages" / "bobdesk" / "resources" / "release-feed"
        feed.write_text(identity.RELEASE_FEED + "\n", encoding="ascii", newline="\n")
    subprocess.run([sys.executable, str(PACKAGING / "icons" / "make_icons.py"), str(icons)], check=True)
    launchers = write_launchers(tree, icons, work / "launchers")
    shutil.copy(HERE / "prompt.cmd", tree / "commands" / "prompt.cmd")
    sums = [f"{sha256(path)}  {path.name}" for path in (*packages, interpreter)]
    write_notices(tree, [*packages, interpreter])
    said = f"# What was downloaded, with SHA-256. Python's DLLs are out of {INTERPRETER}.\n"
    (tree / "licences" / "downloads.txt").write_text(said + "\n".join(sums) + "\n", encoding="ascii")
    for program in (*launchers, tree / "runtime" / "python3.dll"):
        if sign:
            subprocess.run([*shlex.split(sign), str(program)], check=True)
    date_everything(tree, epoch)
    return tree, sums


def refuse_without_tools() -> None:
    """End with a sentence if something is missing that cannot be downloaded."""
    if sys.version_info[:2] != PYTHON:
        version = ".".join(map(str, PYTHON))
        sys.exit(f"Python {version} is needed, whose library goes along: make PYTHON=python{version} VENV=... windows")
    missing = [tool for tool in ("makensis", GCC, WINDRES) if shutil.which(tool) is None]
    if missing:
        sys.exit(f"{', '.join(missing)}: not found; on Debian: apt-get install nsis gcc-mingw-w64-x86-64")
    if os.environ.get("PYTHONHASHSEED") != "0":
        # Sets are written into compiled modules in the order of their hashes.
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, "PYTHONHASHSEED": "0"})


def own_wheel(folder: Path, epoch: int) -> Path:
    """Return the program's own wheel, built anew."""
    shutil.rmtree(folder, ignore_errors=True)
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(folder), str(HOUSE)]
    environment = {
        **os.environ,
        "PIP_CONSTRAINT": str(HOUSE / "constraints.txt"),
        "SOURCE_DATE_EPOCH": str(epoch),
    }
    if subprocess.run(command, env=environment, check=False).returncode:
        sys.exit("pip could not build the program's wheel.")
    return next(folder.glob("*.whl"))


if __name__ == "__main__":
    main()
