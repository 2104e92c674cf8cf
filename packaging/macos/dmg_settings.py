"""How the disk image looks: for dmgbuild, which runs this file and reads the names below.

`defines` has the program's bundle, as `dmgbuild -s dmg_settings.py -D app=BobDesk.app NAME OUT.dmg` gives it.
"""

from pathlib import Path

application = defines["app"]  # type: ignore[name-defined] # noqa: F821 - dmgbuild puts it there

format = "ULMO"  # packed best; read by macOS 10.15 and later
files = [application]
symlinks = {"Applications": "/Applications"}
icon_locations = {Path(application).name: (160, 130), "Applications": (480, 130)}
window_rect = ((200, 200), (640, 300))
default_view = "icon-view"
show_status_bar = False
show_toolbar = False
icon_size = 112
text_size = 13
