import math

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.plan.calibration import (
    Calibration,
    calibration_from_drawing_scale,
    calibration_from_scale,
    calibration_from_world,
    check_distances,
    plan_length_sigma,
    unknown_scale,
)
from bobdesk.plan.calibration_fit import CalibrationFit, fit_calibration, switched
from bobdesk.plan.calibration_sentences import (
    NO_ESTIMATE,
    calibration_sentences,
    check_sentence,
)
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.world import PixelToWorld
from tests.plan.made_points import PIXELS, TRUTH, points_at, same


def distance(start, end, length, name="", *, used=True) -> KnownDistance:
    return KnownDistance(tuple(start), tuple(end), length, name, used)


def test_metres_and_back_is_the_identity():
    assert TRUTH.to_pixels(TRUTH.to_metres(PIXELS)) == pytest.approx(PIXELS, abs=1e-6)


def test_y_is_flipped_once_and_only_once():
    metres = calibration_from_scale(0.5).to_metres([[0, 0], [10, 0], [0, 10]])
    assert metres.tolist() == [[0, 0], [5, 0], [0, -5]]


def test_rotation_turns_the_pictures_x_axis_anticlockwise():
    metres = Calibration(2.0, math.pi / 2).to_metres([[1, 0], [0, 1]])
    assert metres == pytest.approx(np.array([[0, 2], [2, 0]]), abs=1e-12)


def test_points_of_another_shape_are_a_programming_error():
    with pytest.raises(ValueError, match=r"\(n, 2\)"):
        TRUTH.to_metres([1.0, 2.0])


@pytest.mark.parametrize("count", [2, 3, 6])
def test_exact_points_give_the_calibration_back(count):
    fit = fit_calibration(points_at(TRUTH, PIXELS[:count]))
    assert fit.calibration.metres_per_pixel == pytest.approx(TRUTH.metres_per_pixel, rel=1e-9)
    assert fit.calibration.rotation_rad == pytest.approx(TRUTH.rotation_rad, abs=1e-9)
    assert fit.calibration.origin_m == pytest.approx(TRUTH.origin_m, abs=1e-5)
    assert fit.degrees_of_freedom == 2 * count - 4


def test_agrees_with_a_general_least_squares_solver():
    rng = np.random.default_rng(5)
    near = Calibration(0.5393, -0.6, (300.0, 200.0))  # the plain solver cannot do six-digit northings
    points = points_at(near, PIXELS, clicked=PIXELS + rng.normal(0, 3, PIXELS.shape))
    design, known = [], []
    for point in points:
        design += [[point.x_px, point.y_px, 1, 0], [-point.y_px, point.x_px, 0, 1]]
        known += [point.x_m, point.y_m]
    (real, imaginary, east, north), squares, *_ = np.linalg.lstsq(np.array(design), np.array(known), rcond=None)
    fit = fit_calibration(points)
    assert fit.calibration.metres_per_pixel == pytest.approx(math.hypot(real, imaginary), rel=1e-9)
    assert fit.calibration.rotation_rad == pytest.approx(math.atan2(imaginary, real), abs=1e-9)
    assert fit.calibration.origin_m == pytest.approx((east, north), abs=1e-4)
    assert fit.rms_m == pytest.approx(math.sqrt(float(squares[0]) / len(points)), rel=1e-6)


def test_points_with_distances_agree_with_scipy():
    from scipy.optimize import least_squares

    rng = np.random.default_rng(6)
    near = Calibration(0.5393, -0.6, (300.0, 200.0))
    points = points_at(near, PIXELS[:3], clicked=PIXELS[:3] + rng.normal(0, 2, (3, 2)))
    known = [distance((0, 0), (800, 50), 436.0), distance((50, 90), (60, 1500), 757.0)]

    def residuals(guess):
        calibration = Calibration(guess[0], guess[1], (guess[2], guess[3]))
        metres = calibration.to_metres([[point.x_px, point.y_px] for point in points])
        of_points = metres - [[point.x_m, point.y_m] for point in points]
        of_distances = [(guess[0] * item.length_px - item.length_m) / math.sqrt(2) for item in known]
        return [*of_points.ravel(), *of_distances]

    best = least_squares(residuals, [0.5, -0.5, 290, 210], x_scale=[0.1, 0.1, 100, 100], xtol=1e-14, ftol=1e-14)
    fit = fit_calibration(points, distances=known)
    calibration = fit.calibration
    assert (calibration.metres_per_pixel, calibration.rotation_rad, *calibration.origin_m) == pytest.approx(
        tuple(best.x), rel=1e-6
    )
    assert fit.degrees_of_freedom == 6 + 2 - 4
    # the sigma of the scale against the solver's own Jacobian
    variance = 2 * best.cost / 4 * np.linalg.inv(best.jac.T @ best.jac)[0, 0]
    assert calibration.scale_sigma == pytest.approx(math.sqrt(variance), rel=1e-5)


