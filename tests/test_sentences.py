"""Sentences begin large, end once, and count well."""

import pytest

from bobdesk.sentences import are_missing, as_sentence, counted, ended, listed


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("there is no line", "There is no line."),
        ("are the coordinates metres?", "Are the coordinates metres?"),
        ("Done.", "Done."),
        ("wait …", "Wait …"),
        ("", ""),
        (None, ""),
    ],
)
def test_a_sentence_begins_large_and_ends_once(text, sentence):
    assert as_sentence(text) == sentence


def test_ends_and_counts():
    assert ended("so!") == "so!"
    assert [counted(count, "curve") for count in (0, 1, 2, 1200)] == ["0 curves", "1 curve", "2 curves", "1,200 curves"]
    assert listed(["a"]) == "a"
    assert listed(["a", "b", "c"]) == "a, b and c"
    assert are_missing(["kind"]) == "the column kind is missing"
    assert are_missing(["kind", "from_m", "to_m"]) == "the columns kind, from_m and to_m are missing"
