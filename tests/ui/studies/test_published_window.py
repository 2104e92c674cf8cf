"""The published tables in the window."""

import pytest

from bobdesk.cli.main import run as command
from bobdesk.ui.studies.published_window import PublishedWindow


@pytest.fixture
def published(qtbot, desk, answering):
    made = PublishedWindow(desk)
    qtbot.addWidget(made)
    answering(made)
    made.open()
    yield made
    made.stop()
    qtbot.waitUntil(lambda: not made.is_running, timeout=60_000)


def test_the_table_is_the_commands(published, qtbot, tmp_path, capsys):
    assert "not public" in published.about.text()
    published.bar.main_button.click()
    qtbot.waitUntil(lambda: not published.is_running, timeout=60_000)
    assert command(["published", "-o", str(tmp_path / "t.csv")]) == 0
    published.questions.save_path = tmp_path / "w.csv"
    published.csv_button.click()
    assert (tmp_path / "w.csv").read_bytes() == (tmp_path / "t.csv").read_bytes()
    headings = [column.heading().replace("\n", " ") for column in published.model.headed()]
    row = dict(zip(headings, (column.text(published.rows[0]) for column in published.model.headed()), strict=True))
    assert row["Track"] == "Whistler"
    assert row["Paper length %"] == "0.681"
    assert row["pgd drop %"] == "0.000"
    assert published.model.as_text().count("\n") == len(published.rows) + 1


def test_stop_keeps_the_rows_that_are_finished(published, until):
    published.solve()
    until(lambda: len(published.rows) >= 2)
    published.bar.stop_button.click()
    until(lambda: not published.is_running)
    kept = len(published.rows)
    assert 2 <= kept < published._total
    assert str(kept) in published.bar.said.text()
    assert published.csv_button.isEnabled()


def test_a_plan_of_ones_own_takes_the_place_of_a_stand_in_and_is_remembered(published, plan_file, desk, qtbot, until):
    published.questions.open_path = plan_file
    published.own_buttons["Whistler"].click()
    assert published.states["Whistler"].text() == "Whistler: made.csv"
    published.solve()
    until(lambda: len(published.rows) >= 1)
    published.stop()
    until(lambda: not published.is_running)
    assert published.rows[0].row.track == "Whistler"
    assert published.rows[0].plan < 1000
    other = PublishedWindow(desk)
    qtbot.addWidget(other)
    assert other.files == {"Whistler": plan_file}
    assert not published.changed_note.isVisible()
    published.back_buttons["Whistler"].click()
    assert published.states["Whistler"].text() == "Whistler: stand-in"
    assert published.changed_note.isVisible()


def test_a_plan_that_cannot_be_read_is_one_sentence(published, tmp_path, until):
    told = []
    published.desk.notices.told.connect(lambda notice: told.append(notice.sentence))
    published.use_plan("Cesana", tmp_path / "gone.csv")
    published.solve()
    until(lambda: not published.is_running)
    assert len(told) == 1
    assert "gone.csv" in told[0]
    assert published.stack.currentWidget() is published.hint
