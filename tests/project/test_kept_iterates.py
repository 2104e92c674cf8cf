from dataclasses import replace

import numpy as np
import pytest

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.project import derive
from bobdesk.project.kept_iterates import MOST_NUMBERS, kept_iterates
from bobdesk.project.record import record_of
from bobdesk.solve.iterates import Iterate
from bobdesk.solve.profile import make_profile
from tests.project.made_projects import ready_project


@pytest.fixture(scope="module")
def profile():
    project = ready_project()
    inputs = derive.run_inputs(project).needed()
    return make_profile(fit_centreline(inputs.polyline, inputs.fit), inputs.segments, transition=8.0)


def iterates(profile, count):
    pieces = len(profile.piece_lengths)
    return [
        Iterate(
            number, "s", np.full(pieces, 1e-3 * number), 1.0, 1.0, 1.0, 0.0, 1.0, 1.5, profile, np.zeros(pieces - 1)
        )
        for number in range(count)
    ]


def test_iterates_come_back_as_they_were(profile):
    kept = kept_iterates(record_of(iterates(profile, 150)))
    assert kept.numbers.tolist() == list(range(150))
    assert len(kept.layouts) == 1, "equal layouts are kept once"
    assert kept.gradients_of(70).tolist() == [1e-3 * 70] * len(profile.piece_lengths)
    assert kept.scale_of(70) == 1.5
    assert kept.nearest(69.6) == 70


def test_both_ends_are_kept_of_many(profile):
    kept = kept_iterates(record_of(iterates(profile, 5000)))
    assert len(kept.table) <= 200
    assert kept.numbers[[0, -1]].tolist() == [0, 4999]
    assert np.diff(kept.numbers).max() < 100


def test_many_pieces_make_fewer_iterates(profile):
    other = replace(
        profile,
        edges=np.linspace(0, profile.edges[-1], 501),
        segment_of=np.zeros(500, dtype=int),
        half_transitions=np.zeros(499),
        held=np.zeros(499, dtype=bool),
    )
    kept = kept_iterates(record_of(iterates(other, 1000)))
    assert kept.table.size <= MOST_NUMBERS
    assert kept.numbers[[0, -1]].tolist() == [0, 999]


def test_layouts_may_change_on_the_way_and_what_has_no_line_is_left_out(profile):
    found = iterates(profile, 10)
    later = replace(profile, half_transitions=profile.half_transitions / 2)
    mixed = [replace(one, profile=later) if one.number >= 5 else one for one in found]
    mixed[3] = replace(mixed[3], gradients=mixed[3].gradients * np.nan)
    mixed[7] = replace(mixed[7], profile=None)
    kept = kept_iterates(record_of(mixed))
    assert kept.numbers.tolist() == [0, 1, 2, 4, 5, 6, 8, 9]
    assert [kept.layout_of(row) for row in range(8)] == [0, 0, 0, 0, 1, 1, 1, 1]
    assert kept_iterates(record_of([replace(one, profile=None) for one in found])) is None