def test_residuals_point_from_the_known_place_to_the_click():
    points = points_at(calibration_from_scale(0.5), PIXELS)
    moved = ControlPoint(points[4].x_px + 3, points[4].y_px + 4, points[4].x_m, points[4].y_m, "5", used=False)
    fit = fit_calibration([*points[:4], moved, points[5]])
    residual = fit.points[4]
    assert not residual.used
    assert (residual.dx_px, residual.dy_px, residual.norm_px) == pytest.approx((3, 4, 5), abs=1e-9)
    assert (residual.dx_m, residual.dy_m, residual.norm_m) == pytest.approx((1.5, -2, 2.5), abs=1e-9)
    assert fit.rms_m == pytest.approx(0, abs=1e-9)  # it was off: it spoils nothing


def test_the_worst_point_and_the_rms_without_it():
    rng = np.random.default_rng(8)
    clicked = PIXELS + rng.normal(0, 0.3, PIXELS.shape)
    clicked[2] += (15, -9)
    points = points_at(TRUTH, PIXELS, clicked=clicked)
    fit = fit_calibration(points)
    assert fit.worst.name == "3"
    without = fit_calibration(switched(points, index=2, used=False))
    assert fit.worst.rms_without_m == pytest.approx(without.rms_m)
    assert without.rms_m < 0.1 * fit.rms_m
    assert "point 3" in calibration_sentences(fit)[-1]


def test_a_wrong_distance_is_found_as_the_worst():
    points = points_at(TRUTH, PIXELS[:4])
    wrong = distance(PIXELS[0], PIXELS[1], 999.0, "bridge")
    assert fit_calibration(points, distances=[wrong]).worst.name == "bridge"


def test_of_three_points_none_can_be_judged_without():
    rng = np.random.default_rng(9)
    fit = fit_calibration(points_at(TRUTH, PIXELS[:3], clicked=PIXELS[:3] + rng.normal(0, 1, (3, 2))))
    assert fit.degrees_of_freedom == 2
    assert fit.worst.rms_without_m is None


@pytest.mark.parametrize(
    ("points", "distances"),
    [
        (points_at(TRUTH, PIXELS[:2]), []),
        ([], [distance((0, 0), (100, 0), 50.0)]),
        (points_at(TRUTH, PIXELS[:1]), [distance((0, 0), (100, 0), 50.0)]),
    ],
)
def test_with_the_fewest_there_is_no_error_estimate(points, distances):
    fit = fit_calibration(points, distances=distances)
    assert fit.degrees_of_freedom == 0
    assert (fit.rms_m, fit.rms_px, fit.click_sigma_px, fit.worst) == (None, None, None, None)
    assert fit.calibration.scale_sigma is None
    assert plan_length_sigma(fit.calibration, 1300.0) is None
    (sentence,) = calibration_sentences(fit, plan_length_m=1300.0)
    assert NO_ESTIMATE in sentence
    assert "0.000" not in sentence


def test_one_distance_gives_the_scale_and_nothing_else():
    fit = fit_calibration(distances=[distance((10, 10), (40, 50), 25.0)])
    assert fit.calibration.metres_per_pixel == pytest.approx(0.5)
    assert fit.calibration.to_metres([[0, 0], [2, 0], [0, 2]]) == pytest.approx(np.array([[0, 0], [1, 0], [0, -1]]))


def test_one_point_and_a_distance_give_scale_and_position():
    fit = fit_calibration([ControlPoint(10, 20, 500, 700)], distances=[distance((10, 10), (40, 50), 25.0)])
    assert fit.calibration.to_metres([[10, 20], [12, 20]]) == pytest.approx(np.array([[500, 700], [501, 700]]))


