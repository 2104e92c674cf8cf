from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.alignment.segments import Segment
from bobdesk.errors import InputError
from bobdesk.plan.polyline import Polyline
from bobdesk.project import derive, edits
from bobdesk.project.project import Picture, Project, SourceLine, TargetSet
from bobdesk.project.steps import steps
from bobdesk.solve.targets import KnownElevation
from tests.project.edit_strategies import EDITS, ELSEWHERE
from tests.project.made_projects import bends, coordinates_project, full_project, ready_project, solved_run
from tests.project.same_project import print_of


def one_sentence(error: InputError) -> None:
    assert len(str(error).splitlines()) == 1


def test_every_edit_is_tried() -> None:
    assert set(EDITS) | ELSEWHERE == set(edits.__all__)


@pytest.mark.parametrize("name", sorted(EDITS))
@pytest.mark.parametrize("start", [Project, full_project, coordinates_project])
def test_an_edit_leaves_its_input_unchanged(name, start) -> None:  # type: ignore[no-untyped-def]
    project = start()
    before = print_of(project)

    @given(st.data())
    @settings(deadline=None, max_examples=4, derandomize=True, database=None)
    def holds(data: st.DataObject) -> None:
        try:
            result = EDITS[name](project, data.draw)
        except InputError as error:
            one_sentence(error)
        else:
            assert isinstance(result, Project)
        assert print_of(project) == before

    holds()


@given(st.data())
@settings(deadline=None, max_examples=60, derandomize=True)
def test_whatever_was_done_the_steps_can_be_told(data: st.DataObject) -> None:
    project = data.draw(st.sampled_from([Project(), full_project(), coordinates_project()]))
    for name in data.draw(st.lists(st.sampled_from(sorted(EDITS)), max_size=8)):
        try:
            project = EDITS[name](project, data.draw)
        except InputError:
            continue
    found = steps(project)
    assert len(found) == 6
    assert all(step.sentence.endswith(".") for step in found)
    assert sum(step.state == "next" for step in found) <= 1


def test_vertices_placed_by_hand_are_sure_and_not_suspect() -> None:
    project = edits.move_vertex(ready_project(), 3, 60.0, 61.0)
    assert project.trace is not None
    assert project.trace.points[3].tolist() == [60.0, 61.0]
    assert project.trace.confidence[3] == 1.0
    assert project.trace.suspect.tolist() == [[20, 29]]
    project = edits.insert_vertex(project, 3, 61.0, 62.0)
    assert project.trace is not None
    assert project.trace.suspect.tolist() == [[21, 30]]
    project = edits.delete_vertices(project, [0, 22, 23])
    assert project.trace is not None
    assert project.trace.suspect.tolist() == [[20, 27]]
    assert len(project.trace.points) == 298


def test_reversing_twice_gives_the_same_line_and_turns_everything_with_it() -> None:
    project = edits.set_start(edits.flip_segment(ready_project(), 1), 100.0)
    project = edits.say_which_line(project, "left edge", 0.7)
    once = edits.reverse_line(project)
    line = derive.polyline(project).needed().vertices
    np.testing.assert_allclose(derive.polyline(once).needed().vertices[::-1], line, atol=1e-9)
    first, last = project.segments, once.segments
    assert first is not None
    assert last is not None
    assert last[0].kind == first[-1].kind
    assert last[0].length == pytest.approx(first[-1].length)
    twice = edits.reverse_line(once)
    np.testing.assert_allclose(derive.polyline(twice).needed().vertices, line, atol=1e-9)
    assert twice.known_elevations[0].station == pytest.approx(project.known_elevations[0].station)


