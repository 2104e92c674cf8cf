"""Hostile files and noise: one sentence, in bounded time and memory, and no other exception."""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bobdesk.errors import InputError
from bobdesk.files.importers.formats import FORMATS, line_in
from tests.files.importers import made_files as made

_SECONDS = 10
_MEGABYTES = 1000


@pytest.mark.skipif(sys.platform == "win32", reason="measures memory by resource")
def test_every_hostile_file_gives_one_sentence_in_time_and_memory(tmp_path):
    folder = tmp_path / "files"
    folder.mkdir()
    program = [sys.executable, "-W", "error", "-m", "tests.files.importers.hostile_files"]
    subprocess.run([*program, "make", str(folder)], check=True, timeout=100)
    names = {path.name for path in folder.iterdir()}
    assert len(names) > 60
    ended = subprocess.run([*program, "read", str(folder)], capture_output=True, text=True, timeout=300, check=False)
    assert ended.returncode == 0, ended.stderr[-2000:]
    *found, (_, held, _) = [json.loads(line) for line in ended.stdout.splitlines()]
    assert {name for name, _, _ in found} == names
    for name, seconds, sentence in found:
        assert sentence is not None, f"{name} was read as if nothing were wrong"
        assert sentence.startswith(str(folder / name)), sentence
        assert "\n" not in sentence
        assert len(sentence) < 400 + len(str(folder))
        assert seconds < _SECONDS, f"{name} took {seconds} s"
    assert held < _MEGABYTES


_BY_KEY = {known.key: known for known in FORMATS}
_IN_PROCESS = [(name, _BY_KEY.get(name, _BY_KEY["json"])) for name in made.ALL if name != "dxf"]
_PIECES = [b"1e999", b"-", b"nan", b"null", b'"', b"<", b">", b",", b"9" * 30, b"1e300", b"[", b"0"]
_CALM = settings(
    deadline=None, max_examples=60, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def _read(content, known):
    """Return the line or None; whatever else is raised than InputError fails the test."""
    sentence = None
    try:
        found = line_in(content, known, name="f")
    except InputError as error:
        sentence = str(error)
    if sentence is not None:
        assert sentence.startswith("f")
        assert "\n" not in sentence
        return None
    vertices = found.polyline.vertices
    assert np.isfinite(vertices).all()
    assert len(vertices) >= 3
    assert np.abs(vertices).max() < 1e8
    assert np.hypot(*np.diff(vertices, axis=0).T).min() >= 1e-3 - 1e-9
    assert found.elevations is None or (len(found.elevations) == len(vertices) and np.isfinite(found.elevations).all())
    return found


@pytest.mark.parametrize(("name", "known"), _IN_PROCESS, ids=[name for name, _ in _IN_PROCESS])
@_CALM
@given(data=st.data())
def test_damaged_files_raise_nothing_but_the_one_error(name, known, data):
    content = bytearray(made.ALL[name]())
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(content) - 1))
        piece = data.draw(
            st.one_of(
                st.binary(max_size=6),
                st.sampled_from(_PIECES),
            )
        )
        content[at : at + data.draw(st.integers(0, 12))] = piece
    if data.draw(st.booleans()):
        content = content[: data.draw(st.integers(0, len(content)))]
    _read(bytes(content), known)


@pytest.mark.parametrize(("name", "known"), _IN_PROCESS, ids=[name for name, _ in _IN_PROCESS])
@_CALM
@given(content=st.binary(min_size=1, max_size=300))
def test_noise_raises_nothing_but_the_one_error(name, known, content):
    _read(content, known)


_KEYS = ["type", "features", "geometry", "geometries", "coordinates", "crs", "properties", "name", "elements", "nodes"]
_KEYS += ["tags", "lat", "lon", "id", "sport", "format", "version", "columns", "x_m", "y_m", "z_m", "georeference"]
_KEYS += ["longitude", "latitude", "bobdesk_origin"]
_WORDS = ["Feature", "FeatureCollection", "LineString", "MultiLineString", "GeometryCollection", "way", "node"]
_WORDS += ["bobdesk-line", "luge"]
_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from(_KEYS), inner | st.sampled_from(_WORDS), max_size=5)
    ),
    max_leaves=30,
)


@settings(_CALM, max_examples=300)
@given(document=_JSON)
def test_any_json_raises_nothing_but_the_one_error(document):
    _read(json.dumps(document).encode(), _BY_KEY["json"])


_NUMBER = st.floats(width=32).map(str) | st.sampled_from(["1e12", "1e999", "-0", ".5", "1.", "+3", "1e-300", "0", "1"])
_COMMAND = st.tuples(st.sampled_from("MmLlHhVvCcSsQqTtAaZzx"), st.lists(_NUMBER, max_size=8)).map(
    lambda pair: pair[0] + " ".join(pair[1])
)


@settings(_CALM, max_examples=300)
@given(
    path=st.lists(_COMMAND, max_size=12).map("".join),
    transform=st.lists(
        st.tuples(
            st.sampled_from(["matrix", "translate", "scale", "rotate", "skewX", "skewY"]), st.lists(_NUMBER, max_size=7)
        ).map(lambda pair: f"{pair[0]}({','.join(pair[1])})"),
        max_size=3,
    ).map(" ".join),
)
def test_any_path_and_transform_raises_nothing_but_the_one_error(path, transform):
    content = f'<svg><g transform="{transform}"><path d="M0 0 {path}"/></g></svg>'
    _read(content.encode(), _BY_KEY["svg"])


@settings(_CALM, max_examples=12)
@given(data=st.data())
def test_damaged_drawings_raise_nothing_but_the_one_error(data):
    lines = made.dxf().decode().splitlines()
    for _ in range(data.draw(st.integers(1, 8))):
        at = data.draw(st.integers(0, len(lines) - 1))
        lines[at] = data.draw(st.sampled_from(["0", "10", "nan", "1e400", "-5", "LINE", "INSERT", "SPLINE", "999", ""]))
    with contextlib.suppress(InputError):
        _read("\n".join(lines).encode(), _BY_KEY["dxf"])


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9, 0.99])
@pytest.mark.parametrize("name", [name for name in made.ALL if name != "csv"])
def test_a_truncated_file_is_never_taken_for_a_shorter_track(name, share):
    content = made.ALL[name]()
    known = _BY_KEY.get(name, _BY_KEY["json"])
    with pytest.raises(InputError):
        line_in(content[: int(share * len(content))], known, name="f")
