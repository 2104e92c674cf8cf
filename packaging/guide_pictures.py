"""Take the pictures of the user's guide: the program itself, doing what its pages tell.

usage: python packaging/guide_pictures.py [FOLDER]

The pictures go to resources/guide/pictures, or FOLDER: at twice the size of the screen, in light colours.
"""

from __future__ import annotations

import io
import os
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
SAMPLES = ROOT / "resources" / "samples"
LONGEST_JOB_S = 240.0
WIDEST_PX = 1280
COLOURS = 256
# The practice picture: both ends of its scale bar and of its line, pixels; what is known of it.
BAR = ((40.0, 2113.0), (440.0, 2113.0))
LINE = ((1794.9, 159.3), (160.0, 2003.0))
LENGTH, DROP, TOO_SHORT = "703.7", "35.73", "701"
KNOWN = ((200.0, 28.2), (400.0, 20.0), (600.0, 2.6))


def main() -> None:
    os.environ.update(QT_QPA_PLATFORM="offscreen", QT_SCALE_FACTOR="2", OPENBLAS_NUM_THREADS="1")
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "resources" / "guide" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    photographer = Photographer(folder)
    first_track(photographer)
    finished_sample(photographer)
    beside(photographer)
    photographer.close()
    total = sum(path.stat().st_size for path in folder.glob("*.png"))
    print(f"{len(list(folder.glob('*.png')))} pictures, {total / 1e6:.1f} MB, are in {folder.resolve()}.")


class Photographer:
    """A window, a hand, and a camera that cuts out what is talked about."""

    def __init__(self, folder: Path) -> None:
        from PySide6.QtCore import QSize

        from bobdesk.ui.application import install_language, make_application
        from bobdesk.ui.main_window import MainWindow
        from bobdesk.ui.settings import Settings
        from bobdesk.ui.theme import apply_theme

        self.folder = folder
        self.application = make_application([])
        home = Path(tempfile.mkdtemp())
        install_language(self.application, "en")
        apply_theme(self.application, "light")
        self.window = MainWindow(Settings(home / "settings.ini"), home / "data")
        self.window.resize(QSize(1060, 760))
        self.window.show()
        self.rest(1.0)

    def rest(self, at_least: float = 0.4) -> None:
        """Let the window work until nothing runs any more."""
        end, least = time.monotonic() + LONGEST_JOB_S, time.monotonic() + at_least
        while time.monotonic() < end and (time.monotonic() < least or self.window.desk.runner.jobs):
            self.application.processEvents()
            time.sleep(0.005)

    def until(self, true: Callable[[], bool]) -> None:
        """Wait for something."""
        end = time.monotonic() + LONGEST_JOB_S
        while not true():
            if time.monotonic() > end:
                raise TimeoutError("what was waited for did not happen")
            self.application.processEvents()
        self.rest()

    def do(self, name: str) -> None:
        """Trigger an action of the window."""
        self.window.actions_by_name[name].trigger()
        self.rest()

    def click_plan(self, place: tuple[float, float]) -> None:
        """Click on a pixel of the plan."""
        from PySide6.QtCore import QPointF, Qt
        from PySide6.QtTest import QTest

        view = self.window.view
        at = view.viewportTransform().map(QPointF(*place)).toPoint()
        QTest.mouseMove(view.viewport(), at)
        QTest.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at)
        self.rest(0.2)

    def look_at(self, place: tuple[float, float], times: float) -> None:
        """Zoom in on a pixel of the plan."""
        view = self.window.view
        view.fit_all()
        view.zoom_by(times)
        view.centerOn(*place)
        self.rest(0.2)

    def button(self, text: str, inside: object = None) -> object:
        """Return a visible button by its text."""
        from PySide6.QtWidgets import QPushButton

        found = [
            one for one in (inside or self.window).findChildren(QPushButton) if one.text() == text and one.isVisible()
        ]
        return found[0]

    def field(self, name: str) -> object:
        """Return a visible field by its accessible name."""
        from PySide6.QtWidgets import QWidget

        found = [one for one in self.window.findChildren(QWidget) if one.accessibleName() == name and one.isVisible()]
        return found[0]

    def fill(self, name: str, text: str) -> None:
        """Type into a field."""
        from PySide6.QtCore import Qt
        from PySide6.QtTest import QTest

        field = self.field(name)
        field.setFocus()
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Tab)
        self.rest()

    def take(self, name: str, *parts: object, ringed: Sequence[object] = (), margin: int = 8) -> None:
        """Save what surrounds some parts of the window, or all of it, with a ring around what matters."""
        from PySide6.QtCore import QPoint, QRect, QRectF, Qt
        from PySide6.QtGui import QColor, QPainter, QPen

        self.rest()
        window = self.window
        whole = QRect(QPoint(0, 0), window.size())

        def place(widget: object) -> QRect:
            if isinstance(widget, QRect):
                return widget
            return QRect(widget.mapTo(window, QPoint(0, 0)), widget.size()) & whole

        shot = window.grab()
        painter = QPainter(shot)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(QColor("#d0021b"), 3, Qt.PenStyle.SolidLine))
        for widget in ringed:
            painter.drawRoundedRect(QRectF(place(widget)).adjusted(-5, -4, 5, 4), 8, 8)
        painter.end()
        cut = QRect()
        for part in parts:
            cut |= place(part)
        cut = cut.adjusted(-margin, -margin, margin, margin) & whole if parts else whole
        ratio = shot.devicePixelRatio()
        piece = QRect(cut.topLeft() * ratio, cut.size() * ratio)
        self.save(name, shot.copy(piece))

    def save(self, name: str, shot: object) -> None:
        """Save a picture with as few colours and bytes as it needs."""
        from PIL import Image
        from PySide6.QtCore import QBuffer, QIODevice

        buffer = QBuffer()
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        shot.save(buffer, "PNG")
        picture = Image.open(io.BytesIO(bytes(buffer.data().data()))).convert("RGB")
        if picture.width > WIDEST_PX:
            height = round(picture.height * WIDEST_PX / picture.width)
            picture = picture.resize((WIDEST_PX, height), Image.Resampling.LANCZOS)
        few = picture.quantize(COLOURS, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE, kmeans=2)
        few.save(self.folder / f"{name}.png", optimize=True)

    def close(self) -> None:
        """End the program."""
        self.window.leave()
        self.application.processEvents()


