"""Hostile project files: each is one sentence within 10 s and 1 GB, measured in a process of its own."""

from __future__ import annotations

import io
import json
import os
import resource
import struct
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.errors import InputError
from bobdesk.files.project_archive import archive_bytes
from bobdesk.files.project_decoding import decode_project
from bobdesk.files.project_encoding import Encoded, encode_project
from bobdesk.files.project_file import load_project
from bobdesk.project.steps import steps
from tests.project.made_projects import full_project, ready_project

_OPEN = """
import sys, resource
from pathlib import Path
from bobdesk.errors import InputError
from bobdesk.files.project_file import load_project
try:
    load_project(Path(sys.argv[1]))
except InputError as error:
    print(str(error).replace(sys.argv[1], "FILE"), end="")
else:
    print("opened", end="")
"""
_SECONDS, _BYTES = 10, 2**30


def good() -> bytes:
    return archive_bytes(encode_project(full_project()))


def packed(entries: dict[str, bytes], compression: int = zipfile.ZIP_DEFLATED) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", compression) as archive:
        for name, content in entries.items():
            archive.writestr(name, content)
    return buffer.getvalue()


def document(**changes: object) -> bytes:
    found = json.loads(encode_project(ready_project()).document)
    return packed({"project.json": json.dumps(found | changes).encode(), "picture": b"x"})


def with_text(old: str, new: str) -> bytes:
    text = encode_project(ready_project()).document.decode()
    assert old in text
    return packed({"project.json": text.replace(old, new, 1).encode(), "picture": b"x"})


def many_entries() -> bytes:
    """An index of 500,000 entries that all name one part: 32 MB that would take a gigabyte to list."""
    entry = b"PK\x01\x02" + struct.pack("<HHHHHHLLLHHHHHLL", 20, 20, 0, 0, 0, 33, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0) + b"a"
    index = entry * 500_000
    end = struct.pack("<4sHHHHLLH", b"PK\x05\x06", 0, 0, 1, 1, len(index), 4, 0)
    return b"PK\x03\x04" + index + end


def lying_size() -> bytes:
    """A stored part that says it is 1.9 GB long."""
    data = bytearray(packed({"picture": b"x", "project.json": b"{}"}, zipfile.ZIP_STORED))
    at = data.rfind(b"PK\x01\x02", 0, data.rfind(b"project.json"))
    first = data.find(b"PK\x01\x02")
    assert first < at
    struct.pack_into("<LL", data, first + 20, 1_900_000_000, 1_900_000_000)
    return bytes(data)


FILES: dict[str, tuple[Callable[[], bytes], str]] = {
    "empty": (lambda: b"", "the file is empty"),
    "text": (lambda: b"hello, world", "this is not a BobDesk project"),
    "another zip": (lambda: packed({"word/document.xml": b"<x/>"}), "this is not a BobDesk project"),
    "cut off": (lambda: good()[:-500], "the file is damaged: "),
    "cut short": (lambda: good()[:1000], "the file is damaged: its end is missing"),
    "flipped bit": (lambda: good().replace(b'"spacing":1.0', b'"spacing":1.1'), "the file is damaged: "),
    "bomb": (lambda: packed({"project.json": bytes(110_000_000)}), "a part of it unpacks to more than it may"),
    "bomb picture": (
        lambda: packed({"project.json": b"{}", "picture": bytes(300_000_000)}),
        "a part of it unpacks to more than it may",
    ),
    "traversal": (lambda: packed({"project.json": b"{}", "../../evil": b"x"}), "it holds a part that is none of a"),
    "absolute": (lambda: packed({"project.json": b"{}", "/etc/passwd": b"x"}), "it holds a part that is none of a"),
    "many entries": (many_entries, "it holds more than a project may"),
    "lying size": (lying_size, "the file is damaged: its parts are longer than it is"),
    "deep": (
        lambda: packed({"project.json": b'{"format":' + b"[" * 200_000 + b"]" * 200_000 + b"}"}, zipfile.ZIP_STORED),
        "the project in it is damaged: ",
    ),
    "deep beside": (
        lambda: packed({"project.json": b'{"x":' + b"[" * 200_000 + b"]" * 200_000 + b"}"}, zipfile.ZIP_STORED),
        "the project in it is damaged: it is nested too deeply",
    ),
    "NaN": (lambda: with_text('"offset":0.0', '"offset":NaN'), "the project in it is damaged: it is not JSON"),
    "Infinity": (lambda: with_text('"offset":0.0', '"offset":-Infinity'), "the project in it is damaged: it is not"),
    "too large a number": (lambda: with_text('"offset":0.0', '"offset":1e999'), "the project in it is damaged: number"),
    "newer": (lambda: document(version=2), "this project was made by a newer BobDesk; update BobDesk to open it"),
    "older than any": (lambda: document(version=0), "there is no version 0 of BobDesk projects"),
    "wrong format": (lambda: document(format="other"), "this is not a BobDesk project"),
    "unknown field": (lambda: document(surprise=1), "the project in it is damaged: object contains unknown field"),
    "wrong type": (lambda: document(name=3), "the project in it is damaged: expected `str`"),
    "no document": (lambda: packed({"picture": b"x"}), "this is not a BobDesk project"),
    "no picture": (
        lambda: packed({"project.json": encode_project(ready_project()).document}),
        "a part of the project is missing in it: picture",
    ),
    "no such run": (lambda: document(chosen_run=3), "the project in it is damaged: the run that it shows is missing"),
    "negative run": (lambda: document(chosen_run=-1), "the project in it is damaged: the run that it shows is missing"),
    "no targets": (lambda: document(target_sets=[]), "the project in it is damaged: its sets of targets"),
    "no segments": (lambda: document(segments=[]), "there are no segments in it"),
    "a design of nothing": (
        lambda: document(design={"name": "d", "curves": [], "offset": 0.0}),
        "the project in it is damaged: the designer's list of curves makes no sense",
    ),
    "a design that turns on the spot": (
        lambda: document(
            design={
                "name": "d",
                "curves": [{"start": 1.0, "length": 5.0, "radius": 0.0, "side": "left", "name": ""}],
                "offset": 0.0,
            }
        ),
        "the project in it is damaged: the designer's list of curves makes no sense",
    ),
    "huge array": (
        lambda: packed({"project.json": b"[" + b"[0,0]," * 19_000_000 + b"0]"}, zipfile.ZIP_STORED),
        "it holds more points than a project may",
    ),
    "large array": (
        lambda: packed(
            {"project.json": b'{"format":"bobdesk-project","version":1,"x":[' + b"[0,0]," * 3_900_000 + b"0]}"},
            zipfile.ZIP_STORED,
        ),
        "the project in it is damaged: object contains unknown field",
    ),
    "large trace": (
        lambda: with_text('"trace":{"points":[', '"trace":{"points":[' + "[0,0]," * 3_900_000),
        "",
    ),
}


