"""The Debian package: `python packaging/linux/build_deb.py [PROGRAM [OUT]]`.

PROGRAM is the frozen program (dist/bobdesk), OUT the folder for the package (dist). The same program gives the same
bytes. Needs dpkg-deb and, for the version of the C library, objdump (packages dpkg, binutils).
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "notices")]
import identity  # noqa: E402
import layout  # noqa: E402
import make_notices  # noqa: E402

_CONTROL = """Package: {PROGRAM}
Version: {VERSION}
Architecture: {architecture}
Maintainer: {MAINTAINER}
Installed-Size: {size}
Depends: {depends}
Recommends: desktop-file-utils, libwayland-client0, libwayland-cursor0, libwayland-egl1, shared-mime-info, xdg-utils
Section: science
Priority: optional
Description: {SUMMARY}
{description}
"""


def build(program: Path, out: Path) -> Path:
    """Return the package of the frozen `program`, built into the folder `out`."""
    architecture = _said("dpkg", "--print-architecture").strip()
    package = out / f"{identity.PROGRAM}_{identity.VERSION}_{architecture}.deb"
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="bobdesk-deb-") as made:
        root = Path(made) / "root"
        _install(program, root)
        _document(program, root / "usr" / "share" / "doc" / identity.PROGRAM)
        _make_even(root)
        _control(root, architecture)
        environment = os.environ | {"SOURCE_DATE_EPOCH": str(identity.source_date_epoch())}
        # One thread: how many there are decides where xz parts its blocks.
        call = ["dpkg-deb", "--root-owner-group", "-Zxz", "-z6", "--threads-max=1", "--build", str(root), str(package)]
        subprocess.run(call, check=True, env=environment, stdout=subprocess.DEVNULL)
    return package


def _install(program: Path, root: Path) -> None:
    usr = root / "usr"
    shutil.copytree(program, usr / "lib" / identity.PROGRAM, symlinks=True)
    # New versions come by the package manager: the program itself asks nobody.
    (usr / "lib" / identity.PROGRAM / "_internal" / "resources" / "release-feed").unlink(missing_ok=True)
    (usr / "bin").mkdir()
    (usr / "bin" / identity.PROGRAM).symlink_to(f"../lib/{identity.PROGRAM}/{identity.PROGRAM}")
    layout.lay_out(usr)
    overrides = usr / "share" / "lintian" / "overrides" / identity.PROGRAM
    overrides.parent.mkdir(parents=True)
    shutil.copyfile(HERE / "lintian-overrides", overrides)


def _document(program: Path, folder: Path) -> None:
    folder.mkdir(parents=True)
    licence = (identity.ROOT / "LICENSE").read_text(encoding="utf-8").split("\n\n", 2)[2]
    indented = "\n".join(f" {line}" if line.strip() else " ." for line in licence.strip().splitlines())
    text = (HERE / "copyright.in").read_text(encoding="utf-8").replace("@LICENCE_TEXT@", indented)
    (folder / "copyright").write_text(identity.fill(text), encoding="utf-8")
    changes = (
        f"{identity.PROGRAM} ({identity.VERSION}) stable; urgency=medium\n\n  * Version {identity.VERSION}.\n\n"
        f" -- {identity.MAINTAINER}  {identity.values()['DATE_RFC']}\n"
    )
    (folder / "changelog.gz").write_bytes(layout.packed(changes))
    with tempfile.TemporaryDirectory() as made:
        make_notices.make(Path(made), program)
        for name in ("THIRD-PARTY-NOTICES.txt", "bobdesk.cdx.json"):
            text = (Path(made) / name).read_text(encoding="utf-8")
            (folder / f"{name}.gz").write_bytes(layout.packed(text))


def _make_even(root: Path) -> None:
    date = identity.source_date_epoch()
    starts = root / "usr" / "lib" / identity.PROGRAM / identity.PROGRAM
    for path in [*root.rglob("*"), root]:
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or path == starts else 0o644)
        os.utime(path, (date, date), follow_symlinks=False)


def _control(root: Path, architecture: str) -> None:
    files = sorted(path for path in root.rglob("*") if path.is_file() and not path.is_symlink())
    control = root / "DEBIAN"
    control.mkdir(mode=0o755)
    sums = "".join(f"{hashlib.md5(path.read_bytes()).hexdigest()}  {path.relative_to(root)}\n" for path in files)
    (control / "md5sums").write_text(sums, encoding="utf-8")
    kilobytes = sum(-(-path.stat().st_size // 1024) for path in files)
    depends = [f"libc6 (>= {libc_version(root)})", *depended_on()]
    text = _CONTROL.format_map(
        identity.values()
        | {
            "architecture": architecture,
            "size": str(kilobytes),
            "depends": ", ".join(depends),
            "description": _description(),
        }
    )
    (control / "control").write_text(text, encoding="utf-8")
    for path in control.iterdir():
        path.chmod(0o644)


def depended_on() -> list[str]:
    """Return the packages that are named in the file `depends`."""
    lines = (HERE / "depends").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def libc_version(root: Path) -> str:
    """Return the oldest version of the C library that everything below `root` runs on."""
    binaries = [str(path) for path in root.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]
    told = _said("objdump", "--dynamic-syms", *binaries)
    versions = {tuple(map(int, found.split("."))) for found in re.findall(r"\bGLIBC_(\d+\.\d+(?:\.\d+)?)\b", told)}
    return ".".join(map(str, max(versions)))


def _description() -> str:
    words, lines = identity.DESCRIPTION.split(), [""]
    for word in words:
        if len(lines[-1]) + len(word) > 76:
            lines.append("")
        lines[-1] += f" {word}"
    return "\n".join([*lines, " .", " The package carries its own Python, Qt and numerical libraries."])


def _said(*call: str) -> str:
    # objdump fails for one library without symbols, and tells of all others.
    return subprocess.run(call, capture_output=True, text=True, check=call[0] != "objdump").stdout


if __name__ == "__main__":
    if len(sys.argv) > 3 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    given = [Path(argument).resolve() for argument in sys.argv[1:]]
    built = build(
        given[0] if given else identity.ROOT / "dist" / identity.PROGRAM,
        given[1] if len(given) > 1 else identity.ROOT / "dist",
    )
    print(f"{built}: {built.stat().st_size / 1e6:.1f} MB, sha256 {hashlib.sha256(built.read_bytes()).hexdigest()}")
