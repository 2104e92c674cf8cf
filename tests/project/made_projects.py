"""Projects to test with: a drawn line with everything set, and what edits can do to one."""

from __future__ import annotations

from functools import cache

import numpy as np

from bobdesk.alignment.design import DesignCurve, DesignList
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.polyline import Polyline
from bobdesk.plan.trace_vertices import drawn_trace
from bobdesk.plan.traced_line import Trace
from bobdesk.project import derive, edits
from bobdesk.project.digest import inputs_digest
from bobdesk.project.project import ActualTrack, Picture, Project, SourceLine, TargetSet
from bobdesk.project.record import record_of
from bobdesk.project.runs import Run, finished_run
from bobdesk.solve.iterates import Iterate
from bobdesk.solve.run import solve
from bobdesk.solve.targets import KnownElevation
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import figures


def bends(count: int = 300, size: float = 400.0) -> np.ndarray:
    """A line with straights and curves in pixels, some 1,700 px long for the size of 400."""
    along = np.linspace(0.0, 1.0, count)
    turn = 1.6 * np.clip(np.sin(2 * np.pi * 2.5 * along), -0.6, 0.6) / 0.6
    step = 4.2 * size / count
    return 50.0 + np.cumsum(np.column_stack([step * np.cos(turn), step * np.sin(turn)]), axis=0)


def traced(count: int = 300) -> Trace:
    """The line as a tracer hands it over: unsure in places."""
    drawn = drawn_trace(bends(count))
    sure = np.linspace(0.3, 1.0, count)
    sure.flags.writeable = False
    return Trace(
        drawn.points, sure, 3.25, "single", ("A doubtful place.",), np.array([[2, 5], [20, 29]], dtype=np.int64)
    )


def ready_project(picture: bytes = b"\x89PNG not really") -> Project:
    """A project with picture, scale, line and targets: everything but a run."""
    project = edits.open_picture(Project(), Picture(picture, "plan.png", size_px=(900, 900), file_dpi=(200.0, 200.0)))
    project = edits.add_control_point(project, ControlPoint(10.0, 20.0, 100.0, 900.0, "A"))
    project = edits.add_control_point(project, ControlPoint(810.0, 20.0, 500.0, 900.1, "B"))
    project = edits.add_known_distance(project, KnownDistance((10.0, 20.0), (10.0, 420.0), 200.1, "bar"))
    project = edits.add_check_distance(project, KnownDistance((0.1, 0.2), (100.0, 0.0), 50.3))
    project = edits.take_trace(project, traced())
    length = derive.centreline(project).needed().length
    project = edits.set_length(project, round(length * 1.0052, 2))
    project = edits.set_drop(project, round(0.09 * length, 2))
    return edits.add_known_elevation(project, KnownElevation(length / 2, 0.05 * length, 0.5))


def solved_run(project: Project, name: str = "Run 1") -> Run:
    """Solve a project, and return the run with all its iterates."""
    inputs = derive.run_inputs(project).needed()
    line = derive.centreline(project).needed()
    job = solve(line, inputs.segments, inputs.targets, inputs.settings)
    iterates: list[Iterate] = []
    while True:
        try:
            iterates.append(next(job))
        except StopIteration as end:
            solution = end.value
            break
    found = figures(make_centreline3d(line, inputs.segments, solution))
    return finished_run(
        inputs,
        solution,
        found,
        record_of(iterates),
        digest=inputs_digest(project),
        name=name,
        target_set=project.targets.name,
        seconds=0.25,
    )


@cache
def full_project() -> Project:
    """A project with everything in it."""
    project = edits.name_project(ready_project(), "Königssee")
    project = edits.write_notes(project, "notes\nof two lines, 1 m = 1.000000001 m")
    project = edits.keep_run(project, solved_run(project))
    project = edits.flip_segment(project, 0)
    project = edits.lock_segment(project, 1)
    project = edits.name_segment(project, 1, "Kreisel")
    project = edits.add_target_set(project, TargetSet("Women", 700.5, 60.25, 0.09, "segments"))
    project = edits.choose_target_set(project, 0)
    project = edits.keep_run(project, solved_run(project, "Run 2"))
    line = np.column_stack([bends(40), np.linspace(60.0, 0.0, 40)])
    project = edits.compare_with(project, ActualTrack("actual.csv", line))
    curves = (DesignCurve(20.5, 30.25, 17.0, "left", "Labyrinth"), DesignCurve(90.0, 12.0, 33.0))
    return edits.compare_with_design(project, DesignList("Design 1967", curves, 21.5))


def coordinates_project() -> Project:
    """A project that began with coordinates."""
    return edits.open_coordinates(Project(), SourceLine("line.csv", Polyline(bends()), 12.98, 47.6))
