"""A calibration and the control points that it makes."""

import math

import numpy as np

from bobdesk.plan.calibration import Calibration
from bobdesk.plan.control_points import ControlPoint

TRUTH = Calibration(0.5393, math.radians(-37.0), (682_000.0, 5_234_000.0))
PIXELS = np.array([[40, 60], [900, 80], [870, 2000], [30, 1900], [450, 1000], [600, 300.0]])


def points_at(calibration: Calibration, pixels: np.ndarray, *, clicked: np.ndarray | None = None):
    metres = calibration.to_metres(pixels)
    clicked = pixels if clicked is None else clicked
    return [
        ControlPoint(x, y, east, north, name=str(number))
        for number, ((x, y), (east, north)) in enumerate(zip(clicked, metres, strict=True), start=1)
    ]


def same(*numbers):
    return [ControlPoint(*number) for number in numbers]
