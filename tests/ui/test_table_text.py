"""What is copied from tables comes back from a spreadsheet as it was."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QLocale

from bobdesk.ui.table_text import plain_number, table_text


@pytest.mark.parametrize(
    ("language", "shown", "copied"),
    [
        (QLocale.Language.German, "1.358,76", "1358,76"),
        (QLocale.Language.German, "−1.358,76", "-1358,76"),
        (QLocale.Language.German, "8,01e−07", "8,01e-07"),
        (QLocale.Language.German, "1.2", "1.2"),
        (QLocale.Language.English, "1,358.76", "1358.76"),
        (QLocale.Language.English, "+0.12", "+0.12"),
        (QLocale.Language.English, "Track 1,2", "Track 1,2"),
        (QLocale.Language.English, "–", "–"),
    ],
)
def test_numbers_are_plain_and_texts_stay(language, shown, copied):
    QLocale.setDefault(QLocale(language))
    assert plain_number(shown) == copied


@given(st.lists(st.lists(st.text("aä\"\t\n', "), min_size=1, max_size=3), min_size=1, max_size=3))
def test_cells_come_back(rows):
    text = table_text([["first", *row] for row in rows])
    read = list(csv.reader(io.StringIO(text, newline=""), delimiter="\t"))
    assert read == [["first", *row] for row in rows]
