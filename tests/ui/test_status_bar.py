from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from bobdesk.ui.status_bar import StatusBar


class Starting(QWidget):
    """Begins work while it is painted, as layers of the plan do."""

    def __init__(self, desk, parent):
        super().__init__(parent)
        self._desk = desk
        self.started = 0

    def paintEvent(self, _event: QPaintEvent) -> None:
        painter = QPainter(self)
        self._desk.runner.start("Drawing", lambda: (step for step in ()))
        self.started += 1
        painter.drawLine(0, 0, 9, 9)
        painter.end()


def test_work_that_begins_while_something_is_painted_paints_nothing_within(desk, qtbot, until):
    window = QWidget()
    qtbot.addWidget(window)
    column = QVBoxLayout(window)
    bar, starting = StatusBar(desk), Starting(desk, window)
    column.addWidget(starting)
    column.addWidget(bar)
    window.resize(500, 300)

    def long():
        while desk.runner.jobs[0].began and not done:
            yield 1

    done = []
    job = desk.runner.start("Long work", long)
    job.began -= 10.0
    window.show()
    qtbot.waitExposed(window)
    until(lambda: bar._bar.isVisible())
    # The bar changes from known to unknown progress, for which it paints itself at once.
    bar._bar.setRange(0, 1000)
    bar._bar.setValue(500)
    bar._job = None
    starting.repaint()
    assert starting.started >= 1
    done.append(True)
    until(lambda: not desk.runner.jobs and not bar._bar.isVisible())
