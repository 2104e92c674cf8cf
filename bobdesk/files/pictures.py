"""Pictures from the disk and the clipboard, decoded where they can do no harm."""

from __future__ import annotations

import stat
from collections.abc import Generator
from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.picture_process import decode_in_process
from bobdesk.plan.image import LIMIT_MEGAPIXELS, PlanImage
from bobdesk.plan.world import PixelToWorld
from bobdesk.plan.world_file import parse_world_file, world_file_names
from bobdesk.progress import Progress, finish

_LIMIT_BYTES = 2_000_000_000
_LIMIT_WORLD_FILE_BYTES = 10_000


def read_picture(
    path: str | Path, *, page: int = 1, dpi: float = 200.0, limit_megapixels: float = LIMIT_MEGAPIXELS
) -> PlanImage:
    """Return the picture in the file `path`; see `read_picture_steps`."""
    return finish(read_picture_steps(path, page=page, dpi=dpi, limit_megapixels=limit_megapixels))


def read_picture_steps(
    path: str | Path, *, page: int = 1, dpi: float = 200.0, limit_megapixels: float = LIMIT_MEGAPIXELS
) -> Generator[Progress, None, PlanImage]:
    """Return the picture in the file `path`, with the position that a world file beside it gives.

    A generator of `Progress`; closing it stops the work.

    Parameters
    ----------
    path
        A PNG, JPEG, TIFF, WebP, BMP, GIF, SVG or PDF file under any name.
    page, dpi, limit_megapixels
        As in `bobdesk.plan.image.decode_picture`.

    Raises
    ------
    InputError
        If the file is missing, unreadable, no picture, damaged, or over a limit.
    """
    path = Path(path)
    data = picture_bytes(path)
    world, note = _world_beside(path)
    image = yield from decode_in_process(
        data, name=path.name, page=page, dpi=dpi, limit_megapixels=limit_megapixels, world=world
    )
    if note is None or image.world is not None:
        return image
    notes = (*image.notes, note)
    return PlanImage(image.pixels, image.dpi, image.pages, image.format, notes, image.world)


def picture_bytes(path: Path) -> bytes:
    """Return the bytes of the file `path`.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read, or it is over 2 GB.
    """
    try:
        about = path.stat()
        if stat.S_ISDIR(about.st_mode):
            raise InputError(f"{path.name or path} is a folder, not a picture.")
        if not stat.S_ISREG(about.st_mode):
            raise InputError(f"{path.name} is a device, not a picture.")
        if about.st_size > _LIMIT_BYTES:
            raise InputError(f"{path.name} is too large: pictures may have up to {_LIMIT_BYTES // 10**9} GB.")
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"There is no file {path}.") from None
    except PermissionError:
        raise InputError(f"{path.name} cannot be read: you have no permission to open it.") from None
    except (OSError, ValueError) as error:
        raise InputError(f"{path.name} cannot be read: {_reason(error)}.") from None


def _reason(error: OSError | ValueError) -> str:
    reason = error.strerror if isinstance(error, OSError) else None
    return (reason or "its name is not allowed").lower()


def _world_beside(path: Path) -> tuple[PixelToWorld | None, str | None]:
    """Return the position in the world file beside `path`, or a sentence on why it cannot be used."""
    for name in world_file_names(path.name):
        beside = path.with_name(name)
        try:
            if not beside.is_file() or beside.stat().st_size > _LIMIT_WORLD_FILE_BYTES:
                continue
            return parse_world_file(beside.read_text(encoding="utf-8", errors="replace"), name=name), None
        except OSError:
            return None, f"{name} lies beside the picture but cannot be read."
        except InputError as reason:
            return None, str(reason)
    return None, None
