import numpy as np

from bobdesk.ui.plots.decimated import decimated


def test_a_short_curve_is_left_alone():
    x = np.arange(100.0)
    assert decimated(x, x)[1] is x


def test_every_peak_of_a_long_curve_is_kept():
    random = np.random.default_rng(0)
    x = np.arange(1_000_003.0)
    y = random.normal(size=len(x))
    y[123_456], y[999_999] = 50.0, -60.0
    shown_x, shown_y = decimated(x, y)
    assert len(shown_x) <= 2000
    assert (np.diff(shown_x) >= 0).all()
    assert (shown_y.max(), shown_y.min()) == (50.0, -60.0)
    assert (y[shown_x.astype(int)] == shown_y).all()
