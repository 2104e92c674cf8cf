from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from bobdesk.ui.steps_bar import StepsBar


def test_tab_stops_once_at_the_step_that_is_shown(desk, qtbot):
    bar = StepsBar(desk)
    qtbot.addWidget(bar)
    bar.show_step("Scale")
    stops = [
        button.accessibleName()
        for button in bar.findChildren(QToolButton)
        if button.focusPolicy() & Qt.FocusPolicy.TabFocus
    ]
    assert stops == ["Step 2, Scale"]


def test_narrow_window_leaves_the_words_of_undo_out(desk, qtbot):
    bar, button = StepsBar(desk), QToolButton()
    button.setText("Undo set the scale by two points")
    qtbot.addWidget(bar)
    bar.add_at_right(button, words=True)
    bar.resize(1200, 60)
    bar.show()
    wide = bar.minimumSizeHint().width()
    assert button.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonTextBesideIcon
    bar.resize(800, 60)
    assert button.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonIconOnly
    qtbot.waitUntil(lambda: bar.minimumSizeHint().width() < wide - 60)
