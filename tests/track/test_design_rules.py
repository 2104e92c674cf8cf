"""Rules judged on lines whose figures are known."""

import numpy as np
import pytest

from bobdesk.alignment.segments import Segment
from bobdesk.errors import InputError
from bobdesk.track.design_rules import Rule, check_rule, judged, not_judged
from bobdesk.track.sled import GRAVITY, Sled, ride
from tests.track.made_slopes import slope


def one(line, rule, sled=None):
    (found,) = judged(line, [rule], sled)
    return found


def test_a_length_is_the_one_in_space():
    line = slope(1000, 0.1)
    length = 1000 * np.hypot(1, 0.1)
    found = one(line, Rule("l", "length", 1000.0, 1004.0))
    assert found.verdict == "broken"
    assert found.value == pytest.approx(length)
    assert found.stretches == ((0.0, 1000.0),)
    assert one(line, Rule("l", "length", 1000.0, 1005.0)).verdict == "kept"


def two_parts():
    """250 m at 12 %, then 650 m at 7 %, then 100 m that climb at 3 %."""
    stations = np.linspace(0, 1000, 1001)
    return slope(1000, np.where(stations < 250, 0.12, np.where(stations < 900, 0.07, -0.03)))


def test_first_part_and_the_part_after_it_up_to_the_lowest_point():
    line = two_parts()
    lowest = line.stations[line.elevations.argmin()]
    first = one(line, Rule("f", "mean gradient", None, 0.1, 0.0, 250.0))
    assert first.verdict == "broken"
    assert first.value == pytest.approx(0.12, abs=1e-3)
    assert first.stretches == ((0.0, 250.0),)
    rest = one(line, Rule("r", "mean gradient", None, 0.08, 250.0))
    assert rest.verdict == "kept"
    assert rest.value == pytest.approx(0.07, abs=1e-3)
    whole = one(line, Rule("w", "mean gradient", None, 0.01))
    assert whole.value == pytest.approx(line.elevations[0] / lowest)
    assert whole.stretches == ((0.0, lowest),)


def test_where_a_gradient_is_too_large_or_too_small():
    found = one(two_parts(), Rule("g", "gradient", 0.0, 0.1))
    assert found.verdict == "broken"
    assert len(found.stretches) == 2
    assert found.stretches[0] == pytest.approx((0.0, 249.5))
    assert found.stretches[1] == pytest.approx((899.5, 1000.0), abs=1.0)
    assert found.value == pytest.approx(-0.03)
    within = one(two_parts(), Rule("g", "gradient", None, 0.1, 300.0, 800.0))
    assert within.verdict == "kept"
    assert within.value == pytest.approx(0.07)


@pytest.mark.parametrize(("gradient", "verdict"), [(0.0151, "kept"), (0.0249, "kept"), (0.0149, "broken")])
def test_a_figure_is_meant_as_it_is_written(gradient, verdict):
    assert one(slope(100, gradient), Rule("b", "mean gradient", 0.02, 0.02, 0.0, 15.0)).verdict == verdict


def test_a_speed_and_a_load_are_those_of_the_sled():
    line = slope(400, 0.1, radius=50.0)
    free = Sled(drag_area=0.0, friction=0.0, start_speed=0.0)
    run = ride(line, free)
    limit = 3.6 * float(run.speeds[300])
    found = one(line, Rule("s", "speed", None, limit), free)
    assert found.verdict == "broken"
    assert found.value == pytest.approx(3.6 * np.sqrt(2 * GRAVITY * 40))
    assert found.stretches == (pytest.approx((300.5, 400.0)),)
    load = one(line, Rule("a", "acceleration", None, 1.5), free)
    assert load.value == pytest.approx(float(run.load[-1]) / GRAVITY)
    assert load.stretches[0][0] == pytest.approx(float(run.stations[run.load > 1.5 * GRAVITY][0]), abs=0.6)


def test_curves_are_counted():
    segments = (Segment("straight", 0, 30), Segment("curve", 30, 60), Segment("curve", 60, 100))
    line = slope(100, 0.1, segments=segments)
    assert one(line, Rule("c", "curves", 2.0)).verdict == "kept"
    found = one(line, Rule("c", "curves", 3.0))
    assert (found.verdict, found.value) == ("broken", 2.0)


@pytest.mark.parametrize(
    ("rule", "why"),
    [
        (Rule("r", "mean gradient", None, 0.1, 0.0, 250.0), "only 100.0 m long"),
        (Rule("r", "mean gradient", None, 0.1, 250.0), "the lowest point comes at 100.0 m"),
        (Rule("r", "gradient"), "no limit yet"),
        (Rule("r", "speed", None, 100.0), "comes to rest at"),
        (Rule("r", "gradient", None, 0.1, 40.2, 40.6), "no row"),
    ],
)
def test_what_cannot_be_judged_says_why(rule, why):
    found = one(slope(100, 0.001), rule, Sled(start_speed=1.0, friction=0.1))
    assert found.verdict == "not judged"
    assert found.value is None
    assert not found.stretches
    assert why in found.why


def test_before_the_sled_comes_to_rest_it_is_judged():
    sled = Sled(start_speed=10.0, friction=0.1)
    assert one(slope(100, 0.001), Rule("r", "speed", None, 100.0, 0.0, 20.0), sled).verdict == "kept"


def test_rules_that_are_not_used_have_no_finding():
    rules = [Rule("a", "gradient", None, 0.2, is_used=False), Rule("b", "gradient", None, 0.2)]
    assert [found.rule.name for found in judged(slope(100, 0.1), rules)] == ["b"]
    assert [found.why for found in not_judged(rules, "there is no result yet")] == ["there is no result yet"]


@pytest.mark.parametrize(
    "rule",
    [
        Rule(" ", "length"),
        Rule("r", "length", 5.0, 4.0),
        Rule("r", "length", float("nan")),
        Rule("r", "length", 1.0, float("inf")),
        Rule("r", "gradient", None, 0.1, -1.0),
        Rule("r", "gradient", None, 0.1, 10.0, 10.0),
        Rule("r" * 301, "length"),
        Rule("two\nlines", "length"),
        Rule("r", "length", source="two\u2028lines"),
        Rule("r", "colour"),
    ],
)
def test_what_makes_no_sense_is_refused(rule):
    with pytest.raises(InputError):
        check_rule(rule)
