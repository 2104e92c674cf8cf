"""What is typed into a spin box, in two countries."""

import pytest
from PySide6.QtCore import QLocale, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget

from bobdesk.ui.plan_view.popup import Field, Popup
from bobdesk.ui.widgets.spin import Spin, WholeSpin

# A tool tip is a window of its own, and the platform of the tests cannot raise one.
pytestmark = pytest.mark.qt_log_ignore("does not support raise", extend=True)
ENGLISH, GERMAN = QLocale("en_GB"), QLocale("de_DE")


def typed(box, text):
    box.selectAll()
    QTest.keyClicks(box, text)
    QTest.keyClick(box, Qt.Key.Key_Return)
    return box.value()


@pytest.fixture
def box(qtbot):
    def make(locale, kind=Spin):
        QLocale.setDefault(locale)
        made = kind("Length")
        qtbot.addWidget(made)
        made.setRange(0, 5000)
        made.setSuffix(" m")
        made.setValue(7)
        made.show()
        return made

    return make


@pytest.mark.parametrize(
    ("locale", "text", "value"),
    [
        (GERMAN, "12,5", 12.5),
        (GERMAN, "12.5", 12.5),
        (GERMAN, "1.234,5", 1234.5),
        (GERMAN, "1.234", 7),  # two readings: the number from before stays
        (ENGLISH, "12.5", 12.5),
        (ENGLISH, "12,5", 7),
        (ENGLISH, "1,234.5", 1234.5),
        (ENGLISH, "6000", 7),
    ],
)
def test_decimal_sign_and_thousands(box, locale, text, value):
    assert typed(box(locale), text) == value


@pytest.mark.parametrize(("locale", "text", "value"), [(GERMAN, "200.5", 7), (ENGLISH, "2,5", 7), (GERMAN, "300", 300)])
def test_whole_numbers(box, locale, text, value):
    assert typed(box(locale, WholeSpin), text) == value


def test_words_for_the_lowest_number_stay(box):
    made = box(ENGLISH)
    made.setSpecialValueText("automatic")
    made.setValue(0)
    made.interpretText()
    assert made.value() == 0
    assert typed(made, "3") == 3


def test_every_number_that_it_shows_it_reads(box):
    made = box(GERMAN)
    made.setDecimals(3)
    made.setValue(406.84)
    assert made.hasAcceptableInput()
    assert not made.say_what_is_wrong()


def test_arrows_step(box):
    made = box(GERMAN)
    QTest.keyClick(made, Qt.Key.Key_Up)
    assert made.value() == 8


def test_form_beside_a_click_keeps_what_it_cannot_read(qtbot):
    QLocale.setDefault(GERMAN)
    view = QWidget()
    qtbot.addWidget(view)
    host = QWidget(view)
    taken = []

    def take(numbers):
        taken.append(numbers)
        return False

    view.resize(500, 400)
    host.resize(500, 400)
    view.show()
    popup = Popup(
        host, QPointF(50, 50), "Point", [Field("East", 0.0, "m")], lambda numbers: bool(taken.append(numbers))
    )
    (east,) = popup.boxes
    typed(east, "1.290")
    assert taken == []
    assert east.text().startswith("1.290")
    typed(east, "1290")
    assert taken == [[1290.0]]
    popup.drop()
