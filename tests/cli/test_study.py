"""Studies: every combination once, resumable, on processes and on a cluster, failures as rows."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import distributed
import pandas as pd
import psutil
import pytest

from bobdesk.files.study_journal import StudyJournal
from bobdesk.files.study_run import run_study
from bobdesk.track import study
from tests.cli.calls import TARGETS

ROOT = Path(__file__).parents[2]
STUDY = ("--counts", "6,9", "--height-weights", "0.5,1.5", "--methods", "pgd,published,lbfgsb", "--workers", "2")


@pytest.fixture
def finished(call):
    said = call("study", call.plan, *TARGETS, *STUDY, "-o", call.path("t.csv"))
    assert said.status == 0, said.err
    return call


def test_every_combination_is_a_row_in_order(finished):
    rows = pd.read_csv(finished.path("t.csv"), keep_default_na=False)
    assert list(rows.columns) == list(study.STUDY_COLUMNS)
    named = rows[["wanted_segments", "height_weight", "method"]].astype(str).agg("/".join, axis=1)
    each = ["pgd", "published", "lbfgsb"]
    expected = [
        f"{count}/{weight}/{method}"
        for count in (6, 9)
        for method in each
        for weight in (("",) if method == "pgd" else ("0.5", "1.5"))
    ]
    assert list(named) == expected
    assert (rows.segments == rows.wanted_segments).all()
    pgd = rows[rows.method == "pgd"]
    assert pgd.drop_percent.astype(float).abs().max() < 1e-6
    # The sample has surveyed elevations.
    assert rows.z_rms_m.astype(float).between(0.1, 20).all()
    assert not finished.path("t.csv.unfinished").exists()


def test_figures_below_zero_are_numbers_in_the_table(call):
    table = call.path("t.csv")
    targets = ("--length", "730", "--drop", "36")
    said = call("study", call.plan, *targets, "--methods", "pgd,published", "--workers", 1, "-o", table)
    assert said.status == 0, said.err
    rows = pd.read_csv(table)
    assert (rows.length_percent < -1).all()
    assert (rows.status == "not met").all()
    assert rows.missed.str.contains("length 3.[0-9]* % too short").all()
    assert "-0.000000" not in table.read_text()


def test_sets_of_known_elevations_are_rows_of_methods_that_hold_them(call):
    sets = ("--known-set", "none", "--known-set", "350:14", "--known-set", "200:21 500:7")
    said = call(
        "study", call.plan, *TARGETS, *sets, "--methods", "pgd,published", "--workers", 1, "-o", call.path("t.csv")
    )
    assert said.status == 0, said.err
    rows = pd.read_csv(call.path("t.csv"), keep_default_na=False)
    assert list(rows.known) == ["none", "350:14", "200:21 500:7", ""]


def test_a_set_of_known_elevations_is_one_however_it_is_written(call):
    spelled = ["500:7;200:21", "200:21.0 500:7.00", "200:21; 500:7:0 200:21", "none", "NONE"]
    sets = [word for text in spelled for word in ("--known-set", text)]
    said = call("study", call.plan, *TARGETS, *sets, "--counts", "6", "--workers", 1, "-o", call.path("t.csv"))
    assert said.status == 0, said.err
    rows = pd.read_csv(call.path("t.csv"), keep_default_na=False)
    assert list(rows.known) == ["200:21 500:7", "none"]


def test_a_set_that_names_no_elevation_is_refused(call):
    arguments = ("study", call.plan, *TARGETS, "-o", call.path("t.csv"), "--known-set", ";")
    assert "STATION:ELEVATION" in call.refused(*arguments, status=2)


def test_a_cell_that_fails_is_a_row_with_its_reason(call):
    said = call(
        "study", call.plan, *TARGETS, "--known-set", "none", "--known-set", "20:5", "--workers", 1,
        "-o", call.path("t.csv"),
    )  # fmt: skip
    assert said.status == 0, said.err
    assert "1 of them failed" in said.out
    rows = pd.read_csv(call.path("t.csv"), keep_default_na=False)
    assert list(rows.status) == ["met", "failed"]
    assert "between 0 m and 20 m the elevation must fall by 25.00 m" in rows.message[1]


def test_a_killed_study_goes_on_and_its_table_is_the_same(finished, call):
    whole = finished.path("t.csv").read_bytes()
    output = call.path("again.csv")
    arguments = [sys.executable, "-m", "bobdesk", "study", str(call.plan), *TARGETS, *STUDY, "-o", str(output)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(arguments, env=environment, stderr=subprocess.DEVNULL, start_new_session=True)
    journal = output.with_name("again.csv.unfinished")
    deadline = time.monotonic() + 60
    while not (journal.exists() and journal.read_bytes().count(b"\n") >= 4) and time.monotonic() < deadline:
        if process.poll() is not None:
            break
        time.sleep(0.005)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    if journal.exists():
        with journal.open("ab") as file:  # as a line that was cut short
            file.write(b'[7, ["plan", ')
        said = call("study", call.plan, *TARGETS, *STUDY, "-o", output)
        assert said.status == 0, said.err
        assert "rows that were solved before are kept" in said.err
    assert output.read_bytes() == whole
    assert not journal.exists()


def test_a_stopped_study_says_where_its_rows_are_kept(call, monkeypatch):
    def stopped(tasks, executor, journal):
        journal.add(0, study.solve_task(tasks[0]))
        yield
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("bobdesk.cli.study.run_study", stopped)
        said = call("study", call.plan, *TARGETS, *STUDY, "-o", call.path("t.csv"))
    assert said.status == 130
    assert "kept in" in said.err
    assert not call.path("t.csv").exists()
    again = call("study", call.plan, *TARGETS, *STUDY, "-o", call.path("t.csv"))
    assert again.status == 0
    assert "note: rows that were solved before are kept: 1" in again.err
    assert not call.path("t.csv.unfinished").exists()


def test_the_rows_of_another_study_are_not_thrown_away_unasked(call):
    journal = StudyJournal(call.path("t.csv"), "another")
    journal.add(0, ("a", "b"))
    before = journal.path.read_bytes()
    said = call.refused("study", call.plan, *TARGETS, "--counts", "5", "-o", call.path("t.csv"), status=3)
    assert "t.csv.unfinished holds the finished rows of another study" in said
    assert journal.path.read_bytes() == before
    assert not call.path("t.csv").exists()
    again = call("study", call.plan, *TARGETS, "--counts", "5", "-o", call.path("t.csv"), "--restart")
    assert again.status == 0, again.err
    assert not journal.path.exists()


@pytest.mark.parametrize("left", [b"", b"{", b'{"study": "1234'])
def test_a_journal_whose_head_was_cut_short_is_nobodys(call, left):
    journal = call.path("t.csv.unfinished")
    journal.write_bytes(left)
    said = call("study", call.plan, *TARGETS, "--counts", "5", "-o", call.path("t.csv"))
    assert said.status == 0, said.err
    assert not journal.exists()


def test_an_empty_set_of_known_elevations_is_written_none(call):
    arguments = ("study", call.plan, *TARGETS, "--counts", "5", "-o", call.path("t.csv"), "--known-set")
    assert "none for an empty set" in call.refused(*arguments, " ", status=2)


def test_rows_of_another_study_are_not_used(tmp_path):
    table = tmp_path / "t.csv"
    journal = StudyJournal(table, "one")
    journal.add(0, ("a", "b"))
    journal.add(3, ("c", "ä"))
    assert StudyJournal(table, "one").finished() == {0: ("a", "b"), 3: ("c", "ä")}
    other = StudyJournal(table, "two")
    assert other.finished() == {}
    other.add(1, ("x",))
    assert StudyJournal(table, "two").finished() == {1: ("x",)}
    assert StudyJournal(table, "one").finished() == {}


def test_a_study_is_refused_before_anything_is_solved(call):
    out = ("-o", call.path("t.csv"))
    assert "--methods must be of" in call.refused("study", call.plan, *TARGETS, "--methods", "magic", *out, status=2)
    assert "numbers of segments" in call.refused("study", call.plan, *TARGETS, "--counts", "0", *out, status=2)
    assert "weights such as" in call.refused("study", call.plan, *TARGETS, "--height-weights", "x", *out, status=2)
    assert "--known-set takes" in call.refused("study", call.plan, *TARGETS, "--known-set", "3", *out, status=2)
    assert "same name" in call.refused("study", call.plan, call.plan, *TARGETS, *out, status=2)
    assert "overwrite an input" in call.refused("study", call.plan, *TARGETS, "-o", call.plan, status=2)


def test_the_picture_of_a_study(call):
    picture = call.path("p.png")
    said = call(
        "study", call.plan, *TARGETS, "--counts", "6,9", "--methods", "pgd,published", "--workers", 1,
        "-o", call.path("t.csv"), "--picture", picture,
    )  # fmt: skip
    assert said.status == 0, said.err
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_a_cluster_that_does_not_answer_is_one_sentence(call):
    arguments = ("study", call.plan, *TARGETS, "-o", call.path("t.csv"), "--dask", "nonsense://nowhere")
    assert "no Dask scheduler answers" in call.refused(*arguments, status=3)


@pytest.mark.parametrize("address", ["nonsense://nowhere", "nowhere.invalid"])
def test_an_address_of_no_kind_is_one_sentence_to_the_very_end_of_the_program(call, address):
    arguments = ("study", call.plan, *TARGETS, "-o", call.path("t.csv"), "--dask", address)
    ended = subprocess.run(
        [sys.executable, "-m", "bobdesk", *map(str, arguments)], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert ended.returncode == 3
    assert ended.stderr == f"bobdesk: no Dask scheduler answers at {address}.\n"


# What the cluster itself warns of at its end is its own affair.
@pytest.mark.filterwarnings("ignore")
def test_a_local_cluster_of_two_workers_gives_the_same_table(finished, call, monkeypatch):
    # Its workers are processes of their own, which find the package where this one does.
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, scheduler_port=0,
        local_directory=call.path("cluster"),
    ) as cluster:  # fmt: skip
        with distributed.Client(cluster, set_as_default=False) as client:
            pids = client.run(os.getpid)
        assert len({os.getpid(), *pids.values()}) == 3
        said = call("study", call.plan, *TARGETS, *STUDY, "-o", call.path("d.csv"), "--dask", cluster.scheduler_address)
    assert said.status == 0, said.err
    assert call.path("d.csv").read_bytes() == finished.path("t.csv").read_bytes()


def test_closing_a_study_starts_no_other_cell(tmp_path):
    class Slow:
        def __init__(self):
            self.futures = []

        def submit(self, function, task):
            from concurrent.futures import Future

            self.futures.append(Future())
            return self.futures[-1]

    executor = Slow()
    job = run_study([None] * 5, executor, ahead=3)
    next(job)
    next(job)
    job.close()
    assert [future.cancelled() for future in executor.futures] == [True] * 3


def test_a_plan_that_has_not_so_many_segments_is_a_row_that_says_so(call):
    said = call("study", call.plan, *TARGETS, "--counts", "400,6-8:2", "--workers", 1, "-o", call.path("t.csv"))
    assert said.status == 0, said.err
    rows = pd.read_csv(call.path("t.csv"), keep_default_na=False)
    assert list(rows.wanted_segments) == [400, 6, 8]
    assert list(rows.status == "failed") == [True, False, False]
    assert "400 segments cannot be told apart" in rows.message[0]
    assert "cannot be told apart" in call.refused(
        "study", call.plan, *TARGETS, "--counts", "400", "-o", call.path("u.csv"), status=3
    )


def test_workers_end_with_the_command_however_it_ends(call):
    output = call.path("long.csv")
    arguments = [sys.executable, "-m", "bobdesk", "study", str(call.plan), *TARGETS, "--counts", "5-15"]
    arguments += ["--methods", "de", "--workers", "2", "-o", str(output)]
    process = subprocess.Popen(arguments, env={**os.environ, "PYTHONPATH": str(ROOT)}, stderr=subprocess.DEVNULL)
    journal = output.with_name("long.csv.unfinished")
    deadline = time.monotonic() + 60
    while not journal.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    workers = [each for each in psutil.Process(process.pid).children() if "spawn_main" in " ".join(each.cmdline())]
    assert len(workers) == 2
    process.kill()
    process.wait()
    gone, alive = psutil.wait_procs(workers, timeout=10)
    assert not alive, gone
