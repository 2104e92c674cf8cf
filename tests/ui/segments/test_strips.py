"""The strips, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog

from bobdesk.files.project_file import load_project
from bobdesk.ui.questions import Questions
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.segment_files import SegmentFiles
from bobdesk.ui.strips.contents import Curve, Marks, decimated
from bobdesk.ui.strips.station_axis import StationAxis, ticks
from bobdesk.ui.strips.strip import Strip
from bobdesk.ui.strips.strip_export import strip_csv, strip_png, strip_svg
from bobdesk.ui.strips.strip_stack import StripStack
from bobdesk.ui.theme import apply_theme, colours
from tests.alignment.made_lines import DATA

SAMPLES = DATA.parent.parent / "resources" / "samples"


@pytest.fixture
def stack(desk, now, qtbot, shown):
    made = shown(StripStack(desk), 1000, 330)
    qtbot.waitExposed(made)
    return made


def place(strip, station, share=0.5):
    on = strip.geometry_now()
    return QPoint(round(on.x(station)), round(on.area.top() + share * on.area.height()))


def drag(strip, start, end, modifier=Qt.KeyboardModifier.NoModifier, button=Qt.MouseButton.LeftButton, drop=True):
    QTest.mousePress(strip, button, modifier, start)
    for part in (0.3, 0.7, 1.0):
        at = QPointF(start) + part * (QPointF(end) - QPointF(start))
        move(strip, at.toPoint(), button, modifier)
    if drop:
        QTest.mouseRelease(strip, button, modifier, end)


def move(strip, at, button=Qt.MouseButton.NoButton, modifier=Qt.KeyboardModifier.NoModifier):
    from PySide6.QtCore import QEvent
    from PySide6.QtGui import QMouseEvent
    from PySide6.QtWidgets import QApplication

    event = QMouseEvent(
        QEvent.Type.MouseMove, QPointF(at), QPointF(strip.mapToGlobal(at)), Qt.MouseButton.NoButton, button, modifier
    )
    QApplication.sendEvent(strip, event)


def test_a_click_sets_the_cursor_and_selects_the_segment(desk, now, stack):
    middle = 0.5 * (now.segments[3].start + now.segments[3].end)
    QTest.mouseClick(stack.gradient, Qt.MouseButton.LeftButton, pos=place(stack.gradient, middle))
    assert desk.selection.segments == (3,)
    assert desk.selection.station == pytest.approx(middle, abs=1.0)
    assert all(strip.cursor_station == desk.selection.station for strip in stack.strips)
    later = 0.5 * (now.segments[6].start + now.segments[6].end)
    shift = Qt.KeyboardModifier.ShiftModifier
    QTest.mouseClick(stack.curvature, Qt.MouseButton.LeftButton, shift, place(stack.curvature, later))
    assert desk.selection.segments == (3, 4, 5, 6)


def test_the_readout_tells_radius_and_side(desk, now, stack):
    curve = next(index for index, segment in enumerate(now.segments) if segment.kind == "curve")
    desk.selection.station = 0.5 * (now.segments[curve].start + now.segments[curve].end)
    assert "radius" in stack.curvature._note
    assert "left" in stack.curvature._note
    desk.selection.station = 20.0
    assert "straight" in stack.curvature._note
    desk.settings.length_unit = "ft"
    assert "ft" in stack.curvature._note


def test_a_boundary_is_dragged_as_one_step_with_live_figures(desk, now, stack):
    before = desk.session.project
    end = now.segments[4].end
    strip = stack.curvature
    start, target = place(strip, end), place(strip, end + 15)
    drag(strip, start, target, Qt.KeyboardModifier.AltModifier, drop=False)
    assert desk.session.project is before
    assert now.segments[4].end == pytest.approx(end + 15, abs=1.5)
    assert now.is_preview
    assert len(stack.drag.sides()) == 2
    QTest.mouseRelease(strip, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.AltModifier, target)
    assert not now.is_preview
    assert desk.session.undo_label == "Move boundary"
    assert now.segments[4].end == pytest.approx(end + 15, abs=1.5)
    desk.session.undo()
    assert desk.session.project is before


def test_a_dragged_boundary_snaps_to_the_threshold_but_not_with_alt(desk, now, stack):
    strip = stack.elevation
    crossing = float(now.value.crossings()[3])
    boundary = int(np.argmin([abs(segment.end - crossing) for segment in now.segments[:-1]]))
    per_pixel = strip.geometry_now().metres_per_pixel
    operations(desk).move_boundary(boundary, crossing + 9 * per_pixel + 3)
    start = now.segments[boundary].end
    drag(strip, place(strip, start), place(strip, crossing + 4 * per_pixel))
    assert now.segments[boundary].end == crossing
    free = Qt.KeyboardModifier.AltModifier
    drag(strip, place(strip, crossing), place(strip, crossing + 4 * per_pixel + 4), free)
    assert now.segments[boundary].end != crossing


def test_a_boundary_that_stops_before_the_threshold_is_not_said_to_be_there(desk, now, stack):
    crossing = float(now.value.crossings()[5])
    boundary = int(np.argmin([abs(segment.end - crossing) for segment in now.segments[:-1]])) - 1
    assert stack.drag.hold(boundary)
    stack.drag.drag(crossing + 0.5, snap=5.0)
    assert stack.drag.station == pytest.approx(now.known.segments[boundary + 1].end - 3.0)
    assert not stack.drag.snapped
    stack.drag.cancel()


def test_escape_puts_a_dragged_boundary_back(desk, now, stack):
    before = now.segments
    strip = stack.curvature
    end = before[4].end
    drag(strip, place(strip, end), place(strip, end + 20), drop=False)
    QTest.keyClick(stack, Qt.Key.Key_Escape)
    assert now.segments == before
    QTest.mouseRelease(strip, Qt.MouseButton.LeftButton, pos=place(strip, end + 20))
    assert desk.session.undo_label is None


def test_a_locked_boundary_stays_and_says_so(desk, now, stack, told):
    do = operations(desk)
    do.select(4)
    do.lock()
    end = now.segments[4].end
    drag(stack.curvature, place(stack.curvature, end), place(stack.curvature, end + 20))
    assert now.segments[4].end == end
    assert "is locked" in told[-1]


def test_arrows_nudge_the_boundary_or_move_the_cursor(desk, now, stack):
    strip = stack.curvature
    end = now.segments[4].end
    QTest.mouseClick(strip, Qt.MouseButton.LeftButton, pos=place(strip, end))
    assert desk.selection.boundary == 4
    per_pixel = strip.geometry_now().metres_per_pixel
    QTest.keyClick(stack, Qt.Key.Key_Right)
    QTest.keyClick(stack, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(stack, Qt.Key.Key_Left, Qt.KeyboardModifier.ControlModifier)
    assert now.segments[4].end == pytest.approx(end + 10.9 * per_pixel)
    desk.session.undo()
    assert now.segments[4].end == end
    QTest.keyClick(stack, Qt.Key.Key_Escape)
    assert desk.selection.boundary is None
    desk.selection.station = 100.0
    QTest.keyClick(stack, Qt.Key.Key_Left)
    assert desk.selection.station == pytest.approx(100.0 - per_pixel)


def test_delete_takes_the_selected_boundary_away(desk, now, stack):
    desk.selection.boundary = 4
    QTest.keyClick(stack, Qt.Key.Key_Delete)
    assert len(now.segments) == 16


def test_the_threshold_line_is_dragged(desk, now, stack, idle):
    strip = stack.curvature
    on = strip.geometry_now()
    start = QPoint(round(on.x(12.0)), round(on.y(now.threshold)))
    end = QPoint(start.x(), round(on.y(0.02)))
    drag(strip, start, end, drop=False)
    assert now.threshold == pytest.approx(0.02, abs=0.002)
    assert desk.session.undo_label is None
    QTest.mouseRelease(strip, Qt.MouseButton.LeftButton, pos=end)
    idle()
    assert desk.session.project.segmentation.threshold == pytest.approx(0.02, abs=0.002)
    assert desk.session.undo_label == "Change segmentation"


def test_wheel_pan_and_box_zoom_share_one_axis(stack, qtbot):
    axis = stack.axis
    whole = (axis.low, axis.high)
    at = place(stack.gradient, 200.0)
    wheel(stack.gradient, at, 240)
    assert axis.high - axis.low == pytest.approx((whole[1] - whole[0]) / 1.25**2)
    assert stack.elevation.geometry_now().station(at.x()) == pytest.approx(200.0, abs=1.0)
    low = axis.low
    drag(
        stack.elevation,
        place(stack.elevation, 200.0),
        place(stack.elevation, 230.0),
        button=Qt.MouseButton.MiddleButton,
    )
    assert axis.low == pytest.approx(low - 30, abs=1.5)
    drag(
        stack.curvature, place(stack.curvature, 150.0, 0.1), place(stack.curvature, 250.0, 0.6),
        Qt.KeyboardModifier.ControlModifier,
    )  # fmt: skip
    assert (axis.low, axis.high) == (pytest.approx(150, abs=1.5), pytest.approx(250, abs=1.5))
    assert stack.curvature.own_range is not None
    QTest.mouseDClick(stack.curvature, Qt.MouseButton.LeftButton, pos=place(stack.curvature, 180.0))
    assert axis.shows_all
    assert stack.curvature.own_range is None


def wheel(widget, at, angle):
    from PySide6.QtGui import QWheelEvent
    from PySide6.QtWidgets import QApplication

    event = QWheelEvent(
        QPointF(at), QPointF(widget.mapToGlobal(at)), QPoint(), QPoint(0, angle), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(widget, event)


def test_a_dragged_stretch_shows_its_figures(now, stack):
    curve = next(segment for segment in now.segments if segment.kind == "curve")
    shift = Qt.KeyboardModifier.ShiftModifier
    drag(stack.elevation, place(stack.elevation, curve.start), place(stack.elevation, curve.end), shift)
    assert stack.card.isVisible()
    figures = now.figures[now.segments.index(curve)]
    texts = [value.text() for _, value in stack.card._values]
    assert float(texts[0].split()[0]) == pytest.approx(curve.length, abs=3)
    assert float(texts[3].split("°")[0]) == pytest.approx(abs(np.degrees(figures.turn)), abs=6)
    assert texts[4:] == ["–", "–"]
    QTest.keyClick(stack, Qt.Key.Key_Escape)
    assert not stack.card.isVisible()


def test_the_result_is_shown_with_limits_and_known_elevations(desk, stack, idle):
    desk.session.open(load_project(SAMPLES / "made_double" / "made_double.bobdesk"), None)
    idle()
    assert {"run"} == set(stack.gradient.curves) == set(stack.elevation.curves)
    assert len(stack.elevation.marks["known"].stations) == 3
    assert stack.axis.length == pytest.approx(1377, abs=5)
    desk.selection.station = 400.0
    assert stack.gradient._note.endswith("%")
    stack.select_range(100, 300)
    assert "–" not in [value.text() for _, value in stack.card._values]
    desk.session.close()
    assert stack.curvature.curves == {}
    assert stack.elevation.marks == {}


def test_a_strip_is_saved_as_picture_drawing_and_table(stack, tmp_path, desk, told):
    image = QImage.fromData(strip_png(stack.curvature), "PNG")
    assert image.width() == 2 * stack.curvature.width()
    assert QSvgRenderer(strip_svg(stack.curvature)).isValid()
    lines = strip_csv(stack.curvature).decode().splitlines()
    assert lines[0] == "station_m,raw_curvature_per_m,curvature_per_m"
    assert len(lines) == 1 + len(stack.curvature.curves["fitted"].stations)
    assert stack._saving.save(stack.curvature, tmp_path / "c.svg", ".svg")
    assert (tmp_path / "c.svg").read_bytes().startswith(b"<?xml")
    assert not stack._saving.save(stack.curvature, tmp_path / "nowhere" / "c.csv", ".csv")
    assert "cannot be written" in told[-1]


def test_where_to_save_is_asked_in_the_way_that_asks_before_it_overwrites(stack, tmp_path, monkeypatch, window):
    def unasked(*_arguments):
        pytest.fail("a name typed without its ending would overwrite a file unasked")

    endings = []

    def asked(_questions, purpose, _title, name, _filters, ending):
        endings.append((purpose, name, ending))
        return tmp_path / f"{name}{ending}"

    monkeypatch.setattr(QFileDialog, "getSaveFileName", unasked)
    monkeypatch.setattr(Questions, "file_to_save", asked)
    stack._saving.ask(stack.curvature, ".csv")
    SegmentFiles(stack._desk, window).ask_save()
    assert endings == [("export", "curvature", ".csv"), ("export", "segments", ".csv")]
    assert {path.name for path in tmp_path.glob("*.csv")} == {"curvature.csv", "segments.csv"}


def test_the_context_menu_saves_and_fits(stack, qtbot):
    menu = stack.menu_at(stack.curvature.mapToGlobal(QPoint(200, 40)))
    texts = [action.text() for action in menu.actions()]
    assert "Save as PNG…" in texts
    assert "Show the whole line" in texts
    menu.deleteLater()


def test_marks_can_be_dragged_by_others(desk, qtbot):
    strip = Strip(StationAxis(), desk.quantities, "Elevation")
    qtbot.addWidget(strip)
    strip.resize(600, 120)
    strip.show()
    strip.set_curve("run", Curve(np.array([0.0, 1000.0]), np.array([100.0, 0.0])))
    strip.set_marks("known", Marks(np.array([500.0]), np.array([50.0]), is_draggable=True))
    dropped = []
    strip.mark_dropped.connect(lambda *what: dropped.append(what))
    on = strip.geometry_now()
    start = QPoint(round(on.x(500)), round(on.y(50)))
    drag(strip, start, start + QPoint(0, -20))
    assert len(dropped) == 1
    key, index, station, value = dropped[0]
    assert (key, index) == ("known", 0)
    assert station == pytest.approx(500, abs=2)
    assert value == pytest.approx(on.value(on.y(50) - 20), abs=1.5)


def test_a_hundred_thousand_points_keep_every_peak():
    stations = np.linspace(0, 10_000, 100_001)
    values = np.zeros(100_001)
    values[55_555] = 9.0
    x, y = decimated(stations, values, 0, 10_000, 500)
    assert len(x) <= 2004
    assert y.max() == 9.0
    assert (np.diff(x) >= 0).all()


@pytest.mark.parametrize(
    ("low", "high", "expected", "digits"),
    [(0, 1000, [0, 200, 400, 600, 800, 1000], 0), (0, 0.061, [0, 0.02, 0.04, 0.06], 2), (-3, 3, [-2, 0, 2], 0)],
)
def test_ticks_are_round_numbers(low, high, expected, digits):
    found, decimals = ticks(low, high, 5)
    assert found.tolist() == pytest.approx(expected)
    assert decimals == digits


def test_both_kinds_differ_without_colour_and_themes_are_followed(stack, now, qapp):
    apply_theme(qapp, "dark")
    image = stack.grab().toImage()
    assert image.pixelColor(stack.curvature.mapTo(stack, QPoint(3, 3))).name() == colours().base
    on = stack.elevation.geometry_now()
    found = {}
    for segment in now.segments:
        at = QPoint(round(on.x(0.5 * (segment.start + segment.end))) + 2, round(on.area.top()) + 3)
        found.setdefault(segment.kind, set()).add(image.pixelColor(stack.elevation.mapTo(stack, at)).lightness())
    assert max(found["straight"]) < min(found["curve"])
    apply_theme(qapp, "light")
