import pytest
from PySide6.QtCore import QLocale

from bobdesk.errors import InputError
from bobdesk.ui.widgets.typed_number import number_to_edit, typed_number


@pytest.mark.parametrize(
    ("text", "value"),
    [("1.5", 1.5), ("−3", -3.0), (" 1 290.5 ", 1290.5), ("1,290.5", 1290.5), ("1e3", 1000.0), ("1,290", 1290.0)],
)
def test_english_numbers(english, text, value):
    assert typed_number(text) == value


@pytest.mark.parametrize(
    ("text", "value"), [("1,5", 1.5), ("1.5", 1.5), ("1.290,5", 1290.5), ("-0,25", -0.25), ("406,123", 406.123)]
)
def test_german_numbers(german, text, value):
    assert typed_number(text) == value


def test_what_can_be_read_in_two_ways_is_not_guessed(german):
    with pytest.raises(InputError, match="can be read as 1,29 or 1290"):
        typed_number("1.290")


@pytest.mark.parametrize("text", ["", "  ", "12 m", "nan", "inf", "1,2,3.4.5", "--1"])
def test_what_is_no_number(english, text):
    with pytest.raises(InputError):
        typed_number(text)


@pytest.mark.parametrize("value", [0.0, 1.5, -24.1, 406.123, 1624.2, 0.21595123, 5_300_123.25, 1e-7, 123456789.0])
@pytest.mark.parametrize("language", [QLocale.Language.English, QLocale.Language.German, QLocale.Language.French])
def test_what_stands_in_a_field_is_read_back(english, value, language):
    QLocale.setDefault(QLocale(language))
    assert typed_number(number_to_edit(value)) == pytest.approx(value, rel=1e-9)
