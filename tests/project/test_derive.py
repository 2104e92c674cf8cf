from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.errors import InputError
from bobdesk.plan.polyline import Polyline
from bobdesk.progress import finish
from bobdesk.project import derive, edits
from bobdesk.project.derive_runs import (
    run_comparison,
    run_deviations,
    run_envelope,
    run_line,
    run_solution,
    why_out_of_date,
)
from bobdesk.project.digest import inputs_digest
from bobdesk.project.project import Picture, Project, SourceLine
from bobdesk.project.steps import steps
from bobdesk.solve.run import solve
from bobdesk.solve.settings import PgdSettings, SolverSettings
from bobdesk.solve.targets import KnownElevation
from bobdesk.track.figures import figures
from tests.project.made_projects import bends, coordinates_project, full_project, ready_project, solved_run


def states(project: Project) -> dict[str, str]:
    return {step.name: step.state for step in steps(project)}


def test_an_empty_project_says_what_to_do_first() -> None:
    found = steps(Project())
    assert [step.name for step in found] == ["Plan", "Scale", "Centreline", "Segments", "Solve", "Export"]
    assert [step.state for step in found] == ["next", "later", "later", "later", "later", "later"]
    assert "Open a picture" in found[0].sentence


def test_the_steps_move_on_as_the_project_does() -> None:
    project = edits.open_picture(Project(), Picture(b"x", "plan.png"))
    assert states(project)["Scale"] == "next"
    project = edits.scale_by_number(project, 0.5)
    assert states(project)["Centreline"] == "next"
    project = edits.draw_line(project, bends(60))
    assert states(project) | {"Solve": "next"} == states(project)
    assert "length" in steps(project)[4].sentence
    project = edits.set_drop(edits.set_length(project, 800.0), 70.0)
    assert steps(project)[4].sentence == "Everything is ready to solve."
    project = edits.keep_run(project, solved_run(project))
    assert states(project)["Solve"] == "done"
    assert states(project)["Export"] == "next"
    project = edits.move_vertex(project, 3, 120.0, 120.0)
    assert states(project)["Solve"] == "out of date"
    assert steps(project)[4].sentence == "The line in plan or its scale changed since this run."
    assert states(project)["Export"] == "out of date"


def test_coordinates_enter_at_the_segments() -> None:
    found = states(coordinates_project())
    assert [found[name] for name in ("Plan", "Scale", "Centreline", "Segments", "Solve")] == ["done"] * 4 + ["next"]


def test_what_did_not_change_is_the_same_object() -> None:
    project = ready_project()
    renamed = edits.name_project(project, "other")
    assert derive.centreline(renamed).value is derive.centreline(project).value
    assert derive.segments(renamed).value is derive.segments(project).value
    assert derive.curvature(renamed) is derive.curvature(project)
    moved = edits.move_vertex(project, 4, 100.0, 100.0)
    assert derive.centreline(moved).value is not derive.centreline(project).value


def test_the_line_is_that_of_the_parts() -> None:
    project = ready_project()
    found = derive.calibration(project).needed()
    assert project.trace is not None
    expected = fit_centreline(Polyline(found.to_metres(project.trace.points)), project.fit)
    np.testing.assert_array_equal(derive.centreline(project).needed().points, expected.points)


@pytest.mark.parametrize(("side", "radius"), [("left edge", 101.5), ("right edge", 98.5), ("centre", 100.0)])
def test_an_edge_is_moved_to_the_centre(side: str, radius: float) -> None:
    # Anticlockwise about the origin the left side is inside: the centreline of a left edge lies outside.
    angle = np.linspace(0.0, 5.0, 400)
    circle = 100.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    project = edits.open_coordinates(Project(), SourceLine("circle", Polyline(circle)))
    project = edits.say_which_line(project, side, 1.5)  # type: ignore[arg-type]
    moved = derive.polyline(project).needed().vertices
    np.testing.assert_allclose(np.hypot(*moved.T), radius, atol=2e-4)


def test_moving_aside_keeps_a_loop() -> None:
    angle = np.linspace(-2.0, 2 * math.pi + 2.0, 500)
    loop = np.column_stack([20 * np.cos(angle) + angle, 20 * np.sin(angle)])
    moved = derive.moved_aside(loop, distance=0.7)
    apart = np.hypot(*(moved - loop).T)
    np.testing.assert_allclose(apart, 0.7, atol=1e-3)


