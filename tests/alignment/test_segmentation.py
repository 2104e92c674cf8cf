import json

import numpy as np
import pytest

from bobdesk.alignment.curvature import curvature
from bobdesk.alignment.segmentation import detect_segments, fit_by_count, threshold_of
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.alignment.segments import check_segments, set_locked
from bobdesk.errors import InputError
from tests.alignment.made_lines import DATA, circle, correlated_noise, drive, fitted, made_pieces, made_plan

PLANS = json.loads((DATA / "plans" / "index.json").read_text())


def points_of(plan):
    return np.loadtxt(DATA / "plans" / plan["truth"], delimiter=",", skiprows=1)[:, 1:3]


def f1(found, true, *, within):
    """Return the F1 score of boundaries, each matched once, both in order."""
    hits, i, j = 0, 0, 0
    while i < len(true) and j < len(found):
        if abs(true[i] - found[j]) <= within:
            hits, i, j = hits + 1, i + 1, j + 1
        elif true[i] < found[j]:
            i += 1
        else:
            j += 1
    return 2 * hits / (len(true) + len(found))


def score(plan, *, sigma, seed, settings=None):
    points = points_of(plan)
    centreline = fitted(points + correlated_noise(len(points), sigma=sigma, rms=0.1, seed=seed))
    found = np.array([s.start for s in detect_segments(centreline, settings)[1:]])
    true = [s["from_m"] for s in plan["segments"][1:]]
    return f1(found * plan["plan_length_m"] / centreline.length, true, within=5.0)


@pytest.mark.parametrize("sigma", [10, 20])
def test_boundaries_are_found_under_correlated_noise(sigma):
    scores = [score(plan, sigma=sigma, seed=seed) for plan in PLANS for seed in range(3)]
    assert np.mean(scores) >= 0.92
    assert min(scores) >= 0.8


def test_the_published_rule_on_raw_differences_is_far_behind():
    ours = np.mean([score(plan, sigma=0, seed=1) for plan in PLANS])
    published = np.mean(
        [score(plan, sigma=0, seed=1, settings=SegmentationSettings(rule="published")) for plan in PLANS]
    )
    assert published < 0.4 < 0.85 < ours


@pytest.mark.parametrize("plan", PLANS, ids=lambda plan: plan["truth"])
def test_without_noise_kinds_and_directions_are_those_of_the_truth(plan):
    centreline = fitted(points_of(plan))
    segments = detect_segments(centreline)
    stations = np.arange(0.5, plan["plan_length_m"], 1.0)
    starts = np.array([s["from_m"] for s in plan["segments"]])
    true = np.array([s["kind"] == "curve" for s in plan["segments"]])
    found_starts = np.array([s.start for s in segments])
    found = np.array([s.kind == "curve" for s in segments])
    same = true[np.searchsorted(starts, stations) - 1] == found[np.searchsorted(found_starts, stations) - 1]
    assert same.mean() > 0.97


@pytest.mark.parametrize("seed", range(3))
def test_made_segments_are_found_where_they_are(seed):
    pieces = made_pieces(seed)
    lengths = [pieces[0][0]]
    for index in range(1, len(pieces), 4):
        lengths += [sum(piece[0] for piece in pieces[index : index + 3]), pieces[index + 3][0]]
    true = np.cumsum(lengths)[:-1]
    segments = detect_segments(fitted(drive(pieces)))
    assert [s.kind for s in segments] == ["straight", "curve"] * 8 + ["straight"]
    assert np.abs(np.array([s.start for s in segments[1:]]) - true).max() < 2.5


@pytest.mark.parametrize("settings", [SegmentationSettings(), SegmentationSettings(rule="published")])
def test_segments_cover_the_line(settings):
    centreline = fitted(points_of(PLANS[1]))
    check_segments(detect_segments(centreline, settings), length=centreline.length)


