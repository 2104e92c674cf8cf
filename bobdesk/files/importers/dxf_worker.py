"""The process in which DXF drawings are read: started by `dxf`, never by a person.

It reads the file from standard input and answers on standard output: one line of JSON, either
{"error": sentence} or {"starts", "notes"}, and then the points of all paths as a .npy array (n, 3).
A hostile drawing can at worst end this process.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from bobdesk.errors import InputError
from bobdesk.files.worker_streams import worker_streams

_MEMORY_BYTES = 900 * 2**20
_LONGEST_SECONDS = 30  # of CPU, should nobody be left to end this process


def main() -> int:
    """Answer one request; whatever ezdxf raises ends the process with a status of 1."""
    request, answer = worker_streams()
    _limit_this_process()
    with _no_fonts():
        from bobdesk.files.importers.dxf_entities import dxf_paths

    data = request.read()
    try:
        paths, notes = dxf_paths(data)
    except InputError as error:
        answer.write(json.dumps({"error": str(error)}).encode() + b"\n")
        answer.close()
        return 0
    starts = np.concatenate([[0], np.cumsum([len(path) for path in paths])])[:-1].astype(int).tolist()
    answer.write(json.dumps({"starts": starts, "notes": notes}).encode() + b"\n")
    body = io.BytesIO()
    np.save(body, np.concatenate(paths) if paths else np.zeros((0, 3)), allow_pickle=False)
    answer.write(body.getbuffer())
    answer.close()
    return 0


@contextlib.contextmanager
def _no_fonts() -> Iterator[None]:
    """Tell ezdxf that there are no fonts, which lines do not need.

    When it is loaded, it would look into every font of the computer, which takes longer than a drawing may where
    there are thousands, and would leave what it found in the user's home.
    """
    with tempfile.TemporaryDirectory(prefix="bobdesk-", ignore_cleanup_errors=True) as folder:
        cache = Path(folder) / "ezdxf" / "font_manager_cache.json"
        cache.parent.mkdir()
        cache.write_text('{"version": 0, "font-faces": []}', encoding="ascii")
        os.environ["XDG_CACHE_HOME"] = folder
        yield


def _limit_this_process() -> None:
    if sys.platform != "win32":
        import resource

        for number, value in ((resource.RLIMIT_AS, _MEMORY_BYTES), (resource.RLIMIT_CPU, _LONGEST_SECONDS)):
            # macOS refuses some limits; the time limit of the caller still holds.
            with contextlib.suppress(ValueError, OSError):
                resource.setrlimit(number, (value, resource.getrlimit(number)[1]))


if __name__ == "__main__":
    sys.exit(main())