def first_track(at: Photographer) -> None:
    """Do what the page "First track in ten minutes" tells, by the same keys and clicks."""
    from PySide6.QtCore import QRect, Qt
    from PySide6.QtTest import QTest

    window = at.window
    at.take("start", QRect(0, 0, 860, 330), margin=0)
    at.do("practice_picture")
    at.until(lambda: window.desk.picture.image is not None)
    at.do("fit_all")
    at.take("first-open", ringed=[window.steps_bar])

    at.do("step_2")
    at.button("Add distance").click()
    add_distance = at.button("Add distance")
    for place in BAR:
        at.look_at(place, 5)
        at.click_plan(place)
    view = window.view
    popup = at.field("Known distance")
    box = popup.boxes[0]
    box.selectAll()
    QTest.keyClicks(box, "100")
    at.take("first-scale", view, window.panels.stack, ringed=[popup, add_distance], margin=0)
    QTest.keyClick(box, Qt.Key.Key_Return)
    at.until(lambda: len(window.desk.session.project.known_distances) == 1)

    at.do("step_3")
    at.do("fit_all")
    trace = at.button("Trace")
    trace.click()
    for place in LINE:
        at.click_plan(place)
    at.do("loupe")
    at.until(lambda: window.desk.session.project.trace is not None)
    at.take("first-trace", view, window.panels.stack, margin=0)

    at.do("step_4")
    at.rest(1.0)
    strips = window.layout_of_window.strips_dock
    at.take("first-segments", view, strips, margin=0)

    at.do("step_5")
    at.fill("Length (3D)", LENGTH)
    at.fill("Height difference", DROP)
    at.rest(1.0)
    targets, feasible = part(at, "TargetsPart"), part(at, "FeasibilityBox")
    fields = [at.field("Length (3D)"), at.field("Height difference")]
    at.take("first-targets", targets, feasible, ringed=fields)
    at.fill("Length (3D)", TOO_SHORT)
    at.rest(1.0)
    at.take("targets", targets, feasible, ringed=[feasible])
    at.fill("Length (3D)", LENGTH)
    at.rest(1.0)
    at.do("run")
    at.until(lambda: window.desk.session.project.run is not None)
    at.rest(1.0)
    at.take("first-run", strips, margin=0)
    stack = strips.widget()
    wide = stack.elevation.grab()

    for station, elevation in KNOWN:
        window.desk.selection.station = station
        at.rest(0.2)
        add = at.button("Add", part(at, "KnownPart"))
        add.click()
        at.rest(0.2)
        editor = at.application.focusWidget()
        editor.selectAll()
        QTest.keyClicks(editor, str(elevation))
        QTest.keyClick(editor, Qt.Key.Key_Return)
        at.rest(0.2)
    at.do("run")
    at.rest(1.5)
    at.take("first-known", strips, margin=0)
    narrow = stack.elevation.grab()
    at.save("band", below_each_other(wide, narrow))

    at.do("export")
    at.rest(1.0)
    at.take("first-export", *file_of_export(at), margin=6)


