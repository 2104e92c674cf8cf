"""Where one more known elevation would help most."""

from dataclasses import replace

import numpy as np
import pytest

from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import envelope
from bobdesk.solve.next_elevation import next_elevation
from bobdesk.solve.targets import KnownElevation, Targets
from tests.solve.made_plans import plan_of, real_line, run_pgd

TARGETS = Targets(1010.0, 80.0, min_gradient=-0.05, max_gradient=0.25)


def test_an_even_line_is_cut_in_the_middle_and_the_band_is_that_of_the_envelope():
    anchors = anchors_of(TARGETS, 1000.0)
    found = next_elevation(anchors, TARGETS, estimate=(np.array([0.0, 1000.0]), np.array([80.0, 0.0])))
    assert found.station == pytest.approx(500, abs=10)
    known = KnownElevation(found.station, 80 - 0.08 * found.station)
    targets = replace(TARGETS, known=(known,))
    after = envelope(found.stations, anchors_of(targets, 1000.0), targets)
    np.testing.assert_allclose(found.band_after.lowest, after.lowest, atol=1e-9)
    np.testing.assert_allclose(found.band_after.highest, after.highest, atol=1e-9)
    assert found.gain == pytest.approx(found.band.mean_width - after.mean_width)
    assert found.widths[found.best] == found.widths.min()


def test_a_stretch_near_a_limit_needs_none():
    # Nothing is open in the first 400 m: they fall by nearly as much as they may.
    targets = replace(TARGETS, drop=140.0, known=(KnownElevation(400.0, 41.0),))
    assert next_elevation(anchors_of(targets, 1000.0), targets).station > 500


def test_a_scale_moves_the_station():
    true = next_elevation(anchors_of(TARGETS, 1000.0), TARGETS)
    small = next_elevation(anchors_of(TARGETS, 500.0), TARGETS, scale=2.0)
    assert small.station == true.station
    assert small.gain == pytest.approx(true.gain)


@pytest.mark.parametrize("name", ["mugello", "franciacorta", "sa_calobra"])
def test_three_advised_elevations_are_worth_three_evenly_spaced_ones(name):
    true = real_line(name)
    centreline, segments = plan_of(true.plan)
    targets = true.targets()
    for _ in range(3):
        line = run_pgd(centreline, segments, targets).line
        anchors = anchors_of(targets, centreline.length)
        advice = next_elevation(anchors, targets, estimate=(line.stations, line.elevations))
        share = advice.station / centreline.length * true.stations[-1]
        item = KnownElevation(advice.station, float(np.interp(share, true.stations, true.elevations)))
        targets = replace(targets, known=(*targets.known, item))
    advised = true.rms_percent(run_pgd(centreline, segments, targets).line)
    even = true.rms_percent(run_pgd(centreline, segments, true.targets(known=3)).line)
    assert advised < 1.05 * even
