"""The empty window is on the screen before scipy, shapely and the plots' library are loaded."""

import subprocess
import sys

PROGRAM = """
import sys
from pathlib import Path
from PySide6.QtCore import QEvent, QObject
from bobdesk.ui import application
from bobdesk.ui.settings import Settings

folder = Path(sys.argv[1])
qt = application.make_application([])
window = application.MainWindow(Settings(folder / "settings.ini"), folder / "data")
painted = []

class Painted(QObject):
    def eventFilter(self, watched, event):
        if event.type() == QEvent.Type.Paint and not painted:
            painted.append([name for name in ("scipy", "shapely", "pyqtgraph") if name in sys.modules])
        return False

watcher = Painted()
qt.installEventFilter(watcher)
window.show()
while not painted:
    qt.processEvents()
window.close()
print(painted)
"""


def test_heavy_libraries_wait_for_the_first_paint(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path)], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[[]]"
