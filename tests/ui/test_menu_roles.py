"""What macOS moves to the menu that bears the program's name: what is meant to go there, and nothing else."""

from PySide6.QtGui import QAction

from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings

Role = QAction.MenuRole


def test_about_preferences_and_quit_have_their_roles_and_no_text_is_guessed_from(qtbot, tmp_path):
    window = MainWindow(Settings(tmp_path / "s.ini"), tmp_path / "data")
    qtbot.addWidget(window)
    actions = window.actions_by_name
    roles = {row.name: actions[row.name].menuRole() for row in actions.table}
    assert {name: role for name, role in roles.items() if role != Role.NoRole} == {
        "about": Role.AboutRole,
        "preferences": Role.PreferencesRole,
        "quit": Role.QuitRole,
    }
    window.close()
