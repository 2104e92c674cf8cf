"""A window opens a project while its start page looks at recent ones: both are read at once, for the first time."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "resources" / "samples" / "mugello" / "mugello.bobdesk"
# Threads take turns as often as they can: without care about one time in three ends by a fault.
AT_ONCE = """
import sys, threading
from pathlib import Path
from bobdesk.files.project_file import load_project
sys.setswitchinterval(1e-5)
together, found = threading.Barrier(4), []
def read():
    together.wait()
    found.append(load_project(Path(sys.argv[1])).name)
threads = [threading.Thread(target=read) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert found == ["Mugello, descent"] * 4, found
"""


def test_projects_are_read_by_several_threads_at_once():
    started = [subprocess.Popen([sys.executable, "-c", AT_ONCE, str(SAMPLE)], cwd=ROOT) for _ in range(10)]
    assert [each.wait(60) for each in started] == [0] * 10