def test_a_page_at_another_dpi_keeps_every_place_in_metres() -> None:
    old = Picture(b"%PDF", "plan.pdf", 2, 200.0, (1000, 800), (200.0, 200.0))
    project = edits.open_picture(Project(), old)
    for point in ready_project().control_points:
        project = edits.add_control_point(project, point)
    project = edits.set_start(edits.draw_line(project, bends(80)), 33.0)
    finer = edits.redraw_page(project, Picture(b"%PDF", "plan.pdf", 2, 400.0, (2000, 1600), (400.0, 400.0)))
    np.testing.assert_allclose(
        derive.polyline(finer).needed().vertices, derive.polyline(project).needed().vertices, atol=1e-6
    )
    with pytest.raises(InputError, match="another picture"):
        edits.redraw_page(project, Picture(b"other", "plan.pdf", 2, 400.0, (2000, 1600)))


def test_locked_segments_survive_detecting_again_and_automatic_gives_all_up() -> None:
    project = edits.lock_segment(ready_project(), 0)
    assert project.segments is not None
    again = edits.detect_again(project)
    assert again.segments is not None
    assert again.segments[0] == project.segments[0]
    assert edits.use_automatic_segments(again).segments is None
    assert edits.detect_again(edits.lock_segment(again, 0, locked=False)).segments is None


def test_segments_from_a_file_must_cover_the_line() -> None:
    project = ready_project()
    length = derive.centreline(project).needed().length
    both = (Segment("straight", 0.0, 50.0), Segment("curve", 50.0, length))
    assert edits.set_segments(project, both).segments == tuple(replace(one, by_hand=True) for one in both)
    with pytest.raises(InputError, match="the segments end at"):
        edits.set_segments(project, both[:1])


def test_removing_sets_and_runs_keeps_the_choice() -> None:
    project = ready_project()
    for name in ("B", "C"):
        project = edits.add_target_set(project, TargetSet(name))
    assert project.targets.name == "C"
    assert edits.remove_target_set(project, 0).targets.name == "C"
    assert edits.remove_target_set(project, 2).targets.name == "B"
    with pytest.raises(InputError, match="named B already"):
        edits.name_target_set(project, "B")
    project = edits.choose_target_set(project, 0)
    run = solved_run(project)
    project = edits.keep_run(edits.keep_run(project, run), run)
    project = edits.name_run(project, 1, "second")
    assert edits.remove_run(project, 0).run is project.runs[1]
    assert edits.remove_run(edits.remove_run(project, 1), 0).run is None


def test_known_elevations_stay_in_running_order() -> None:
    project = edits.set_known_elevations(Project(), [KnownElevation(9, 1), KnownElevation(3, 5)])
    project = edits.change_known_elevation(project, 0, KnownElevation(30, 0.5))
    assert [item.station for item in project.known_elevations] == [9.0, 30.0]
    with pytest.raises(InputError, match="a known elevation is"):
        edits.add_known_elevation(project, KnownElevation(float("nan"), 1))


def test_a_line_cut_to_nearly_nothing_keeps_a_segment() -> None:
    project = edits.cut_final_climb(edits.flip_segment(coordinates_project(), 0), 0.002)
    assert project.segments is not None
    assert len(project.segments) == 1
    assert "Centreline" in {step.name for step in steps(project) if step.state == "next"}
    assert edits.keep_final_climb(project).segments is not None


def test_coordinates_may_bring_their_segments_and_a_place_on_the_earth() -> None:
    source = SourceLine("a.json", Polyline(bends()), 12.0, 46.5)
    line = edits.open_coordinates(ready_project(), source)
    assert line.segments is None
    found = derive.segments(line).needed()
    project = edits.open_coordinates(ready_project(), source, edits.flip_segment(line, 1).segments)
    kept = derive.segments(project).needed()
    assert len(kept) == len(found)
    assert [one.kind == other.kind for one, other in zip(kept[:3], found, strict=False)] == [True, False, True]
    for longitude, latitude in ((12.0, None), (None, 46.0), (12.0, 95.0), (1e6, 46.0), (float("nan"), 46.0)):
        with pytest.raises(InputError, match="no place on the Earth"):
            edits.open_coordinates(Project(), SourceLine("a", Polyline(bends()), longitude, latitude))
