"""Random edits for hypothesis: each draws its arguments from the project that it is applied to."""

from __future__ import annotations

from collections.abc import Callable
from typing import get_args

import numpy as np
from hypothesis import strategies as st

from bobdesk.alignment.design import DesignCurve, DesignList
from bobdesk.alignment.segmentation_settings import SegmentationSettings
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.polyline import Polyline
from bobdesk.plan.world import PixelToWorld
from bobdesk.project import edits
from bobdesk.project.project import (
    ActualTrack,
    CalibrationWay,
    ExportChoice,
    Picture,
    Project,
    SourceLine,
    TargetSet,
)
from bobdesk.solve.settings import PgdSettings, SolverSettings, Weights
from bobdesk.solve.targets import KnownElevation
from bobdesk.track.design_rules import QUANTITIES, Rule
from bobdesk.track.sled import Sled
from tests.project.made_projects import bends, full_project, traced

Draw = Callable[[st.SearchStrategy], object]  # type: ignore[type-arg]
pixels = st.floats(-50.0, 2000.0)
metres = st.floats(-1e6, 1e6)
positive = st.floats(1e-6, 1e5)
words = st.text(max_size=12)
index = st.integers(0, 5)
limits = st.none() | st.floats(-10, 2000)
_rules = st.builds(
    Rule, words, st.sampled_from(QUANTITIES), limits, limits, st.floats(-1, 500), limits, words, st.booleans()
)
places = st.just((None, None)) | st.tuples(st.floats(-180, 180), st.floats(-89, 89))


def _point(draw: Draw) -> ControlPoint:
    return ControlPoint(draw(pixels), draw(pixels), draw(metres), draw(metres), draw(words), draw(st.booleans()))


def _distance(draw: Draw) -> KnownDistance:
    x, y = draw(pixels), draw(pixels)
    return KnownDistance((x, y), (x + 1 + abs(draw(pixels)), y), draw(positive), draw(words), draw(st.booleans()))


def _known(draw: Draw) -> KnownElevation:
    return KnownElevation(draw(st.floats(0, 2000)), draw(st.floats(0, 200)), draw(st.floats(0, 5)))


def _picture(draw: Draw) -> Picture:
    world = PixelToWorld(0.5, 0.0, draw(metres), 0.0, -0.5, draw(metres)) if draw(st.booleans()) else None
    dpi = draw(st.none() | st.tuples(positive, positive))
    return Picture(draw(st.binary(max_size=50)), draw(words), draw(st.integers(1, 9)), 150, (30, 20), dpi, world)


def _segmentation(draw: Draw) -> SegmentationSettings:
    return SegmentationSettings(
        draw(st.none() | st.floats(1e-5, 1.0)), draw(st.none() | st.integers(1, 12)), draw(positive), draw(positive)
    )


def _targets(draw: Draw) -> TargetSet:
    return TargetSet(draw(words), draw(st.none() | positive), draw(st.none() | positive), draw(st.floats(-2, 2)))


def _solver(draw: Draw) -> SolverSettings:
    method = draw(st.sampled_from(["pgd", "published", "lbfgsb", "slsqp", "trustconstr", "de"]))
    settings = PgdSettings(transition=draw(positive), max_iterations=draw(st.integers(1, 10**6)))
    return SolverSettings(method, settings, Weights(draw(positive), 1, draw(positive), 0))


def _design(draw: Draw) -> DesignList:
    curves = [
        DesignCurve(
            draw(metres), draw(positive), draw(positive), draw(st.sampled_from(["left", "right", None])), draw(words)
        )
        for _ in range(draw(st.integers(1, 3)))
    ]
    return DesignList(draw(words), tuple(curves), draw(metres))


def _points(draw: Draw, count: int) -> np.ndarray:
    return np.array([[draw(pixels), draw(pixels)] for _ in range(count)])


