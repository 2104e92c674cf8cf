"""The windows beside the main one: opened by actions, free of it, ended with it."""

import time

import psutil
import pytest
from PySide6.QtCore import QLocale, Qt

from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings
from bobdesk.ui.studies.study_choice import StudyChoice


@pytest.fixture
def main(qtbot, tmp_path, opened):
    made = MainWindow(Settings(tmp_path / "settings.ini"), tmp_path / "data")
    qtbot.addWidget(made)
    made.desk.session.open(opened, None)
    made.show()
    qtbot.waitUntil(lambda: not made.desk.runner.jobs, timeout=60_000)
    yield made
    made.leave()


def children() -> set[int]:
    return {child.pid for child in psutil.Process().children(recursive=True) if "spawn_main" in str(child.cmdline())}


def test_the_actions_open_each_window_once(main):
    for action, name in (
        ("compare_methods", "methods_window"), ("study", "study_window"), ("published_tables", "published_window"),
    ):  # fmt: skip
        main.actions_by_name[action].trigger()
        (window,) = main.beside._made.values() if len(main.beside._made) == 1 else list(main.beside._made.values())[-1:]
        assert window.objectName() == name
        assert window.isVisible()
        assert window.parent() is None
        assert not window.testAttribute(Qt.WidgetAttribute.WA_QuitOnClose)
        assert main.beside.open({"methods_window": "methods", "study_window": "study"}.get(name, "published")) is window
    main.desk.session.close()
    assert not main.actions_by_name["compare_methods"].isEnabled()
    assert main.actions_by_name["study"].isEnabled()


def test_leaving_in_mid_study_ends_its_processes_and_keeps_its_rows(main, until, tmp_path):
    study = main.beside.open("study")
    study.form.show_choice(StudyChoice(counts="3-12", methods=("pgd", "de"), workers=2))
    study.solve()
    until(lambda: len(study.results.rows) >= 1)
    assert children()
    main.leave()
    deadline = time.monotonic() + 20
    while children() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not children()
    (journal,) = (tmp_path / "data" / "studies").iterdir()
    assert journal.read_bytes().count(b"\n") >= 2


def test_numbers_follow_the_country_on_the_screen_and_never_in_files(main, until, answering, tmp_path):
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    study = main.beside.open("study")
    answering(study)
    study.form.show_choice(StudyChoice(counts="6", weights="0,5", methods=("published",), workers=1))
    study.solve()
    until(lambda: not study.is_running)
    assert "\t0,5\tpublished\t" in study.results.model.as_text()
    study.questions.save_path = tmp_path / "s.csv"
    study.csv_button.click()
    assert ",0.5,published," in (tmp_path / "s.csv").read_text()
