"""Freeze the program: `python packaging/freeze/freeze.py [FOLDER]` leaves it in FOLDER/bobdesk (dist/bobdesk).

Needs the packages of `make setup`. The same commit gives the same bytes, wherever it lies: dates are those of the
commit, and names hash alike.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import identity  # noqa: E402
import metadata_copies  # noqa: E402


def freeze(folder: Path) -> Path:
    """Freeze into `folder`, replacing what was there, and return the program's folder."""
    program = folder / identity.PROGRAM
    shutil.rmtree(program, ignore_errors=True)
    date = identity.source_date_epoch()
    with tempfile.TemporaryDirectory(prefix="bobdesk-freeze-") as made:
        work = Path(made)
        _run(sys.executable, str(HERE.parent / "icons" / "make_icons.py"), str(work / "icons"))
        environment = os.environ | {
            "SOURCE_DATE_EPOCH": str(date),
            "PYTHONHASHSEED": "0",
            "PYTHONDONTWRITEBYTECODE": "1",
            # Packages and installers pack better what is not packed yet, and the program starts sooner.
            "PYINSTALLER_ZLIB_COMPRESSION_LEVEL": "0",
            "PYINSTALLER_CONFIG_DIR": str(work / "cache"),
            "BOBDESK_ICONS": str(work / "icons"),
            "BOBDESK_METADATA": str(work / "metadata"),
        }
        metadata_copies.copy_metadata(work / "metadata")
        if identity.RELEASE_FEED:
            environment["BOBDESK_FEED_FILE"] = str(_feed_file(work))
        call = [sys.executable, "-m", "PyInstaller", "--noconfirm", "--clean", "--log-level", "WARN"]
        call += ["--distpath", str(folder), "--workpath", str(work / "build"), str(HERE / "bobdesk.spec")]
        _run(*call, environment=environment)
    if sys.platform == "linux":
        _strip(program)
    _make_even(program, date)
    return program


def _feed_file(folder: Path) -> Path:
    """Write the one file that has the program offer to look for newer versions."""
    place = folder / "release-feed"
    place.write_text(identity.RELEASE_FEED + "\n", encoding="ascii", newline="\n")
    return place


def _run(*call: str, environment: dict[str, str] | None = None) -> None:
    subprocess.run(call, check=True, env=environment)


def _strip(program: Path) -> None:
    """Take the symbols off libraries, but not off those that were edited after linking: most wheels' may break."""
    if shutil.which("strip") is None:
        print("freeze: there is no `strip` (package binutils); the program is some megabytes larger", file=sys.stderr)
        return
    inside = program / "_internal"
    wanted = ("libpython3*.so.*", "python3*/lib-dynload/*.so", "ezdxf/acc/*.so", "fontTools/**/*.so")
    libraries = [library for pattern in wanted for library in inside.glob(pattern)]
    for library in sorted(libraries):
        _run("strip", "--strip-unneeded", str(library))


def _make_even(program: Path, date: int) -> None:
    """Give all files the same permissions and dates, whatever the umask and the clock were."""
    for path in sorted(program.rglob("*"), reverse=True):
        if path.is_symlink():
            os.utime(path, (date, date), follow_symlinks=False)
            continue
        runs = path.is_dir() or (path.parent == program and path.stem == identity.PROGRAM)
        path.chmod(0o755 if runs else 0o644)
        os.utime(path, (date, date))
    program.chmod(0o755)
    os.utime(program, (date, date))


def digest(program: Path) -> str:
    """Return the SHA-256 of all names, kinds, permissions and bytes below `program`."""
    whole = hashlib.sha256()
    for path in sorted(program.rglob("*"), key=lambda path: path.relative_to(program).as_posix()):
        name = path.relative_to(program).as_posix()
        if path.is_symlink():
            whole.update(f"link {name} {path.readlink().as_posix()}\n".encode())
        elif path.is_file():
            content = hashlib.sha256(path.read_bytes()).hexdigest()
            whole.update(f"file {name} {path.stat().st_mode & 0o777:o} {content}\n".encode())
    return whole.hexdigest()


def main(arguments: list[str]) -> int:
    if len(arguments) > 1 or arguments[:1] in (["-h"], ["--help"]):
        print(__doc__)
        return 2
    folder = Path(arguments[0]) if arguments else identity.ROOT / "dist"
    program = freeze(folder.resolve())
    size = sum(path.stat().st_size for path in program.rglob("*") if path.is_file() and not path.is_symlink())
    print(f"{program}: {size / 1e6:.0f} MB, sha256 of the tree {digest(program)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
