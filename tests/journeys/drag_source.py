"""A small window out of which a file can be dragged, like a file manager's.

usage: python -m tests.journeys.drag_source FILE
"""

import sys

from PySide6.QtCore import QMimeData, Qt, QTimer, QUrl
from PySide6.QtGui import QDrag
from PySide6.QtWidgets import QApplication, QLabel


class Source(QLabel):
    def mouseMoveEvent(self, event):
        drag = QDrag(self)
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(sys.argv[1])])
        drag.setMimeData(data)
        drag.exec(Qt.DropAction.CopyAction)
        # The other program fetches the data after the button was released.
        QTimer.singleShot(1500, QApplication.quit)


application = QApplication(sys.argv[:1])
window = Source("drag me")
window.setWindowFlags(Qt.WindowType.FramelessWindowHint | Qt.WindowType.WindowStaysOnTopHint)
window.setGeometry(0, 0, 80, 40)
window.show()
print("shown", flush=True)
application.exec()
