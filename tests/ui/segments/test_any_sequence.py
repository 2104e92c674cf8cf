"""Whatever is done in whatever order, undone and done again: the line stays covered, and window and project agree."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule, run_state_machine_as_test
from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication

from bobdesk.alignment.segments import Segment, check_segments
from bobdesk.plan.polyline import Polyline
from bobdesk.project import derive, edits
from bobdesk.project.project import Project, SourceLine
from bobdesk.project.segment_edits import shortest_by_hand
from bobdesk.ui.desk import Desk
from bobdesk.ui.notices import Notices
from bobdesk.ui.plan_picture import PlanPicture
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.runner import Runner
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.segments.automatic_operations import automatic_operations
from bobdesk.ui.segments.boundary_drag import BoundaryDrag
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.segments_model import SegmentsModel
from bobdesk.ui.selection import Selection
from bobdesk.ui.session import Session
from bobdesk.ui.settings import Settings
from tests.alignment.made_lines import made_plan

LINE = SourceLine("made.csv", Polyline(made_plan(5, curves=4)))
shares = st.floats(0.0, 1.0)


class AtTheDesk(RuleBasedStateMachine):
    """A person who tries everything."""

    def __init__(self) -> None:
        super().__init__()
        self._folder = tempfile.TemporaryDirectory()
        self.owner = QObject()
        session, runner = Session(self.owner), Runner(self.owner)
        wanted = Settings(Path(self._folder.name) / "settings.ini", self.owner)
        self.desk = Desk(
            session=session,
            selection=Selection(self.owner),
            picture=PlanPicture(session, runner, self.owner),
            runner=runner,
            notices=Notices(self.owner),
            settings=wanted,
            quantities=Quantities(wanted, self.owner),
        )
        session.open(edits.open_coordinates(Project(), LINE), None)
        self.now = alignment_now(self.desk)
        self.do = operations(self.desk)
        self.find = automatic_operations(self.desk)
        self.drag = BoundaryDrag(self.desk, self.owner)
        self.model = SegmentsModel(self.desk, self.owner)
        self.locked: set[tuple[str, float, float]] = set()
        self.before = 0.0
        self.wait()

    def teardown(self) -> None:
        self.desk.runner.close()
        self.owner.deleteLater()
        self._folder.cleanup()

    def wait(self) -> None:
        end = time.monotonic() + 10
        while self.desk.runner.jobs:
            QApplication.processEvents()
            assert time.monotonic() < end

    def remember(self) -> None:
        """Note what is locked, and how short the shortest is, before something is done."""
        self.locked = {(one.kind, one.start, one.end) for one in self.now.segments if one.locked}

    def station(self, share: float) -> float:
        assert self.now.value is not None
        return share * self.now.value.line.length

    @rule(share=shares)
    def split(self, share: float) -> None:
        self.remember()
        self.desk.selection.station = self.station(share)
        self.do.split()

    @rule(share=shares, more=st.integers(0, 3))
    def merge(self, share: float, more: int) -> None:
        self.remember()
        first = int(share * (len(self.now.segments) - 1))
        self.do.select(first, station=self.now.segments[first].start)
        self.do.select(min(first + more, len(self.now.segments) - 1), add=True)
        self.do.merge()

    @rule(share=shares)
    def flip(self, share: float) -> None:
        self.remember()
        self.do.select(int(share * (len(self.now.segments) - 1)))
        self.do.flip()

    @rule(share=shares)
    def lock(self, share: float) -> None:
        self.do.select(int(share * (len(self.now.segments) - 1)))
        self.do.lock()
        self.remember()

    @precondition(lambda self: len(self.now.segments) > 1)
    @rule(share=shares, to=shares, snap=st.booleans(), dropped=st.booleans())
    def drag_boundary(self, share: float, to: float, snap: bool, dropped: bool) -> None:
        self.remember()
        project = self.desk.session.project
        if not self.drag.hold(int(share * (len(self.now.segments) - 2))):
            return
        for part in (0.5, 1.0):
            self.drag.drag(self.station(to * part), snap=20.0 if snap else 0.0)
            check_segments(self.now.segments, length=self.station(1.0))
        if dropped:
            self.drag.drop()
        else:
            self.drag.cancel()
            assert self.desk.session.project is project

    @precondition(lambda self: len(self.now.segments) > 1)
    @rule(share=shares, by=st.floats(-9, 9))
    def nudge(self, share: float, by: float) -> None:
        self.remember()
        self.desk.selection.boundary = int(share * (len(self.now.segments) - 2))
        self.do.nudge(by)

    @precondition(lambda self: len(self.now.segments) > 1)
    @rule(share=shares)
    def delete_boundary(self, share: float) -> None:
        self.remember()
        self.desk.selection.boundary = int(share * (len(self.now.segments) - 2))
        self.do.delete_boundary()

    @precondition(lambda self: len(self.now.segments) > 1)
    @rule(share=shares, column=st.sampled_from(["from", "length", "to"]), typed=st.floats(-50.0, 900.0))
    def type_into_the_table(self, share: float, column: str, typed: float) -> None:
        self.remember()
        before = [one.length for one in self.now.segments]
        row = min(int(share * len(before)), len(before) - 1)
        index = self.model.index(row, self.model.column(column))
        if self.model.flags(index) & Qt.ItemFlag.ItemIsEditable:
            self.model.setData(index, f"{typed:.3f}")
            self.nothing_is_too_short(before)

    @rule(cuts=st.lists(shares, min_size=1, max_size=8, unique=True))
    def take_a_file(self, cuts: list[float]) -> None:
        ends = [*sorted(self.station(cut) for cut in cuts if 0 < cut < 1), self.station(1.0)]
        starts = [0.0, *ends[:-1]]
        kinds = ("straight", "curve")
        self.do.take(
            tuple(Segment(kinds[at % 2], *pair) for at, pair in enumerate(zip(starts, ends, strict=True))), "f"
        )
        self.locked = set()
        self.nothing_is_too_short([])

    def nothing_is_too_short(self, before: list[float]) -> None:
        """Only what was too short before may still be, and only if it is no shorter."""
        least = min([shortest_by_hand(self.desk.session.project), *before])
        assert min(one.length for one in self.now.segments) >= least - 1e-6

    @rule(share=shares, name=st.text("ab1 ", max_size=4))
    def rename(self, share: float, name: str) -> None:
        self.remember()
        self.do.rename(int(share * (len(self.now.segments) - 1)), name)

    @rule()
    def number(self) -> None:
        self.remember()
        self.do.number_curves()

    @rule(threshold=st.floats(0.002, 0.03), shortest=st.floats(1.0, 15.0))
    def change_settings(self, threshold: float, shortest: float) -> None:
        self.remember()
        self.find.change_settings(threshold=threshold, shortest=shortest)

    @rule(count=st.none() | st.integers(1, 12))
    def want(self, count: int | None) -> None:
        self.remember()
        self.find.change_settings(count=count)

    @rule()
    def detect_again(self) -> None:
        self.remember()
        self.find.detect_again()

    @rule()
    def automatic(self) -> None:
        self.find.back_to_automatic()
        self.locked = set()

    @rule(steps=st.integers(1, 4))
    def undo(self, steps: int) -> None:
        for _ in range(steps):
            self.desk.session.undo()
        self.locked = set()

    @rule(steps=st.integers(1, 4))
    def redo(self, steps: int) -> None:
        for _ in range(steps):
            self.desk.session.redo()
        self.locked = set()

    @invariant()
    def the_line_is_covered_and_everything_agrees(self) -> None:
        self.wait()
        project = self.desk.session.project
        segments = derive.segments(project).needed()
        check_segments(segments, length=self.station(1.0))
        assert self.now.segments == segments
        assert len(self.now.figures) == len(segments)
        assert self.model.rowCount() == len(segments)
        for row, segment in enumerate(segments):
            assert self.model.index(row, self.model.column("kind")).data() == segment.kind
            shown = self.model.index(row, self.model.column("to")).data().replace(",", "")
            assert abs(float(shown) - segment.end) <= 0.051
        assert self.locked <= {(one.kind, one.start, one.end) for one in segments}
        assert all(index < len(segments) for index in self.desk.selection.segments)


def test_any_sequence_of_operations(qapp: QApplication) -> None:
    run_state_machine_as_test(  # type: ignore[no-untyped-call]
        AtTheDesk,
        settings=settings(
            max_examples=25,
            stateful_step_count=25,
            deadline=None,
            derandomize=True,
            suppress_health_check=list(HealthCheck),
        ),
    )


def test_a_drag_never_makes_a_segment_shorter_than_allowed(qapp: QApplication) -> None:
    machine = AtTheDesk()
    shortest = shortest_by_hand(machine.desk.session.project)
    for boundary in range(len(machine.now.segments) - 1):
        for to in np.linspace(0, 1, 7).tolist():
            assert machine.drag.hold(boundary)
            machine.drag.drag(machine.station(to), snap=0.0)
            assert min(one.length for one in machine.now.segments) >= shortest - 1e-9
            machine.drag.cancel()
    machine.teardown()
