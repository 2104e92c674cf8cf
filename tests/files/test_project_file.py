from __future__ import annotations

import json
import os
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.errors import InputError
from bobdesk.files import atomic
from bobdesk.files.migrations import MIGRATIONS, migrated
from bobdesk.files.npy import npy_bytes, npy_table
from bobdesk.files.project_archive import archive_bytes
from bobdesk.files.project_decoding import decode_project
from bobdesk.files.project_encoding import encode_project
from bobdesk.files.project_file import load_project, save_project
from bobdesk.files.project_schema import VERSION
from bobdesk.plan.polyline import Polyline
from bobdesk.project import edits
from bobdesk.project.derive_runs import iterate_line, run_line, why_out_of_date
from bobdesk.project.project import Picture, Project, SourceLine
from tests.project.edit_strategies import EDITS
from tests.project.made_projects import bends, coordinates_project, full_project, ready_project
from tests.project.same_project import print_of

STORED = Path(__file__).parent.parent / "data" / "projects"


@pytest.mark.parametrize("made", [Project, ready_project, coordinates_project, full_project])
def test_save_load_save_gives_the_same_bytes_and_the_same_project(made, tmp_path) -> None:  # type: ignore[no-untyped-def]
    project = made()
    first, second = tmp_path / "one.bobdesk", tmp_path / "two.bobdesk"
    save_project(project, first)
    loaded = load_project(first)
    save_project(loaded, second)
    assert first.read_bytes() == second.read_bytes()
    assert print_of(loaded) == print_of(project)


@given(st.data())
@settings(deadline=None, max_examples=120, derandomize=True)
def test_whatever_edits_make_survives_the_file_to_the_last_bit(data: st.DataObject) -> None:
    project = data.draw(st.sampled_from([Project(), full_project(), coordinates_project()]))
    for name in data.draw(st.lists(st.sampled_from(sorted(EDITS)), min_size=1, max_size=8)):
        try:
            project = EDITS[name](project, data.draw)
        except InputError:
            continue
    encoded = encode_project(project)
    loaded = decode_project(encoded.document, lambda name: encoded.blobs[name])
    assert print_of(loaded) == print_of(project)
    assert archive_bytes(encode_project(loaded)) == archive_bytes(encoded)


def test_a_loaded_run_is_up_to_date_and_draws_the_same_line(tmp_path: Path) -> None:
    project = full_project()
    save_project(project, tmp_path / "a.bobdesk")
    loaded = load_project(tmp_path / "a.bobdesk")
    assert loaded.run is not None
    assert why_out_of_date(loaded, loaded.run) is None
    assert why_out_of_date(loaded, loaded.runs[0]) == "the segments changed since this run"
    for old, new in zip(project.runs, loaded.runs, strict=True):
        np.testing.assert_array_equal(iterate_line(old, 3).points, iterate_line(new, 3).points)
        np.testing.assert_array_equal(run_line(old).points, run_line(new).points)
    # Both were solved on one plan, which is stored and loaded once.
    assert loaded.runs[0].inputs.polyline is loaded.runs[1].inputs.polyline


def test_runs_of_older_files_count_no_iteration_for_the_iterate_where_they_began() -> None:
    project = full_project()
    older = replace(project, runs=tuple(replace(run, nit=run.nit + 1) for run in project.runs))
    encoded = encode_project(older)
    loaded = decode_project(encoded.document, lambda name: encoded.blobs[name])
    assert [run.nit for run in loaded.runs] == [run.history[-1, 0] for run in loaded.runs]


@pytest.mark.parametrize(
    ("row", "column", "value"),
    [(0, 1, 7.0), (0, 1, 0.5), (1, 0, 0.0), (0, 2, 0.0), (0, 2, -1.0), (0, 4, np.nan), (1, 5, np.inf)],
)
def test_iterates_that_do_not_fit_together_are_refused(row: int, column: int, value: float) -> None:
    project = full_project()
    run = project.runs[0]
    assert run.iterates is not None
    table = run.iterates.table.copy()
    table[row, column] = value
    encoded = encode_project(project)
    name = json.loads(encoded.document)["runs"][0]["iterates"]["table"]
    blobs = encoded.blobs | {name: npy_bytes(table)}
    with pytest.raises(InputError, match="the iterates of a run do not fit together"):
        decode_project(encoded.document, lambda wanted: blobs[wanted])


