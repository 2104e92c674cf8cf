"""The published objective, with its exact derivative."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.solve.problem import mean_shares
from bobdesk.solve.profile import Profile
from bobdesk.solve.settings import Weights
from bobdesk.solve.targets import Targets

_STRAIGHTEST = 1e-6


@dataclass(frozen=True)
class Terms:
    """The four errors of the objective, target less value, in m, m, 1/m and as a gradient."""

    length: float
    height: float
    curvature: float
    gradient: float


@dataclass(frozen=True, eq=False)
class _Plan:
    """What does not depend on the gradients: it stays the same while the scale does."""

    scale: float
    steps2: FloatArray
    speed: FloatArray
    bend: FloatArray
    along: FloatArray
    cross: FloatArray
    smoothing: FloatArray
    curvature: FloatArray


class PublishedObjective:
    """J = a eL² + b eH² + c eK² + d eg² over the gradients of the pieces, and its derivative.

    eL = L - sum of d_k, eH = H - sum of |z_k - z_{k-1}|, eK = mean of (K2 - K3), eg = mean of the
    segments' gradients - target (Chen et al., Eq. 3). K2 and K3 come from repeated central
    differences of the coordinates (Eq. 1 and 5). Eq. 5 has a slip: it names the first derivative u
    and the second v, but writes |v|³ below the line. The curvature of a space curve is
    |r' x r''| / |r'|³ with r' the first derivative, and that is what is used here. The root is
    smoothed by 1e-6 1/m, since |r' x r''| has no derivative where a straight has no kink.

    Parameters
    ----------
    profile
        Rows and pieces; without transitions the gradient is constant in a segment, as published.
    targets
        The mean gradient is compared with the mean over the segments whatever its definition;
        without one, drop / plan length is the target.
    weights
        a, b, c and d.
    """

    def __init__(self, profile: Profile, targets: Targets, weights: Weights) -> None:
        self._targets = targets
        self._weights = weights
        self._falls = profile.falls.by_piece
        self._falls_transposed = self._falls.T.tocsr()
        self._steps = profile.chords
        self._shares = mean_shares(profile)
        mean = targets.mean_gradient
        self._mean_gradient = targets.drop / profile.length if mean is None else mean
        first = np.gradient(profile.points, axis=0)
        second = np.gradient(first, axis=0)
        self._speed = (first**2).sum(axis=1)
        self._bend = (second**2).sum(axis=1)
        self._along = (first * second).sum(axis=1)
        self._cross = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) ** 2
        self._plan = self._plan_at(1.0)
        self.nfev = self.njev = 0

    def terms(self, gradients: FloatArray, scale: float = 1.0) -> Terms:
        """Return the four errors for a plan enlarged by `scale`."""
        return self._evaluate(gradients, scale)[1]

    def value(self, gradients: FloatArray, scale: float = 1.0) -> float:
        """Return J."""
        self.nfev += 1
        return self._evaluate(gradients, scale)[0]

    def value_and_terms(self, gradients: FloatArray, scale: float = 1.0) -> tuple[float, Terms]:
        """Return J and the four errors."""
        self.nfev += 1
        return self._evaluate(gradients, scale)[:2]

    def value_and_derivative(self, gradients: FloatArray, scale: float = 1.0) -> tuple[float, FloatArray]:
        """Return J and its derivative by each gradient, (p,)."""
        self.nfev += 1
        self.njev += 1
        return self._evaluate(gradients, scale, derivative=True)[::2]

    def _evaluate(
        self, gradients: FloatArray, scale: float, *, derivative: bool = False
    ) -> tuple[float, Terms, FloatArray]:
        plan = self._plan if scale == self._plan.scale else self._plan_at(scale)
        self._plan = plan
        speed, bend, along = plan.speed, plan.bend, plan.along
        falls = scale * (self._falls @ gradients)
        distances = np.sqrt(plan.steps2 + falls**2)
        # The sign of z does not matter to the curvature, so that falls may stand for rises.
        first = _differences(np.concatenate([[0.0], falls.cumsum()]))
        second = _differences(first)
        in_space = plan.cross + first**2 * bend + second**2 * speed - 2 * first * second * along
        root = np.sqrt(np.maximum(in_space, 0.0) + plan.smoothing)
        speed3 = speed + first**2
        curvature3 = root / speed3**1.5
        terms = Terms(
            length=self._targets.length - float(distances.sum()),
            height=self._targets.drop - float(np.abs(falls).sum()),
            curvature=float((plan.curvature - curvature3).sum()) / len(first),
            gradient=float(self._shares @ gradients) - self._mean_gradient,
        )
        weights = self._weights
        value = (
            weights.length * terms.length**2
            + weights.height * terms.height**2
            + weights.curvature * terms.curvature**2
            + weights.gradient * terms.gradient**2
        )
        if not derivative:
            return value, terms, np.zeros(0)
        count = len(first)
        by_first = (first * bend - second * along) / (root * speed3**1.5) - 3 * first * curvature3 / speed3
        by_second = (second * speed - first * along) / (root * speed3**1.5)
        by_elevation = _gradient_adjoint(by_first + _gradient_adjoint(by_second)) / count
        by_fall = np.cumsum(by_elevation[::-1])[::-1][1:] * (-2 * weights.curvature * terms.curvature)
        by_fall += -2 * weights.length * terms.length * falls / distances
        by_fall += -2 * weights.height * terms.height * np.sign(falls)
        result: FloatArray = scale * (self._falls_transposed @ by_fall)
        return value, terms, result + 2 * weights.gradient * terms.gradient * self._shares

    def _plan_at(self, scale: float) -> _Plan:
        speed, cross = scale**2 * self._speed, scale**4 * self._cross
        smoothing = (_STRAIGHTEST * speed**1.5) ** 2
        return _Plan(
            scale=scale,
            steps2=(scale * self._steps) ** 2,
            speed=speed,
            bend=scale**2 * self._bend,
            along=scale**2 * self._along,
            cross=cross,
            smoothing=smoothing,
            curvature=np.sqrt(cross + smoothing) / speed**1.5,
        )


def _differences(values: FloatArray) -> FloatArray:
    """Return numpy.gradient (unit steps) of values, (n,), in a tenth of its time."""
    result = np.empty_like(values)
    result[1:-1] = (values[2:] - values[:-2]) / 2
    result[0] = values[1] - values[0]
    result[-1] = values[-1] - values[-2]
    return result


def _gradient_adjoint(values: FloatArray) -> FloatArray:
    """Return the transpose of numpy.gradient (unit steps) applied to values, (n,)."""
    result = np.zeros_like(values)
    result[2:] += values[1:-1] / 2
    result[:-2] -= values[1:-1] / 2
    result[1] += values[0]
    result[0] -= values[0]
    result[-1] += values[-1]
    result[-2] -= values[-1]
    return result
