"""Every control that the keyboard reaches says what it is and what it does: in every panel, dock and dialog."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractScrollArea,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDialogButtonBox,
    QGraphicsView,
    QHeaderView,
    QLabel,
    QLineEdit,
    QMenu,
    QMenuBar,
    QTabBar,
    QTableView,
    QTreeView,
    QWidget,
)

from bobdesk.ui.dialogs.about import AboutDialog
from bobdesk.ui.dialogs.command_palette import CommandPalette
from bobdesk.ui.dialogs.crash_dialog import CrashDialog
from bobdesk.ui.dialogs.import_coordinates.dialog import ImportDialog
from bobdesk.ui.dialogs.preferences import PreferencesDialog
from bobdesk.ui.dialogs.shortcut_sheet import ShortcutSheet
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.strips.strip_stack import StripStack
from bobdesk.ui.view3d.space_canvas import SpaceCanvas
from bobdesk.ui.widgets.fold import Fold

SAMPLES = Path(__file__).parent.parent.parent / "resources" / "samples"
CORTINA = SAMPLES / "cortina_2026_design"
STEPS = ("Plan", "Scale", "Centreline", "Segments", "Solve", "Export")


def inner(control: QWidget) -> bool:
    """Whether a control is Qt's own part of another one, which speaks for it."""
    parent = control.parentWidget()
    above = parent
    while above is not None:
        if isinstance(above, (QAbstractSpinBox, QComboBox)):
            return True
        above = above.parentWidget()
    return (
        # What a label says can be copied; its text is its name.
        isinstance(control, (QLabel, QHeaderView, QMenu, QMenuBar))
        or (isinstance(parent, QAbstractScrollArea) and control is parent.viewport())
        or (isinstance(parent, QAbstractItemView) and isinstance(control, (QHeaderView, QLineEdit)))
    )


def headings_say_more(table: QAbstractItemView) -> bool:
    """Whether each column of a table says by its heading what it is."""
    model, across = table.model(), Qt.Orientation.Horizontal
    return (
        isinstance(table, (QTableView, QTreeView))
        and model.columnCount() > 0
        and all(model.headerData(column, across, Qt.ItemDataRole.ToolTipRole) for column in range(model.columnCount()))
    )


def faults(top: QWidget) -> list[str]:
    """Return what is wrong with the controls of a window or panel, hidden ones too."""
    found = []
    for control in [top, *top.findChildren(QWidget)]:
        if isinstance(control, QGraphicsView) and not control.viewport().accessibleName():
            found.append(f"no name: what {type(control).__name__} shows")
        is_spare = isinstance(control, QAbstractButton) and control.isHidden() and not control.text()
        if control.focusPolicy() == Qt.FocusPolicy.NoFocus or inner(control) or is_spare:
            continue
        name = control.accessibleName() or (control.text() if isinstance(control, QAbstractButton) else "")
        path = f"{type(control).__name__} {control.objectName() or name!r} in {type(control.parentWidget()).__name__}"
        if not name:
            found.append(f"no name: {path}")
        says_more = control.toolTip() or (isinstance(control, QAbstractItemView) and headings_say_more(control))
        # What is done by pressing OK or Cancel, and by choosing a tab, is the same everywhere.
        is_known = isinstance(control.parentWidget(), QDialogButtonBox) or isinstance(control, QTabBar)
        # A tip would pop up over what is looked at; a screen reader is told.
        is_told = isinstance(control, (PlanView, SpaceCanvas, StripStack)) and control.accessibleDescription()
        if not says_more and not is_known and not is_told:
            found.append(f"no tip: {path}")
    return found


@pytest.mark.parametrize("step", STEPS)
def test_every_control_of_a_step(whole_window, step, until):
    whole_window.go_to(step)
    until(lambda: not whole_window.desk.runner.jobs)
    panel = whole_window.panels._shown[step]
    for fold in panel.findChildren(Fold):
        fold.set_open(True)
    until(lambda: not whole_window.desk.runner.jobs)
    assert "\n".join(faults(panel)) == ""


def test_every_control_around_the_panels(whole_window, until):
    whole_window.go_to("Segments")
    whole_window.desk.notices.error("Something is wrong with 5.")
    until(lambda: not whole_window.desk.runner.jobs)
    whole_window.panels._strips.select_range(50.0, 90.0)
    whole_window.views.show_in_space(True)
    until(lambda: not whole_window.desk.runner.jobs)
    assert "\n".join(faults(whole_window)) == ""
    whole_window.views.show_in_space(False)


def test_every_control_of_the_start_page(whole_window):
    whole_window.start.refresh()
    assert faults(whole_window.start.page) == []


DIALOGS = {
    "preferences": lambda window: PreferencesDialog(window.desk.settings, window),
    "shortcuts": lambda window: ShortcutSheet(window.actions_by_name, window.desk.settings, window),
    "palette": lambda window: CommandPalette(window.actions_by_name, window.desk.settings, window),
    "about": lambda window: AboutDialog(window),
    "import": lambda window: ImportDialog(SAMPLES / "mugello" / "mugello.csv", window.desk, parent=window),
    "crash": lambda window: CrashDialog(
        "Traceback …\nZeroDivisionError", "ZeroDivisionError", kept=True, parent=window
    ),
}


@pytest.mark.parametrize("name", DIALOGS)
def test_every_control_of_a_dialog(whole_window, name, until, qtbot):
    dialog = DIALOGS[name](whole_window)
    qtbot.addWidget(dialog)
    dialog.show()
    until(lambda: not whole_window.desk.runner.jobs)
    found = faults(dialog)
    dialog.close()
    QApplication.processEvents()
    assert "\n".join(found) == ""
