import os

import pytest

from tests.soak.closing import WAYS, close_once, described


@pytest.mark.parametrize("number", range(0, 2 * len(WAYS), 2), ids=described)
def test_closing_in_the_middle_of_a_run_is_clean(number, tmp_path, monkeypatch):
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    assert close_once(number, tmp_path) == ""


def test_closing_a_real_window_in_the_middle_of_a_run_is_clean(screen, tmp_path, monkeypatch):
    monkeypatch.setenv("QT_QPA_PLATFORM", "xcb")
    monkeypatch.setenv("DISPLAY", screen.display)
    assert os.environ["DISPLAY"] == screen.display
    assert close_once(1, tmp_path) == ""
