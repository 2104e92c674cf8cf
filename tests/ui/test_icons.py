"""The icons: each can be drawn, in the palette's colours alone, and shows something at the smallest size."""

import re
from pathlib import Path

import pytest
from defusedxml import ElementTree
from PySide6.QtWidgets import QApplication

from bobdesk.ui.icons import icon
from bobdesk.ui.resources import resource
from bobdesk.ui.settings import Theme
from bobdesk.ui.theme import apply_theme

DRAWINGS = sorted(resource("icons").glob("*.svg"))


@pytest.mark.parametrize("drawing", DRAWINGS, ids=lambda drawing: drawing.stem)
def test_a_drawing_has_no_colour_of_its_own(drawing: Path) -> None:
    text = drawing.read_text(encoding="utf-8")
    root = ElementTree.fromstring(text)
    assert root.tag.endswith("svg")
    if drawing.stem != "bobdesk":
        assert root.get("viewBox") == "0 0 24 24"
        found = set(re.findall(r'(?:fill|stroke|color)="([^"]*)"', text))
        assert found <= {"none", "currentColor"}
        assert "style" not in text


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_every_icon_shows_something_at_sixteen_pixels(qapp: QApplication, theme: Theme) -> None:
    apply_theme(qapp, theme)
    for drawing in DRAWINGS:
        image = icon(drawing.stem).pixmap(16, 16).toImage()
        inked = sum(image.pixelColor(x, y).alpha() > 100 for x in range(image.width()) for y in range(image.height()))
        assert inked >= 12, drawing.stem
    apply_theme(qapp, "light")
