"""Design rules in files."""

import json

import pandas as pd
import pytest

from bobdesk.errors import InputError
from bobdesk.files.rules_file import findings_table, read_rules, rules_json
from bobdesk.track.design_rules import Rule, judged
from bobdesk.ui.resources import resource
from tests.track.made_slopes import slope


@pytest.fixture
def file(tmp_path):
    def written(content):
        path = tmp_path / "rules.json"
        path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        return path

    return written


def test_the_usual_rules_have_a_source_each():
    rules = read_rules(resource("rules", "design_rules.json"))
    assert len(rules) == 11
    assert all(rule.source for rule in rules)
    by_name = {rule.name: rule for rule in rules}
    assert by_name["start block: 15 m at 2 %"].end == 15
    assert by_name["mean gradient, second part"].start == 250
    assert "assumption" in by_name["mean gradient, second part"].source
    assert by_name["acceleration in curves"].quantity == "acceleration"
    assert "second hand" in json.loads(resource("rules", "design_rules.json").read_text())["note"]


def test_rules_come_back_as_they_were_written(file):
    rules = (
        Rule("a", "gradient", None, 0.204, 3.0, 900.0, "here", is_used=False),
        Rule("Länge", "length", 1000.5, None, source="dort; „so“"),
    )
    assert read_rules(file(rules_json(rules))) == rules


def test_what_a_rule_is_about_follows_from_its_words(file):
    rows = [
        {"rule": "race length", "unit": "m", "min": 1000},
        {"rule": "start block: 15 m at 2 %", "unit": "gradient"},
        {"rule": "mean gradient, first 250 m", "unit": "gradient"},
        {"rule": "mean gradient, second part", "unit": "gradient"},
        {"rule": "largest gradient", "unit": "gradient"},
        {"rule": "design speed", "unit": "km/h"},
        {"rule": "acceleration in curves", "unit": "g"},
        {"rule": "number of curves", "unit": "curves"},
    ]
    found = read_rules(file({"note": "n", "rules": rows}))
    assert [(rule.quantity, rule.start, rule.end) for rule in found] == [
        ("length", 0, None), ("mean gradient", 0, 15), ("mean gradient", 0, 250), ("mean gradient", 250, None),
        ("gradient", 0, None), ("speed", 0, None), ("acceleration", 0, None), ("curves", 0, None),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"rule,unit\n", "not JSON"),
        (b"[" * 100_000, "no design rules"),
        ({"rules": [{"rule": "r"}]}, "unit"),
        ({"rules": [{"rule": "r", "unit": "m", "min": "1"}]}, "min"),
        ({"rules": [{"rule": "beauty", "unit": "m"}]}, "beauty"),
        ({"rules": [{"rule": "r", "unit": "km", "quantity": "length"}]}, "its unit must be m"),
        ({"rules": [{"rule": "r", "unit": "m", "quantity": "width"}]}, "one of length"),
        ({"rules": [{"rule": "r", "unit": "m", "quantity": "length", "min": 3, "max": 2}]}, "at least 3"),
        ({"rules": [{"rule": "r", "unit": "g"}] * 501}, "at most 500"),
    ],
)
def test_a_bad_file_is_refused_in_a_sentence(file, content, says):
    with pytest.raises(InputError, match=says):
        read_rules(file(content))


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(InputError):
        read_rules(tmp_path / "none.json")


def test_findings_as_a_table(tmp_path):
    rules = (
        Rule("=steep", "gradient", None, 0.05, source="a, b"),
        Rule("long", "mean gradient", None, 0.1, 0.0, 2000.0),
        Rule("fine", "length", 100.0),
    )
    path = tmp_path / "f.csv"
    path.write_bytes(findings_table(judged(slope(300, 0.1), rules)))
    rows = pd.read_csv(path)
    assert list(rows.verdict) == ["broken", "not judged", "kept"]
    assert rows.rule[0] == "'=steep"
    assert rows.broken_m[0] == "0.00-300.00"
    assert rows.value[0] == pytest.approx(0.1)
    assert rows.source[0] == "a, b"
    assert "only 300.0 m" in rows.why[1]
    assert pd.isna(rows.value[1])
