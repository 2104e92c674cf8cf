import numpy as np
import pytest

from bobdesk.track.comparison import compare

ALONG = np.linspace(0.0, 400.0, 401)
LINE = np.column_stack([ALONG, np.zeros_like(ALONG), 40 - 0.1 * ALONG])


def lifted(by):
    return LINE + np.column_stack([0 * ALONG, 0 * ALONG, by])


def test_a_line_against_itself_is_zero():
    found = compare(LINE, LINE)
    assert (found.z_rms, found.z_max, found.gradient_rms) == (0, 0, 0)
    assert (found.length_percent, found.drop_percent, found.mean_gradient_percent) == (0, 0, 0)
    assert (found.z_rms_percent, found.plan_length_percent) == (0, 0)


def test_origin_direction_and_datum_do_not_matter():
    turn = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])
    found = compare(LINE @ turn.T + [1000.0, -500.0, 1234.0], LINE)
    assert found.z_rms == pytest.approx(0, abs=1e-9)
    assert found.gradient_rms == pytest.approx(0, abs=1e-9)
    assert found.plan_length_percent == pytest.approx(0, abs=1e-9)


def test_a_known_wave_has_its_known_root_mean_square():
    # Nothing at both ends, so that the lowest point stays the end.
    found = compare(lifted(2 * np.sin(np.pi * ALONG / 400)), LINE)
    assert found.z_rms == pytest.approx(2 / np.sqrt(2) * np.sqrt(400 / 401), rel=1e-6)
    assert found.z_max == pytest.approx(2.0)
    assert found.z_max_station == pytest.approx(200.0)
    assert found.z_rms_percent == pytest.approx(100 * found.z_rms / 40)
    assert found.gradient_rms == pytest.approx(2 * np.pi / 400 / np.sqrt(2), rel=1e-3)
    assert found.drop_percent == pytest.approx(0)


def test_a_steeper_line_is_off_by_what_it_is_steeper():
    steeper = LINE * [1, 1, 1.1]
    found = compare(steeper, LINE)
    assert found.drop_percent == pytest.approx(10.0)
    assert found.gradient_rms == pytest.approx(0.01)
    assert found.length_percent == pytest.approx(100 * (np.sqrt(1 + 0.11**2) / np.sqrt(1.01) - 1))
    assert found.z_max == pytest.approx(4.0)
    assert found.z_max_station == 0


def test_equal_shares_of_unequal_plan_lengths_are_compared():
    longer = LINE * [1.02, 1, 1]
    found = compare(longer, LINE)
    assert found.plan_length_percent == pytest.approx(2.0)
    assert found.z_rms == pytest.approx(0, abs=1e-9)
    assert found.gradient_rms == pytest.approx(0.1 - 0.1 / 1.02)


def test_rows_at_other_spacings_compare_the_same():
    coarse = np.column_stack([np.interp(ALONG[::8], ALONG, column) for column in LINE.T])
    found = compare(coarse, LINE)
    assert found.z_rms == pytest.approx(0, abs=1e-12)
    assert found.length_percent == pytest.approx(0, abs=1e-9)
