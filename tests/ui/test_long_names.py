from PySide6.QtWidgets import QWidget

from bobdesk.project.project import Picture, Project
from bobdesk.ui.notice_bar import NoticeBar
from bobdesk.ui.status_bar import StatusBar
from bobdesk.ui.widgets.long_names import breakable, shortened

LONG = "x" * 240 + ".jpg"


def test_long_name_keeps_its_beginning_and_its_ending():
    assert shortened("igls.jpg") == "igls.jpg"
    assert shortened(LONG, 11) == "xxxxx…x.jpg"


def test_only_very_long_words_can_be_broken_anywhere():
    assert breakable("igls.jpg is no picture") == "igls.jpg is no picture"
    assert breakable(LONG).replace("\u200b", "") == LONG
    assert max(len(part) for part in breakable(LONG).split("\u200b")) == 40


def test_the_window_does_not_grow_with_a_file_s_name(desk, qtbot):
    owner = QWidget()
    qtbot.addWidget(owner)
    status, notices = StatusBar(desk, owner), NoticeBar(desk.notices, owner)
    desk.session.open(Project(picture=Picture(b"", LONG, size_px=(3, 3))), None)
    desk.notices.error(LONG + " is damaged")
    assert status.minimumSizeHint().width() < 700
    assert notices.minimumSizeHint().width() < 700
    desk.runner.close()
