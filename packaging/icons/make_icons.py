"""All icons from one drawing, the program's own sign: `python packaging/icons/make_icons.py FOLDER`.

Leaves in FOLDER, for the program (bobdesk) and for a project file (bobdesk-project): NAME-16.png to NAME-1024.png,
NAME.ico for Windows, NAME.icns for macOS. Needs the packages resvg-py and Pillow, and no display. The same bytes
each time.
"""

from __future__ import annotations

import io
import re
import sys
from pathlib import Path

import resvg_py
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent.parent
SIGN = ROOT / "resources" / "icons" / "bobdesk.svg"
SIZES = (16, 22, 24, 32, 48, 64, 128, 256, 512, 1024)
ICO_SIZES = (16, 24, 32, 48, 64, 128, 256)
ICNS_SIZES = (16, 32, 64, 128, 256, 512, 1024)

# A sheet of paper with a turned corner, and the sign on it; below 32 pixels the sign fills most of the sheet.
_SHEET = """<svg xmlns="http://www.w3.org/2000/svg" width="256" height="256" viewBox="0 0 256 256">
  <path d="M52 8H160L220 68V228A20 20 0 0 1 200 248H56A20 20 0 0 1 36 228V24A16 16 0 0 1 52 8Z"
        fill="#fbfcfe" stroke="#7b8794" stroke-width="{stroke}" stroke-linejoin="round"/>
  <path d="M160 8V56A12 12 0 0 0 172 68H220Z" fill="#d5dde6" stroke="#7b8794" stroke-width="{stroke}"
        stroke-linejoin="round"/>
  <svg x="{x}" y="{y}" width="{side}" height="{side}" viewBox="0 0 256 256">{sign}</svg>
</svg>"""


def sheet(sign: str, size: int) -> str:
    """Return the drawing of a project file for icons of `size` pixels."""
    inner = re.sub(r"^.*?<svg[^>]*>|</svg>\s*$", "", sign, flags=re.DOTALL)
    group = f'<g fill="none" stroke-linecap="round" stroke-linejoin="round">{inner}</g>'
    side = 168 if size < 32 else 132
    return _SHEET.format(sign=group, side=side, x=128 - side / 2, y=236 - side, stroke=14 if size < 32 else 8)


def drawn(svg: str, size: int) -> Image.Image:
    png = resvg_py.svg_to_bytes(svg_string=svg, width=size, height=size, skip_system_fonts=True)
    picture = Image.open(io.BytesIO(png)).convert("RGBA")
    if picture.size != (size, size):
        raise SystemExit(f"the icon came out as {picture.size}, not {size} × {size}")
    return picture


def make(folder: Path) -> None:
    """Write all icons into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    sign = SIGN.read_text(encoding="utf-8")
    for name in ("bobdesk", "bobdesk-project"):
        pictures = {size: drawn(sign if name == "bobdesk" else sheet(sign, size), size) for size in SIZES}
        for size, picture in pictures.items():
            picture.save(folder / f"{name}-{size}.png", optimize=True)
        _save_all(pictures, ICO_SIZES, folder / f"{name}.ico")
        _save_all(pictures, ICNS_SIZES, folder / f"{name}.icns")


def _save_all(pictures: dict[int, Image.Image], sizes: tuple[int, ...], path: Path) -> None:
    largest = pictures[sizes[-1]]
    others = [pictures[size] for size in sizes[:-1]]
    if path.suffix == ".ico":
        largest.save(path, sizes=[(size, size) for size in sizes], append_images=others)
    else:
        largest.save(path, append_images=others)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    make(Path(sys.argv[1]))
