from pathlib import Path

import pytest

from bobdesk.ui.settings import Settings


@pytest.fixture
def place(tmp_path, qapp):
    return tmp_path / "settings.ini"


def test_everything_is_remembered(place):
    first = Settings(place)
    first.theme, first.language, first.length_unit, first.gradient_unit = "dark", "de", "ft", "degrees"
    first.autosave_minutes = 5
    first.set_flag("loupe", False)
    first.set_key("draw", "Ctrl+D")
    first.remember_recent(Path("/a/b.bobdesk"))
    first.write()
    again = Settings(place)
    assert (again.theme, again.language, again.length_unit, again.gradient_unit) == ("dark", "de", "ft", "degrees")
    assert again.autosave_minutes == 5
    assert again.flag("loupe", True) is False
    assert again.key_of("draw") == "Ctrl+D"
    assert again.recent == (Path("/a/b.bobdesk").absolute(),)


def test_nonsense_in_the_file_gives_the_usual_values(place):
    place.write_text("[General]\ntheme=purple\nlength_unit=cubits\nautosave_minutes=soon\nrecent=@Invalid()\n")
    settings = Settings(place)
    assert (settings.theme, settings.length_unit, settings.autosave_minutes, settings.recent) == ("system", "m", 0, ())


def test_newest_project_comes_first_and_once(place):
    settings = Settings(place)
    for name in ("/a.bobdesk", "/b.bobdesk", "/a.bobdesk"):
        settings.remember_recent(Path(name))
    assert settings.recent == (Path("/a.bobdesk"), Path("/b.bobdesk"))
    settings.forget_recent(Path("/a.bobdesk"))
    assert settings.recent == (Path("/b.bobdesk"),)


def test_usual_key_comes_back(place):
    settings = Settings(place)
    settings.set_key("draw", "")
    assert settings.key_of("draw") == ""
    settings.set_key("draw", None)
    assert settings.key_of("draw") is None
