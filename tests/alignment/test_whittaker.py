import numpy as np
import pytest

from bobdesk.alignment.whittaker import whittaker

STATIONS = np.arange(600.0)


@pytest.mark.parametrize("wavelength", [5.0, 15.0, 60.0])
def test_straights_and_parabolas_are_kept(wavelength):
    values = np.column_stack([3 - 0.2 * STATIONS, 1 + 0.1 * STATIONS - 0.002 * STATIONS**2])
    smoothed = whittaker(values, spacing=1.0, wavelength=wavelength)
    np.testing.assert_allclose(smoothed, values, rtol=0, atol=1e-9 * wavelength**2)


def test_it_solves_the_normal_equations():
    count, spacing, wavelength = 40, 1.3, 9.0
    values = np.random.default_rng(2).standard_normal((count, 2))
    differences = np.diff(np.eye(count), 3, axis=0)
    penalty = (wavelength / (2 * np.pi * spacing)) ** 6
    expected = np.linalg.solve(np.eye(count) + penalty * differences.T @ differences, values)
    np.testing.assert_allclose(whittaker(values, spacing=spacing, wavelength=wavelength), expected, atol=1e-11)


def passed(wave, *, wavelength, spacing=0.25):
    """Return the share of a cosine wave's amplitude that is left in the middle of a long line."""
    stations = np.arange(0.0, 40 * max(wave, wavelength), spacing)
    cosine = np.cos(2 * np.pi * stations / wave)
    inner = slice(len(stations) // 3, 2 * len(stations) // 3)
    smoothed = whittaker(cosine, spacing=spacing, wavelength=wavelength)
    return float(smoothed[inner] @ cosine[inner] / (cosine[inner] @ cosine[inner]))


@pytest.mark.parametrize("wavelength", [10.0, 15.0, 20.0])
def test_a_wave_of_the_wavelength_keeps_half(wavelength):
    assert passed(wavelength, wavelength=wavelength) == pytest.approx(0.5, abs=0.002)
    assert passed(3 * wavelength, wavelength=wavelength) == pytest.approx(1 / (1 + 3**-6), abs=0.002)
    assert passed(wavelength / 3, wavelength=wavelength) == pytest.approx(1 / (1 + 3**6), abs=0.002)


def test_the_result_does_not_depend_on_the_spacing():
    waves = [
        (stations, whittaker(np.sin(stations / 4) + np.sin(stations), spacing=spacing, wavelength=15.0))
        for spacing in (0.125, 0.25, 0.5)
        for stations in [np.arange(0.0, 300.0 + 1e-9, spacing)]
    ]
    finest = waves[0]
    for stations, smoothed in waves[1:]:
        apart = np.abs(smoothed - np.interp(stations, *finest))
        assert apart[(stations > 40) & (stations < 260)].max() < 2e-3


def test_a_circle_shrinks_by_no_more_than_is_said():
    angles = np.arange(0.0, 8 * np.pi, 1 / 15.0)
    points = 15.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    smoothed = whittaker(points, spacing=1.0, wavelength=15.0)
    radii = np.hypot(*smoothed[100:-100].T)
    # The circle is a wave of length 2 pi R; what is lost is 1 / (1 + (2 pi R / wavelength)^6) of it.
    assert 1 - radii.mean() / 15 == pytest.approx((2 * np.pi) ** -6, rel=0.02)


def test_nothing_to_smooth_is_a_copy():
    values = np.array([1.0, 5.0, 2.0, 8.0, 3.0])
    same = whittaker(values, spacing=1.0, wavelength=0.0)
    np.testing.assert_array_equal(same, values)
    assert same is not values
    np.testing.assert_array_equal(whittaker(values[:3], spacing=1.0, wavelength=15.0), values[:3])
