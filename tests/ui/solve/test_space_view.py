import math
import time
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor

from bobdesk.project import edits
from bobdesk.project.project import ActualTrack
from bobdesk.ui.theme import colours
from bobdesk.ui.view3d.camera import Camera
from bobdesk.ui.view3d.colouring import STEPS, colouring
from bobdesk.ui.view3d.picture import scene_file, scene_image
from bobdesk.ui.view3d.scene import Scene, Thread
from bobdesk.ui.view3d.space_view import SpaceView


@pytest.fixture
def view(desk, opened, solving, idle, shown):
    solving.run()
    idle()
    made = shown(SpaceView(desk), 800, 600)
    idle()
    return made


def scene(points, **values):
    points = np.asarray(points, dtype=float)
    plain = np.zeros(len(points), dtype=bool)
    found = colouring("elevation", points[:, 2])
    return Scene(points, found, is_curve=plain, is_selected=plain, has_drop_lines=False, **values)


def test_usual_sides():
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]])
    flat = Camera(zoom=1.0, exaggeration=1.0)
    front, _ = flat.looking(0, 0).seen(points, 0, 0)
    assert front == pytest.approx(np.array([[0, 0], [10, 0], [0, 0], [0, -10]]), abs=1e-9)
    side, _ = flat.looking(90, 0).seen(points, 0, 0)
    assert side == pytest.approx(np.array([[0, 0], [0, 0], [10, 0], [0, -10]]), abs=1e-9)
    top, _ = flat.looking(0, 90).seen(points, 0, 0)
    assert top == pytest.approx(np.array([[0, 0], [10, 0], [0, -10], [0, 0]]), abs=1e-9)


def test_panning_and_zooming_keep_places_under_the_mouse():
    points = np.random.default_rng(1).normal(size=(20, 3)) * 100
    camera = Camera().fitted(points, 800, 600)
    before, _ = camera.seen(points, 800, 600)
    after, _ = camera.panned(30, -20).seen(points, 800, 600)
    assert after - before == pytest.approx(np.full((20, 2), (30, -20)))
    at = before[3] - (400, 300)
    zoomed, _ = camera.zoomed(1.7, *at).seen(points, 800, 600)
    assert zoomed[3] == pytest.approx(before[3])
    assert np.ptp(zoomed[:, 0]) == pytest.approx(1.7 * np.ptp(before[:, 0]))


def test_what_is_fitted_is_in_sight():
    points = np.random.default_rng(2).normal(size=(50, 3)) * (300, 20, 5)
    for turn, tilt in ((0, 0), (90, 0), (0, 90), (-35, 28)):
        places, _ = replace(Camera().looking(turn, tilt)).fitted(points, 800, 600).seen(points, 800, 600)
        assert places.min() >= 0
        assert places[:, 0].max() <= 800
        assert places[:, 1].max() <= 600


def test_what_is_in_front_covers_what_is_behind(qapp):
    crossing = scene([[-50, 0, 0], [50, 0, 0]])
    far = Thread(np.array([[0.0, 40, -40], [0, 40, 40]]), "#ff00ff")
    near = Thread(np.array([[20.0, -40, -40], [20, -40, 40]]), "#00ff00")
    camera = Camera(turn=0, tilt=0, zoom=4, exaggeration=1)
    image = scene_image(replace(crossing, threads=(far, near)), camera, 600, 400)
    assert image.pixelColor(300, 200) == QColor(colours().straight), "the line lies before the far one"
    assert image.pixelColor(380, 200).green() > 200, "and behind the near one"
    turned = scene_image(replace(crossing, threads=(far, near)), camera.looking(180, 0), 600, 400)
    assert turned.pixelColor(300, 200).green() < 60, "from behind the order is the other way round"


def test_colours_span_the_values_and_deviations_lie_about_nothing():
    found = colouring("gradient", np.array([0.02, 0.1, 0.15]))
    assert found.levels.tolist()[0] == 0
    assert found.levels.tolist()[-1] == STEPS - 1
    found = colouring("deviation", np.array([-1.0, 0.0, 4.0]))
    assert found.low == -found.high
    assert found.levels.tolist()[1] in (STEPS // 2 - 1, STEPS // 2)
    assert colouring("elevation", np.zeros(5)).levels.tolist() == [0] * 5


def test_cursor_and_selection_are_those_of_the_window(view, desk, qtbot):
    canvas = view.canvas
    line = view._shown.line
    row = len(line.stations) // 3
    (x, y), *_ = canvas.camera.seen(line.points[[row]], canvas.width(), canvas.height())[0]
    assert abs(canvas.row_at(QPointF(x, y)) - row) <= 3
    qtbot.mouseMove(canvas, QPoint(round(x), round(y)))
    assert desk.selection.station == pytest.approx(line.stations[row], abs=8)
    qtbot.mouseClick(canvas, Qt.MouseButton.LeftButton, pos=QPoint(round(x), round(y)))
    assert len(desk.selection.segments) == 1
    desk.selection.segments = (0, 1)
    assert canvas.scene.is_selected.sum() == np.isin(line.segment_of, (0, 1)).sum()
    desk.selection.station = float(line.stations[20])
    assert canvas.scene.cursor == pytest.approx(line.points[20])


def test_keys_and_mouse(view, qtbot):
    canvas = view.canvas
    canvas.setFocus()
    qtbot.keyClick(canvas, Qt.Key.Key_7)
    assert canvas.camera.tilt == pytest.approx(math.pi / 2)
    qtbot.keyClick(canvas, Qt.Key.Key_1)
    assert canvas.camera.tilt == 0
    turn = canvas.camera.turn
    qtbot.mousePress(canvas, Qt.MouseButton.LeftButton, pos=QPoint(400, 300))
    qtbot.mouseMove(canvas, QPoint(450, 300))
    qtbot.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=QPoint(450, 300))
    assert canvas.camera.turn == pytest.approx(turn - math.radians(20), abs=0.1)
    view.height_slider.setValue(50)
    assert canvas.camera.exaggeration == 5.0
    assert "5.0" in view.height_label.text()


def test_deviation_needs_the_actual_track(view, desk):
    item = view.figure_box.model().item(3)
    assert not item.isEnabled()
    points = np.column_stack([np.linspace(0, 700, 50), np.zeros(50), np.linspace(60, 0, 50)])
    desk.session.apply("Compare", lambda project: edits.compare_with(project, ActualTrack("a.csv", points)))
    assert item.isEnabled()
    view.figure_box.setCurrentIndex(3)
    view.figure_box.activated.emit(3)
    assert view.canvas.scene.colouring.is_two_sided
    assert len(view.canvas.scene.threads) == 1


def test_it_is_not_drawn_while_it_is_hidden(view, desk):
    view.hide()
    before = view.canvas.scene
    desk.selection.station = 33.0
    assert view.canvas.scene is before
    view.show()
    assert view.canvas.scene is not before


@pytest.mark.parametrize(("kind", "head"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")])
def test_pictures(view, kind, head):
    content = scene_file(view.canvas.scene, view.canvas.camera, 800, 600, kind)
    assert content.startswith(head)
    assert len(content) > 5000


def test_a_frame_is_quick(qapp):
    along = np.linspace(0, 1500, 1500)
    points = np.column_stack([300 * np.sin(along / 200), along, 120 * (1 - along / 1500)])
    made = replace(scene(points), has_drop_lines=True)
    camera = Camera().fitted(points, 1000, 700)
    scene_image(made, camera, 1000, 700)
    began = time.process_time()
    for _ in range(5):
        scene_image(made, camera, 1000, 700)
    assert (time.process_time() - began) / 5 < 0.1
