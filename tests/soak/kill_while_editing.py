"""Kill a process at random moments while it edits and saves, and see what is left on the disk.

    python -m tests.soak.kill_while_editing --seconds 600

Each round forks a process that edits one project as fast as a hand can, and saves it now and then; after a
random while it is killed without warning. Then the file must be a whole old or a whole new one, and the
recovery copy must hold all edits but those of the last 0.5 s. The folders stay from round to round, so
that copies pile up as they would for a user.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from bobdesk.files.project_encoding import encode_project
from bobdesk.files.project_file import load_project, save_project
from bobdesk.files.recovery import Recovery
from bobdesk.files.recovery_store import KEPT, recover, recoverable
from bobdesk.project import edits
from bobdesk.project.project import Picture, Project
from tests.project.made_projects import bends

_LATE_S = 0.5
_PICTURE_BYTES = 3_000_000
_VERTICES = 500


def first_project(seed: int) -> Project:
    """The project before the first edit."""
    picture = random.Random(seed).randbytes(_PICTURE_BYTES)
    project = edits.open_picture(Project(), Picture(picture, "plan.png"))
    return edits.write_notes(edits.draw_line(project, bends(_VERTICES)), "0")


def edited(project: Project, number: int) -> Project:
    """The project after edit `number`: a vertex moves; the notes count."""
    index = (37 * number) % _VERTICES
    project = edits.move_vertex(project, index, 100.0 + number / 7, 200.0 + number / 3)
    return edits.write_notes(project, str(number))


def work(file: Path, data_folder: Path, seed: int, tell: int) -> None:
    """Edit and save until killed; say each thing on the pipe `tell` once it is done."""
    chance = random.Random(seed)
    recovery = Recovery(data_folder, say=lambda sentence: _tell(tell, f"said {sentence}"))
    project = first_project(seed)
    number = 0
    while True:
        number += 1
        project = edited(project, number)
        recovery.keep(project, path=file, last_edit=f"edit {number}")
        _tell(tell, f"edit {number} {time.monotonic()}")
        if chance.random() < 0.1:
            _tell(tell, f"saving {number}")
            save_project(project, file)
            _tell(tell, f"saved {number}")
        time.sleep(chance.uniform(0.0, 0.02))


def one_round(folder: Path, seed: int, chance: random.Random) -> int:
    """Kill a worker and check what is left; returns how many edits it had made."""
    file, data_folder = folder / f"track {seed}.bobdesk", folder / "data"
    reading, telling = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(reading)
            work(file, data_folder, seed, telling)
        finally:
            os._exit(1)
    os.close(telling)
    time.sleep(chance.uniform(0.05, 1.2))
    os.kill(child, signal.SIGKILL)
    killed = time.monotonic()
    os.waitpid(child, 0)
    with os.fdopen(reading) as pipe:
        told = [line.split(maxsplit=2) for line in pipe.read().splitlines()]
    complaints = [line for line in told if line[0] == "said"]
    if complaints:
        raise AssertionError(f"seed {seed}: {complaints}")
    _check_file(file, told, seed)
    # Each worker counts its edits from 1: those told are those made, but for one.
    made = max((int(line[1]) for line in told if line[0] == "edit"), default=0)
    due = max((int(line[1]) for line in told if line[0] == "edit" and float(line[2]) < killed - _LATE_S), default=0)
    _check_recovery(data_folder, file, due, made, seed)
    return made


def _check_file(file: Path, told: list[list[str]], seed: int) -> None:
    saved = [int(line[1]) for line in told if line[0] == "saved"]
    begun = [int(line[1]) for line in told if line[0] == "saving"]
    whole = saved[-1:] + begun[-1:]
    if not file.exists():
        if saved:
            raise AssertionError(f"seed {seed}: the file has vanished after it was saved")
        return
    found = load_project(file)
    if int(found.notes) not in whole:
        raise AssertionError(f"seed {seed}: the file holds edit {found.notes}, not one of {whole}")
    _check_same(found, seed)


def _check_recovery(data_folder: Path, file: Path, due: int, made: int, seed: int) -> None:
    left = recoverable(data_folder)
    if len(left) > KEPT + 1:
        raise AssertionError(f"seed {seed}: {len(left)} copies are kept")
    mine = [item for item in left if item.name == file.stem]
    if not mine:
        if due:
            raise AssertionError(f"seed {seed}: no recovery copy, though edit {due} was over 0.5 s old")
        return
    found = recover(mine[0])
    number = int(found.notes)
    if not due <= number <= made + 1:
        raise AssertionError(f"seed {seed}: edit {number} came back; {due} was due, {made} were made")
    if mine[0].last_edit != f"edit {number}" or mine[0].path != file:
        raise AssertionError(f"seed {seed}: the copy is named {mine[0]}")
    _check_same(found, seed)


_first: dict[int, Project] = {}


def _check_same(found: Project, seed: int) -> None:
    """Compare with the project made anew: the last edit of each vertex counts."""
    expected = _first[seed]
    for number in range(1, int(found.notes) + 1):
        expected = edited(expected, number)
    expected = replace(expected, notes=found.notes)
    if encode_project(found).document != encode_project(expected).document:
        raise AssertionError(f"seed {seed}: edit {found.notes} is not what it was")
    assert found.picture is not None
    assert expected.picture is not None
    if found.picture.data != expected.picture.data:
        raise AssertionError(f"seed {seed}: the picture is another")


def _tell(pipe: int, line: str) -> None:
    os.write(pipe, line.encode() + b"\n")


def main(arguments: list[str]) -> int:
    """Kill processes for a while; return 0 if nothing was ever lost."""
    parser = argparse.ArgumentParser(description="Kill BobDesk's editing and saving at random moments.")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--rounds", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    options = parser.parse_args(arguments)
    chance = random.Random(options.seed)
    ends = time.monotonic() + options.seconds
    rounds = total = 0
    np.seterr(all="raise")
    with tempfile.TemporaryDirectory() as name:
        while rounds < options.rounds and time.monotonic() < ends:
            seed = options.seed + rounds
            _first.clear()
            _first[seed] = first_project(seed)
            total += one_round(Path(name), seed, chance)
            rounds += 1
    print(f"{rounds} processes killed after {total} edits; nothing was lost (seed {options.seed})")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