def draws(count: int, sigma_px: float, distances_used: bool) -> list[CalibrationFit]:
    rng = np.random.default_rng(20)
    ends = np.array([[[10, 10], [900, 1800]], [[800, 100], [100, 1900]]], dtype=float)
    fits = []
    for _ in range(count):
        points = points_at(TRUTH, PIXELS, clicked=PIXELS + rng.normal(0, sigma_px, PIXELS.shape))
        known = []
        if distances_used:
            for start, end in ends:
                clicks = np.array([start, end]) + rng.normal(0, sigma_px, (2, 2))
                known.append(distance(clicks[0], clicks[1], math.dist(start, end) * TRUTH.metres_per_pixel))
        fits.append(fit_calibration(points, distances=known))
    return fits


@pytest.mark.parametrize("distances_used", [False, True])
def test_a_thousand_draws_agree_with_theory(distances_used):
    sigma_px = 2.0
    fits = draws(1000, sigma_px, distances_used)
    freedom = 8 + 2 * distances_used
    assert {fit.degrees_of_freedom for fit in fits} == {freedom}

    # Each bound is four standard errors of the simulation itself.
    squares = np.array([fit.click_sigma_px for fit in fits]) ** 2 / sigma_px**2
    assert abs(squares.mean() - 1) < 4 * math.sqrt(2 / freedom / 1000)
    if not distances_used:
        rms = np.array([fit.rms_px for fit in fits])
        expected = sigma_px**2 * freedom / len(PIXELS)
        assert abs((rms**2).mean() / expected - 1) < 4 * math.sqrt(2 / freedom / 1000)

    scales = np.array([fit.calibration.metres_per_pixel for fit in fits])
    sigmas = np.array([fit.calibration.scale_sigma for fit in fits])
    assert abs(math.sqrt((sigmas**2).mean()) / scales.std(ddof=1) - 1) < 4 / math.sqrt(2 * 1000) * 1.1
    # One sigma holds the truth as often as Student's t says.
    from scipy.stats import t

    within = np.abs(scales - TRUTH.metres_per_pixel) < sigmas
    share = t.cdf(1, freedom) - t.cdf(-1, freedom)
    assert abs(within.mean() - share) < 4 * math.sqrt(share * (1 - share) / 1000)


def test_the_plan_lengths_sigma_is_the_scatter_of_plan_lengths():
    length_px = 2500.0
    fits = draws(1000, 2.0, False)
    lengths = np.array([length_px * fit.calibration.metres_per_pixel for fit in fits])
    said = np.array([plan_length_sigma(fit.calibration, length) for fit, length in zip(fits, lengths, strict=True)])
    assert math.sqrt((said**2).mean()) == pytest.approx(lengths.std(ddof=1), rel=0.1)


def test_check_distances_take_no_part_in_the_fit():
    fit = fit_calibration(points_at(calibration_from_scale(0.5), PIXELS))
    (check,) = check_distances(fit.calibration, [distance((0, 0), (300, 400), 251.0, "A-B")])
    assert check.plan_m == pytest.approx(250)
    assert check.difference_m == pytest.approx(-1)
    assert check.difference_percent == pytest.approx(-100 / 251)
    assert "A-B" in check_sentence(check)


def test_unknown_scale_counts_pixels_and_checks_nothing():
    calibration = unknown_scale()
    assert not calibration.scale_known
    assert calibration.to_metres([[3, 4]]).tolist() == [[3, -4]]
    with pytest.raises(InputError, match="unknown"):
        check_distances(calibration, [distance((0, 0), (1, 0), 1.0)])


def test_a_drawing_scale_and_dpi():
    assert calibration_from_drawing_scale((254, 254), one_to=500).metres_per_pixel == pytest.approx(0.05)
    for dpi, one_to in (None, 500), ((204, 98), 500), ((300, 300), 0):
        with pytest.raises(InputError):
            calibration_from_drawing_scale(dpi, one_to=one_to)


@pytest.mark.parametrize(
    ("points", "distances", "words"),
    [
        ([], [], "two control points or one known distance"),
        (same((0, 0, 1, 1)), [], "second one"),
        (same((5, 5, 0, 0), (5, 5, 9, 9), (5, 5, 1, 3)), [], "same place"),
        (same((0, 0, 7, 7), (90, 50, 7, 7)), [], "same position"),
        (same((0, 0, 0, 0), (100, 0, 100, 0), (0, 100, 0, 100), (90, 90, 90, 90)), [], "mirrored"),
        (same((0, 0, 0, 0), (100, 0, -100, 0), (0, 100, 0, -100)), [], "mirrored"),
    ],
)
def test_what_cannot_be_fitted_says_so(points, distances, words):
    with pytest.raises(InputError, match=words):
        fit_calibration(points, distances=distances)


