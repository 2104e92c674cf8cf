"""Boundaries dragged on lines that come back to themselves: a ring, and a figure of eight."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from bobdesk.alignment.segments import Segment
from bobdesk.plan.polyline import Polyline
from bobdesk.project import edits
from bobdesk.project.project import Project, SourceLine
from bobdesk.ui.plan_view.line_on_plan import LineOnPlan
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.operations import operations
from tests.ui.segments.test_strips import move

ALT, LEFT = Qt.KeyboardModifier.AltModifier, Qt.MouseButton.LeftButton


def eight():
    """A figure of eight, 240 m wide: it crosses itself in the middle, at 29 % and at 71 % of its length or so."""
    t = np.linspace(-1.4, 4.5, 900)
    return np.column_stack([120 * np.sin(t), 120 * np.sin(t) * np.cos(t)])


def ring():
    """A ring of 80 m radius that overlaps itself by a tenth, 3 m further out at its end."""
    t = np.linspace(0, 2.2 * np.pi, 900)
    r = 80 + 3 * t / t[-1]
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


def limacon():
    """A loop within a loop, as a Kreisel in a plan: it crosses itself at an angle."""
    t = np.linspace(-2.0, 2 * np.pi - 2.6, 900)
    r = 60 + 110 * np.cos(t)
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


LINES = {"eight": eight, "ring": ring, "limacon": limacon}


@pytest.fixture(params=LINES)
def view(request, desk, idle, shown):
    project = edits.open_coordinates(Project(), SourceLine("made.csv", Polyline(LINES[request.param]())))
    desk.session.open(project, None)
    alignment_now(desk)
    idle()
    made = shown(PlanView(desk), 1000, 800)
    made.show_step("Segments")
    made.fit_all()
    made.grab()
    return made


def put_boundary(desk, idle, station):
    """Have two segments that meet at a station: each branch of a crossing lies within reach of the drag."""
    length = alignment_now(desk).value.line.length
    operations(desk).take((Segment("curve", 0.0, station), Segment("straight", station, length)), "Two")
    idle()


def on_screen(view, desk, stations):
    line = LineOnPlan(alignment_now(desk)).on_screen(desk.session.project, view.frame_now())
    return line.at(np.asarray(stations, dtype=float))


def follow(view, desk, stations, *, aside=0.0):
    """Drag the boundary with the mouse from station to station, so many pixels beside the line; return where it was."""
    places = on_screen(view, desk, stations)
    ahead = on_screen(view, desk, np.asarray(stations) + 0.5) - on_screen(view, desk, np.asarray(stations) - 0.5)
    normal = np.column_stack([-ahead[:, 1], ahead[:, 0]]) / np.hypot(*ahead.T)[:, None]
    paths = places + aside * normal
    port, found = view.viewport(), []
    QTest.mousePress(port, LEFT, ALT, QPointF(*places[0]).toPoint())
    for at in paths[1:]:
        move(port, QPointF(*at).toPoint(), LEFT, ALT)
        found.append(alignment_now(desk).segments[0].end)
    QTest.mouseRelease(port, LEFT, ALT, QPointF(*paths[-1]).toPoint())
    return np.array(found)


@pytest.mark.parametrize("aside", [0.0, -9.0, 9.0])
@pytest.mark.parametrize("steps", [200, 12])
@pytest.mark.parametrize("forward", [True, False])
def test_it_follows_its_branch_all_the_way(view, desk, idle, forward, steps, aside):
    length = alignment_now(desk).value.line.length
    stations = np.linspace(0.04, 0.96, steps) * length
    stations = stations if forward else stations[::-1]
    put_boundary(desk, idle, float(stations[0]))
    found = follow(view, desk, stations, aside=aside)
    per_pixel = view.frame_now().per_screen
    assert np.abs(found - stations[1:]).max() < 12 * per_pixel + 2.0
    assert alignment_now(desk).segments[0].end == pytest.approx(stations[-1], abs=12 * per_pixel + 2.0)
    assert desk.session.undo_label == "Move boundary"


def test_a_boundary_beside_a_crossing_is_dragged_through_it_and_back(view, desk, idle):
    points, stations = alignment_now(desk).value.line.points, alignment_now(desk).value.line.stations
    apart = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    apart[np.abs(stations[:, None] - stations[None]) < 60] = np.inf
    first, second = np.unravel_index(apart.argmin(), apart.shape)
    for crossing in sorted((stations[first], stations[second])):
        low, high = max(crossing - 20, 8.0), min(crossing + 20, stations[-1] - 8.0)
        put_boundary(desk, idle, float(low))
        there = np.linspace(low, high, 30)
        found = follow(view, desk, np.concatenate([there, there[::-1]]))
        assert np.abs(found - np.concatenate([there, there[::-1]])[1:]).max() < 4.0


def test_it_comes_over_to_where_the_mouse_points_when_it_leaves_the_line(view, desk, idle):
    length = alignment_now(desk).value.line.length
    start, wanted = 0.2 * length, 0.55 * length
    put_boundary(desk, idle, start)
    first, last = on_screen(view, desk, [start, wanted])
    port = view.viewport()
    QTest.mousePress(port, LEFT, ALT, QPointF(*first).toPoint())
    for share in np.linspace(0, 1, 25):
        move(port, QPointF(*(first + share * (last - first))).toPoint(), LEFT, ALT)
    assert alignment_now(desk).segments[0].end == pytest.approx(wanted, abs=6.0)
    QTest.mouseRelease(port, LEFT, ALT, QPointF(*last).toPoint())
