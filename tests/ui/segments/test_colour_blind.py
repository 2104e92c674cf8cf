"""Straights and curves, and runs, as a person without the green cones sees them: on plan, strip and in the table.

The simulation is that of Machado, Oliveira and Fernandes, "A physiologically-based model for simulation of color
vision deficiency", 2009, for a whole deuteranopia, on linear RGB.
"""

import numpy as np
import pytest
from PySide6.QtGui import QColor, QImage

from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.segments.segments_table import SegmentsTable
from bobdesk.ui.strips.strip_stack import StripStack
from bobdesk.ui.theme import apply_theme, colours
from tests.ui.segments.test_boundaries_tool import at

DEUTERANOPIA = np.array([
    [0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881],
])  # fmt: skip
TO_XYZ = np.array([
    [0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041],
])  # fmt: skip
WHITE = TO_XYZ @ np.ones(3)
# The least difference of two colours that is seen at a glance, CIE 1976.
AT_A_GLANCE = 20.0


def as_seen(rgb, simulation=DEUTERANOPIA):
    """CIE Lab of colours (…, 3), 0 to 255, after the simulation."""
    scaled = np.asarray(rgb, dtype=float) / 255
    linear = np.where(scaled <= 0.04045, scaled / 12.92, ((scaled + 0.055) / 1.055) ** 2.4)
    t = np.clip(linear @ simulation.T, 0, 1) @ TO_XYZ.T / WHITE
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], axis=-1)


def pixels(widget):
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
    return np.array(image.constBits()).reshape(image.height(), image.width(), 4)[:, :, 2::-1]


def apart(one, other, simulation=DEUTERANOPIA):
    return float(np.linalg.norm(as_seen(one, simulation) - as_seen(other, simulation)))


@pytest.fixture(params=["light", "dark"])
def theme(request, qapp):
    apply_theme(qapp, request.param)
    yield request.param
    apply_theme(qapp, "light")


def rgb(name):
    return QColor(name).getRgb()[:3]


def test_the_simulation_takes_red_and_green_together():
    assert apart((200, 90, 40), (130, 130, 40)) < AT_A_GLANCE < apart((200, 90, 40), (40, 90, 200))


def test_both_kinds_differ_on_the_plan_in_colour_and_in_width(desk, now, theme, qtbot):
    view = PlanView(desk)
    qtbot.addWidget(view)
    view.resize(1000, 800)
    view.show()
    view.show_step("Segments")
    view.fit_all()
    shown = pixels(view.viewport())
    drawn = {}
    for segment in now.segments:
        place = at(view, desk, now, segment.start + 0.35 * segment.length)
        near = shown[place.y() - 8 : place.y() + 9, place.x() - 8 : place.x() + 9]
        ground = as_seen(rgb(colours().canvas))
        is_line = np.linalg.norm(as_seen(near) - ground, axis=-1) > AT_A_GLANCE
        drawn.setdefault(segment.kind, []).append((near[8, 8], is_line.mean()))
    of = {kind: np.median([colour for colour, _ in found], axis=0) for kind, found in drawn.items()}
    assert apart(of["straight"], of["curve"]) > AT_A_GLANCE
    assert apart(of["straight"], rgb(colours().canvas)) > AT_A_GLANCE
    assert apart(of["curve"], rgb(colours().canvas)) > AT_A_GLANCE
    wide = {kind: np.median([share for _, share in found]) for kind, found in drawn.items()}
    assert wide["curve"] > 1.3 * wide["straight"]


def test_both_kinds_differ_in_the_table(desk, now, theme, qtbot):
    table = SegmentsTable(desk)
    qtbot.addWidget(table)
    table.resize(500, 500)
    table.show()
    shown = pixels(table.viewport())
    column = table.segments.column("kind")
    chips = []
    for row in (0, 1):
        rect = table.visualRect(table.model().index(row, column))
        chip = as_seen(shown[rect.top() : rect.bottom(), rect.left() : rect.left() + 28].reshape(-1, 3))
        ground = as_seen(shown[rect.top() + 1, rect.left() + 1])
        chips.append(chip[np.linalg.norm(chip - ground, axis=-1).argmax()])
    assert np.linalg.norm(chips[0] - chips[1]) > AT_A_GLANCE


def test_curves_are_tinted_on_the_strips(desk, now, theme, qtbot):
    stack = StripStack(desk)
    qtbot.addWidget(stack)
    stack.resize(1000, 330)
    stack.show()
    strip = stack.elevation
    shown, on = pixels(strip), strip.geometry_now()
    tints = {}
    for segment in now.segments:
        x = round(on.x(segment.start + 0.4 * segment.length))
        tints.setdefault(segment.kind, []).append(as_seen(shown[round(on.area.bottom()) - 4, x]))
    straight, curve = (np.median(tints[kind], axis=0) for kind in ("straight", "curve"))
    # A tint behind curves need only be seen beside none; each boundary has a line of its own too.
    assert np.linalg.norm(straight - curve) > 2.3


def test_no_run_has_the_colour_of_the_actual_track_or_of_another_run(theme):
    of = colours()
    everybody = np.eye(3)
    for number, run in enumerate(of.runs):
        for other in (of.measure, of.base, *of.runs[:number]):
            assert apart(rgb(run), rgb(other), everybody) > AT_A_GLANCE, (run, other)


def test_the_first_four_runs_differ_without_green_cones_too(theme):
    of = colours()
    for number, run in enumerate(of.runs[:4]):
        for other in (of.base, *of.runs[:number]):
            assert apart(rgb(run), rgb(other)) > AT_A_GLANCE, (run, other)
    assert apart(rgb(of.runs[3]), rgb(of.measure)) > AT_A_GLANCE
