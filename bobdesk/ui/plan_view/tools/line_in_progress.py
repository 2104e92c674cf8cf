"""The line that is being placed: piece by piece, each by one click, the last one taken back first."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from bobdesk.arrays import FloatArray

End = Literal["start", "end"]


@dataclass(eq=False)
class Piece:
    """What one click has added.

    Attributes
    ----------
    points, confidence
        (k, 2) and (k,), without the point that the line had before.
    width
        Of the line that was followed, pixels; 0 for a click.
    """

    points: FloatArray
    confidence: FloatArray
    width: float = 0.0


def clicked(place: tuple[float, float]) -> Piece:
    """Return the piece of a plain click."""
    return Piece(np.array([place], dtype=np.float64), np.ones(1))


@dataclass(eq=False)
class LineInProgress:
    """Pieces in the order in which they were placed.

    Attributes
    ----------
    continues
        The end of the line that there is already, from which these pieces go on.
    origin
        That end's place, plan units.
    """

    pieces: list[Piece] = field(default_factory=list)
    continues: End | None = None
    origin: tuple[float, float] | None = None

    @property
    def is_empty(self) -> bool:
        """Whether nothing was begun."""
        return not self.pieces and self.continues is None

    @property
    def last(self) -> tuple[float, float] | None:
        """Where the next piece begins."""
        if self.pieces:
            x, y = self.pieces[-1].points[-1]
            return float(x), float(y)
        return self.origin

    @property
    def first(self) -> tuple[float, float] | None:
        """Where the line began."""
        if self.origin is not None:
            return self.origin
        if not self.pieces:
            return None
        x, y = self.pieces[0].points[0]
        return float(x), float(y)

    @property
    def points(self) -> FloatArray:
        """All places (n, 2), without the origin."""
        return np.concatenate([piece.points for piece in self.pieces]) if self.pieces else np.zeros((0, 2))

    @property
    def confidence(self) -> FloatArray:
        """How sure each place is (n,)."""
        return np.concatenate([piece.confidence for piece in self.pieces]) if self.pieces else np.zeros(0)

    @property
    def width(self) -> float:
        """Of the line that was followed, pixels; 0 where all was clicked."""
        widths = [piece.width for piece in self.pieces if piece.width > 0]
        return float(np.median(widths)) if widths else 0.0

    def with_origin(self) -> FloatArray:
        """Return all places (n, 2) with the origin before them."""
        return self.points if self.origin is None else np.vstack([self.origin, self.points])

    def take_back(self) -> Piece | None:
        """Drop the last piece, or else the origin; return the piece."""
        if self.pieces:
            return self.pieces.pop()
        self.continues, self.origin = None, None
        return None

    def clear(self) -> None:
        """Begin anew."""
        self.pieces.clear()
        self.continues, self.origin = None, None
