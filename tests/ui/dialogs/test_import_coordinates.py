"""The import dialog: how a file is read is shown, can be said otherwise, and is what is imported."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QApplication, QComboBox
from pytestqt.qtbot import QtBot

from bobdesk.ui.desk import Desk
from bobdesk.ui.dialogs.import_coordinates import look_at_coordinates
from bobdesk.ui.dialogs.import_coordinates.dialog import ImportDialog
from bobdesk.ui.resources import resource

LEFT = Qt.MouseButton.LeftButton
SAMPLE = resource("samples", "mugello", "mugello.csv")
Open = Callable[..., ImportDialog]


@pytest.fixture
def opened(qtbot: QtBot, desk: Desk) -> Iterator[Open]:
    made: list[ImportDialog] = []

    def open_it(path: Path, **given: Any) -> ImportDialog:
        dialog = ImportDialog(path, desk, **given)
        made.append(dialog)
        dialog.show()
        read(qtbot, dialog)
        return dialog

    yield open_it
    for dialog in made:
        dialog.reject()
        dialog.deleteLater()


def read(qtbot: QtBot, dialog: ImportDialog) -> None:
    qtbot.waitUntil(
        lambda: not (dialog._pause.isActive() or dialog.bar.isVisible() or dialog._newest.is_busy), timeout=10_000
    )


def pick(qtbot: QtBot, dialog: ImportDialog, box: QComboBox, text: str) -> None:
    """Choose with the keyboard."""
    box.setFocus()
    qtbot.keyClick(box, Qt.Key.Key_Home)
    for _ in range(box.findText(text) - box.currentIndex()):
        qtbot.keyClick(box, Qt.Key.Key_Down)
    assert box.currentText() == text
    read(qtbot, dialog)


def file(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "plan.csv"
    path.write_text(text)
    return path


def test_a_sample_is_shown_and_imported_with_its_elevations(qtbot: QtBot, opened: Open) -> None:
    dialog = opened(SAMPLE)
    assert dialog.choices.separator.currentText() == "comma"
    assert dialog.choices.x_column.currentText() == "x_m"
    assert "With elevations" in dialog.about.text()
    assert dialog.rows.horizontalHeaderItem(1).text().endswith("x")
    assert dialog.keep.isVisible()
    assert not dialog.problem.isVisible()
    qtbot.keyClick(dialog.import_button, Qt.Key.Key_Return)
    assert dialog.result() == ImportDialog.DialogCode.Accepted
    assert dialog.line is not None
    assert dialog.keeps_elevations


def test_elevations_need_not_be_kept(qtbot: QtBot, opened: Open) -> None:
    dialog = opened(SAMPLE)
    qtbot.keyClick(dialog.keep, Qt.Key.Key_Space)
    assert not dialog.keeps_elevations


def test_columns_that_are_not_clear_are_chosen(qtbot: QtBot, opened: Open, tmp_path: Path) -> None:
    dialog = opened(file(tmp_path, "nr;rechts;hoch\n1;0,5;0\n2;10,5;1\n3;20,5;3\n"))
    assert dialog.problem.isVisible()
    assert "Choose the columns" in dialog._sentence.text()
    assert str(tmp_path) not in dialog._sentence.text()
    assert not dialog.import_button.isEnabled()
    pick(qtbot, dialog, dialog.choices.x_column, "rechts")
    pick(qtbot, dialog, dialog.choices.y_column, "hoch")
    assert dialog.import_button.isEnabled()
    assert dialog.line is not None
    np.testing.assert_allclose(dialog.line.polyline.vertices, [[0.5, 0], [10.5, 1], [20.5, 3]])
    assert dialog.choice is not None
    assert dialog.choice.columns == (1, 2, None)


def test_another_separator_finds_other_columns(qtbot: QtBot, opened: Open, tmp_path: Path) -> None:
    dialog = opened(file(tmp_path, "x;y\n1,5;2,5\n3,5;9,5\n8,5;9,5\n"))
    assert dialog.line is not None
    pick(qtbot, dialog, dialog.choices.separator, "comma")
    assert dialog.line is None
    pick(qtbot, dialog, dialog.choices.separator, "semicolon")
    assert dialog.line is not None
    assert dialog.line.polyline.vertices[0].tolist() == [1.5, 2.5]


@pytest.mark.parametrize(
    ("unit", "rows", "expected"),
    [
        ("feet", "0,0,10\n100,0,9\n200,50,8\n", [[0, 0], [30.48, 0], [60.96, 15.24]]),
        ("millimetres", "0,0,10\n1000,0,9\n2000,500,8\n", [[0, 0], [1, 0], [2, 0.5]]),
    ],
)
def test_other_units_become_metres(
    qtbot: QtBot, opened: Open, tmp_path: Path, unit: str, rows: str, expected: list[list[float]]
) -> None:
    dialog = opened(file(tmp_path, f"x,y,z\n{rows}"))
    pick(qtbot, dialog, dialog.choices.unit, unit)
    assert dialog.line is not None
    np.testing.assert_allclose(dialog.line.polyline.vertices, expected)
    assert dialog.line.elevations is not None
    assert dialog.line.elevations[0] == pytest.approx(10 * {"feet": 0.3048, "millimetres": 0.001}[unit])


def test_degrees_become_metres_in_true_size(qtbot: QtBot, opened: Open, tmp_path: Path) -> None:
    dialog = opened(file(tmp_path, "x,y\n12.1,46.5\n12.1,46.501\n12.1,46.502\n"))
    pick(qtbot, dialog, dialog.choices.unit, "degrees of longitude and latitude")
    assert dialog.line is not None
    assert dialog.line.georeference is not None
    assert dialog.line.polyline.vertices[-1, 1] == pytest.approx(222.35, abs=0.05)
    dialog = opened(file(tmp_path, "x,y\n1200,46.5\n1201,46.501\n1205,46.502\n"))
    pick(qtbot, dialog, dialog.choices.unit, "degrees of longitude and latitude")
    assert "out of its range" in dialog._sentence.text()


def test_a_file_that_cannot_be_read_is_one_sentence(opened: Open, tmp_path: Path) -> None:
    dialog = opened(tmp_path / "none.csv")
    assert dialog._sentence.text() == "none.csv: there is no such file."
    assert not dialog.import_button.isEnabled()
    assert dialog.line is None


def test_the_actual_track_needs_elevations(opened: Open, tmp_path: Path) -> None:
    dialog = opened(file(tmp_path, "x,y\n0,0\n10,0\n20,5\n"), as_actual=True)
    assert "no elevations" in dialog._sentence.text()
    assert not dialog.import_button.isEnabled()
    assert opened(SAMPLE, as_actual=True).keeps_elevations


def test_reading_can_be_stopped_and_begun_again(qtbot: QtBot, desk: Desk, tmp_path: Path) -> None:
    rows = "\n".join(f"{index},{index % 7}" for index in range(60_000))
    dialog = ImportDialog(file(tmp_path, f"x,y\n{rows}\n"), desk)
    dialog.show()
    assert dialog.bar.isVisible()
    qtbot.mouseClick(dialog.stop_button, LEFT)
    qtbot.waitUntil(lambda: not dialog._newest.is_busy, timeout=10_000)
    assert dialog.line is None
    assert dialog.stop_button.text() == "Read again"
    qtbot.mouseClick(dialog.stop_button, LEFT)
    read(qtbot, dialog)
    assert dialog.line is not None
    dialog.reject()
    dialog.deleteLater()


@pytest.mark.parametrize("take", [True, False])
def test_the_window_gets_the_line_or_nothing(qtbot: QtBot, desk: Desk, take: bool) -> None:
    clock = QTimer()

    def answer() -> None:
        dialog = QApplication.activeModalWidget()
        if not isinstance(dialog, ImportDialog) or not dialog.import_button.isEnabled():
            return
        clock.stop()
        qtbot.keyClick(dialog, Qt.Key.Key_Return if take else Qt.Key.Key_Escape)

    clock.timeout.connect(answer)
    clock.start(20)
    looked = look_at_coordinates(desk, SAMPLE, as_actual=False, parent=None)
    clock.stop()
    assert (looked is not None) == take
    if looked is not None:
        assert looked[1]


def test_every_control_has_name_and_tip(opened: Open) -> None:
    dialog = opened(SAMPLE)
    for box in dialog.findChildren(QComboBox):
        assert box.accessibleName()
        assert box.toolTip()