def test_start_finish_and_cut_off_shorten_the_line_exactly() -> None:
    project = coordinates_project()
    whole = derive.digitised_length(project)
    assert whole is not None
    cut = edits.cut_final_climb(edits.set_finish(edits.set_start(project, 100.0), 1500.0), 1400.0)
    line = derive.polyline(cut).needed().vertices
    assert np.hypot(*np.diff(line, axis=0).T).sum() == pytest.approx(1300.0, abs=1e-6)
    kept = edits.keep_final_climb(cut)
    assert np.hypot(*np.diff(derive.polyline(kept).needed().vertices, axis=0).T).sum() == pytest.approx(1400.0)
    with pytest.raises(InputError, match="behind the start"):
        edits.set_finish(cut, 50.0)


def test_segments_by_hand_stay_on_their_place_when_the_start_moves() -> None:
    project = edits.flip_segment(coordinates_project(), 0)
    project = edits.add_known_elevation(project, KnownElevation(900.0, 30.0))
    before = derive.segments(project).needed()
    line = derive.centreline(project).needed()
    moved = edits.set_start(project, 40.0)
    after = derive.segments(moved).needed()
    assert len(after) == len(before)
    place = np.array([np.interp(before[2].start, line.stations, line.points[:, axis]) for axis in (0, 1)])
    new = derive.centreline(moved).needed()
    same = np.array([np.interp(after[2].start, new.stations, new.points[:, axis]) for axis in (0, 1)])
    assert np.hypot(*(place - same)) < 0.3
    assert moved.known_elevations[0].station == pytest.approx(860.0, abs=1e-6)


def test_segments_by_hand_follow_a_corrected_scale() -> None:
    project = edits.flip_segment(ready_project(), 0)
    shares = [segment.end / derive.centreline(project).needed().length for segment in derive.segments(project).needed()]
    project = edits.scale_by_number(project, 1.25)
    length = derive.centreline(project).needed().length
    found = derive.segments(project).needed()
    assert found[-1].end == length
    assert [segment.end / length for segment in found] == pytest.approx(shares, abs=1e-9)


def test_an_unknown_scale_is_brought_near_true_size() -> None:
    project = edits.find_the_scale(ready_project())
    length = project.targets.length
    assert length is not None
    assert derive.centreline(project).needed().length == pytest.approx(length, rel=0.02)
    inputs = derive.run_inputs(project).needed()
    assert inputs.targets.unknown_scale
    assert inputs.factor == derive.plan_factor(project) != 1.0
    # Known elevations count in the drawing, and must come along.
    assert inputs.targets.known[0].station == pytest.approx(inputs.factor * project.known_elevations[0].station)


def test_known_elevations_stay_at_their_places_where_the_scale_becomes_unknown() -> None:
    project = ready_project()
    scale = derive.calibration(project).needed().metres_per_pixel
    assert scale != 1.0
    unknown = edits.find_the_scale(project)
    for before, after in zip(project.known_elevations, unknown.known_elevations, strict=True):
        assert after.station == pytest.approx(before.station / scale, abs=1e-6)
        assert after.elevation == before.elevation
    assert edits.find_the_scale(unknown).known_elevations == unknown.known_elevations
    again = edits.scale_by_number(unknown, 2 * scale)
    assert [each.station for each in again.known_elevations] == pytest.approx(
        [2 * each.station for each in project.known_elevations], abs=1e-5
    )


@pytest.mark.parametrize("method", ["pgd", "published", "slsqp", "unknown scale"])
def test_a_run_gives_back_the_solvers_line_bit_by_bit(method: str) -> None:
    project = ready_project()
    if method == "unknown scale":
        project = edits.find_the_scale(project)
    else:
        project = edits.set_solver(project, SolverSettings(method))  # type: ignore[arg-type]
    inputs = derive.run_inputs(project).needed()
    line = derive.centreline(project).needed()
    solution = finish(solve(line, inputs.segments, inputs.targets, inputs.settings))
    run = solved_run(project)
    again = run_solution(run)
    for name in ("stations", "points", "edges", "segment_of", "half_transitions", "held", "curvature"):
        np.testing.assert_array_equal(getattr(again.profile, name), getattr(solution.profile, name))
    np.testing.assert_array_equal(again.gradients, solution.gradients)
    assert (again.status, again.nit, again.scale) == (solution.status, solution.nit, solution.scale)
    found = figures(run_line(run))
    assert found == run.figures
    if method in ("pgd", "unknown scale"):
        assert run_deviations(run).length == pytest.approx(0.0, abs=1e-3)
        band = run_envelope(run)
        assert (run_line(run).elevations >= band.lowest - 1e-5).all()
        assert (run_line(run).elevations <= band.highest + 1e-5).all()


