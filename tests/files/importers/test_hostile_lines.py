"""Damaged 3D lines, lists of segments and previews raise nothing but the one error."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bobdesk.errors import InputError
from bobdesk.files.exporters.formats import export_line
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.files.importers.preview import preview
from bobdesk.files.importers.segments_csv import read_segments
from tests.files.exporters.exact_line import exact_line
from tests.files.importers import made_files as made

_PIECES = [
    b"1e999",
    b"-",
    b"nan",
    b"null",
    b'"',
    b"<",
    b">",
    b",",
    b"9" * 30,
    b"1e300",
    b"[",
    b"0",
    b"\n",
    b"curve",
    b"{}",
]
_SEGMENTS = (
    b"segment,kind,from_m,to_m,radius_m,turn_rad\n1,straight,0,30,,0\n2,curve,30,75.5,20,1\n3,straight,75.5,100,,0\n"
)
_CALM = settings(
    deadline=None, max_examples=80, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def _segments(path: Path) -> None:
    found = read_segments(path, length=100.0)
    edges = [found[0].start, *(segment.end for segment in found)]
    assert edges[0] == 0
    assert edges[-1] == 100
    assert (np.diff(edges) > 0).all()


def _line(path: Path) -> None:
    line = read_line3d(path).line
    assert np.isfinite(line.points).all()
    assert (np.diff(line.stations) > 0).all()
    assert line.segment_of.max() < len(line.segments)
    export_line(line, format="json")


def _preview(path: Path) -> None:
    found = preview(path)
    assert (found.line is None) == (found.problem is not None)


READERS: dict[str, tuple[Callable[[], bytes], str, Callable[[Path], None]]] = {
    "LINE.csv": (lambda: export_line(exact_line(spacing=40)), "line.csv", _line),
    "line.json": (lambda: export_line(exact_line(spacing=40), format="json"), "line.json", _line),
    "segments": (lambda: _SEGMENTS, "s.csv", _segments),
    **{f"preview of {name}": (made.ALL[name], f"a.{name}", _preview) for name in made.ALL if name != "dxf"},
}


@pytest.mark.parametrize("name", list(READERS))
@_CALM
@given(data=st.data())
def test_damaged_files_raise_nothing_but_the_one_error(name: str, tmp_path: Path, data: st.DataObject) -> None:
    make, title, read = READERS[name]
    content = bytearray(make())
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(content) - 1))
        content[at : at + data.draw(st.integers(0, 12))] = data.draw(st.binary(max_size=6) | st.sampled_from(_PIECES))
    path = tmp_path / title
    path.write_bytes(bytes(content))
    sentence = None
    try:
        read(path)
    except InputError as error:
        sentence = str(error)
    assert sentence is None or (sentence.startswith(str(path)) and "\n" not in sentence)
