"""Profiles drawn at random: inside the envelope, and evenly spread over all that there are."""

import numpy as np
import pytest
from scipy.stats import ks_2samp

from bobdesk.errors import TargetError
from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import envelope, smooth_envelope
from bobdesk.solve.profile_sampling import sample_profiles
from bobdesk.solve.targets import KnownElevation, Targets

KNOWN = (KnownElevation(400.0, 95.0, 1.0), KnownElevation(903.0, 40.0))


def bundle(targets, length, **others):
    return finish(sample_profiles(anchors_of(targets, length), targets, **others))


@pytest.mark.parametrize("change", [None, 0.004])
@pytest.mark.parametrize("known", [(), KNOWN, (KnownElevation(1300.0, 0.0),)])
def test_a_thousand_profiles_never_leave_the_envelope(known, change):
    targets = Targets(1510.0, 120.0, known=known)
    anchors = anchors_of(targets, 1500.0)
    drawn = finish(sample_profiles(anchors, targets, count=1000, largest_change=change, step=25.0))
    if change is None:
        band = envelope(drawn.stations, anchors, targets)
    else:
        band = finish(smooth_envelope(anchors, targets, largest_change=change, step=25.0))
    assert drawn.elevations.shape == (1000, len(band.stations))
    assert (drawn.elevations >= band.lowest - 1e-7).all()
    assert (drawn.elevations <= band.highest + 1e-7).all()
    gradients = -np.diff(drawn.elevations) / np.diff(drawn.stations)
    assert gradients.min() >= targets.min_gradient - 1e-9
    assert gradients.max() <= targets.max_gradient + 1e-9
    if change is not None:
        cells = np.diff(drawn.stations)
        assert (np.abs(np.diff(gradients)) <= change * 0.5 * (cells[1:] + cells[:-1]) + 1e-9).all()
    # They are no copies of each other.
    middle = len(band.stations) // 2
    apart = drawn.elevations.std(axis=0)
    assert apart[middle] > 0.01 * (band.highest - band.lowest)[middle]
    assert (apart[-1] > 1.0) == (len(known) == 1)


def rejected_until(targets, length, cells, change, wanted=4000):
    """Draw gradients of all cells but the last evenly, and keep what meets everything."""
    rng = np.random.default_rng(5)
    step = length / cells
    kept = []
    while sum(len(part) for part in kept) < wanted:
        gradients = rng.uniform(targets.min_gradient, targets.max_gradient, (400_000, cells - 1))
        last = targets.drop / step - gradients.sum(axis=1)
        gradients = np.column_stack([gradients, last])
        heights = targets.drop - step * np.cumsum(gradients, axis=1)
        fits = (last >= targets.min_gradient) & (last <= targets.max_gradient) & (heights >= -1e-9).all(axis=1)
        if change is not None:
            fits &= (np.abs(np.diff(gradients)) <= change * step).all(axis=1)
        for item in targets.known:
            row = round(item.station / step) - 1
            fits &= np.abs(heights[:, row] - item.elevation) <= item.tolerance
        kept.append(heights[fits, :-1])
    return np.concatenate(kept)[:wanted]


@pytest.mark.parametrize(
    ("known", "change"),
    [((), None), ((), 0.006), ((KnownElevation(40.0, 3.0, 1.0),), None), ((KnownElevation(20.0, 5.0, 0.5),), 0.01)],
)
def test_each_station_is_distributed_as_by_rejection(known, change):
    targets = Targets(61.0, 5.0, known=known)
    true = rejected_until(targets, 60.0, 6, change)
    drawn = bundle(targets, 60.0, count=4000, largest_change=change)
    assert drawn.stations == pytest.approx(np.arange(0, 61, 10))
    for column in range(5):
        # 4,000 against 4,000: a difference of 0.043 would come by chance once in a thousand.
        assert ks_2samp(true[:, column], drawn.elevations[:, column + 1]).statistic < 0.043
    between = np.cov(true.T)
    np.testing.assert_allclose(np.cov(drawn.elevations[:, 1:-1].T), between, atol=0.1 * np.diag(between).max())


def test_long_lines_forget_where_they_began():
    targets = Targets(1510.0, 120.0)
    drawn = bundle(targets, 1500.0, count=400)
    later = bundle(targets, 1500.0, count=400, seed=2)
    for column in range(15, 150, 15):
        assert ks_2samp(drawn.elevations[:, column], later.elevations[:, column]).pvalue > 1e-4
    # Far from the limits the gradients of the cells are nearly independent and even: a bridge of known width.
    gradients = -np.diff(drawn.elevations) / 10
    spread = gradients.std()
    middle = drawn.elevations[:, 75].std()
    assert middle == pytest.approx(spread * 10 * np.sqrt(75 * 75 / 150), rel=0.15)


@pytest.mark.parametrize("tolerance", [0.001, 0.5])
def test_a_small_tolerance_does_not_hold_the_rest_of_the_line(tolerance):
    # From the lowest point at 0 or a little more, gradients are drawn evenly, and what dips is thrown away.
    rng = np.random.default_rng(7)
    heights = rng.uniform(0, tolerance, 400_000)
    fits = np.ones(len(heights), dtype=bool)
    for _ in range(14):
        heights -= 10 * rng.uniform(-0.2, 0.25, len(heights))
        fits &= heights >= 0
    targets = Targets(710.0, 55.0, known=(KnownElevation(560.0, 0.0, tolerance),))
    drawn = bundle(targets, 700.0, count=2000)
    # 2,000 against 20,000 and more: a difference of 0.046 would come by chance once in a thousand.
    assert fits.sum() > 20_000
    assert ks_2samp(heights[fits], drawn.elevations[:, -1]).statistic < 0.046


def test_the_seed_decides_and_quantiles_are_in_order():
    targets = Targets(1510.0, 120.0, known=KNOWN)
    one, two = (bundle(targets, 1500.0, count=20, seed=3, step=50.0) for _ in range(2))
    np.testing.assert_array_equal(one.elevations, two.elevations)
    low, middle, high = one.quantiles(0.05, 0.5, 0.95)
    assert (low <= middle).all()
    assert (middle <= high).all()
    assert low[0] == high[0] == 120


def test_what_contradicts_itself_is_refused():
    with pytest.raises(TargetError, match="no profile within the limits"):
        bundle(Targets(1510.0, 120.0, max_gradient=0.07), 1500.0)
