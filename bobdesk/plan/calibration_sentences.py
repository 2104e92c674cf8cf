"""What a calibration is worth, in sentences for a person."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from bobdesk.plan.affine_check import AffineCheck
from bobdesk.plan.calibration import Calibration, DistanceCheck, plan_length_sigma
from bobdesk.plan.calibration_fit import CalibrationFit
from bobdesk.plan.control_points import ControlPoint
from bobdesk.sentences import counted

NO_ESTIMATE = "no error estimate possible"
_PROBABLE = 0.05
# A distortion of a thousandth is less than paper shrinks.
_HARMLESS = 1e-3
# Below this, percent, a scatter is that of rounding.
_EXACT_PERCENT = 1e-6
# Residuals over this share of the points' extent come from wrong points, not from clicking.
_WRONG_SHARE = 0.05


def calibration_sentences(fit: CalibrationFit, *, plan_length_m: float | None = None) -> tuple[str, ...]:
    """Return what `fit` says: residuals, scale, the plan length's uncertainty, and the worst point."""
    points = sum(point.used for point in fit.points)
    distances = sum(known.used for known in fit.distances)
    given = " and ".join(
        counted(count, noun) for count, noun in ((points, "control point"), (distances, "known distance")) if count
    )
    if fit.rms_m is None or fit.rms_px is None:
        return (
            f"Scale {_scale(fit.calibration)} from {given}: just enough to set it, {NO_ESTIMATE}; "
            "one more point or distance gives one.",
        )
    sentences = [
        f"Residuals {fit.rms_m:.3g} m RMS ({fit.rms_px:.2g} px) from {given}, "
        f"{counted(fit.degrees_of_freedom, 'degree')} of freedom.",
        f"Scale {_scale(fit.calibration)}.",
    ]
    if plan_length_m is not None:
        sigma = plan_length_sigma(fit.calibration, plan_length_m)
        sentences.append(f"Plan length {plan_length_m:.1f} m ± {sigma:.2g} m (1 sigma, from the scale alone).")
    if fit.worst is not None:
        worst = f"point {fit.worst.name}" if fit.worst.name else "one point"
        if fit.worst.rms_without_m is None:
            sentences.append(f"The largest residual is at {worst}; too few are left to judge without it.")
        else:
            sentences.append(f"Without {worst}, the worst, the RMS is {fit.worst.rms_without_m:.3g} m.")
    return tuple(sentences)


def misfit_sentence(fit: CalibrationFit, points: Sequence[ControlPoint]) -> str | None:
    """Return a warning where the residuals are so large that a point must be wrong, else None."""
    metres = np.array([(point.x_m, point.y_m) for point in points if point.used])
    if fit.rms_m is None or len(metres) == 0:
        return None
    extent = float(np.hypot(*np.ptp(metres, axis=0)))
    if fit.rms_m <= _WRONG_SHARE * extent:
        return None
    return (
        f"The control points do not fit together: their residuals are {100 * fit.rms_m / extent:.0f} % of their "
        "extent, so a point is wrong and the scale cannot be trusted."
    )


def affine_sentence(check: AffineCheck) -> str:
    """Return what `check` says about stretch and shear."""
    stretch = 100 * (check.scale_ratio - 1)
    compared = "longer" if stretch > 0 else "shorter"
    found = (
        f"On the ground a pixel is {abs(stretch):.2f} % {compared} down the picture than across it, and "
        f"the axes are {abs(math.degrees(check.shear_rad)):.2f}° off a right angle"
    )
    if check.chance is None:
        return f"{found}; {NO_ESTIMATE} from three points, so this may be clicking errors alone."
    if check.chance >= _PROBABLE:
        return f"{found}: no more than clicking errors explain."
    if abs(check.scale_ratio - 1) < _HARMLESS and abs(check.shear_rad) < _HARMLESS:
        return f"{found}: too little to matter."
    return f"{found}: more than clicking errors explain; the picture is distorted or a point is wrong."


def check_sentence(check: DistanceCheck) -> str:
    """Return what an independent distance says."""
    name = f"Check distance {check.name}".rstrip()
    return (
        f"{name}: {check.plan_m:.2f} m in the plan, {check.known_m:.2f} m known, "
        f"difference {check.difference_m:+.2f} m ({check.difference_percent:+.2f} %)."
    )


def _scale(calibration: Calibration) -> str:
    if calibration.scale_sigma is None:
        return f"{calibration.metres_per_pixel:.5g} m per pixel"
    percent = 100 * calibration.scale_sigma / calibration.metres_per_pixel
    if percent < _EXACT_PERCENT:
        return f"{calibration.metres_per_pixel:.6g} m per pixel, exact"
    return f"{calibration.metres_per_pixel:.6g} m per pixel ± {percent:.2g} % (1 sigma)"