def test_a_runs_figures_are_those_of_its_line_and_meet_the_targets() -> None:
    project = full_project()
    run = project.runs[0]
    line = run_line(run)
    assert line.slope_lengths[-1] == run.figures.length
    assert run.figures.drop == pytest.approx(project.targets.drop, abs=1e-5)
    assert run.figures.length == pytest.approx(project.targets.length, rel=1e-5)
    found = run_comparison(project, run)
    assert found is not None
    assert found is run_comparison(project, run)


def test_a_run_shows_its_line_even_after_the_project_went_on() -> None:
    project = ready_project()
    project = edits.keep_run(project, solved_run(project))
    run = project.run
    assert run is not None
    before = run_line(run).points
    changed = edits.delete_line(edits.set_length(project, 9000.0))
    assert changed.run is run
    np.testing.assert_array_equal(run_line(run).points, before)


def test_histories_have_at_most_2000_rows_with_both_ends() -> None:
    project = edits.set_solver(ready_project(), SolverSettings(pgd=PgdSettings(tolerance=1e-13)))
    run = solved_run(project)
    assert 2 <= len(run.history) <= 2000
    assert run.history[0, 0] == 0
    assert run.history[-1, 0] == run.history[:, 0].max()


@pytest.mark.parametrize(
    ("edit", "changed"),
    [
        (lambda p: edits.name_project(p, "x"), set()),
        (lambda p: edits.use_control_point(p, 0, used=False), {"plan"}),
        (lambda p: edits.remove_check_distance(p, 0), set()),
        (lambda p: edits.set_spacing(p, 2), {"fit"}),
        (lambda p: edits.set_spacing(p, 1), set()),
        (lambda p: edits.reverse_line(p), {"plan", "targets"}),
        (lambda p: edits.flip_segment(p, 0), {"segments"}),
        (lambda p: edits.set_length(p, 900), {"targets"}),
        (lambda p: edits.set_limits(p, -0.1, 0.2), {"targets"}),
        (lambda p: edits.remove_known_elevation(p, 0), {"targets"}),
        (lambda p: edits.name_target_set(p, "Men"), set()),
        (lambda p: edits.set_solver(p, SolverSettings("slsqp")), {"solver"}),
        (lambda p: edits.set_solver(p, SolverSettings("of a plug-in")), {"solver"}),
        (lambda p: edits.set_solver(p, SolverSettings("pgd", rate=1e-6)), set()),
        (lambda p: edits.scale_by_number(p, 0.5), {"plan"}),
        (lambda p: edits.say_which_line(p, "left edge", 0.0), set()),
        (lambda p: edits.say_which_line(p, "left edge", 0.7), {"plan"}),
    ],
)
def test_the_digest_tells_what_changes_a_result(edit, changed) -> None:  # type: ignore[no-untyped-def]
    project = ready_project()
    before, after = inputs_digest(project), inputs_digest(edit(project))
    names = ("plan", "fit", "segments", "targets", "solver")
    assert {name for name in names if getattr(before, name) != getattr(after, name)} == changed


def test_the_rate_counts_where_it_is_used() -> None:
    def digest(method: str, rate: float | None) -> str:
        return inputs_digest(edits.set_solver(ready_project(), SolverSettings(method, rate=rate))).solver

    assert digest("published", 1e-5) != digest("published", None)
    assert digest("slsqp", 1e-5) == digest("slsqp", None)


def test_switching_back_makes_a_run_up_to_date_again() -> None:
    project = ready_project()
    run = solved_run(project)
    project = edits.keep_run(project, run)
    locked = edits.use_automatic_segments(edits.lock_segment(project, 0))
    assert why_out_of_date(locked, run) is None
    other = edits.set_smoothing(edits.set_length(project, 999.0), 21.0)
    assert why_out_of_date(other, run) == (
        "spacing or smoothing and targets, limits or known elevations changed since this run"
    )


def test_locking_or_naming_what_was_found_leaves_a_run_up_to_date() -> None:
    project = ready_project()
    run = solved_run(project)
    project = edits.name_segment(edits.lock_segment(edits.keep_run(project, run), 1), 1, "Kreisel")
    assert project.segments is not None
    assert why_out_of_date(project, run) is None
    assert why_out_of_date(edits.flip_segment(project, 0), run) == "the segments changed since this run"


def test_elevations_off_the_line_wait() -> None:
    project = edits.add_known_elevation(ready_project(), KnownElevation(1e5, 3.0))
    assert len(derive.elevations_on_the_line(project)) == 1
    assert derive.run_inputs(project).value is not None


def test_contradictions_are_sentences() -> None:
    project = edits.set_drop(ready_project(), 5000.0)
    assert derive.run_inputs(project).problem == ("the drop must be more than 0 m and less than the length, not 5000 m")
    nothing = replace(ready_project(), control_points=(), known_distances=())
    assert "two control points" in (derive.calibration(nothing).problem or "")
