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


def test_other_units_are_told(settings, qtbot):
    shown = Quantities(settings)
    with qtbot.waitSignal(shown.changed, timeout=1000):
        settings.length_unit = "ft"
