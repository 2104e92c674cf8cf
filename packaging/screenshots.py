"""Take a picture of every screen and dialog, light and dark, at 100 % and 200 %.

usage: python packaging/screenshots.py [FOLDER]

The pictures go to out/screenshots, or FOLDER; each theme and size is a program of its own. Studies are solved in
processes, which begin by reading this file again.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

SAMPLES = Path(__file__).parent.parent / "resources" / "samples"
STEPS = ("Plan", "Scale", "Centreline", "Segments", "Solve", "Export")
LONGEST_JOB_S = 90.0


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path("out/screenshots")
    for theme in ("light", "dark"):
        for scale in ("1", "2"):
            place = folder / f"{theme}-{scale}00"
            place.mkdir(parents=True, exist_ok=True)
            subprocess.run(
                [sys.executable, __file__, "--one", theme, str(place)],
                env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "QT_SCALE_FACTOR": scale},
                check=True,
            )
    print(f"The pictures are in {folder.resolve()}.")


def one(theme: str, folder: Path) -> None:
    """Walk through the program and take its pictures."""
    from PySide6.QtCore import QSize
    from PySide6.QtWidgets import QApplication, QWidget

    from bobdesk.files.project_file import load_project, save_project
    from bobdesk.files.recovery import Recovery
    from bobdesk.ui.application import install_language, make_application
    from bobdesk.ui.main_window import MainWindow
    from bobdesk.ui.settings import Settings
    from bobdesk.ui.theme import apply_theme

    application = make_application([])
    home = Path(tempfile.mkdtemp())
    settings = Settings(home / "settings.ini")
    install_language(application, "en")
    apply_theme(application, theme)

    def work(true: Callable[[], bool] = lambda: True, at_least: float = 0.3) -> None:
        end, least = time.monotonic() + LONGEST_JOB_S, time.monotonic() + at_least
        while time.monotonic() < end and (time.monotonic() < least or not true()):
            application.processEvents()
            time.sleep(0.005)

    def take(name: str, widget: QWidget) -> None:
        work()
        widget.grab().save(str(folder / f"{name}.png"))

    for name in ("made_double", "mugello"):
        recent = home / f"{name}.bobdesk"
        save_project(load_project(SAMPLES / name / f"{name}.bobdesk"), recent)
        settings.remember_recent(recent)
    settings.remember_recent(home / "gone.bobdesk")
    left = Recovery(home / "data")
    left.keep(load_project(SAMPLES / "mugello" / "mugello.bobdesk"), path=None, last_edit="Move vertex")
    left.wait(10)
    left.close(forget=False)

    window = MainWindow(settings, home / "data")
    window.resize(QSize(1440, 900))
    window.show()
    quiet = lambda: not window.desk.runner.jobs  # noqa: E731
    work(quiet, 0.8)
    take("start", window)
    window.start.open_sample("made_double")
    work(lambda: window.desk.session.is_open and quiet(), 1.0)
    for number, step in enumerate(STEPS, start=1):
        window.go_to(step)
        work(quiet, 0.8)
        take(f"step-{number}-{step.lower()}", window)
        if step == "Segments":
            as_seen_without_green(folder / f"step-{number}-{step.lower()}.png")
    for name in open_data(window):
        work(quiet, 0.8)
        take(name, window)
    window.go_to("Plan")
    window.desk.notices.note("The project was recovered; save it to keep it.")
    window.desk.notices.warn("The line turns back on itself at 412, 618; look there.")
    window.desk.notices.error("The project is not saved: igls.bobdesk: there is no space left on the disk.")
    take("notices", window)
    for name, dialog in dialogs(window, home):
        dialog.show()
        work(quiet, 0.8)
        take(f"dialog-{name}", dialog)
        dialog.close()
        dialog.deleteLater()
    beside(window, take, work)
    for page in ("index.md", "first-track.md", "files.md"):
        window.guide.open(page)
        take(f"guide-{page.removesuffix('.md')}", window.guide.window)
    window.leave()
    QApplication.processEvents()


def as_seen_without_green(picture: Path) -> None:
    """Put a picture beside one, as a person with deuteranopia sees it (Machado and others, 2009)."""
    import numpy as np
    from PIL import Image

    mixed = np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]])
    shown = np.asarray(Image.open(picture).convert("RGB")) / 255
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    seen = np.clip(linear @ mixed.T, 0, 1)
    seen = np.where(seen <= 0.0031308, 12.92 * seen, 1.055 * seen ** (1 / 2.4) - 0.055)
    Image.fromarray(np.rint(255 * seen).astype(np.uint8)).save(picture.with_stem(f"{picture.stem}-deuteranopia"))


def open_data(window: object) -> Iterator[str]:
    """Show what the data leave open, one thing after the other, and the design rules."""
    from bobdesk.ui.panels.export_panel import ExportPanel
    from bobdesk.ui.panels.solve_panel import SolvePanel
    from bobdesk.ui.solve.open_data import open_data_of

    found = open_data_of(window.desk)
    window.go_to("Solve")
    panel = window.findChild(SolvePanel)
    panel.advice.ask_button.click()
    yield "open-advice"
    panel.advice.ask_button.click()
    found.show("profiles", True)
    yield "open-profiles"
    found.show("profiles", False)
    found.show("error_band", True)
    panel.budget.fold.set_open(True)
    panel.verticalScrollBar().setValue(panel.verticalScrollBar().maximum())
    yield "open-budget"
    panel.verticalScrollBar().setValue(panel.verticalScrollBar().maximum())
    yield "open-budget-below"
    found.show("error_band", False)
    panel.budget.fold.set_open(False)
    window.go_to("Export")
    panel = window.findChild(ExportPanel)
    rules = panel.rules
    rules.table.selectRow(next(row for row in range(20) if getattr(rules.finding(row), "stretches", ())))
    rules.table.clicked.emit(rules.table.currentIndex())
    rules.sled_fold.set_open(True)
    panel.ensureWidgetVisible(rules.sled_fold)
    yield "design-rules"
    rules.sled_fold.set_open(False)
    window.desk.selection.stretch = None


def beside(window: object, take: Callable, work: Callable) -> None:
    """Walk through the windows beside the main one: empty, and with what they are for."""
    from PySide6.QtCore import QSize

    methods = window.beside.open("methods")
    methods.resize(QSize(1000, 720))
    take("window-methods-empty", methods)
    methods.compare()
    work(lambda: not methods.is_running)
    methods.table.choose(0)
    take("window-methods", methods)
    study = window.beside.open("study")
    study.resize(QSize(1180, 760))
    take("window-study-empty", study)
    study.form.plans.add_files([SAMPLES / "mugello" / "mugello.csv"])
    work(lambda: not study.form.plans.is_reading)
    study.form.counts.setText("8-16:2, 400")
    study.form.weights.setText("0.5; 1; 1.5")
    study.solve()
    work(lambda: len(study.results.rows) > 8)
    take("window-study-at-work", study)
    work(lambda: not study.is_running)
    for page, name in enumerate(("table", "heat-map", "curves")):
        study.results.pages.setCurrentIndex(page)
        take(f"window-study-{name}", study)
    published = window.beside.open("published")
    published.resize(QSize(1180, 720))
    take("window-published-empty", published)
    published.solve()
    work(lambda: not published.is_running)
    take("window-published", published)


def dialogs(window: object, home: Path) -> Iterator[tuple[str, object]]:
    """Make every dialog, one after the other."""
    from bobdesk.ui.dialogs.about import AboutDialog
    from bobdesk.ui.dialogs.command_palette import CommandPalette
    from bobdesk.ui.dialogs.crash_dialog import CrashDialog
    from bobdesk.ui.dialogs.import_coordinates.dialog import ImportDialog
    from bobdesk.ui.dialogs.preferences import PreferencesDialog
    from bobdesk.ui.dialogs.shortcut_sheet import ShortcutSheet

    actions, settings = window.actions_by_name, window.desk.settings
    bad = home / "bad.csv"
    bad.write_text("x;y\n1,5;2\nhere;3\n")
    yield "preferences", PreferencesDialog(settings, window)
    yield "shortcuts", ShortcutSheet(actions, settings, window)
    yield "palette", CommandPalette(actions, settings, window)
    yield "about", AboutDialog(window)
    yield "import", ImportDialog(SAMPLES / "mugello" / "mugello.csv", window.desk, parent=window)
    yield "import-bad", ImportDialog(bad, window.desk, parent=window)
    yield "crash", CrashDialog("Traceback …\nZeroDivisionError", "ZeroDivisionError", kept=True, parent=window)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        one(sys.argv[2], Path(sys.argv[3]))
    else:
        main()
