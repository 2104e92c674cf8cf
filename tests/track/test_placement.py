import numpy as np
import pytest

from bobdesk.track.placement import laid_over


def line():
    along = np.linspace(0, 900, 300)
    return np.column_stack([along, 80 * np.sin(along / 120) + 0.0003 * along**2])


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_line_that_was_moved_turned_and_scaled_comes_back(mirror):
    own = line()
    turn = np.array([[np.cos(2.1), -np.sin(2.1)], [np.sin(2.1), np.cos(2.1)]])
    other = 0.37 * (own * (1.0, mirror)) @ turn.T + (1000.0, -50.0)
    assert laid_over(other, own) == pytest.approx(own, abs=1e-6)


def test_a_point_is_only_moved():
    assert laid_over(np.ones((5, 2)), line()).shape == (5, 2)
