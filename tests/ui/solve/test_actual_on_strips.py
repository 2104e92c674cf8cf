"""The axes of the strips hold the actual track, but not the spikes of single bad points in it."""

import numpy as np
import pytest

from bobdesk.project import edits
from bobdesk.project.project import ActualTrack
from bobdesk.ui.solve.result_strips import ResultStrips
from bobdesk.ui.strips.contents import without_spikes
from bobdesk.ui.strips.strip_stack import StripStack


@pytest.fixture
def stack(desk, opened, solving, qtbot, idle):
    """Strips with a run."""
    made = StripStack(desk)
    qtbot.addWidget(made)
    ResultStrips(desk, made)
    made.resize(900, 330)
    made.show()
    solving.run()
    idle()
    return made


def compare(desk, elevations, idle):
    along = np.arange(len(elevations), dtype=float)
    points = np.column_stack([along, np.zeros_like(along), elevations])
    desk.session.apply("Compare", lambda project: edits.compare_with(project, ActualTrack("a.csv", points)))
    idle()


def steep(peak):
    """Elevations, 1 m apart, of a track of 8 % with 40 m at `peak`."""
    gradients = np.full(700, 0.08)
    gradients[300:340] = peak
    fallen = np.concatenate([[0.0], np.cumsum(gradients)])
    return fallen[-1] - fallen


def test_the_axis_holds_a_steeper_actual_track_and_its_climb(desk, stack, idle):
    low, high = stack.gradient.usual_range()
    assert high < 40
    assert low > -30
    compare(desk, steep(0.45), idle)
    assert 45 < stack.gradient.usual_range()[1] < 55
    compare(desk, steep(-0.35), idle)
    assert -45 < stack.gradient.usual_range()[0] < -35
    assert stack.gradient.usual_range()[1] == pytest.approx(high, abs=5)
    desk.session.apply("Alone", edits.compare_with_nothing)
    assert stack.gradient.usual_range() == (low, high)


def test_a_single_bad_elevation_presses_nothing_flat(desk, stack, idle):
    compare(desk, steep(0.12), idle)
    ranges = stack.gradient.usual_range(), stack.elevation.usual_range()
    spoilt = steep(0.12)
    spoilt[100] += 50.0
    spoilt[600] += 900.0
    compare(desk, spoilt, idle)
    assert stack.gradient.curves["actual"].values.max() > 20
    assert stack.gradient.usual_range() == pytest.approx(ranges[0], abs=0.5)
    assert stack.elevation.usual_range() == pytest.approx(ranges[1], abs=1.0)


@pytest.mark.parametrize("apart", [0.01, 1.0, 5.0, 200.0])
def test_what_holds_for_a_while_stays_however_far_the_points_lie_apart(apart):
    stations = apart * np.arange(200.0)
    values = np.zeros(200)
    values[50:80] = 1.0
    values[120:122] = 7.0
    found = without_spikes(stations, values)
    assert (found.min(), found.max()) == (0.0, 1.0)


def test_of_four_points_all_count():
    values = np.array([0.0, 3.0, 0.0, 1.0])
    assert without_spikes(np.arange(4.0), values) is values
