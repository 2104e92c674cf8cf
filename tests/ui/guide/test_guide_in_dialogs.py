"""The guide is opened from a dialog by key and button, read, and left again, while the dialog waits."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialogButtonBox

from bobdesk.ui.dialogs.import_coordinates.dialog import ImportDialog
from bobdesk.ui.dialogs.preferences import PreferencesDialog
from bobdesk.ui.resources import resource
from bobdesk.ui.solve.preset_dialog import PresetDialog

MADE = {
    "import": lambda window: ImportDialog(resource("samples", "mugello", "mugello.csv"), window.desk, parent=window),
    "preferences": lambda window: PreferencesDialog(window.desk.settings, window),
    # The parent is a part deep in the window, as it is for the button that opens this one.
    "presets": lambda window: PresetDialog(window.desk.quantities, window.centralWidget()),
}


@pytest.mark.parametrize(
    ("name", "page", "heading"),
    [
        ("import", "plan.md", "From coordinates"),
        ("preferences", "questions.md", "Can I change keys, units, colours?"),
        ("presets", "solve.md", "What is known of the track"),
    ],
)
@pytest.mark.parametrize("by", ["key", "button"])
def test_the_guide_opens_at_what_the_dialog_is_about(qtbot, window, name, page, heading, by):
    dialog = MADE[name](window)
    dialog.open()
    qtbot.waitExposed(dialog)
    dialog.activateWindow()
    qtbot.waitUntil(dialog.isActiveWindow)
    if by == "key":
        qtbot.keyClick(dialog, Qt.Key.Key_F1)
    else:
        help_button = dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Help)
        qtbot.mouseClick(help_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: window.guide.window is not None and window.guide.window.isActiveWindow())
    shown = window.guide.window.browser
    assert (shown.page.name, shown.textCursor().block().text()) == (page, heading)
    # The dialog does not block it.
    qtbot.keyClick(window.guide.window, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not window.guide.window.isVisible())
    assert dialog.isVisible()
    dialog.reject()
    dialog.deleteLater()
