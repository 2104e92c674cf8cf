"""Where one more known elevation would help most."""

from dataclasses import replace

import numpy as np
import pytest

from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import envelope
from bobdesk.solve.next_elevation import next_elevation
from bobdesk.solve.profile_sampling import sample_profiles
from bobdesk.solve.targets import KnownElevation, Targets
from tests.solve.made_plans import plan_of, real_line, run_pgd

TARGETS = Targets(1010.0, 80.0, min_gradient=-0.05, max_gradient=0.25)


@pytest.fixture
def coarse(monkeypatch):
    """Cells of 25 m and fewer profiles: what holds for them holds for finer ones and more."""
    from bobdesk.solve import next_elevation as module

    monkeypatch.setattr(module, "_MOST_CELLS", 40)
    monkeypatch.setattr(module, "_PROFILES", 300)


def advice(targets, length=1000.0, **others):
    return finish(next_elevation(anchors_of(targets, length), targets, **others))


def test_a_line_is_cut_near_its_middle_and_the_band_is_that_of_the_envelope(coarse):
    found = advice(TARGETS, estimate=(np.array([0.0, 1000.0]), np.array([80.0, 0.0])))
    assert found.station == pytest.approx(500, abs=120)
    known = KnownElevation(found.station, 80 - 0.08 * found.station)
    targets = replace(TARGETS, known=(known,))
    after = envelope(found.stations, anchors_of(targets, 1000.0), targets)
    np.testing.assert_allclose(found.band_after.lowest, after.lowest, atol=1e-9)
    np.testing.assert_allclose(found.band_after.highest, after.highest, atol=1e-9)
    assert found.gain == pytest.approx(found.band.mean_width - after.mean_width)
    assert found.spreads[found.best] == found.spreads.min() == found.spread_after
    assert 0 < found.spread_after < found.spread


def test_what_is_promised_is_what_profiles_through_the_known_elevation_show(coarse):
    found = advice(TARGETS)
    anchors = anchors_of(TARGETS, 1000.0)
    before = finish(sample_profiles(anchors, TARGETS, count=400, seed=7, largest_change=0.002, step=25.0))
    height = float(np.interp(found.station, before.stations, before.elevations.mean(axis=0)))
    targets = replace(TARGETS, known=(KnownElevation(found.station, height),))
    after = finish(
        sample_profiles(anchors_of(targets, 1000.0), targets, count=400, seed=8, largest_change=0.002, step=25.0)
    )

    def spread(bundle):
        return np.sqrt(np.trapezoid(bundle.elevations.var(axis=0), bundle.stations) / 1000.0)

    assert spread(before) == pytest.approx(found.spread, rel=0.1)
    assert spread(after) == pytest.approx(found.spread_after, rel=0.25)


def test_a_stretch_near_a_limit_needs_none(coarse):
    # Nothing is open in the first 400 m: they fall by nearly as much as they may.
    targets = replace(TARGETS, drop=140.0, known=(KnownElevation(400.0, 41.0),))
    assert advice(targets).station > 500


def test_known_elevations_that_need_steeper_changes_are_met(coarse):
    # 100 m at 1 % beside 100 m at 24 %: no change of 2 % in 10 m does that.
    targets = replace(TARGETS, known=(KnownElevation(100.0, 79.0), KnownElevation(120.0, 75.0)))
    assert 0 < advice(targets).station < 1000


def test_the_users_own_change_is_kept_to(coarse):
    targets = replace(TARGETS, known=(KnownElevation(100.0, 79.0), KnownElevation(120.0, 75.0)))
    with pytest.raises(TargetError):
        advice(targets, largest_change=0.0002)
    assert advice(TARGETS, largest_change=0.0002).spread < advice(TARGETS).spread


def test_a_scale_moves_the_station(coarse):
    true = advice(TARGETS)
    small = advice(TARGETS, 500.0, scale=2.0)
    assert small.station == pytest.approx(true.station)
    assert small.gain == pytest.approx(true.gain)


def test_the_same_data_give_the_same_advice(coarse):
    assert advice(TARGETS).station == advice(TARGETS).station


@pytest.mark.parametrize("name", ["mugello", "franciacorta"])  # `make benchmark` takes all lines
def test_three_advised_elevations_are_worth_more_than_three_evenly_spaced_ones(name):
    true = real_line(name)
    centreline, segments = plan_of(true.plan)
    targets = true.targets()
    for _ in range(3):
        line = run_pgd(centreline, segments, targets).line
        found = advice(targets, centreline.length, estimate=(line.stations, line.elevations))
        share = found.station / centreline.length * true.stations[-1]
        item = KnownElevation(found.station, float(np.interp(share, true.stations, true.elevations)))
        targets = replace(targets, known=(*targets.known, item))
    advised = true.rms_percent(run_pgd(centreline, segments, targets).line)
    even = true.rms_percent(run_pgd(centreline, segments, true.targets(known=3)).line)
    assert advised < even