def test_the_file_is_what_the_design_says(tmp_path: Path) -> None:
    path = tmp_path / "a.bobdesk"
    picture = bytes(range(256)) * 40
    save_project(edits.open_picture(full_project(), Picture(picture, "plan.png")), path)
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        names = archive.namelist()
        assert names[:2] == ["project.json", "picture"]
        assert names[2:] == sorted(names[2:])
        assert {info.date_time for info in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert archive.read("picture") == picture
        document = json.loads(archive.read("project.json"))
        assert (document["format"], document["version"]) == ("bobdesk-project", 1)
        history = next(run["history"] for run in document["runs"])
        with archive.open(history) as stream:
            assert np.load(stream).shape[1] == 8


def test_the_stored_file_of_version_1_still_opens() -> None:
    project = load_project(STORED / "v1.bobdesk")
    assert project.name == "Königssee"
    assert project.picture is not None
    assert project.picture.data == b"\x89PNG not really"
    assert [run.name for run in project.runs] == ["Run 1", "Run 2"]
    assert project.run is project.runs[1]
    assert project.segments is not None
    assert (project.segments[1].locked, project.segments[1].name) == (True, "Kreisel")
    assert [targets.name for targets in project.target_sets] == ["Track", "Women"]
    assert project.trace is not None
    assert project.trace.suspect.tolist() == [[2, 5], [20, 29]]
    assert project.actual is not None
    assert len(project.actual.points) == 40
    assert project.design is None
    assert run_line(project.runs[0]).slope_lengths[-1] == pytest.approx(project.runs[0].figures.length, abs=1e-6)


def test_each_version_has_a_stored_file_and_a_way_to_the_next() -> None:
    assert sorted(path.name for path in STORED.iterdir()) == [f"v{number}.bobdesk" for number in range(1, VERSION + 1)]
    assert sorted(MIGRATIONS) == list(range(1, VERSION))


def test_migrations_are_applied_in_order() -> None:
    steps = {1: lambda plain: plain | {"b": plain["a"] + 1}, 2: lambda plain: plain | {"c": plain["b"] + 1}}
    assert migrated({"version": 1, "a": 1}, to=3, migrations=steps) == {"version": 3, "a": 1, "b": 2, "c": 3}


def test_tables_are_npy_files(tmp_path: Path) -> None:
    table = np.array([[1.5, np.nan], [-0.0, np.inf], [5e-324, 1 / 3]])
    (tmp_path / "a.npy").write_bytes(npy_bytes(table))
    assert np.load(tmp_path / "a.npy").tobytes() == table.tobytes()
    assert npy_table(npy_bytes(table), columns=2).tobytes() == table.tobytes()
    for damaged in (b"", npy_bytes(table)[:-1], npy_bytes(table[:, :1]), b"x" + npy_bytes(table)[1:]):
        with pytest.raises(ValueError, match="damaged"):
            npy_table(damaged, columns=2)


def test_a_name_that_is_no_text_is_saved(tmp_path: Path) -> None:
    project = edits.open_picture(Project(), Picture(b"x", "pl\udce4n.png"))
    save_project(project, tmp_path / "a.bobdesk")
    loaded = load_project(tmp_path / "a.bobdesk")
    assert loaded.picture is not None
    assert loaded.picture.name == "pl?n.png"


@pytest.mark.parametrize("call", ["fsync", "write", "replace"])
def test_a_disk_that_is_full_leaves_the_old_file(call, tmp_path, monkeypatch) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "a.bobdesk"
    save_project(Project(), path)
    before = path.read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    if call == "fsync":
        monkeypatch.setattr(atomic.os, "fsync", full)
    elif call == "replace":
        monkeypatch.setattr(atomic.Path, "replace", full)
    else:
        opened = atomic.os.fdopen

        class Full:
            def __init__(self, handle: int, mode: str) -> None:
                self.stream = opened(handle, mode)
                self.write = full

            def __enter__(self):  # type: ignore[no-untyped-def]
                return self

            def __exit__(self, *_: object) -> None:
                self.stream.close()

        monkeypatch.setattr(atomic.os, "fdopen", Full)
    with pytest.raises(InputError, match="cannot be written: no space left on device"):
        save_project(full_project(), path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_is_closed_or_gone_is_a_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match="cannot be written: there is no folder"):
        save_project(Project(), tmp_path / "gone" / "a.bobdesk")

    # Tests may run as root, who may write anywhere.
    def refused(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(atomic, "new_file", refused)
    with pytest.raises(InputError, match="cannot be written: permission denied"):
        save_project(Project(), tmp_path / "a.bobdesk")
    assert list(tmp_path.iterdir()) == []


def test_what_a_crash_left_of_a_save_is_swept_away_later(tmp_path: Path) -> None:
    path = tmp_path / "a.bobdesk"
    # What a process leaves that is killed between writing and moving, and what another is writing now.
    left, new = (atomic._staged(path, b"half") for _ in range(2))
    others = tmp_path / ".another.part"
    others.write_bytes(b"not ours")
    for place in (left, others):
        os.utime(place, (1e9, 1e9))
    save_project(Project(), path)
    assert sorted(tmp_path.iterdir()) == sorted([path, new, others])


@pytest.mark.parametrize(
    "broken",
    [
        Project(name=3),  # type: ignore[arg-type]
        Project(chosen_run=4),
        Project(target_sets=()),
        Project(segments=()),
        Project(source=SourceLine("a", Polyline(bends(9)), 12.0, None)),
        replace(Project(), solver=replace(Project().solver, pgd=replace(Project().solver.pgd, max_iterations=2.5))),  # type: ignore[arg-type]
    ],
)
def test_what_could_not_be_opened_again_never_replaces_a_file(broken: Project, tmp_path: Path) -> None:
    path = tmp_path / "a.bobdesk"
    save_project(full_project(), path)
    before = path.read_bytes()
    with pytest.raises(InputError, match="could not be opened again"):
        save_project(broken, path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]
