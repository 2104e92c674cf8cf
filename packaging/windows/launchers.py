"""The two programs of the package for Windows: BobDesk.exe for the window, commands/bobdesk.exe for the console."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from house import HERE, identity
from interpreter import GCC, HARDENED, REPRODUCIBLE, STEM

WINDRES = "x86_64-w64-mingw32-windres"


def version_of_four(version: str) -> tuple[int, int, int, int]:
    """Return a version as Windows counts it: four numbers, none of them larger than 65,535."""
    numbers = [int(part) for part in re.findall(r"\d+", version)[:4]]
    first, second, third, fourth = (*numbers, 0, 0, 0, 0)[:4]
    return first, second, third, fourth


def fill(template: Path, names: dict[str, str]) -> str:
    """Return a template with each @NAME@ replaced."""
    numbers = version_of_four(identity.VERSION)
    known = {
        **identity.values(),
        "VERSION_DOTS": ".".join(map(str, numbers)),
        "VERSION_COMMAS": ",".join(map(str, numbers)),
        **names,
    }
    return re.sub(r"@([A-Z_]+)@", lambda found: known[found[1]], template.read_text(encoding="utf-8"))


def write_launchers(folder: Path, icons: Path, work: Path) -> list[Path]:
    """Compile both programs into `folder`, and return their paths.

    Parameters
    ----------
    icons
        Where bobdesk.ico and bobdesk-project.ico lie.
    work
        For what is made on the way.
    """
    window, console = folder / identity.WINDOWS_EXECUTABLE, folder / identity.WINDOWS_CONSOLE
    compile_launcher(window, "runtime", icons, work, for_console=False)
    compile_launcher(console, "..\\runtime", icons, work, for_console=True)
    return [window, console]


def compile_launcher(program: Path, runtime: str, icons: Path, work: Path, *, for_console: bool) -> None:
    """Compile one program, with version, icons and manifest in it."""
    program.parent.mkdir(parents=True, exist_ok=True)
    work.mkdir(parents=True, exist_ok=True)
    kind = "console" if for_console else "window"
    manifest, script, resources = (work / f"{kind}.{end}" for end in ("manifest", "rc", "res.o"))
    manifest.write_text(fill(HERE / "launcher.manifest.in", {}), encoding="utf-8")
    names = {
        "ICON": (icons / f"{identity.PROGRAM}.ico").as_posix(),
        "PROJECT_ICON": (icons / f"{identity.PROGRAM}-project.ico").as_posix(),
        "MANIFEST": manifest.as_posix(),
        "FILE": program.name,
        "FILE_DESCRIPTION": f"{identity.NAME} for the console" if for_console else identity.NAME,
    }
    script.write_text(fill(HERE / "launcher.rc.in", names), encoding="utf-8")
    subprocess.run([WINDRES, "--codepage=65001", str(script), str(resources)], check=True)
    subsystem = ["-DCONSOLE", "-mconsole"] if for_console else ["-mwindows"]
    words = {"RUNTIME": runtime.replace("\\", "\\\\"), "PYDLL": f"{STEM}.dll", "PRODUCT": identity.NAME}
    defines = [f'-D{name}=L"{value}"' for name, value in words.items()]
    command = [GCC, "-Os", "-Wall", "-Wextra", "-Werror", "-municode", *subsystem, *REPRODUCIBLE, *HARDENED, *defines]
    subprocess.run([*command, "-o", str(program), str(HERE / "launcher.c"), str(resources), "-lshell32"], check=True)
