"""A study's rows as a table of two axes and as curves."""

import pytest

from bobdesk.errors import InputError
from bobdesk.solve.targets import KnownElevation
from bobdesk.track.study import STUDY_COLUMNS, Cell, failed_row
from bobdesk.track.study_choices import check_size, counts_of, known_set, weights_of
from bobdesk.track.study_pivot import curves, figures_in, labels_on, pivot, varied


def row(count, weight, method, known, length, *, plan="a"):
    cells = dict.fromkeys(STUDY_COLUMNS, "")
    cells |= {"plan": plan, "wanted_segments": count, "segments": count or "11", "height_weight": weight}
    cells |= {"method": method, "known": known, "length_percent": length, "status": "met"}
    return tuple(cells.values())


ROWS = (
    row("10", "", "pgd", "none", "0.1"),
    row("10", "0.5", "published", "", "-0.4"),
    row("10", "1.5", "published", "", "0.3"),
    row("9", "", "pgd", "none", "0"),
    row("9", "0.5", "published", "", "0.2"),
    row("9", "1.5", "published", "", ""),
    failed_row(Cell("a", None, None, "pgd", "none"), "no segments"),
)


def test_numbers_stand_by_size_and_what_is_found_automatically_last():
    assert labels_on(ROWS, "segments") == ("9", "10", "auto")
    assert labels_on(ROWS, "height_weight") == ("", "0.5", "1.5")
    assert labels_on(ROWS, "method") == ("pgd", "published")


def test_what_a_method_does_not_know_is_no_variation():
    assert varied(ROWS) == ("segments", "height_weight", "method")
    assert varied([row("9", "1", "published", "", "0"), row("9", "", "pgd", "none", "0")]) == ("method",)
    assert figures_in(ROWS) == ("length_percent",)


def test_a_place_of_several_rows_shows_the_one_furthest_from_zero():
    table = pivot(ROWS, ("segments",), ("method",), "length_percent")
    assert table.down == (("9",), ("10",), ("auto",))
    assert table.across == (("pgd",), ("published",))
    assert table.cells[1, 1].numbers == (-0.4, 0.3)
    assert table.cells[1, 1].worst == -0.4
    assert table.cells[0, 1].numbers == (0.2,)
    assert (table.cells[2, 0].worst, table.cells[2, 0].failed) == (None, 1)
    assert (2, 1) not in table.cells


def test_curves_go_over_an_axis_one_for_each_other_combination():
    labels, found = curves(ROWS, "segments", "length_percent")
    assert labels == ("9", "10")
    assert {curve.name: curve.values for curve in found} == {
        ("", "pgd"): (0.0, 0.1),
        ("0.5", "published"): (0.2, -0.4),
        ("1.5", "published"): (None, 0.3),
    }


def test_a_method_without_weights_is_level_over_them():
    labels, found = curves(ROWS, "height_weight", "length_percent")
    assert labels == ("0.5", "1.5")
    level = {curve.name: curve for curve in found}["10", "pgd"]
    assert level.is_constant
    assert level.values == (0.1, 0.1)
    assert not {curve.name: curve for curve in found}["10", "published"].is_constant


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        ("10,15,21", (10, 15, 21)),
        ("10, 15; 21 9", (10, 15, 21, 9)),
        ("6-9", (6, 7, 8, 9)),
        ("6 – 12:3, auto", (6, 9, 12, None)),
        ("AUTO,7,7", (None, 7)),
    ],
)
def test_counts_as_they_are_written(text, counts):
    assert counts_of(text) == counts


@pytest.mark.parametrize("text", ["", "0", "x", "3.5", "9-6", "5-6:0", "-3", "1-99999", "10,,12"])
def test_counts_that_are_none_are_refused(text):
    with pytest.raises(InputError, match="numbers of segments such as"):
        counts_of(text)


def test_weights_and_sets_as_they_are_written():
    assert weights_of(["0.5", "1", "1.0"]) == (0.5, 1.0)
    for bad in ([], ["x"], ["-1"], ["nan"], ["inf"]):
        with pytest.raises(InputError, match="weights such as"):
            weights_of(bad)
    assert known_set("none") == known_set(" ") == ()
    assert known_set("250:98.5 600:40:0.5") == (KnownElevation(250, 98.5), KnownElevation(600, 40, 0.5))
    with pytest.raises(InputError, match="STATION:ELEVATION"):
        known_set("250")
    with pytest.raises(InputError, match="allowed"):
        check_size(100_001)
