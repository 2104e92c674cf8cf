"""About: every library that the program needs is named, with a licence's text."""

import re
import tomllib
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from bobdesk import __version__
from bobdesk.ui import licences
from bobdesk.ui.dialogs.about import AboutDialog
from bobdesk.ui.resources import resource

ROOT = Path(__file__).parents[3]


def test_it_shows_licences_and_copies_versions(qtbot: QtBot) -> None:
    dialog = AboutDialog()
    qtbot.addWidget(dialog)
    dialog.show()
    dialog.tabs.setCurrentIndex(1)
    qtbot.keyClick(dialog.list, Qt.Key.Key_Down)
    assert "Lesser General Public License" in dialog.text.toPlainText()
    assert "GNU GENERAL PUBLIC LICENSE" in dialog.text.toPlainText()
    qtbot.mouseClick(dialog.copy_button, Qt.MouseButton.LeftButton)
    copied = QGuiApplication.clipboard().text()
    assert f"BobDesk {__version__}" in copied
    assert "numpy" in copied
    qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    assert not dialog.isVisible()


def test_every_needed_library_is_listed() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    needed = {
        re.split(r"[^\w-]", one)[0].lower() for one in project["dependencies"] + extras["cad"] + extras["cluster"]
    }
    assert needed <= {row[0].lower() for row in licences._LIBRARIES}


def test_every_part_has_a_text() -> None:
    found = licences.components()
    assert found[0].name == "BobDesk"
    for one in found:
        assert len(one.text) > 100, one.name
        assert one.licence, one.name


def test_libraries_without_texts_of_their_own_get_the_bundled_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(licences, "_own_texts", lambda _distribution: "")
    texts = {one.name: one.text for one in licences.components()}
    assert "Apache License" in texts["pypdfium2, with PDFium"]


def test_the_bundled_licence_is_the_repositorys() -> None:
    assert resource("licences", "BobDesk.txt").read_text() == (ROOT / "LICENSE").read_text()
