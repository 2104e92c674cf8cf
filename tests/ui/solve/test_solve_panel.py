import numpy as np
import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtGui import QGuiApplication

from bobdesk.project import derive, edits
from bobdesk.project.project import ActualTrack
from bobdesk.solve.settings import SolverSettings
from bobdesk.ui.solve.preset_dialog import PresetDialog
from bobdesk.ui.solve.presets import presets
from bobdesk.ui.theme import apply_theme
from bobdesk.ui.widgets.typed_number import typed_number


def type_into(qtbot, field, text):
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, text)


def test_the_sentence_lives_while_one_types(desk, panel, qtbot, until, idle):
    box = panel.feasibility.box
    assert box.sentence.startswith("✓ These figures can all be met")
    type_into(qtbot, panel.targets.length, "990")
    until(lambda: box.sentence.startswith("! No plausible 3D line"))
    assert desk.session.undo_label == "Length"
    assert "990.00 m" in box.sentence
    panel.targets.length.setText("")
    idle()


def test_a_row_of_key_strokes_is_one_step(desk, panel, qtbot, until, idle, opened):
    before = desk.session.project.targets.drop
    field = panel.targets.drop
    type_into(qtbot, field, "7")
    until(lambda: desk.session.project.targets.drop == 7.0)
    qtbot.keyClicks(field, "2")
    until(lambda: desk.session.project.targets.drop == 72.0)
    qtbot.keyClick(field, Qt.Key.Key_Return)
    desk.session.undo()
    assert desk.session.project.targets.drop == before
    idle()


def test_what_is_no_number_is_told_and_the_old_one_comes_back(desk, panel, qtbot, told):
    before = desk.session.project.targets.length
    type_into(qtbot, panel.targets.length, "long")
    qtbot.keyClick(panel.targets.length, Qt.Key.Key_Return)
    assert told == ["'long' is not a number; write it like 1234.5."]
    assert desk.session.project.targets.length == before
    assert panel.targets.length.text() == str(before)


def test_an_empty_field_is_unknown(desk, panel, qtbot, until, idle):
    type_into(qtbot, panel.targets.mean, "9")
    until(lambda: desk.session.project.targets.mean_gradient == pytest.approx(0.09))
    panel.targets.mean.selectAll()
    qtbot.keyClick(panel.targets.mean, Qt.Key.Key_Delete)
    until(lambda: desk.session.project.targets.mean_gradient is None)
    idle()


def offers(panel):
    return {button.text(): button for button in panel.feasibility.box.buttons}


def test_keep_two_and_derive_the_third(desk, panel, qtbot, idle):
    desk.session.apply("Mean", lambda project: edits.set_mean_gradient(project, 0.2))
    idle()
    found = [text for text in offers(panel) if text.startswith("Keep the others")]
    assert len(found) == 3
    mean = next(text for text in found if "mean gradient" in text)
    qtbot.mouseClick(offers(panel)[mean], Qt.MouseButton.LeftButton)
    targets = desk.session.project.targets
    assert targets.mean_gradient == pytest.approx(targets.drop / targets.length, rel=1e-4)
    idle()
    assert not [text for text in offers(panel) if text.startswith("Keep the others")]
    desk.session.undo()
    assert desk.session.project.targets.mean_gradient == 0.2
    idle()


def test_use_this_f_makes_the_figures_agree(desk, panel, qtbot, idle):
    length = desk.session.project.targets.length
    desk.session.apply("Length", lambda project: edits.set_length(project, round(1.05 * length, 2)))
    desk.session.apply("Known", lambda project: edits.set_known_elevations(project, ()))
    idle()
    use = next(text for text in offers(panel) if text.startswith("Use f ="))
    qtbot.mouseClick(offers(panel)[use], Qt.MouseButton.LeftButton)
    idle()
    assert panel.feasibility.box.sentence.startswith("✓"), panel.feasibility.box.sentence
    assert desk.session.undo_label == "Scale the plan by f"


def test_use_a_length_that_can_be_met(desk, panel, qtbot, idle):
    desk.session.apply("Length", lambda project: edits.set_length(project, 2000.0))
    idle()
    use = next(text for text in offers(panel) if text.startswith("Use the length"))
    qtbot.mouseClick(offers(panel)[use], Qt.MouseButton.LeftButton)
    idle()
    assert panel.feasibility.box.sentence.startswith("✓")


def test_it_blocks_nothing(desk, panel, idle):
    desk.session.apply("Length", lambda project: edits.set_length(project, 2000.0))
    panel.run.run_button.click()
    idle()
    assert desk.session.project.run.status == 2
    assert "short" in panel.run.progress.text()


