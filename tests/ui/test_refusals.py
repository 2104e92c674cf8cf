"""What is refused in the whole window: the plan is not covered by what was tried before."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from bobdesk.project import edits
from bobdesk.ui.panels.solve_panel import SolvePanel


def test_refusals_of_fields_edits_and_tools_do_not_pile_up(whole_window, until, qtbot):
    desk, bar = whole_window.desk, whole_window.notice_bar
    whole_window.go_to("Solve")
    targets = whole_window.findChild(SolvePanel).targets
    bar.clear()
    for field, typed in ((targets.length, "long"), (targets.drop, "-3"), (targets.lowest, "30"), (targets.mean, "-5")):
        field.setFocus()
        field.selectAll()
        qtbot.keyClicks(field, typed)
        qtbot.keyClick(field, Qt.Key.Key_Return)
    assert [notice.sentence for notice in bar.shown] == [
        "The mean gradient is the drop divided by the length, so it must be more than 0."
    ]
    whole_window.go_to("Segments")
    until(lambda: not desk.runner.jobs)
    desk.selection.clear()
    QTest.keyClick(whole_window.view, Qt.Key.Key_O)
    assert [notice.sentence for notice in bar.shown] == [
        "Select a segment first: click it on the plan, on a strip or in the table."
    ]
    desk.session.apply("Drop", lambda project: edits.set_drop(project, -1.0))
    assert len(bar.shown) == 1
