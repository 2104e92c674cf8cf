"""Which targets a line misses, judged by the line and not by what its solver says."""

from dataclasses import replace

import pytest

from bobdesk.alignment.segments import Segment
from bobdesk.progress import finish
from bobdesk.solve.profile import make_profile
from bobdesk.solve.run import METHODS
from bobdesk.solve.settings import SolverSettings
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.track.figures import figures
from bobdesk.track.method_comparison import compare_methods, failed_method
from bobdesk.track.missed import missed_targets, missed_text
from tests.solve.made_plans import straight_plan
from tests.track.test_centreline3d import THREE, solution_of

GRADIENTS = (0.1, 0.05, 0.2)


def missed_by(targets, gradients=GRADIENTS, *, start=18.5, scale=1.0):
    plan = straight_plan(THREE[-1].end)
    solution = solution_of(make_profile(plan, THREE), gradients, start=start, scale=scale)
    line = make_centreline3d(plan, THREE, solution)
    return missed_targets(line, figures(line), solution, targets)


def own_targets(gradients=GRADIENTS, *, start=18.5):
    plan = straight_plan(THREE[-1].end)
    line = make_centreline3d(plan, THREE, solution_of(make_profile(plan, THREE), gradients, start=start))
    found = figures(line)
    return Targets(found.length, found.drop)


def test_a_line_meets_its_own_figures_and_what_lies_within_the_tolerance():
    own = own_targets()
    assert missed_by(own) == ()
    assert missed_by(replace(own, length=own.length * 1.00009, drop=own.drop * 0.99991)) == ()
    assert missed_text(missed_by(replace(own, length=own.length * 1.00011))) == "length 0.011 % too short"
    assert missed_text(missed_by(replace(own, drop=own.drop / 2))) == "drop 100 % too large"


def test_a_mean_gradient_counts_only_where_it_is_a_target_of_its_own():
    own = replace(own_targets(), mean_gradient=0.1)
    assert missed_by(own) == ()
    text = missed_text(missed_by(replace(own, mean_gradient_is="segments")))
    assert text == "mean gradient 1.67 percentage points too large"
    mean = sum(GRADIENTS) / 3
    assert missed_by(replace(own, mean_gradient=mean, mean_gradient_is="segments")) == ()


def test_limits_of_the_gradient_are_targets():
    own = own_targets()
    assert (
        missed_text(missed_by(replace(own, max_gradient=0.19)))
        == "gradients up to 1.00 percentage points beyond a limit"
    )
    assert (
        missed_text(missed_by(replace(own, min_gradient=0.07)))
        == "gradients up to 2.00 percentage points beyond a limit"
    )


def test_known_elevations_are_met_within_their_own_tolerance():
    # Falls 4 m in the first 40 m.
    own = own_targets()
    assert missed_by(replace(own, known=(KnownElevation(40, 14.5),))) == ()
    assert missed_by(replace(own, known=(KnownElevation(40, 15.0, 0.5),))) == ()
    one = missed_by(replace(own, known=(KnownElevation(40, 15.0), KnownElevation(90, 12.0))))
    assert missed_text(one) == "known elevation at 40 m missed by 0.50 m"
    assert one[0].off == pytest.approx(-0.5, abs=1e-3)
    two = missed_by(replace(own, known=(KnownElevation(40, 15.0), KnownElevation(90, 9.0))))
    assert missed_text(two) == "2 known elevations missed by up to 3.00 m"


def test_stations_of_known_elevations_count_in_the_plan_before_scaling():
    found = missed_by(Targets(2, 1, known=(KnownElevation(40, 29.0), KnownElevation(90, 9.0))), start=37.0, scale=2.0)
    (known,) = (miss for miss in found if miss.target == "known elevations")
    assert (known.station, known.count) == (90, 1)
    assert known.off == pytest.approx(15.0, abs=1e-3)


HALVES = (Segment("straight", 0, 120), Segment("curve", 120, 180), Segment("straight", 180, 300))


def rows_of(targets, *methods, segments=HALVES):
    plan = straight_plan(300.0)
    chosen = [method for method in METHODS if method.key in methods]
    job = compare_methods(plan, segments, targets, SolverSettings(), clock=lambda: 0.0, methods=chosen)
    return {row.method: row for row in finish(job)}


def test_a_method_that_converged_at_its_start_has_not_met_the_targets():
    # J knows one gradient a segment: with one segment alone no other can make the line longer.
    rows = rows_of(Targets(301.5, 24.0), "pgd", "lbfgsb", segments=(Segment("straight", 0, 300),))
    assert rows["lbfgsb"].solution.status == 0
    assert rows["lbfgsb"].verdict == "not met"
    assert "length" in missed_text(rows["lbfgsb"].missed)
    assert (rows["pgd"].verdict, rows["pgd"].missed) == ("met", ())
    assert failed_method("x", "X", "no plan").verdict == "failed"


def test_a_rise_that_the_objective_takes_for_a_drop_is_found():
    # The last stretch must rise, which J counts as height difference.
    rows = rows_of(Targets(301.5, 20.0, known=(KnownElevation(200, 0.0), KnownElevation(300, 5.0))), "pgd", "lbfgsb")
    assert rows["pgd"].has_rises_in_objective
    assert rows["pgd"].counted_drop == pytest.approx(25.0, abs=0.5)
    assert not rows["lbfgsb"].has_rises_in_objective
    assert [miss.target for miss in rows["lbfgsb"].missed][-1] == "known elevations"