@pytest.mark.skipif(sys.platform == "win32", reason="limits on memory are those of POSIX")
@pytest.mark.parametrize("name", sorted(FILES))
def test_a_hostile_file_is_one_sentence_in_10_s_and_1_gb(name: str, tmp_path: Path) -> None:
    make, expected = FILES[name]
    path = tmp_path / "hostile.bobdesk"
    path.write_bytes(make())

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (_BYTES, _BYTES))

    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", _OPEN, str(path)],
        capture_output=True,
        text=True,
        timeout=_SECONDS,
        env=dict(os.environ, PYTHONPATH=os.getcwd(), OPENBLAS_NUM_THREADS="1"),  # noqa: PTH109
        preexec_fn=limited,
        check=False,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    assert done.stdout.startswith(f"FILE: {expected}"), done.stdout[:300]
    assert len(done.stdout.splitlines()) == 1
    assert len(done.stdout) < 400
    assert list(tmp_path.iterdir()) == [path]


def test_a_missing_file_and_a_folder_are_sentences(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file"):
        load_project(tmp_path / "none.bobdesk")
    with pytest.raises(InputError, match="this is a folder"):
        load_project(tmp_path)


@given(st.data())
@settings(deadline=None, max_examples=200, derandomize=True)
def test_damaged_bytes_raise_nothing_but_the_one_error(data: st.DataObject) -> None:
    encoded = encode_project(full_project())
    document = bytearray(encoded.document)
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(document) - 1))
        document[at : at + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=3))
    _decodes_or_says_why(Encoded(bytes(document), encoded.blobs))


@given(st.data())
@settings(deadline=None, max_examples=200, derandomize=True)
def test_wrong_values_raise_nothing_but_the_one_error(data: st.DataObject) -> None:
    encoded = encode_project(full_project())
    found = json.loads(encoded.document)
    for _ in range(data.draw(st.integers(1, 2))):
        place = found
        while True:
            keys = list(place) if isinstance(place, dict) else list(range(len(place)))
            key = data.draw(st.sampled_from(keys))
            if not isinstance(place[key], dict | list) or not place[key] or data.draw(st.integers(0, 5)) == 0:
                break
            place = place[key]
        place[key] = data.draw(
            st.sampled_from([None, -1, 0, 1e300, 2**70, "", "x", True, [], {}, [[]], [1.0], -0.5, 10**9])
        )
    _decodes_or_says_why(Encoded(json.dumps(found).encode(), encoded.blobs))


def _decodes_or_says_why(encoded: Encoded) -> None:
    try:
        project = decode_project(encoded.document, lambda name: encoded.blobs[name])
    except InputError as error:
        one_sentence(error)
    else:
        # What opens can be shown and saved again.
        assert len(steps(project)) == 6
        encode_project(project)


def one_sentence(error: InputError) -> None:
    assert len(str(error).splitlines()) == 1


@given(st.data())
@settings(deadline=None, max_examples=150, derandomize=True)
def test_damaged_archives_raise_nothing_but_the_one_error(tmp_path_factory, data: st.DataObject) -> None:  # type: ignore[no-untyped-def]
    content = bytearray(good())
    kind = data.draw(st.sampled_from(["flip", "cut", "index"]))
    if kind == "cut":
        del content[data.draw(st.integers(0, len(content) - 1)) :]
    else:
        low = content.find(b"PK\x01\x02") if kind == "index" else 0
        for _ in range(data.draw(st.integers(1, 5))):
            content[data.draw(st.integers(low, len(content) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.mktemp("damaged") / "a.bobdesk"
    path.write_bytes(content)
    try:
        load_project(path)
    except InputError as error:
        one_sentence(error)
