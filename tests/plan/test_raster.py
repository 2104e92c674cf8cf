"""Pixels as numbers: averages, colours and samples against values worked out by hand or by a second way."""

from __future__ import annotations

import numpy as np
import pytest

from bobdesk.plan.raster import area_average, halved, halving_pyramid, lab, sample
from bobdesk.plan.stages import at_once
from bobdesk.plan.work_copy import work_copy


def test_area_average_is_that_of_the_blocks() -> None:
    pixels = np.random.default_rng(1).integers(0, 256, (60, 84, 3)).astype(np.uint8)
    half = at_once(area_average(pixels, height=30, width=42))
    blocks = pixels.reshape(30, 2, 42, 2, 3).mean(axis=(1, 3))
    # Pillow rounds to whole values twice, across and down.
    assert np.abs(half - blocks).max() <= 1.0
    odd = at_once(area_average(pixels, height=17, width=23))
    assert abs(odd.mean() - pixels.mean()) < 0.6


def test_strips_do_not_show_in_the_average() -> None:
    ramp = np.repeat(np.linspace(0, 255, 4000)[:, None], 1200, axis=1).astype(np.uint8)
    copy = at_once(area_average(ramp, height=1333, width=400))
    assert np.abs(np.diff(copy[:, 7, 0])).max() <= 1.01


def test_one_bit_and_sixteen_bit_fill_the_same_range_as_eight() -> None:
    grey = np.zeros((40, 40), np.uint8)
    grey[:, 20:] = 255
    for pixels in (grey > 0, grey, grey.astype(np.uint16) * 100 + 500):
        copy = at_once(area_average(pixels, height=20, width=20))
        assert copy.shape == (20, 20, 1)
        assert copy.min() == pytest.approx(0.0)
        assert copy.max() == pytest.approx(255.0)


def test_what_is_transparent_is_white() -> None:
    pixels = np.zeros((16, 16, 4), np.uint8)
    pixels[:8, :, 3] = 255
    copy = at_once(area_average(pixels, height=8, width=8))
    assert copy[0, 0].tolist() == [0, 0, 0]
    assert copy[-1, 0].tolist() == [255, 255, 255]


def test_lab_of_known_colours() -> None:
    """Values of CIE Lab (D65) as any colour calculator gives them."""
    colours = np.array([[255, 255, 255], [255, 0, 0], [0, 0, 255], [119, 119, 119]], dtype=np.float32)
    known = [[100, 0, 0], [53.24, 80.09, 67.20], [32.30, 79.19, -107.86], [50.03, 0, 0]]
    assert np.abs(lab(colours) - known).max() < 0.15
    assert abs(float(lab(np.full((1, 1), 119, np.float32))[0, 0]) - 50.03) < 0.1


def test_samples_between_pixels_are_bilinear_and_repeat_the_edge() -> None:
    y, x = np.mgrid[0:20, 0:30]
    pixels = (5 * x + 3 * y).astype(np.uint8)
    rng = np.random.default_rng(2)
    at_x, at_y = rng.uniform(0, 29, 50), rng.uniform(0, 19, 50)
    assert np.abs(sample(pixels, at_x, at_y)[:, 0] - (5 * at_x + 3 * at_y)).max() < 1e-3
    assert sample(pixels, np.array([-7.0]), np.array([40.0]))[0, 0] == 57


def test_the_pyramid_halves_down_to_the_size_wanted() -> None:
    pixels = np.full((1200, 2300), 80, np.uint8)
    levels = at_once(halving_pyramid(pixels))
    assert [level.shape for level in levels] == [(1200, 2300), (600, 1150), (300, 575)]
    assert levels[0] is pixels
    assert all((level == 80).all() for level in levels)
    grey = at_once(halved(np.array([[True, False], [False, False]])))
    assert grey.tolist() == [[64]]


def test_copy_pixels_and_picture_pixels_convert_both_ways() -> None:
    copy = at_once(work_copy(np.full((400, 900), 200, np.uint8), megapixels=0.04))
    points = np.array([[0.0, 0.0], [899.0, 399.0], [450.2, 13.7]])
    assert np.allclose(copy.to_picture(copy.to_copy(points)), points)
    # The outer edge of the picture is that of the copy: half a pixel before the first centre.
    assert np.allclose(copy.to_copy([[-0.5, -0.5]]), [[-0.5, -0.5]])
    assert copy.colours.shape[0] * copy.colours.shape[1] <= 41_000