def test_presets_want_to_be_confirmed(desk, panel, qtbot, idle):
    dialog = PresetDialog(desk.quantities, panel)
    taken = []
    dialog.taken.connect(taken.append)
    dialog.taken.connect(panel.targets.take_preset)
    dialog.table.selectRow(0)
    assert not dialog.take_button.isEnabled()
    dialog.confirmed.setChecked(True)
    dialog.take_button.click()
    assert taken == [presets()[0]]
    assert desk.session.project.targets.length == presets()[0].length
    assert desk.session.undo_label == f"Figures of {presets()[0].name}"
    assert len(presets()) == 17
    idle()


def test_start_houses(desk, panel, idle, monkeypatch):
    from PySide6.QtWidgets import QInputDialog

    monkeypatch.setattr(QInputDialog, "getText", lambda *_args, **_named: ("Juniors", True))
    panel.targets._on_add()
    assert [one.name for one in desk.session.project.target_sets] == ["Track", "Juniors"]
    assert panel.targets.sets.currentText() == "Juniors"
    panel.targets._on_remove()
    assert panel.targets.sets.count() == 1
    assert not panel.targets.remove_action.isEnabled()
    idle()


def test_a_known_elevation_is_added_at_the_cursor_and_changed_in_the_table(desk, panel, idle):
    desk.selection.station = 100.0
    before = desk.session.project
    panel.known.add_button.click()
    # Nothing is known until it is typed.
    assert desk.session.project is before
    model = panel.known.model
    row = model.rowCount() - 1
    assert model.setData(model.index(row, 1), "55.5")
    (added,) = set(desk.session.project.known_elevations) - set(before.known_elevations)
    assert (added.station, added.elevation) == (100.0, 55.5)
    assert not model.setData(model.index(desk.session.project.known_elevations.index(added), 2), "-1")
    desk.session.undo()
    assert desk.session.project.known_elevations == before.known_elevations
    idle()


def test_stations_are_pixels_while_the_scale_is_unknown(desk, panel, idle):
    scale = derive.calibration(desk.session.project).needed().metres_per_pixel
    model = panel.known.model
    assert model.headerData(0, Qt.Orientation.Horizontal) == "Station m"
    (metres,) = (each.station for each in desk.session.project.known_elevations)
    desk.session.apply("Scale", edits.find_the_scale)
    assert model.headerData(0, Qt.Orientation.Horizontal) == "Station px"
    assert typed_number(model.data(model.index(0, 0))) == pytest.approx(metres / scale, abs=0.006)
    desk.session.undo()
    idle()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("station_m,z_m\n10,50\n20.5,40\n", [(10, 50, 0), (20.5, 40, 0)]),
        ("z_m;station_m;tolerance_m\n50;10;0,5\n", [(10, 50, 0.5)]),
        ("10 50\n20 40\n", [(10, 50, 0), (20, 40, 0)]),
    ],
)
def test_known_elevations_from_a_table(tmp_path, text, expected):
    from bobdesk.files.importers.known_elevations import read_known_elevations

    path = tmp_path / "known.csv"
    path.write_text(text)
    found = read_known_elevations(path)
    assert [(one.station, one.elevation, one.tolerance) for one in found] == expected


def test_runs_are_shown_renamed_deleted_and_brought_back(desk, panel, solving, idle):
    solving.run()
    solving.run()
    idle()
    model = panel.runs.model
    assert model.rowCount() == 3
    assert model.setData(model.index(0, 1), "First")
    assert desk.session.project.runs[0].name == "First"
    panel.runs.table.selectRow(0)
    assert desk.session.project.chosen_run == 0
    colour = panel.runs.shown.colour_of(desk.session.project.runs[0])
    assert colour != panel.runs.shown.colour_of(desk.session.project.runs[1])
    panel.runs.delete_button.click()
    assert len(desk.session.project.runs) == 1
    desk.session.undo()
    assert desk.session.project.runs[0].name == "First"
    assert panel.runs.shown.colour_of(desk.session.project.runs[0]) == colour
    idle()


