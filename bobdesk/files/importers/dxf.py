"""Lines from a DXF drawing, read in a process of its own with limits on time and memory."""

from __future__ import annotations

import importlib.util
import io
import json
import os
import subprocess
import sys

import numpy as np

from bobdesk.errors import InputError
from bobdesk.files.importers.drawn_paths import line_from_paths
from bobdesk.files.importers.imported_line import ImportedLine
from bobdesk.files.process_start import START_S

WORKER_ARGUMENT = "--dxf-worker"
_LIMIT_BYTES = 200_000_000
_TIME_LIMIT_S = 8.0 + START_S


def read_dxf(data: bytes, *, name: str) -> ImportedLine:
    """Read the longest line of the model space: lines, polylines, arcs and splines, brought to metres.

    Raises
    ------
    InputError
        If ezdxf is not installed, or the drawing is damaged, over a limit, or holds no line.
    """
    if importlib.util.find_spec("ezdxf") is None:
        raise InputError(
            f"{name}: DXF drawings are read with the package ezdxf, which is not installed;"
            ' install it with: pip install "bobdesk[cad]"'
        )
    if len(data) > _LIMIT_BYTES:
        raise InputError(f"{name}: the drawing is {len(data) / 1e6:,.0f} MB large; the most that is read is 200 MB")
    try:
        ended = subprocess.run(
            _worker_command(),
            input=data,
            capture_output=True,
            timeout=_TIME_LIMIT_S,
            check=False,
            env=_environment(),
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
    except subprocess.TimeoutExpired:
        raise InputError(
            f"{name}: the drawing took longer than {_TIME_LIMIT_S:g} seconds to read and was given up;"
            " save the track alone in a drawing of its own"
        ) from None
    if ended.returncode != 0:
        raise InputError(f"{name}: this is no DXF drawing, or it is damaged or takes more memory than it may")
    head, _, body = ended.stdout.partition(b"\n")
    answer = json.loads(head)
    if "error" in answer:
        raise InputError(f"{name}: {answer['error']}")
    points = np.load(io.BytesIO(body), allow_pickle=False)
    paths = np.split(points, answer["starts"][1:]) if answer["starts"] else []
    return line_from_paths(paths, name=name, notes=tuple(answer["notes"]))


def _worker_command() -> list[str]:
    """Return the command that starts `bobdesk.files.importers.dxf_worker`; see `picture_process`."""
    if getattr(sys, "frozen", False):
        return [sys.executable, WORKER_ARGUMENT]
    return [sys.executable, "-P", "-W", "ignore", "-m", "bobdesk.files.importers.dxf_worker"]


def _environment() -> dict[str, str]:
    environment = dict(os.environ)
    environment["PYTHONPATH"] = os.pathsep.join(entry for entry in sys.path if entry)
    environment.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", MKL_NUM_THREADS="1")
    return environment
