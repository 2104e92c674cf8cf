from PySide6.QtCore import QLocale, Qt
from PySide6.QtWidgets import QToolButton

from bobdesk.project import derive, edits
from bobdesk.project.project import Picture, Project
from bobdesk.ui.steps_bar import StepsBar
from tests.project.made_projects import full_project


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


def test_sentences_have_the_signs_of_the_country_and_the_unit(desk, qtbot, until):
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    bar = StepsBar(desk)
    qtbot.addWidget(bar)
    desk.session.open(full_project(), None)
    length = derive.centreline(desk.session.project).needed().length
    until(lambda: "✓" in bar._buttons["Centreline"].text())
    bar.show_step("Centreline")
    assert bar._sentence.text() == f"{length:.1f} m in plan.".replace(".", ",", 1)
    bar.show_step("Scale")
    assert bar._sentence.text().startswith("0,5")
    desk.settings.length_unit = "ft"
    bar.show_step("Centreline")
    assert bar._sentence.text().endswith(" ft in plan.")
    assert all(button.toolTip() for button in bar._buttons.values())


def test_a_name_keeps_its_dots_and_braces(desk, qtbot, until):
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    bar = StepsBar(desk)
    qtbot.addWidget(bar)
    picture = Picture(b"x", "plan 1.5 {0}.png", size_px=(900, 900))
    desk.session.open(edits.open_picture(Project(), picture), None)
    until(lambda: "✓" in bar._buttons["Plan"].text())
    bar.show_step("Plan")
    assert bar._sentence.text() == "Picture plan 1.5 {0}.png."
