"""For Linux without Debian's packages: `python packaging/linux/build_tarball.py [PROGRAM [OUT]]`.

PROGRAM is the frozen program (dist/bobdesk), OUT the folder for bobdesk-VERSION-linux-ARCH.tar.xz (dist). In it lie
the program, `install` for one user, menu entry and the like, and the notices. The same program gives the same bytes.
"""

from __future__ import annotations

import hashlib
import platform
import shutil
import sys
import tarfile
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "notices")]
import build_deb  # noqa: E402
import identity  # noqa: E402
import layout  # noqa: E402
import make_notices  # noqa: E402

_RUNS = (f"program/{identity.PROGRAM}", "install")


def build(program: Path, out: Path) -> Path:
    """Return the archive of the frozen `program`, built into the folder `out`."""
    name = f"{identity.PROGRAM}-{identity.VERSION}-linux-{platform.machine()}"
    out.mkdir(parents=True, exist_ok=True)
    archive = out / f"{name}.tar.xz"
    with tempfile.TemporaryDirectory(prefix="bobdesk-tar-") as made:
        top = Path(made) / name
        shutil.copytree(program, top / "program", symlinks=True)
        layout.lay_out(top)
        make_notices.make(top / "licences", program)
        (top / "install").write_text(identity.fill((HERE / "install.in").read_text(encoding="utf-8")), encoding="utf-8")
        libraries = ", ".join(build_deb.depended_on())
        readme = (HERE / "README.txt.in").read_text(encoding="utf-8").replace("@LIBRARIES@", libraries)
        readme = readme.replace("@LIBC@", build_deb.libc_version(program))
        (top / "README.txt").write_text(identity.fill(readme), encoding="utf-8")
        _pack(top, archive)
    return archive


def _pack(top: Path, archive: Path) -> None:
    date = identity.source_date_epoch()

    def even(info: tarfile.TarInfo) -> tarfile.TarInfo:
        info.uid = info.gid = 0
        info.uname = info.gname = "root"
        info.mtime = date
        inside = info.name.partition("/")[2]
        if not info.issym():
            info.mode = 0o755 if info.isdir() or inside in _RUNS else 0o644
        return info

    with tarfile.open(archive, "w:xz", format=tarfile.PAX_FORMAT, preset=6) as tar:
        tar.add(top, arcname=top.name, recursive=False, filter=even)
        for path in sorted(top.rglob("*"), key=lambda path: path.relative_to(top).as_posix()):
            name = f"{top.name}/{path.relative_to(top).as_posix()}"
            tar.add(path, arcname=name, recursive=False, filter=even)


if __name__ == "__main__":
    if len(sys.argv) > 3 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    given = [Path(argument).resolve() for argument in sys.argv[1:]]
    built = build(
        given[0] if given else identity.ROOT / "dist" / identity.PROGRAM,
        given[1] if len(given) > 1 else identity.ROOT / "dist",
    )
    print(f"{built}: {built.stat().st_size / 1e6:.1f} MB, sha256 {hashlib.sha256(built.read_bytes()).hexdigest()}")
