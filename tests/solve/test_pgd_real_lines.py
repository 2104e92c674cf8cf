from functools import cache

import numpy as np
import pytest

from bobdesk.alignment.segmentation import detect_segments
from bobdesk.plan.polyline import Polyline, edge_lengths
from bobdesk.progress import finish
from bobdesk.solve.feasibility import feasibility
from bobdesk.solve.pgd import pgd
from bobdesk.solve.settings import PgdSettings
from bobdesk.solve.targets import in_scale
from tests.alignment.made_lines import fitted
from tests.solve.made_plans import REAL_LINES, height_at, length_of, plan_of, real_line, run_pgd

NAMES = tuple(REAL_LINES)


@cache
def plan(name):
    return plan_of(real_line(name).plan)


@cache
def solved(name, known):
    return run_pgd(*plan(name), real_line(name).targets(known=known))


@pytest.mark.parametrize("known", [0, 3, 9])
@pytest.mark.parametrize("name", NAMES)
class TestEveryRun:
    def test_the_drop_is_exact(self, name, known):
        line, targets = solved(name, known).line, real_line(name).targets()
        assert line.elevations[0] - line.elevations.min() == pytest.approx(targets.drop, abs=1e-6)
        assert line.elevations.min() == pytest.approx(0, abs=1e-6)

    def test_known_elevations_are_exact_at_their_stations(self, name, known):
        line = solved(name, known).line
        for item in real_line(name).targets(known=known).known:
            assert height_at(line, item.station) == pytest.approx(item.elevation, abs=1e-6)

    def test_the_length_is_met_wherever_that_is_said_to_be_possible(self, name, known):
        run, targets = solved(name, known), real_line(name).targets(known=known)
        found = feasibility(*plan(name), targets)
        if found.feasible:
            assert run.solution.status == 0
            assert length_of(run.line) == pytest.approx(targets.length, rel=1e-5)
        else:
            assert run.solution.status == 2
            nearest = min(found.reachable_length, key=lambda length: abs(length - targets.length))
            assert length_of(run.line) == pytest.approx(nearest, rel=1e-4)
        # Drawn 5 m apart, Sa Calobra's chords are shorter than the fitted curve; without a known
        # elevation Franciacorta would need gradients that swing implausibly.
        assert found.feasible == (
            (name, known) in {*(("mugello", k) for k in (0, 3, 9))} | {("franciacorta", 3), ("franciacorta", 9)}
        )

    def test_no_exported_gradient_leaves_the_limits(self, name, known):
        gradients = solved(name, known).line.gradients
        # Elevations are rounded to 1e-6 m, which is as much of the gradient over a step of a metre.
        assert gradients.min() >= -0.2 - 2e-6
        assert gradients.max() <= 0.25 + 2e-6

    def test_the_gradient_has_no_jump(self, name, known):
        run = solved(name, known)
        profile, gradients = run.solution.profile, run.solution.gradients
        held, given = profile.held, run.solution.edge_gradients[: len(profile.held)]
        shortest = np.minimum(profile.piece_lengths[1:], profile.piece_lengths[:-1])
        np.testing.assert_allclose(profile.half_transitions, np.minimum(4.0, shortest / 2))
        jumps = np.where(
            held,
            2 * np.maximum(np.abs(gradients[:-1] - given), np.abs(gradients[1:] - given)),
            np.abs(np.diff(gradients)),
        )
        steepest = (jumps / (2 * profile.half_transitions)).max()
        spacing = np.diff(run.line.stations).max()
        assert np.abs(np.diff(run.line.gradients)).max() <= steepest * spacing + 3e-6

    def test_every_iterate_holds_drop_and_limits(self, name, known):
        run = solved(name, known)
        numbers = [iterate.number for iterate in run.iterates]
        assert numbers == list(range(run.solution.nit + 1))
        for iterate in run.iterates[:: max(1, len(run.iterates) // 20)]:
            assert iterate.gradients.min() >= -0.2 - 1e-12
            assert iterate.gradients.max() <= 0.25 + 1e-12


@pytest.mark.parametrize(
    ("name", "known", "most"),
    [("sa_calobra", 3, 2.0), ("mugello", 3, 6.0), *((name, 9, 1.6) for name in NAMES)],
)
def test_elevations_are_near_the_surveyed_ones(name, known, most):
    assert real_line(name).rms_percent(solved(name, known).line) <= most


@pytest.mark.parametrize("name", NAMES)
def test_known_elevations_bring_the_line_nearer(name):
    errors = [real_line(name).rms_percent(solved(name, known).line) for known in (0, 3, 9)]
    assert errors == sorted(errors, reverse=True)


def prescaled(name, known):
    """Enlarge a plan drawn at 0.9 to about the wanted length first, as the command does; return f and the run."""
    true = real_line(name)
    targets = true.targets(known=known, plan_scale=0.9, unknown_scale=True)
    drawn = Polyline(0.9 * true.plan)
    factor = (targets.length**2 - targets.drop**2) ** 0.5 / edge_lengths(drawn).sum()
    centreline = fitted(factor * drawn.vertices)
    run = run_pgd(centreline, detect_segments(centreline), in_scale(targets, factor))
    return factor * run.solution.scale, run


@pytest.mark.parametrize(("known", "most"), [(0, 0.003), (3, 0.0015)])
@pytest.mark.parametrize("name", NAMES)
def test_an_unknown_scale_is_found(name, known, most):
    true = real_line(name)
    factor, run = prescaled(name, known)
    assert factor * 0.9 == pytest.approx(1, abs=most)
    assert length_of(run.line) == pytest.approx(true.length, rel=1e-5)
    for item in true.targets(known=known).known:
        at = item.station * factor * 0.9
        assert height_at(run.line, at) == pytest.approx(item.elevation, abs=1e-6)

    direct = plan_of(0.9 * true.plan)
    solution = finish(pgd(*direct, true.targets(known=known, plan_scale=0.9, unknown_scale=True)))
    assert solution.scale * 0.9 == pytest.approx(1, abs=most)


@pytest.mark.parametrize("name", NAMES)
def test_without_meeting_the_length_the_smoothest_profile_stays(name):
    targets = real_line(name).targets(known=3)
    smoothest, met = (
        run_pgd(*plan(name), targets, PgdSettings(meet_length=meet, level_out=0.0)).line for meet in (False, True)
    )

    def roughness(line):
        return float(np.sum(np.diff(line.gradients) ** 2))

    assert roughness(smoothest) <= roughness(met) * (1 + 1e-6)


def test_kinks_instead_of_transitions_meet_the_figures_as_well():
    true = real_line("mugello")
    targets = true.targets(known=3)
    run = run_pgd(*plan("mugello"), targets, PgdSettings(transition=0.0))
    assert length_of(run.line) == pytest.approx(targets.length, rel=1e-5)
    assert not run.solution.profile.half_transitions.any()
    for item in targets.known:
        assert height_at(run.line, item.station) == pytest.approx(item.elevation, abs=1e-6)