@pytest.mark.parametrize("count", [1, 2, 7, 17, 25, 33])
def test_a_wanted_number_of_segments_is_met(count):
    centreline = fitted(points_of(PLANS[0]))
    segments = detect_segments(centreline, SegmentationSettings(count=count))
    assert len(segments) == count
    check_segments(segments, length=centreline.length)


def test_too_many_segments_are_refused_with_the_most_there_are():
    with pytest.raises(InputError, match=r"500 segments cannot be told apart .* want \d+ at most"):
        detect_segments(fitted(made_plan(1)), SegmentationSettings(count=500))


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (SegmentationSettings(count=0), "at least 1, not 0"),
        (SegmentationSettings(threshold=0.0), "threshold"),
        (SegmentationSettings(threshold=float("nan")), "threshold"),
        (SegmentationSettings(threshold=2.0), "between 0.00001 and 1 per metre, not 2"),
        (SegmentationSettings(rule="published", count=5), "no wanted number"),
    ],
)
def test_settings_that_cannot_be_are_named(settings, words):
    with pytest.raises(InputError, match=words):
        detect_segments(fitted(made_plan(1)), settings)


def test_detecting_again_keeps_locked_segments():
    centreline = fitted(made_plan(2))
    locked = set_locked(detect_segments(centreline, SegmentationSettings(count=9)), 4, locked=True)
    again = detect_segments(centreline, previous=locked)
    check_segments(again, length=centreline.length)
    assert [s for s in again if s.locked] == [locked[4]]
    assert detect_segments(centreline) == detect_segments(centreline, previous=detect_segments(centreline))


def test_the_published_rule_takes_a_station_with_its_neighbours():
    points = drive([(100.0, 0.0, 0.0), (50.0, 1 / 30, 1 / 30), (100.0, 0.0, 0.0)])
    centreline = fitted(points, wavelength=0.0)
    settings = SegmentationSettings(rule="published", threshold=0.01)
    high = np.abs(curvature(centreline, "published")) >= 0.01
    curved = [any(high[max(k - 2, 0) : k + 3]) for k in range(len(high))]
    segments = detect_segments(centreline, settings)
    assert [s.kind for s in segments] == ["straight", "curve", "straight"]
    inside = [segments[1].start < station < segments[1].end for station in centreline.stations]
    assert inside == curved


def test_a_line_without_curves_is_one_straight_and_a_circle_one_curve():
    straight = fitted(np.column_stack([np.linspace(0, 300, 40), np.zeros(40)]))
    assert [s.kind for s in detect_segments(straight)] == ["straight"]
    assert [s.kind for s in detect_segments(fitted(circle(30.0, turn=5, count=150)))] == ["curve"]


def test_left_and_right_without_a_straight_between_them_are_two_curves():
    bend = 1 / 25
    pieces = [(60.0, 0, 0), (40.0, bend, bend), (40.0, -bend, -bend), (60.0, 0, 0)]
    segments = detect_segments(fitted(drive(pieces)))
    assert [s.kind for s in segments] == ["straight", "curve", "curve", "straight"]
    assert segments[1].end == pytest.approx(100.0, abs=1.0)


def test_the_automatic_threshold_lies_between_its_limits():
    for seed in range(3):
        assert 0.0025 <= threshold_of(fitted(made_plan(seed)), SegmentationSettings()) <= 0.008
    assert threshold_of(fitted(made_plan(0)), SegmentationSettings(threshold=0.02)) == 0.02


def test_the_gain_by_count_stops_growing_at_the_true_number():
    gains = fit_by_count(fitted(made_plan(4)), SegmentationSettings(), most=30)
    steps = np.diff(gains)
    assert steps[:16].min() > 2.0
    assert steps[16:].max() < 1.0


def test_a_wanted_number_goes_before_the_shortest_segment_with_corrections_too():
    centreline = fitted(made_plan(2))
    settings = SegmentationSettings(count=15, shortest=60.0)
    found = detect_segments(centreline, settings)
    locked = set_locked(found, 4, locked=True)
    assert len(detect_segments(centreline, settings, previous=locked)) == len(found)
