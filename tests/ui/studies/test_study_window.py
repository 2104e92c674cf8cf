"""The study window: what is chosen, rows as they come, rest, stop and go on, pictures, what is remembered."""

import pytest
from PySide6.QtCore import QLocale, QPoint, QTimer

from bobdesk.cli.main import run as command
from bobdesk.errors import InputError
from bobdesk.files.project_file import save_project
from bobdesk.track.study_pivot import is_failed, value_of
from bobdesk.ui.studies.study_choice import PlanFile, StudyChoice, from_text, to_text, wanted_of
from bobdesk.ui.studies.study_window import StudyWindow


@pytest.fixture
def make(qtbot, desk, tmp_path, answering):
    made = []

    def window() -> StudyWindow:
        study = StudyWindow(desk, tmp_path / "studies")
        qtbot.addWidget(study)
        answering(study)
        study.open()
        made.append(study)
        return study

    yield window
    for study in made:
        study.stop()
        qtbot.waitUntil(lambda study=study: not study.is_running, timeout=60_000)


@pytest.fixture
def study(opened, make):
    return make()


def choose(study, **values) -> None:
    usual = {"workers": 2, "methods": ("pgd", "published"), "counts": "4-8:2", "weights": "0.5 1.5"}
    study.form.show_choice(StudyChoice(**{**usual, **values}))


def test_it_says_how_many_solves_that_makes(study):
    choose(study, known="100:5\n100:5 150:2")
    # 3 counts, pgd with 3 sets of known elevations, published with 2 weights
    assert study.summary.text().startswith("15 solves")
    study.form.counts.setText("many")
    assert "numbers of segments such as" in study.summary.text().lower()
    assert not study.bar.main_button.isEnabled()
    study.form.counts.setText("6")
    for box in study.form.method_boxes.values():
        box.setChecked(False)
    assert study.summary.text() == "Choose a method at least."


def test_without_any_plan_it_says_what_to_do(make):
    study = make()
    assert "Open a project" in study.summary.text()
    assert study.results.stack.currentWidget() is study.results.hint


def test_the_rows_are_the_commands(study, until, desk, tmp_path, capsys):
    choose(study)
    study.bar.main_button.click()
    until(lambda: not study.is_running)
    assert len(study.results.rows) == 9
    path = tmp_path / "made.bobdesk"
    save_project(desk.session.project, path)
    table = tmp_path / "t.csv"
    arguments = ["--counts", "4-8:2", "--methods", "pgd,published", "--height-weights", "0.5,1.5", "--workers", "1"]
    assert command(["study", str(path), *arguments, "-o", str(table)]) == 0
    study.questions.save_path = tmp_path / "w.csv"
    study.csv_button.click()
    assert (tmp_path / "w.csv").read_bytes() == table.read_bytes()


def test_stopped_and_begun_again_in_another_window_it_ends_in_the_same_table(study, make, until, held_at):
    going_on = held_at(3)
    choose(study, counts="3-9")
    study.solve()
    until(lambda: len(study.results.rows) >= 3)
    study.bar.stop_button.click()
    until(lambda: not study.is_running)
    kept = len(study.results.rows)
    assert 3 <= kept < 21
    going_on.set()
    assert "goes on from there" in study.bar.said.text()
    other = make()
    choose(other, counts="3-9")
    other.solve()
    until(lambda: not other.is_running)
    assert f"Solved before: {kept}." in other.bar.said.text()
    study.solve(restart=True)
    until(lambda: not study.is_running)
    assert "Solved before" not in study.bar.said.text()
    assert other.results.rows == study.results.rows
    assert len(study.results.rows) == 21


