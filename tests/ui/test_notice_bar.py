"""Notices: stacked, closed, remedied, and gone after a while."""

from collections.abc import Iterator

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from bobdesk.ui import notice_bar
from bobdesk.ui.notice_bar import NoticeBar, NoticeRow
from bobdesk.ui.notices import Notices, Remedy


@pytest.fixture
def notices() -> Notices:
    return Notices()


@pytest.fixture
def bar(qtbot: QtBot, notices: Notices) -> Iterator[NoticeBar]:
    window = QWidget()
    column = QVBoxLayout(window)
    made = NoticeBar(notices)
    column.addWidget(made)
    column.addWidget(QPushButton("elsewhere"))
    qtbot.addWidget(window)
    window.resize(500, 400)
    window.show()
    qtbot.waitExposed(window)
    yield made
    window.close()


def sentences(bar: NoticeBar) -> list[str]:
    return [notice.sentence for notice in bar.shown]


def row(bar: NoticeBar, sentence: str) -> NoticeRow:
    return next(row for row in bar.findChildren(NoticeRow) if row.notice.sentence == sentence and row.isVisible())


def test_it_is_hidden_until_there_is_something_to_say(bar: NoticeBar, notices: Notices) -> None:
    assert not bar.isVisible()
    notices.warn("look")
    assert bar.isVisible()
    assert sentences(bar) == ["Look."]


def test_the_newest_is_first_and_the_same_sentence_is_shown_once(bar: NoticeBar, notices: Notices) -> None:
    for sentence in ("One.", "Two.", "One."):
        notices.warn(sentence)
    assert sentences(bar) == ["One.", "Two."]


def test_another_document_takes_away_what_was_said_of_the_one_before(bar: NoticeBar, notices: Notices) -> None:
    notices.error("It cannot be solved.")
    notices.warn("It is short.")
    notices.note("It was saved.")
    notices.offer("There is a newer version.")
    bar.leave_document()
    assert sentences(bar) == ["There is a newer version."]


def test_at_most_four_and_notes_go_first(bar: NoticeBar, notices: Notices) -> None:
    notices.error("An error.")
    notices.note("A note.")
    for sentence in ("a.", "b.", "c."):
        notices.warn(sentence)
    assert sentences(bar) == ["C.", "B.", "A.", "An error."]
    notices.error("d.")
    assert sentences(bar) == ["D.", "C.", "B.", "A."]


def test_a_note_goes_by_itself_and_a_warning_stays(
    qtbot: QtBot, bar: NoticeBar, notices: Notices, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(notice_bar, "_NOTE_LASTS_MS", 30)
    notices.warn("Stays.")
    notices.note("Goes.")
    qtbot.waitUntil(lambda: sentences(bar) == ["Stays."])


def test_a_note_stays_while_the_keyboard_is_in_it(
    qtbot: QtBot, bar: NoticeBar, notices: Notices, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(notice_bar, "_NOTE_LASTS_MS", 30)
    notices.note("Read me.")
    bar.window().activateWindow()
    shown = row(bar, "Read me.")
    shown.close_button.setFocus()
    qtbot.waitUntil(shown.close_button.hasFocus)
    with qtbot.assertNotEmitted(shown.done, wait=120):
        pass
    qtbot.keyClick(shown.close_button, Qt.Key.Key_Escape)
    assert not sentences(bar)


def test_no_clock_runs_in_a_hidden_bar(bar: NoticeBar, notices: Notices) -> None:
    notices.note("Note.")
    timers = row(bar, "Note.").findChildren(QTimer)
    assert any(timer.isActive() for timer in timers)
    bar.window().hide()
    assert not any(timer.isActive() for timer in timers)


def test_closing_with_the_mouse(qtbot: QtBot, bar: NoticeBar, notices: Notices) -> None:
    notices.error("plan.png: the file cannot be read")
    assert sentences(bar) == ["plan.png: the file cannot be read."]
    qtbot.mouseClick(row(bar, "plan.png: the file cannot be read.").close_button, Qt.MouseButton.LeftButton)
    assert not bar.isVisible()


def test_a_remedy_is_done_once_and_may_tell_of_more(qtbot: QtBot, bar: NoticeBar, notices: Notices) -> None:
    notices.error("Broken.", Remedy("Mend it", lambda: notices.note("Mended.")))
    link = row(bar, "Broken.").findChild(QPushButton)
    link.setFocus()
    qtbot.keyClick(link, Qt.Key.Key_Space)
    assert sentences(bar) == ["Mended."]


def test_every_control_has_a_name(bar: NoticeBar, notices: Notices) -> None:
    notices.error("Broken.", Remedy("Mend it", lambda: None))
    shown = row(bar, "Broken.")
    assert shown.close_button.accessibleName()
    assert shown.accessibleName() == "Broken."


@pytest.mark.parametrize(
    ("first", "then"),
    [
        ("Segment 3 is locked, so this boundary stays.", "Segment 12 is locked, so this boundary stays."),
        ("a cut at 12.5 m would leave 3 m", "a cut at 1,234.25 m would leave 3 m"),
        ("'abc' is not a number; write it like 12.5", "'d e' is not a number; write it like 12.5"),
        ("It ends at 5.", "It ends at −17.25."),
    ],
)
def test_the_same_refusal_of_other_numbers_replaces_the_earlier_one(bar, notices, first, then):
    notices.warn("Something else.")
    notices.note(first)
    notices.note(then)
    assert len(bar.shown) == 2
    assert bar.shown[0].sentence.lower().startswith(then.lower().rstrip("."))


def test_other_refusals_and_other_weights_stay(bar, notices):
    notices.note("Segment 3 is locked.")
    notices.warn("Segment 4 is locked.")
    notices.note("Segment 3 is short.")
    assert len(bar.shown) == 3


def test_a_refusal_takes_the_place_of_the_one_before_whatever_it_is_about_and_however_grave(bar, notices):
    notices.error("The disk is full.")
    notices.note("It was saved.")
    notices.refuse("the length must be more than 0 m", weight="error")
    notices.refuse("'abc' is not a number", weight="warning")
    notices.refuse("Select a segment first", Remedy("Select all", lambda: None))
    assert sentences(bar) == ["Select a segment first.", "It was saved.", "The disk is full."]
    assert bar.shown[0].weight == "note"


def test_many_long_notices_are_scrolled_within_a_bounded_height(qtbot, bar, notices):
    long = "There is much to say of this, more than fits in one line of a window that is not wide. " * 3
    for number in range(4):
        notices.error("abcd"[number] + long)
    qtbot.waitUntil(lambda: bar.height() > 0)
    assert len(bar.shown) == 4
    assert bar.height() <= 7 * bar.fontMetrics().lineSpacing()
    last = row(bar, bar.shown[3].sentence)
    assert last.visibleRegion().isEmpty()
    last.close_button.setFocus()
    bar.clear()
    assert not bar.isVisible()


def test_one_notice_takes_no_more_room_than_it_needs(qtbot, bar, notices):
    notices.note("Short.")
    qtbot.waitUntil(lambda: row(bar, "Short.").height() > 0)
    assert bar.height() <= row(bar, "Short.").sizeHint().height() + 12
    shown = row(bar, "Short.")
    assert shown.visibleRegion().boundingRect().height() == shown.height()
