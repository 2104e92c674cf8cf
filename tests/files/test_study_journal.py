"""Finished rows that are kept: whatever is damaged in them is solved again."""

from concurrent.futures import ThreadPoolExecutor

import pytest

from bobdesk.files.study_journal import StudyJournal, digest_of
from bobdesk.files.study_run import StudyProgress, run_study
from bobdesk.progress import finish
from bobdesk.track.study import Cell, Unready, solve_task

TASKS = [Unready(Cell("plan", count, None, "pgd", "none"), f"no {count} segments") for count in (400, 500, 600)]


@pytest.fixture
def journal(tmp_path):
    made = StudyJournal(tmp_path / "t.csv", digest_of(TASKS, "1"))
    for number, task in enumerate(TASKS):
        made.add(number, solve_task(task))
    return made


@pytest.mark.parametrize(
    "bad",
    [
        b'[-1, ["x"]]\n',
        b'["0", []]\n',
        b'[7, ["x"]]\n',
        b'[true, ["x"]]\n',
        b"[0, [1, 2]]\n",
        b"[0, null]\n",
        b"\xff\x00\n",
        b'[0, ["x"]]\n',
        b"",
        b"\n",
    ],
)
def test_a_damaged_row_is_solved_again(journal, bad):
    lines = journal.path.read_bytes().splitlines(keepends=True)
    journal.path.write_bytes(lines[0] + bad + lines[2])
    steps: list[StudyProgress] = []
    with ThreadPoolExecutor(1) as executor:
        rows = finish(run_study(TASKS, executor, journal), steps.append)
    assert rows == tuple(solve_task(task) for task in TASKS)
    told: dict[int, tuple[str, ...]] = {}
    for step in steps:
        told |= step.rows
    assert tuple(told[number] for number in range(3)) == rows
    assert (steps[-1].solved, steps[-1].total, steps[-1].left) == (3, 3, 0.0)
    assert set(journal.finished()) >= {0, 1, 2} - set(steps[0].rows)


def test_other_cells_have_another_digest():
    assert digest_of(TASKS, "1") != digest_of(TASKS[:2], "1")
    assert digest_of(TASKS, "1") != digest_of(TASKS, "2")