def test_it_rests_and_goes_on(study, until, qtbot, held_at):
    going_on = held_at(1)
    choose(study, counts="3-12")
    study.solve()
    until(lambda: len(study.results.rows) >= 1)
    study.bar.main_button.click()
    assert study.job.is_paused
    assert study.bar.said.text().startswith("Paused")
    going_on.set()
    # The step that was under way is the last one; what is solved meanwhile waits for its turn.
    spin(qtbot)
    shown = len(study.results.rows) + len(study.job.drained())
    spin(qtbot)
    assert study.job.drained() == []
    assert shown < 30
    study.bar.main_button.click()
    until(lambda: not study.is_running)
    assert len(study.results.rows) == 30


def spin(qtbot) -> None:
    """Let the window work for a while."""
    clock = QTimer()
    clock.setSingleShot(True)
    with qtbot.waitSignal(clock.timeout):
        clock.start(400)


def test_a_row_says_what_its_line_misses_whatever_its_method_says(study, until):
    choose(study, counts="4", weights="1")
    study.solve()
    until(lambda: not study.is_running)
    model = study.results.model
    targets = [column.heading() for column in model.headed()].index("Targets")
    pgd, other = study.results.rows
    assert model.index(0, targets).data() == "✓ met"
    assert (value_of(pgd, "status"), value_of(other, "status")) == ("met", "not met")
    assert model.index(1, targets).data() == f"! {value_of(other, 'missed')}"
    assert "% too short" in value_of(other, "missed")


def test_a_cell_that_fails_is_a_row_with_its_reason(study, until):
    choose(study, counts="4, 900", methods=("pgd",))
    study.solve()
    until(lambda: not study.is_running)
    good, failed = study.results.rows
    assert not is_failed(good)
    assert is_failed(failed)
    assert "cannot be told apart" in value_of(failed, "message")
    assert "Failed, with their reason: 1." in study.bar.said.text()


def test_files_are_plans_with_targets_of_their_own(study, until, plan_file, tmp_path, desk):
    study.form.plans.add_files([plan_file, tmp_path / "gone.csv"])
    until(lambda: not study.form.plans.is_reading)
    (entry,) = study.form.plans.entries
    assert entry.length == desk.session.project.targets.length
    assert [name for name, _ in study.form.plans.used()] == ["made", "made 2"]
    model = study.form.plans.model
    assert model.setData(model.index(1, 2), "1,000.5")
    assert study.form.plans.entries[0].length == 1000.5
    assert not model.setData(model.index(0, 2), "1000")
    choose_before = study.form.choice()
    assert choose_before.files == (PlanFile(str(plan_file), 1000.5, entry.drop),)
    assert model.setData(model.index(0, 0), 0, 10)  # the check box of the open project
    assert [name for name, _ in study.form.plans.used()] == ["made"]


def test_what_was_chosen_comes_back(study, make, until, plan_file):
    study.form.plans.add_files([plan_file])
    until(lambda: not study.form.plans.is_reading)
    study.form.counts.setText("7, 9")
    study.form.method_boxes["slsqp"].setChecked(True)
    study.form.known.setPlainText("100:5")
    chosen = study.form.choice()
    study.close()
    other = make()
    until(lambda: not other.form.plans.is_reading)
    assert other.form.choice() == chosen


def test_what_is_remembered_wrongly_is_forgotten():
    choice = StudyChoice(counts="3", files=(PlanFile("x.csv", 1.0, None, False),))
    assert from_text(to_text(choice)) == choice
    for bad in ("", "{}", "[1]", "null", '{"counts": 3, "methods": [], "files": []}', '{"files": [1]}'):
        assert from_text(bad) == StudyChoice()


def test_closing_in_mid_study_asks_and_stops(study, until, held_at):
    held_at(1)
    choose(study, counts="3-12")
    study.solve()
    until(lambda: len(study.results.rows) >= 1)
    study.close()
    assert study.questions.asked == ["stop"]
    assert study.isVisible()
    study.questions.stop_answer = True
    study.close()
    assert not study.isVisible()
    until(lambda: not study.is_running)


