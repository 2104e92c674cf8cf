"""The process in which pictures are decoded: started by `picture_process`, never by a person.

It reads one request from standard input, answers on standard output and ends:

    in    one line of JSON (name, page, dpi, limit_megapixels, world, size), then `size` bytes
    out   {"header": ...} once the size is known, then either
          {"error": sentence} or {"picture": shape, dtype, dpi ...} and the pixels' bytes

A hostile picture can at worst fill or hang this process, which has limits, and not the window.
"""

from __future__ import annotations

import contextlib
import json
import sys
from typing import IO, Any

import numpy as np

from bobdesk.errors import InputError
from bobdesk.files.worker_streams import worker_streams
from bobdesk.plan.image import PictureHeader, decode_picture
from bobdesk.plan.world import PixelToWorld

_START_BYTES = 900 * 2**20  # for opening any file, and for drawing a page
_ROOM_BYTES = 400 * 2**20  # beside the pixels: the interpreter, libraries, and the file
_LONGEST_SECONDS = 600  # of CPU, should nobody be left to end this process


def main() -> int:
    """Answer one request; return 0 whether the picture was good or not."""
    request_stream, answer = worker_streams()
    request = json.loads(request_stream.readline())
    _limit("RLIMIT_CORE", 0)
    _limit("RLIMIT_CPU", _LONGEST_SECONDS)
    _limit_memory(_START_BYTES + 2 * int(request["size"]))
    try:
        data = request_stream.read(int(request["size"]))
        _answer(answer, data, request)
    except InputError as error:
        _say(answer, {"error": str(error)})
    except MemoryError:
        _say(answer, {"error": f"{request['name']} takes more memory to open than a picture may."})
    answer.flush()
    return 0


def _answer(answer: IO[bytes], data: bytes, request: dict[str, Any]) -> None:
    def header_known(header: PictureHeader) -> None:
        if header.format not in ("PDF", "SVG"):
            _limit_memory(_ROOM_BYTES + 2 * len(data) + header.memory_bytes)
        _say(answer, {"header": {"megapixels": header.width * header.height / 1e6, "format": header.format}})

    world = request["world"]
    image = decode_picture(
        data,
        name=request["name"],
        page=request["page"],
        dpi=request["dpi"],
        limit_megapixels=request["limit_megapixels"],
        world=None if world is None else PixelToWorld(*world),
        before_decoding=header_known,
    )
    picture = {
        "shape": image.pixels.shape,
        "dtype": image.pixels.dtype.name,
        "dpi": image.dpi,
        "pages": image.pages,
        "format": image.format,
        "notes": image.notes,
        "world": None if image.world is None else image.world.coefficients,
    }
    _say(answer, {"picture": picture})
    answer.write(np.ascontiguousarray(image.pixels).data.cast("B"))


def _say(answer: IO[bytes], message: dict[str, Any]) -> None:
    answer.write(json.dumps(message).encode() + b"\n")
    answer.flush()


def _limit_memory(size: int) -> None:
    _limit("RLIMIT_AS", size)


def _limit(name: str, value: int) -> None:
    """Set the soft limit `name` where the system has such limits (Windows has none of them)."""
    if sys.platform != "win32":
        import resource

        number = getattr(resource, name, None)
        if number is None:
            return
        _, hard = resource.getrlimit(number)
        if hard != resource.RLIM_INFINITY:
            value = min(value, hard)
        # macOS refuses some limits; the time limit of the caller still holds.
        with contextlib.suppress(ValueError, OSError):
            resource.setrlimit(number, (value, hard))


if __name__ == "__main__":
    sys.exit(main())
