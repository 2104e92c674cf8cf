"""What the user can set of the solvers."""

from __future__ import annotations

from dataclasses import dataclass, field

PUBLISHED_THRESHOLD = 1e-3


@dataclass(frozen=True)
class Weights:
    """Weights of the four terms: length, height, curvature, mean gradient (the paper's a, b, c, d)."""

    length: float = 1.0
    height: float = 1.0
    curvature: float = 1.0
    gradient: float = 1.0


@dataclass(frozen=True)
class PgdSettings:
    """What the user can set of the recommended method.

    Attributes
    ----------
    meet_length
        Meet the length (stage two), or leave the smoothest profile.
    evenness
        Weight in stage two of swings of one size against little change of elevation, m².
    plausible
        Largest root mean square of the change of gradient in stage two. A length that asks for
        more is met only as far as that.
    typical_swing
        Root mean square of the change of gradient that is expected of a track whose plan has no
        scale; there the length tells the scale, and cannot tell the swing too.
    transition
        Length of the vertical transitions at gradient breaks, m; 0 for kinks.
    level_out
        The drop is to the lowest point, where a track is level: the gradient is taken to die out
        over this length before it, m, or over a quarter of a short line; 0 for not at all.
    longest_piece
        Longer segments are divided into equal pieces, m: an even gradient over 100 m and more is
        not what tracks have. (At most some 300 divisions a line.)
    longest_swing
        Stage two changes the gradient by one amount in each segment, and in each part of a segment
        that is longer than this, m.
    tolerance
        On the optimality measure in stage one.
    max_iterations
        Of each descent.
    """

    meet_length: bool = True
    evenness: float = 1e3
    plausible: float = 0.06
    typical_swing: float = 0.03
    transition: float = 8.0
    level_out: float = 30.0
    longest_piece: float = 40.0
    longest_swing: float = 60.0
    tolerance: float = 1e-8
    max_iterations: int = 5000


@dataclass(frozen=True)
class PublishedSettings:
    """What the paper names, with its values.

    Attributes
    ----------
    weights
        a, b, c, d.
    rate
        Learning rate η; None is the paper's 1e-5, and with an unknown scale the smaller of that and
        0.2 / plan length², since 1e-5 overshoots there (the paper determines it for each track).
    threshold
        δ: the end is where J changes by less.
    first_derivative
        The derivative that the first update assigns, before there are two iterates to difference.
    max_iterations
        The paper has no limit; this one is only ever reached with a tiny rate.
    """

    weights: Weights = field(default_factory=Weights)
    rate: float | None = None
    threshold: float = PUBLISHED_THRESHOLD
    first_derivative: float = -100.0
    max_iterations: int = 200_000


@dataclass(frozen=True)
class SecondOpinionSettings:
    """Weights of the objective, and how long a method may take.

    Attributes
    ----------
    weights
        a, b, c, d of the published objective.
    max_iterations
        Iterations, or generations.
    numeric_derivatives
        Let SLSQP difference the objective itself instead of using the exact derivative.
    seed
        Of the differential evolution.
    """

    weights: Weights = field(default_factory=Weights)
    max_iterations: int = 1000
    numeric_derivatives: bool = False
    seed: int = 1


@dataclass(frozen=True)
class SolverSettings:
    """The method and what can be set of it.

    Attributes
    ----------
    method
        Key of one of `bobdesk.solve.run.METHODS`, or of a plug-in's.
    pgd
        Settings of the recommended method.
    weights
        a, b, c, d of the published objective, for the other methods.
    rate
        η of the published method, or None for its usual value.
    threshold
        δ of the published method.
    """

    method: str = "pgd"
    pgd: PgdSettings = field(default_factory=PgdSettings)
    weights: Weights = field(default_factory=Weights)
    rate: float | None = None
    threshold: float = PUBLISHED_THRESHOLD
