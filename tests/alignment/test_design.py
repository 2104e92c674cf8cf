"""Where a designer's list lies along a line."""

import tracemalloc

from bobdesk.alignment.design import DesignCurve, DesignList, best_offset
from bobdesk.alignment.segments import Segment

SEGMENTS = (Segment("straight", 0, 60), Segment("curve", 60, 110), Segment("straight", 110, 200))


def test_the_offset_lays_curves_over_curves():
    assert best_offset(DesignList("", (DesignCurve(40, 50, 30),)), SEGMENTS) == 20.0


def test_a_curve_far_behind_the_line_changes_nothing_and_takes_no_room():
    wrong = DesignList("", (DesignCurve(40, 50, 30), DesignCurve(2e6, 50, 30)))
    tracemalloc.start()
    offset = best_offset(wrong, SEGMENTS)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert offset == 20.0
    assert most < 1_000_000
