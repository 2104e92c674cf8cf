"""The error budget, and whether the truth lies inside as often as it says."""

import numpy as np
import pytest

from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.openness import openness
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.error_budget import error_budget
from bobdesk.track.input_errors import InputErrors
from bobdesk.track.rounding import half_unit
from tests.solve.made_plans import made
from tests.track.made_truth import covered


@pytest.mark.parametrize(
    ("figure", "half"), [(1278.0, 0.5), (149.3, 0.05), (1700.0, 0.5), (0.25, 0.005), (1e6, 0.5), (120.125, 0.0005)]
)
def test_half_a_unit_of_the_last_place(figure, half):
    assert half_unit(figure) == pytest.approx(half)


@pytest.mark.parametrize("conditions", [{}, {"known": 3}, {"unknown_scale": True}], ids=str)
def test_the_truth_lies_inside_as_often_as_it_says(conditions):
    shares = np.array([covered(seed, **conditions)[1:] for seed in range(10)])
    length, elevation, gradient = shares.mean(axis=0)
    assert length >= 0.9  # ten tracks: one may fall out; `make benchmark` takes forty
    assert elevation >= 0.88
    assert 0.90 <= gradient <= 0.99


def budget(errors, targets=None):
    line, segments = made(3)
    drop = 0.09 * line.length
    targets = targets or Targets(float(np.hypot(line.length, drop)) + 0.6, drop)
    return finish(error_budget(line, segments, targets, errors))


def test_each_source_is_a_row_and_they_add_by_squares():
    found = budget(InputErrors(scale=0.002, digitising=0.3, length_rounding=0.05, drop_rounding=0.5))
    assert [share.source for share in found.shares] == [
        "digitising", "calibration", "rounding of the length", "rounding of the drop", "left open by the data",
        "all together",
    ]  # fmt: skip
    length = found.stations[-1]
    assert found.shares[1].plan_length == pytest.approx(1.96 * 0.002 * length)
    assert found.shares[0].plan_length == pytest.approx(1.96 * 0.3)
    *parts, total = found.shares
    for name in ("plan_length", "scale", "elevation", "gradient"):
        assert getattr(total, name) == pytest.approx(np.sqrt(sum(getattr(part, name) ** 2 for part in parts)))
    # The start is at the drop: as sure as that.
    assert found.elevation[0] == pytest.approx(1.96 * 0.5 / np.sqrt(3), rel=0.01)
    assert found.elevation[-1] == pytest.approx(0, abs=1e-3)
    assert f"± {total.plan_length:.1f} m" in found.sentence
    assert "what the data leave open" in found.sentence


def test_sure_figures_leave_what_is_open():
    found = budget(InputErrors())
    assert all(share.elevation == 0 for share in found.shares[:-2])
    assert found.shares[-1].elevation == found.shares[-2].elevation > 0
    assert "As 3D length" not in found.sentence


def test_an_unknown_scale_has_a_plus_minus():
    line, segments = made(3)
    drop = 0.09 * line.length
    targets = Targets(float(np.hypot(line.length, drop)) + 0.6, drop, unknown_scale=True)
    found = finish(error_budget(line, segments, targets, InputErrors(length_rounding=0.5, drop_rounding=0.05)))
    by_source = {share.source: share for share in found.shares}
    assert "calibration" not in by_source
    assert by_source["rounding of the length"].scale == pytest.approx(
        1.96 * 0.5 / np.sqrt(3) / targets.length, rel=0.05
    )
    assert by_source["usual swing of the gradient"].scale > 0


def test_known_elevations_close_what_is_open():
    targets = Targets(1510.0, 120.0)
    wide = openness(anchors_of(targets, 1500.0), swing=0.03)
    known = tuple(KnownElevation(at, 120 - 0.08 * at, 0.3) for at in (400.0, 800.0, 1100.0))
    tight = openness(anchors_of(Targets(1510.0, 120.0, known=known), 1500.0), swing=0.03)
    assert tight.elevation.max() < 0.6 * wide.elevation.max()
    assert np.interp(800.0, tight.stations, tight.elevation) == pytest.approx(0.3 / np.sqrt(3), rel=0.1)
    np.testing.assert_allclose(wide.elevation[[0, -1]], 0, atol=1e-3)


def test_an_end_of_which_nothing_is_known_is_left_open():
    lowest = KnownElevation(1300.0, 0.0)
    free = openness(anchors_of(Targets(1510.0, 120.0, known=(lowest,)), 1500.0), swing=0.03)
    known = (lowest, KnownElevation(1500.0, 10.0))
    held = openness(anchors_of(Targets(1510.0, 120.0, known=known), 1500.0), swing=0.03)
    assert free.elevation[-1] > 3.0
    assert held.elevation[-1] == pytest.approx(0, abs=1e-3)
    before = free.stations <= 1300.0
    np.testing.assert_allclose(free.elevation[before], held.elevation[before], atol=0.2)