def test_the_copied_table_is_read_by_a_spreadsheet_of_the_same_country(desk, panel, solving, idle, qtbot):
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    german = QLocale()
    for drop in (60.0, 60.5):
        desk.session.apply("Drop", lambda project, drop=drop: edits.set_drop(project, drop))
        solving.run()
        idle()
    desk.session.apply("Rename", lambda project: edits.name_run(project, 0, "1.234"))
    panel.runs.table.selectRow(1)
    panel.runs.baseline_button.click()
    idle()
    panel.runs.copy()
    rows = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert len({len(row) for row in rows}) == 1
    assert rows[1][0] == "1.234", "a name stays as it is"
    length, drop = german.toDouble(rows[2][1]), german.toDouble(rows[1][2].removeprefix("+"))
    assert length == (pytest.approx(desk.session.project.runs[1].figures.length, abs=0.006), True)
    assert drop == (pytest.approx(-0.5, abs=0.006), True)
    assert "−" not in "".join(cell for row in rows[1:3] for cell in row[:8])


def test_overlay_baseline_and_copy(desk, panel, solving, idle):
    solving.run()
    desk.session.apply("Drop", lambda project: edits.set_drop(project, project.targets.drop + 2))
    solving.run()
    idle()
    points = np.column_stack([np.linspace(0, 700, 50), np.zeros(50), np.linspace(60, 0, 50)])
    desk.session.apply("Compare", lambda project: edits.compare_with(project, ActualTrack("a.csv", points)))
    model = panel.runs.model
    assert model.rowCount() == 4
    assert model.setData(model.index(0, 0), Qt.CheckState.Checked, Qt.ItemDataRole.CheckStateRole)
    idle()
    assert [run.name for run, _ in panel.runs.shown.overlays] == ["Run 1"]
    panel.runs.table.selectRow(0)
    panel.runs.baseline_button.click()
    assert model.data(model.index(1, 3)) == "+2.00"
    panel.runs.copy()
    lines = QGuiApplication.clipboard().text().splitlines()
    assert len(lines) == 5
    assert lines[0].split("\t")[:3] == ["Run", "Length m, difference to Run 1", "Drop m, difference to Run 1"]
    assert len({line.count("\t") for line in lines}) == 1
    assert lines[4].split("\t")[2] == f"{60 - desk.session.project.runs[0].figures.drop:+.2f}"
    idle()


@pytest.mark.parametrize("method", ["pgd", "published", "slsqp"])
def test_iterations_are_counted_in_one_way(desk, panel, solving, idle, method):
    desk.session.apply("Method", lambda project: edits.set_solver(project, SolverSettings(method=method)))
    told = []
    solving.advanced.connect(lambda: told.append((solving.record.count, panel.run.progress.text())))
    solving.run()
    idle()
    run = desk.session.project.run
    assert panel.convergence.plot.data.numbers[0] == 0
    assert f" {run.nit:,} iterations in " in panel.run.progress.text()
    assert panel.convergence.reading.text().startswith(f"Iterate {run.nit:,} of {run.nit:,}:")
    count, text = told[-1]
    assert f": iteration {count - 1:,}, " in text


def test_out_of_date_is_said_with_what_has_changed(desk, panel, solving, idle):
    solving.run()
    idle()
    assert not panel.run.state.isVisible()
    desk.session.apply("Drop", lambda project: edits.set_drop(project, project.targets.drop + 2))
    assert panel.run.state.isVisible()
    assert "targets, limits or known elevations changed" in panel.run.state.text()
    idle()


def test_settings_of_the_method(desk, panel, idle):
    panel.method.fold.set_open(True)
    assert panel.method._pgd.isVisible()
    panel.method.transition.setValue(12.0)
    assert desk.session.project.solver.pgd.transition == 12.0
    panel.method.method.setCurrentIndex(1)
    panel.method.method.activated.emit(1)
    assert desk.session.project.solver.method == "published"
    assert panel.method._published.isVisible()
    panel.method.threshold.setText("0.01")
    panel.method.threshold.setModified(True)
    panel.method.threshold.editingFinished.emit()
    assert desk.session.project.solver.threshold == 0.01
    idle()


def test_every_control_has_a_name_and_a_tip(panel, idle):
    from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit

    for kind in (QAbstractButton, QComboBox, QAbstractSpinBox):
        for control in panel.findChildren(kind):
            if control.objectName().startswith("qt_") or control.parent().inherits("QHeaderView"):
                continue
            if control.parent().inherits("QTableView") or control.parent().inherits("QAbstractSpinBox"):
                continue
            assert control.accessibleName(), control
            assert control.toolTip(), control.accessibleName()
    for field in panel.findChildren(QLineEdit):
        if not field.objectName().startswith("qt_"):
            assert field.accessibleName()


def test_it_fits_and_takes_the_dark(qapp, panel, idle):
    apply_theme(qapp, "dark")
    assert panel.widget().minimumSizeHint().width() <= 430
    panel.grab()
    apply_theme(qapp, "light")
