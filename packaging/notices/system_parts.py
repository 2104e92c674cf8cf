"""The system's libraries in a program that was frozen on Debian or a relative, and what their packages say of them."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

from part import Part, text_of


def carried_libraries(tree: Path) -> list[str]:
    """Return the names of the libraries in a frozen program that come neither with Python nor from a wheel."""
    inside = tree / "_internal"
    return sorted(
        path.name
        for path in inside.iterdir()
        if ".so" in path.name and not path.is_symlink() and path.is_file() and not path.name.startswith("libpython")
    )


def system_parts(tree: Path) -> Iterator[Part]:
    """Yield each package that gave a library.

    Raises
    ------
    SystemExit
        If dpkg knows of no package with a library.
    """
    packages: dict[str, list[str]] = {}
    for library in carried_libraries(tree):
        packages.setdefault(_package(library), []).append(library)
    for package, libraries in sorted(packages.items()):
        base = package.split(":")[0]
        version = _said("dpkg-query", "--show", "--showformat=${Version}", package)
        texts = ((f"copyright, of {', '.join(libraries)}", text_of(Path("/usr/share/doc", base, "copyright"))),)
        yield Part(base, version, "see its text", "", texts)


def _package(library: str) -> str:
    # Other architectures may be installed beside this one.
    multiarch = _said("dpkg-architecture", "-qDEB_HOST_MULTIARCH")
    found = _said("dpkg-query", "--search", f"*/{multiarch}/{library}", wrong="")
    if not found:
        raise SystemExit(f"dpkg knows of no package with {library}; its licence cannot be told")
    return found.splitlines()[0].rsplit(": ", 1)[0].split(",")[0]


def _said(*call: str, wrong: str | None = None) -> str:
    done = subprocess.run(call, capture_output=True, text=True, check=wrong is None)
    return done.stdout.strip() if done.returncode == 0 else str(wrong)
