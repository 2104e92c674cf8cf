"""R.json: the figures of a check, a run or a comparison, under the names that scripts rely on."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from bobdesk.alignment.segment_figures import segment_figures
from bobdesk.files.plan_input import PlanInput
from bobdesk.solve.feasibility import Feasibility
from bobdesk.solve.iterates import Solution
from bobdesk.solve.next_elevation import NextElevation
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.comparison import Comparison
from bobdesk.track.figures import Deviations, Figures


def check_report(given: PlanInput, found: Feasibility) -> dict[str, Any]:
    """Return what `check` found."""
    return {
        "targets": _targets(given.asked),
        "scale": None if found.scale is None else found.scale * given.factor,
        "plan_length_m": found.plan_length / given.factor,
        "feasible": found.feasible,
        "feasibility": found.sentence,
        "reachable_length_m": None if found.reachable_length is None else list(found.reachable_length),
    }


def run_report(
    given: PlanInput,
    found: Feasibility,
    solution: Solution,
    line: Centreline3D,
    figures: Figures,
    deviations: Deviations,
    seconds: float,
) -> dict[str, Any]:
    """Return what `reconstruct` found."""
    return {
        **check_report(given, found),
        "scale": solution.scale * given.factor,
        "achieved": {
            "length_m": figures.length,
            "drop_m": figures.drop,
            "mean_gradient_drop_per_length": figures.mean_gradient_drop_per_length,
            "mean_gradient_drop_per_plan": figures.mean_gradient_drop_per_plan,
            "mean_gradient_segments": figures.mean_gradient_segments,
            "max_gradient": figures.max_gradient,
            "min_gradient": figures.min_gradient,
            "mean_curvature_difference_per_m": figures.mean_curvature_difference,
        },
        "deviation_percent": {
            "length_m": deviations.length,
            "drop_m": deviations.drop,
            "mean_gradient": deviations.mean_gradient,
        },
        "method": solution.method,
        "iterations": solution.nit,
        "evaluations": solution.nfev,
        "seconds": seconds,
        "status": solution.status,
        "message": solution.message,
        "objective": solution.objective,
        "optimality": solution.optimality,
        "segments": [
            {
                "kind": segment.kind,
                "from_m": segment.start,
                "to_m": segment.end,
                "gradient": float(gradient),
                "radius_m": _radius(given, index, solution.scale),
            }
            for index, (segment, gradient) in enumerate(zip(line.segments, line.segment_gradients, strict=True))
        ],
    }


def own_station(given: PlanInput, solution: Solution, advice: NextElevation) -> float:
    """Return the advised station as `--known` counts it, in the plan's own scale."""
    return advice.station / (solution.scale * given.factor)


def advice_report(given: PlanInput, solution: Solution, advice: NextElevation) -> dict[str, Any]:
    """Return where one more known elevation would help most."""
    return {
        "station": own_station(given, solution, advice),
        "spread_m": advice.spread,
        "spread_with_it_m": advice.spread_after,
        "envelope_mean_width_m": advice.band.mean_width,
        "envelope_mean_width_with_it_m": advice.band_after.mean_width,
    }


def comparison_report(found: Comparison) -> dict[str, Any]:
    """Return what `compare` found."""
    return {
        "z_rms_m": found.z_rms,
        "z_rms_percent_of_drop": found.z_rms_percent,
        "z_max_m": found.z_max,
        "z_max_station_m": found.z_max_station,
        "gradient_rms": found.gradient_rms,
        "deviation_percent": {
            "length_m": found.length_percent,
            "drop_m": found.drop_percent,
            "mean_gradient_drop_per_length": found.mean_gradient_percent,
            "plan_length_m": found.plan_length_percent,
        },
    }


def _targets(targets: Targets) -> dict[str, Any]:
    return {
        "length_m": targets.length,
        "drop_m": targets.drop,
        "mean_gradient": targets.mean_gradient,
        "mean_gradient_is": targets.mean_gradient_is,
        "min_gradient": targets.min_gradient,
        "max_gradient": targets.max_gradient,
        "known": [asdict(known) for known in targets.known],
        "unknown_scale": targets.unknown_scale,
    }


def _radius(given: PlanInput, index: int, scale: float) -> float | None:
    radius = segment_figures(given.centreline, given.segments[index]).radius
    return None if radius is None else radius * scale
