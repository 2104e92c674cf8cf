"""What a Linux desktop wants beside the program, for all packages: `python packaging/linux/layout.py FOLDER`.

Leaves below FOLDER/share: menu entry, file type, icons, AppStream metainfo and the manual page. FOLDER is /usr in the
.deb, the top of the tar.xz, and usr in the AppImage.
"""

from __future__ import annotations

import gzip
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent.parent)]
import identity  # noqa: E402

# 1024 is for macOS only; hicolor ends at 512.
_SIZES = (16, 22, 24, 32, 48, 64, 128, 256, 512)


def lay_out(folder: Path) -> None:
    """Write all files below `folder`/share."""
    share = folder / "share"
    _write(share / "applications" / f"{identity.APP_ID}.desktop", filled("bobdesk.desktop.in"))
    _write(share / "metainfo" / f"{identity.APP_ID}.metainfo.xml", filled("metainfo.xml.in"))
    _write(share / "mime" / "packages" / f"{identity.APP_ID}.xml", filled("mime-type.xml.in"))
    page = share / "man" / "man1" / f"{identity.PROGRAM}.1.gz"
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_bytes(packed(manual()))
    _lay_out_icons(share / "icons" / "hicolor")


def filled(template: str) -> str:
    """Return one of this folder's templates with names and versions in it."""
    return identity.fill((HERE / template).read_text(encoding="utf-8"))


def manual() -> str:
    """Return the manual page, with the commands that the program has."""
    from bobdesk.cli.main import COMMANDS

    listed = "\n".join(f".TP\n.B {name}\n{_roff(line)}" for name, line in COMMANDS.items())
    text = (HERE / "bobdesk.1.in").read_text(encoding="utf-8").replace("@COMMANDS@", listed)
    return identity.fill(text)


def packed(text: str) -> bytes:
    """Return `text` as gzip, the same bytes each time."""
    return gzip.compress(text.encode(), compresslevel=9, mtime=0)


def _roff(line: str) -> str:
    return line.replace("\\", "\\e").replace("-", "\\-")


def _lay_out_icons(theme: Path) -> None:
    with tempfile.TemporaryDirectory() as made:
        icons = Path(made)
        environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
        maker = HERE.parent / "icons" / "make_icons.py"
        subprocess.run([sys.executable, str(maker), str(icons)], check=True, env=environment)
        for size in _SIZES:
            of_size = theme / f"{size}x{size}"
            _copy(icons / f"bobdesk-{size}.png", of_size / "apps" / f"{identity.APP_ID}.png")
            _copy(icons / f"bobdesk-project-{size}.png", of_size / "mimetypes" / f"{identity.MIME_ICON}.png")
    scalable = theme / "scalable" / "apps" / f"{identity.APP_ID}.svg"
    _copy(identity.ROOT / "resources" / "icons" / "bobdesk.svg", scalable)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(source.read_bytes())


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    lay_out(Path(sys.argv[1]))