def test_pictures_are_drawn_and_saved(study, until, tmp_path):
    choose(study)
    study.solve()
    until(lambda: not study.is_running)
    assert not study.png_button.isEnabled()
    study.results.pages.setCurrentIndex(1)
    until(lambda: study.results.heat_view.laid_out is not None)
    heat = study.results.heat_view.laid_out.map
    assert heat.down == ("4 segments", "6 segments", "8 segments")
    assert heat.across == (("pgd",), ("published",))
    tip = study.results.heat_view.tip_at(study.results.heat_view.laid_out.rectangle(0, 1).center())
    assert tip.startswith("4 segments, published: ")
    assert "Rows in this place: 2" in tip
    assert study.results.heat_view.tip_at(QPoint(0, 0)) == ""
    study.results.pages.setCurrentIndex(2)
    until(lambda: study.results.chart_view.chart is not None)
    shown = study.results.chart_view.chart
    assert [series.name for series in shown.series] == ["pgd", "b = 0.5, published", "b = 1.5, published"]
    assert [name for _, name in shown.ticks] == ["4", "6", "8"]
    assert study.results.over.currentData() == "segments"
    study.results.over.setCurrentIndex(study.results.over.findData("height_weight"))
    study.results.over.activated.emit(study.results.over.currentIndex())
    until(lambda: study.results.chart_view.chart is not shown)
    assert [name for _, name in study.results.chart_view.chart.ticks] == ["0.5", "1.5"]
    for suffix, begins in ((".png", b"\x89PNG"), (".svg", b"<?xml")):
        study.questions.save_path = tmp_path / f"p{suffix}"
        study.save_picture(suffix)
        assert (tmp_path / f"p{suffix}").read_bytes().startswith(begins)


def test_numbers_are_read_with_the_signs_of_the_country():
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    wanted = wanted_of(StudyChoice(methods=("published", "pgd"), weights="0,5; 1 1,5", known="100:5,5"), 1)
    assert wanted.weights == (0.5, 1.0, 1.5)
    assert list(wanted.sets) == ["none", "100:5.5"]
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    assert wanted_of(StudyChoice(methods=("published",), weights="0.5,1,1.5"), 1).weights == (0.5, 1.0, 1.5)
    with pytest.raises(InputError, match="weights such as"):
        wanted_of(StudyChoice(methods=("published",), weights="0,5; 1"), 1)


def test_a_set_of_known_elevations_is_one_however_it_is_written():
    wanted = wanted_of(StudyChoice(methods=("pgd",), known="100:5;200:3\n200:3; 100:5.0\nnone"), 1)
    assert list(wanted.sets) == ["none", "100:5 200:3"]
    assert wanted.cells_of(1) == 2
    assert list(wanted_of(StudyChoice(methods=("pgd",), known="100.25:-5:0.5", without_known=False), 1).sets) == [
        "100.25:-5:0.5"
    ]


def test_rows_that_keep_coming_are_drawn_on_the_way(study, until, held_at):
    going_on = held_at(2)
    choose(study, counts="3-12")
    study.solve()
    study.results.pages.setCurrentIndex(1)
    until(lambda: study.results.heat_view.laid_out is not None)
    assert study.is_running
    first = study.results.heat_view.laid_out.map
    going_on.set()
    until(lambda: not study.is_running)
    until(lambda: len(study.results.heat_view.laid_out.map.down) == 10)
    assert len(first.down) < 10


def test_where_no_row_can_be_kept_it_says_so(qtbot, desk, opened, tmp_path, answering, until):
    (tmp_path / "studies").write_text("a file")
    study = StudyWindow(desk, tmp_path / "studies")
    qtbot.addWidget(study)
    told = []
    study.desk.notices.told.connect(lambda notice: told.append(notice.sentence))
    study.open()
    choose(study, counts="4", methods=("pgd",))
    study.solve()
    until(lambda: not study.is_running)
    assert len(told) == 1
    assert "cannot be kept" in told[0]
