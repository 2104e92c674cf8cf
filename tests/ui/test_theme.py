import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QComboBox, QLineEdit, QWidget

from bobdesk.ui.theme import apply_theme, colours
from bobdesk.ui.widgets.spin import Spin


def luminance(colour):
    parts = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in colour.getRgbF()[:3]]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


MAKERS = {"spin": lambda parent: Spin("Size", parent), "line": QLineEdit, "combo": QComboBox}


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_the_outline_of_a_field_can_be_seen(qapp, qtbot, theme, make):
    apply_theme(qapp, theme)
    parent = QWidget()
    qtbot.addWidget(parent)
    field = make(parent)
    field.setGeometry(20, 20, 160, 28)
    parent.resize(220, 80)
    parent.show()
    qtbot.waitExposed(parent)
    image = field.grab().toImage()
    # The corners are round, and lines may lie a pixel inside.
    edge = [image.pixelColor(80, row) for row in range(3)]
    assert max(contrast(pixel, QColor(colours().base)) for pixel in edge) >= 3.0
    parent.close()
    apply_theme(qapp, "light")