def test_one_wrong_point_is_not_called_mirrored():
    for index in range(5):
        metres = TRUTH.to_metres(PIXELS[:5])
        metres[index] = TRUTH.to_metres(PIXELS[5:])[0]
        points = [ControlPoint(*pixel, *place) for pixel, place in zip(PIXELS[:5], metres, strict=True)]
        assert fit_calibration(points).rms_m > 1


def test_noise_on_points_in_a_line_is_not_called_mirrored():
    rng = np.random.default_rng(3)
    line = np.column_stack([np.linspace(0, 1000, 5), np.linspace(0, 700, 5)])
    for _ in range(200):
        fit_calibration(points_at(TRUTH, line, clicked=line + rng.normal(0, 5, line.shape)))


@pytest.mark.parametrize(
    "make",
    [
        lambda: ControlPoint(math.nan, 0, 0, 0),
        lambda: ControlPoint(0, 0, math.inf, 0),
        lambda: distance((0, 0), (1, 1), 0.0),
        lambda: distance((0, 0), (1, 1), math.nan),
        lambda: distance((1, 1), (1, 1), 5.0),
        lambda: distance((1, math.nan), (1, 1), 5.0),
        lambda: calibration_from_scale(0.0),
        lambda: calibration_from_scale(math.nan),
    ],
)
def test_what_is_no_number_is_refused(make):
    with pytest.raises(InputError):
        make()


def signed_turns(metres: np.ndarray) -> np.ndarray:
    step = np.diff(metres, axis=0)
    return step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]


def test_a_mirrored_picture_swaps_left_and_right_and_nothing_else():
    rng = np.random.default_rng(12)
    trace = np.cumsum(rng.normal((1, 0.5), 1, (200, 2)), axis=0) * 5
    mirrored = trace * (-1, 1) + (2000, 0)
    calibration = Calibration(0.4, 0.3, (10, 20))
    straight, swapped = calibration.to_metres(trace), calibration.to_metres(mirrored)
    assert signed_turns(swapped) == pytest.approx(-signed_turns(straight), rel=1e-6, abs=1e-9)
    assert np.linalg.norm(np.diff(swapped, axis=0), axis=1) == pytest.approx(
        np.linalg.norm(np.diff(straight, axis=0), axis=1)
    )


def test_a_left_curve_on_screen_is_left_in_metres():
    # right along the picture, then up: y falls on screen, the driver turns left
    assert signed_turns(calibration_from_scale(0.5).to_metres([[0, 100], [50, 100], [50, 50]]))[0] > 0


def test_world_gives_a_calibration():
    turned = calibration_from_world(PixelToWorld(0.3, 0.4, 1000, 0.4, -0.3, 2000), name="a.pgw")
    assert turned.metres_per_pixel == pytest.approx(0.5)
    assert turned.to_metres([[10, 20]]) == pytest.approx(np.array([[1011, 1998]]))


@pytest.mark.parametrize(
    ("world", "words"),
    [
        (PixelToWorld(0.5, 0, 0, 0, 0.5, 0), "mirrored"),
        (PixelToWorld(0.5, 0, 0, 0, -0.6, 0), "square"),
        (PixelToWorld(0.5, 0.1, 0, 0, -0.5, 0), "sheared"),
    ],
)
def test_world_that_is_no_similarity_is_refused(world, words):
    with pytest.raises(InputError, match=words):
        calibration_from_world(world, name="a.pgw")


def test_sentences_name_uncertainty_and_degrees_of_freedom():
    (fit,) = draws(1, 2.0, True)
    sentences = " ".join(calibration_sentences(fit, plan_length_m=1352.0))
    for words in ("6 control points and 2 known distances", "10 degrees of freedom", "1 sigma", "1352.0 m ±"):
        assert words in sentences


def test_points_without_any_error_are_called_exact():
    fit = fit_calibration([ControlPoint(x, y, 0.5 * x, -0.5 * y) for x, y in ((0, 0), (300, 10), (40, 700))])
    assert "m per pixel, exact" in " ".join(calibration_sentences(fit))
