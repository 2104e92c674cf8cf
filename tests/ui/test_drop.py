import warnings

from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent

from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings


def test_a_dropped_file_is_copied_never_moved_and_read_after_the_drop(qtbot, tmp_path, monkeypatch):
    window = MainWindow(Settings(tmp_path / "settings.ini"), tmp_path / "data")
    qtbot.addWidget(window)
    opened = []
    monkeypatch.setattr(window.plans, "open_any", opened.append)
    mime = QMimeData()
    mime.setUrls([QUrl.fromLocalFile(str(tmp_path / "igls.png"))])
    either = Qt.DropAction.CopyAction | Qt.DropAction.MoveAction
    button, held = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier
    with warnings.catch_warnings():
        # Qt 6.12 wants a QPointF here, which Qt 6.11 does not take.
        warnings.simplefilter("ignore", DeprecationWarning)
        enter = QDragEnterEvent(QPoint(9, 9), either, mime, button, held)
    window.dragEnterEvent(enter)
    assert enter.isAccepted()
    drop = QDropEvent(QPointF(9, 9), either, mime, button, held)
    drop.setDropAction(Qt.DropAction.MoveAction)
    window.dropEvent(drop)
    assert drop.dropAction() == Qt.DropAction.CopyAction
    assert opened == []
    qtbot.waitUntil(lambda: opened == [tmp_path / "igls.png"])
    window.close()
