"""Designers' lists of curves."""

from pathlib import Path

import pytest

from bobdesk.alignment.design import DesignCurve
from bobdesk.errors import InputError
from bobdesk.files.importers.design_list import read_design_list

SAMPLE = Path(__file__).parents[3] / "resources" / "samples" / "cortina_2026_design" / "design.json"


def test_the_sample_is_read():
    found = read_design_list(SAMPLE)
    assert found.name == "Cortina 2026, design sections"
    assert len(found.curves) == 16
    assert found.curves[0] == DesignCurve(80.5, 32.0, 17.0, "left")
    assert found.curves[0].end == 112.5


def test_a_table_is_read_in_any_dialect(tmp_path):
    path = tmp_path / "list.csv"
    path.write_text(
        "name;from_m;length_m;radius_m;direction\nB;20,5;10,5;15,0;Rechts\nA;1,0;2,0;3,0;l\n;90,0;9,0;30,0;\n"
    )
    first, second, third = read_design_list(path).curves
    assert first == DesignCurve(1.0, 2.0, 3.0, "left", "A")
    assert (second.start, second.side) == (20.5, "right")
    assert third.side is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("from_m,length_m\n1,2\n", "the column radius_m is missing"),
        ("from_m,length_m,radius_m,direction\n1,2,3,up\n", "line 2: the direction is 'up'"),
        ("from_m,length_m,radius_m\n1,-2,3\n", "line 2: the length must be more than 0"),
        ("from_m,length_m,radius_m\n1,2,0\n", "line 2: the radius must be more than 0"),
        ('{"curves": [{"from_m": 1, "length_m": 2}]}', "curve 1: there is no radius_m"),
        ('{"curves": [{"from_m": "a", "length_m": 2, "radius_m": 3}]}', "curve 1: from_m is not a number"),
        ('{"curves": []}', "there are no curves"),
        ('{"name": "x"}', "no list of curves"),
        ("[1, 2]", "no list of curves"),
        ("{", "list"),
        ("", "is empty"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, text, words):
    path = tmp_path / "list.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=words) as caught:
        read_design_list(path)
    assert len(str(caught.value).splitlines()) == 1