def finished_sample(at: Photographer) -> None:
    """Take pictures of a bobsleigh track that is finished."""
    window = at.window
    window.documents.begin()
    at.rest()
    window.start.open_sample("made_double")
    at.until(lambda: window.desk.session.project.run is not None)
    view, strips = window.view, window.layout_of_window.strips_dock
    at.do("step_2")
    at.do("fit_all")
    at.take("scale", view, window.panels.stack, margin=0)
    at.do("step_3")
    at.take("centreline", view, window.panels.stack, margin=0)
    at.do("step_4")
    at.rest(1.0)
    at.take("segments", view, strips, window.panels.stack, margin=0)
    at.do("step_5")
    at.rest(1.0)
    at.take("solve", view, strips, window.panels.stack, margin=0)
    at.do("in_space")
    at.rest(1.0)
    at.take("space", window.views, margin=0)
    at.do("in_space")
    at.do("export")
    at.rest(1.0)
    at.take("export", *file_of_export(at), margin=6)


def beside(at: Photographer) -> None:
    """Take pictures of the windows for methods and studies, with their work done."""
    at.window.documents.begin()
    at.rest()
    at.window.start.open_sample("mugello")
    at.until(lambda: at.window.desk.session.project.run is not None)
    methods = at.window.beside.open("methods")
    methods.resize(900, 640)
    methods.compare()
    at.until(lambda: not methods.is_running)
    methods.table.choose(0)
    at.rest(1.0)
    at.save("methods", methods.grab())
    methods.close()
    study = at.window.beside.open("study")
    study.resize(1000, 640)
    study.form.counts.setText("8-24:4")
    study.form.weights.setText("0.5; 1; 1.5")
    study.solve()
    at.until(lambda: not study.is_running and bool(study.results.rows))
    study.results.pages.setCurrentIndex(1)
    at.rest(1.0)
    at.save("study", study.grab())
    study.close()


def part(at: Photographer, kind: str) -> object:
    """Return the visible part of a panel by the name of its class."""
    from PySide6.QtWidgets import QWidget

    return next(one for one in at.window.findChildren(QWidget) if type(one).__name__ == kind and one.isVisible())


def file_of_export(at: Photographer) -> tuple[object, ...]:
    """Return what of the panel Export is about the file: from its format to the button that saves it."""
    return at.field("Format"), at.field("Separators"), at.field("Preview of the file"), at.button("Copy")


def below_each_other(*shots: object) -> object:
    """Return one picture of several."""
    from PySide6.QtGui import QColor, QPainter, QPixmap

    ratio = shots[0].devicePixelRatio()
    gap = 14
    height = sum(shot.height() for shot in shots) + round(ratio * gap * (len(shots) - 1))
    whole = QPixmap(max(shot.width() for shot in shots), height)
    whole.setDevicePixelRatio(ratio)
    whole.fill(QColor("white"))
    painter = QPainter(whole)
    top = 0.0
    for shot in shots:
        painter.drawPixmap(0, round(top), shot)
        top += shot.height() / ratio + gap
    painter.end()
    return whole


if __name__ == "__main__":
    main()
