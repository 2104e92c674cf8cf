"""A double click on a file in macOS's Finder comes as an event to the application."""

import subprocess
import sys
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QDialog

from bobdesk.ui.file_requests import FileRequests

ROOT = Path(__file__).parents[2]
PROJECT = ROOT / "resources" / "samples" / "made_thin" / "made_thin.bobdesk"

# The system's event, before there is a window, and a later one while the window asks something.
PROGRAM = """
import sys
from pathlib import Path
from PySide6.QtCore import QCoreApplication, QEvent, QTimer
from PySide6.QtGui import QFileOpenEvent
from PySide6.QtWidgets import QMessageBox
from bobdesk.ui import application

project = sys.argv[1]
opened = []

class Watched(application.MainWindow):
    def __init__(self, *arguments):
        super().__init__(*arguments)
        QTimer.singleShot(0, self, self.look)

    def open_file(self, path):
        opened.append(path)
        super().open_file(path)

    def look(self):
        if self.desk.session.path is None or self.desk.runner.jobs:
            QTimer.singleShot(20, self, self.look)
            return
        print(self.desk.session.path, flush=True)
        self.close()

application.MainWindow = Watched
make = application.make_application

def with_event(arguments):
    made = make(arguments)
    QCoreApplication.postEvent(made, QFileOpenEvent(project))
    return made

application.make_application = with_event
status = application.start(None)
print(len(opened))
sys.exit(status)
"""


def test_the_program_opens_the_file_of_the_event(own_folders, tmp_path):
    project = tmp_path / "Bahn für Tests.bobdesk"
    project.write_bytes(PROJECT.read_bytes())
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(project)], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [str(project), "1"]


def test_files_wait_for_the_window_and_for_answers(qtbot, window, until):
    requests = FileRequests()
    opened = []
    requests.add(Path("one"))
    requests.add(Path("two"))
    question = QDialog(window)
    question.open()
    owner = QObject()
    requests.hand_to(owner, opened.append)
    qtbot.waitUntil(question.isVisible)
    with qtbot.waitSignal(requests._timer.timeout):  # it looks, and goes on waiting
        pass
    assert opened == []
    question.reject()
    until(lambda: opened == [Path("one"), Path("two")])
    owner.deleteLater()


def test_no_file_goes_to_a_window_that_is_gone(qtbot, qapp):
    requests = FileRequests()
    opened = []
    owner = QObject()
    requests.hand_to(owner, opened.append)
    with qtbot.waitSignal(owner.destroyed):
        owner.deleteLater()
    requests.add(Path("late"))
    assert not requests._timer.isActive()
    assert opened == []
