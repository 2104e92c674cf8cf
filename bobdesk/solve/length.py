"""The 3D length of a profile and its derivative, without a pass over all rows."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from bobdesk.arrays import FloatArray
from bobdesk.solve.profile import Profile


class LengthOf:
    """Sum of the distances between neighbouring rows as a function of the gradients.

    Rows that lie in one piece only have a fall of gradient times step, so that a piece's share is
    sqrt(D^2 + h^2) exactly; only rows at boundaries and in transitions, some eight a boundary, are
    summed one by one. An evaluation costs O(pieces), whatever the spacing.

    Parameters
    ----------
    profile
        Rows and pieces.
    edge_gradients : (p-1,)
        Gradients given at held edges.
    scale
        Factor on the plan.
    """

    def __init__(self, profile: Profile, edge_gradients: FloatArray, scale: float) -> None:
        falls = profile.falls.by_piece
        pieces = falls.shape[1]
        rows = np.flatnonzero(np.diff(falls.indptr) == 1)
        first = falls.indptr[rows]
        step = falls.data[first]
        # A row in a transition through a held edge has one piece too, but only a part of its step.
        whole = np.abs(step - np.diff(profile.stations)[rows]) <= 1e-9 * step
        rows, piece, step = rows[whole], falls.indices[first[whole]], step[whole]
        self._chords = scale * np.bincount(piece, profile.chords[rows], minlength=pieces)
        self._steps = scale * np.bincount(piece, step, minlength=pieces)
        rest = np.setdiff1d(np.arange(falls.shape[0]), rows)
        self._mixed = sparse.csr_array(scale * falls[rest])
        self._mixed_transposed = sparse.csr_array(self._mixed.T)
        self._given_falls = scale * (profile.falls.by_edge @ edge_gradients)[rest]
        self._squares = self._chords**2
        self._mixed_squares = (scale * profile.chords[rest]) ** 2

    def __call__(self, gradients: FloatArray) -> tuple[float, FloatArray]:
        """Return the length, m, and its derivative by each gradient, (p,), m."""
        falls = self._steps * gradients
        lengths = np.sqrt(self._squares + falls * falls)
        mixed_falls = self._mixed @ gradients + self._given_falls
        mixed_lengths = np.sqrt(self._mixed_squares + mixed_falls * mixed_falls)
        # A piece without a whole row has length 0 and no share.
        derivative = self._steps * falls / np.maximum(lengths, 1e-300)
        derivative += self._mixed_transposed @ (mixed_falls / np.maximum(mixed_lengths, 1e-300))
        return float(lengths.sum() + mixed_lengths.sum()), derivative
