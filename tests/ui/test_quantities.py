import math

import pytest
from PySide6.QtCore import QLocale

from bobdesk.ui.quantities import Quantities
from bobdesk.ui.settings import Settings


@pytest.fixture
def settings(tmp_path, qapp):
    return Settings(tmp_path / "settings.ini")


def test_metres_and_percent(settings):
    shown = Quantities(settings)
    assert shown.length(1290.04) == "1,290.0 m"
    assert shown.gradient(0.0931) == "9.31 %"
    assert shown.number(-0.04, 1) == "0.0"
    assert shown.number(-2.5, 1) == "−2.5"
    assert shown.length(None) == "–"
    assert shown.length(math.nan) == "–"


def test_feet_and_degrees(settings):
    settings.length_unit = "ft"
    settings.gradient_unit = "degrees"
    shown = Quantities(settings)
    assert shown.length(0.3048 * 100) == "100.0 ft"
    assert shown.gradient(1.0) == "45.00 °"
    assert shown.meant_gradient(shown.shown_gradient(0.123)) == pytest.approx(0.123, rel=1e-12)


def test_signs_of_the_country(settings):
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    assert Quantities(settings).length(1290.04) == "1.290,0 m"


@pytest.mark.parametrize(
    ("text", "german"),
    [
        ("It can lie between 1380.23 m and 1,382.39 m.", "It can lie between 1.380,23 m and 1.382,39 m."),
        ("J changed by less than 0.001.", "J changed by less than 0,001."),
        ("J changed by less than 1e-300.", "J changed by less than 1e-300."),
        ("Stopped by hand after 42,357 iterations; the best is kept.",
         "Stopped by hand after 42.357 iterations; the best is kept."),
        ("It is 12.5 m (0.90 %) less, -3.5 m lower.", "It is 12,5 m (0,90 %) less, −3,5 m lower."),
        ("A factor of 1.0042, v1.2.3, 3D and plan2.5.csv.", "A factor of 1,0042, v1.2.3, 3D and plan2.5.csv."),
        ("0.5 m/px", "0,5 m/px"),
    ],
)  # fmt: skip
def test_numbers_in_sentences(settings, text, german):
    shown = Quantities(settings)
    assert shown.sentence(text.replace("1380", "1,380")) == text.replace("1380", "1,380").replace("-3.5", "−3.5")
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    assert shown.sentence(text) == german


def test_metres_in_sentences_follow_the_unit(settings):
    settings.length_unit = "ft"
    assert (
        Quantities(settings).sentence("Between 100.00 m and 304.8 m; f = 1.5.")
        == "Between 328.08 ft and 1,000.0 ft; f = 1.5."
    )


def test_numbers_of_any_size(settings):
    shown = Quantities(settings)
    assert [shown.short(value) for value in (8.014e-7, 0.44123, 0.0, None, math.nan, math.inf)] == [
        "8.01e−07", "0.441", "0", "–", "–", "∞",
    ]  # fmt: skip
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    assert shown.short(0.44123) == "0,441"
    assert shown.short(8.014e-7) == "8,01e−07"


def test_other_units_are_told(settings, qtbot):
    shown = Quantities(settings)
    with qtbot.waitSignal(shown.changed, timeout=1000):
        settings.length_unit = "ft"
