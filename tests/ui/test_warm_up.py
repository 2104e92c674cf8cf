"""What is loaded after the first paint, and on which thread."""

import subprocess
import sys

LOADED = """
import sys
from bobdesk.ui.warm_up import {function}
before = set(sys.modules)
{call}
print(*sorted({{name.partition(".")[0] for name in set(sys.modules) - before}}))
"""


def loaded_by(function: str, call: str) -> set[str]:
    code = LOADED.format(function=function, call=call)
    return set(subprocess.check_output([sys.executable, "-c", code], text=True).split())


def test_no_class_of_qt_is_made_on_another_thread():
    found = loaded_by("warm_up_steps", "list(warm_up_steps())")
    assert {"numpy", "scipy", "shapely"} <= found
    assert not {"PySide6", "shiboken6", "pyqtgraph"} & found


def test_plots_are_loaded_by_the_window_itself():
    assert "pyqtgraph" in loaded_by("warm_up_plots", "warm_up_plots()")


def test_the_window_loads_them_when_the_rest_is_there(whole_window, until, monkeypatch):
    called = []
    monkeypatch.setattr("bobdesk.ui.main_window.warm_up_plots", lambda: called.append(True))
    whole_window.warm_up()
    until(lambda: called == [True])
