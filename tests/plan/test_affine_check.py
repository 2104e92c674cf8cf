import math

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.plan.affine_check import check_affine
from bobdesk.plan.calibration_sentences import NO_ESTIMATE, affine_sentence
from bobdesk.plan.control_points import ControlPoint
from tests.plan.made_points import PIXELS, TRUTH, points_at, same


def test_affine_finds_a_stretched_and_sheared_picture():
    stretched = PIXELS @ np.array([[1, 0], [0, 1 / 1.05]])
    check = check_affine(points_at(TRUTH, PIXELS, clicked=stretched))
    assert check.scale_ratio == pytest.approx(1.05, rel=1e-9)
    assert check.shear_rad == pytest.approx(0, abs=1e-9)
    assert check.degrees_of_freedom == 6
    assert check.chance < 1e-6
    sheared = PIXELS - np.outer(PIXELS[:, 1], [math.tan(0.02), 0])
    assert check_affine(points_at(TRUTH, PIXELS, clicked=sheared)).shear_rad == pytest.approx(-0.02, rel=1e-6)


def test_affine_calls_clicking_errors_distortion_in_one_case_of_twenty():
    rng = np.random.default_rng(21)
    chances = []
    for _ in range(1000):
        points = points_at(TRUTH, PIXELS, clicked=PIXELS + rng.normal(0, 2, PIXELS.shape))
        chances.append(check_affine(points).chance)
    assert abs(np.mean(np.array(chances) < 0.05) - 0.05) < 4 * math.sqrt(0.05 * 0.95 / 1000)
    assert abs(np.mean(chances) - 0.5) < 4 * math.sqrt(1 / 12 / 1000)


def test_affine_on_exact_points_finds_nothing():
    check = check_affine(points_at(TRUTH, PIXELS))
    assert check.chance == 1.0
    assert "no more than clicking errors" in affine_sentence(check)


def test_affine_through_three_points_has_no_error_estimate():
    check = check_affine(points_at(TRUTH, PIXELS[:3]))
    assert (check.rms_m, check.chance) == (None, None)
    assert NO_ESTIMATE in affine_sentence(check)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (points_at(TRUTH, PIXELS[:2]), "three"),
        (points_at(TRUTH, np.array([[0, 0], [10, 10], [50, 50], [70, 70.0]])), "line"),
        (same((0, 0, 0, 0), (100, 0, 100, 0), (0, 100, 0, 100)), "mirrored"),
        (same((5, 5, 0, 0), (5, 5, 9, 9), (5, 5, 1, 3)), "line"),
    ],
)
def test_affine_refuses_what_cannot_tell(points, words):
    with pytest.raises(InputError, match=words):
        check_affine(points)


def test_a_sure_distortion_of_a_hair_is_called_harmless():
    corners = [(0, 0), (1000, 0), (1000, 800), (0, 800), (500, 400), (250, 700)]
    points = [ControlPoint(x, y, 0.5 * x, -0.5 * 1.0002 * y) for x, y in corners]
    assert affine_sentence(check_affine(points)).endswith("too little to matter.")
    points = [ControlPoint(x, y, 0.5 * x, -0.5 * 1.02 * y) for x, y in corners]
    assert "distorted" in affine_sentence(check_affine(points))