EDITS: dict[str, Callable[[Project, Draw], Project]] = {
    "name_project": lambda p, d: edits.name_project(p, d(words)),
    "write_notes": lambda p, d: edits.write_notes(p, d(words)),
    "open_picture": lambda p, d: edits.open_picture(p, _picture(d)),
    "open_coordinates": lambda p, d: edits.open_coordinates(
        p,
        SourceLine(d(words), Polyline(bends(d(st.integers(5, 40)))), *d(places)),
        d(st.sampled_from([None, full_project().segments])),
    ),
    "compare_with": lambda p, d: edits.compare_with(p, ActualTrack(d(words), np.full((3, 3), d(metres)))),
    "compare_with_design": lambda p, d: edits.compare_with_design(p, _design(d)),
    "move_design": lambda p, d: edits.move_design(p, d(metres)),
    "compare_with_no_design": lambda p, d: edits.compare_with_no_design(p),
    "compare_with_nothing": lambda p, d: edits.compare_with_nothing(p),
    "add_control_point": lambda p, d: edits.add_control_point(p, _point(d)),
    "change_control_point": lambda p, d: edits.change_control_point(p, d(index), _point(d)),
    "move_control_point": lambda p, d: edits.move_control_point(p, d(index), d(pixels), d(pixels)),
    "use_control_point": lambda p, d: edits.use_control_point(p, d(index), used=d(st.booleans())),
    "remove_control_point": lambda p, d: edits.remove_control_point(p, d(index)),
    "set_control_points": lambda p, d: edits.set_control_points(p, [_point(d)]),
    "add_known_distance": lambda p, d: edits.add_known_distance(p, _distance(d)),
    "change_known_distance": lambda p, d: edits.change_known_distance(p, d(index), _distance(d)),
    "remove_known_distance": lambda p, d: edits.remove_known_distance(p, d(index)),
    "add_check_distance": lambda p, d: edits.add_check_distance(p, _distance(d)),
    "change_check_distance": lambda p, d: edits.change_check_distance(p, d(index), _distance(d)),
    "remove_check_distance": lambda p, d: edits.remove_check_distance(p, d(index)),
    "scale_by_points": lambda p, d: edits.scale_by_points(p),
    "scale_by_number": lambda p, d: edits.scale_by_number(p, d(positive)),
    "scale_of_drawing": lambda p, d: edits.scale_of_drawing(p, d(positive)),
    "scale_by_position": lambda p, d: edits.scale_by_position(p),
    "find_the_scale": lambda p, d: edits.find_the_scale(p),
    "choose_scale_way": lambda p, d: edits.choose_scale_way(p, d(st.sampled_from(get_args(CalibrationWay)))),
    "take_trace": lambda p, d: edits.take_trace(p, traced(d(st.integers(40, 60)))),
    "draw_line": lambda p, d: edits.draw_line(p, _points(d, d(st.integers(0, 6)))),
    "delete_line": lambda p, d: edits.delete_line(p),
    "move_vertex": lambda p, d: edits.move_vertex(p, d(index), d(pixels), d(pixels)),
    "move_vertices": lambda p, d: edits.move_vertices(p, [0, 2], _points(d, 2)),
    "insert_vertex": lambda p, d: edits.insert_vertex(p, d(index) - 1, d(pixels), d(pixels)),
    "delete_vertices": lambda p, d: edits.delete_vertices(p, [d(index), d(index)]),
    "redraw_stretch": lambda p, d: edits.redraw_stretch(p, d(index), 5, _points(d, 3), [0.5, 1.0, d(st.floats(0, 1))]),
    "reverse_line": lambda p, d: edits.reverse_line(p),
    "set_start": lambda p, d: edits.set_start(p, d(st.floats(0, 900))),
    "set_finish": lambda p, d: edits.set_finish(p, d(st.none() | st.floats(0, 2000))),
    "cut_final_climb": lambda p, d: edits.cut_final_climb(p, d(st.floats(0, 2000))),
    "keep_final_climb": lambda p, d: edits.keep_final_climb(p),
    "say_which_line": lambda p, d: edits.say_which_line(
        p, d(st.sampled_from(["centre", "left edge", "right edge"])), d(st.floats(0, 3))
    ),
    "set_spacing": lambda p, d: edits.set_spacing(p, d(positive)),
    "set_smoothing": lambda p, d: edits.set_smoothing(p, d(positive)),
    "split_segment": lambda p, d: edits.split_segment(p, d(st.floats(0, 900))),
    "merge_segments": lambda p, d: edits.merge_segments(p, d(index), d(index)),
    "move_boundary": lambda p, d: edits.move_boundary(p, d(index), d(st.floats(0, 900))),
    "flip_segment": lambda p, d: edits.flip_segment(p, d(index)),
    "lock_segment": lambda p, d: edits.lock_segment(p, d(index), locked=d(st.booleans())),
    "name_segment": lambda p, d: edits.name_segment(p, d(index), d(words)),
    "flip_segments": lambda p, d: edits.flip_segments(p, [d(index), d(index)]),
    "lock_segments": lambda p, d: edits.lock_segments(p, [d(index)], locked=d(st.booleans())),
    "delete_boundary": lambda p, d: edits.delete_boundary(p, d(index)),
    "number_curves": lambda p, d: edits.number_curves(p),
    "detect_again": lambda p, d: edits.detect_again(p),
    "use_automatic_segments": lambda p, d: edits.use_automatic_segments(p),
    "set_segmentation": lambda p, d: edits.set_segmentation(p, _segmentation(d)),
    "set_length": lambda p, d: edits.set_length(p, d(st.none() | positive | st.integers(1, 2000))),
    "set_drop": lambda p, d: edits.set_drop(p, d(st.none() | positive)),
    "set_mean_gradient": lambda p, d: edits.set_mean_gradient(p, d(st.none() | st.floats(-2, 2)), "segments"),
    "add_target_set": lambda p, d: edits.add_target_set(p, _targets(d)),
    "choose_target_set": lambda p, d: edits.choose_target_set(p, d(index)),
    "name_target_set": lambda p, d: edits.name_target_set(p, d(words)),
    "remove_target_set": lambda p, d: edits.remove_target_set(p, d(index)),
    "set_limits": lambda p, d: edits.set_limits(p, d(st.floats(-2, 2)), d(st.floats(-2, 2))),
    "set_gradient_change": lambda p, d: edits.set_gradient_change(p, d(st.none() | st.floats(-1, 2))),
    "set_plan_error": lambda p, d: edits.set_plan_error(p, d(st.none() | st.floats(-1, 1))),
    "set_rules": lambda p, d: edits.set_rules(p, d(st.none() | st.lists(_rules, max_size=3))),
    "add_rule": lambda p, d: edits.add_rule(p, d(_rules), usual=(Rule("usual", "length"),)),
    "change_rule": lambda p, d: edits.change_rule(p, d(index), d(_rules), usual=(Rule("usual", "length"),)),
    "remove_rule": lambda p, d: edits.remove_rule(p, d(index), usual=(Rule("usual", "length"),)),
    "set_sled": lambda p, d: edits.set_sled(p, Sled(mass=d(st.floats(-1, 2000)), friction=d(st.floats(0, 0.1)))),
    "add_known_elevation": lambda p, d: edits.add_known_elevation(p, _known(d)),
    "change_known_elevation": lambda p, d: edits.change_known_elevation(p, d(index), _known(d)),
    "remove_known_elevation": lambda p, d: edits.remove_known_elevation(p, d(index)),
    "set_known_elevations": lambda p, d: edits.set_known_elevations(p, [_known(d), _known(d)]),
    "set_solver": lambda p, d: edits.set_solver(p, _solver(d)),
    "keep_run": lambda p, d: edits.keep_run(p, full_project().runs[d(st.integers(0, 1))]),
    "take_over_run": lambda p, d: edits.take_over_run(p, full_project().runs[d(st.integers(0, 1))]),
    "choose_export": lambda p, d: edits.choose_export(
        p,
        ExportChoice(
            d(st.sampled_from(["csv", "dxf"])),
            d(st.sampled_from(["default", "tab"])),
            d(st.none() | st.floats(0.0, 2000)),
        ),
    ),
    "choose_run": lambda p, d: edits.choose_run(p, d(st.none() | index)),
    "name_run": lambda p, d: edits.name_run(p, d(index), d(words)),
    "remove_run": lambda p, d: edits.remove_run(p, d(index)),
}
# These take values that only fit the project they are made for, and have tests of their own.
ELSEWHERE = {"redraw_page", "set_segments"}
