"""The plan length's error as it is said, beside the spread over many hands."""

import numpy as np
import pytest

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.fit_settings import FitSettings
from bobdesk.alignment.length_error import length_sigma_of_vertices
from bobdesk.plan.polyline import Polyline


def bent(step):
    """800 m of swinging curves of 40 m radius and more, a vertex each `step` metres."""
    along = np.arange(0.0, 800.0, 0.05)
    heading = 1.2 * np.sin(2 * np.pi * along / 300)
    points = np.cumsum(0.05 * np.column_stack([np.cos(heading), np.sin(heading)]), axis=0)
    return points[:: round(step / 0.05)]


@pytest.mark.parametrize(("step", "noise", "wavelength"), [(5.0, 0.3, 20.0), (10.0, 0.5, 30.0), (8.0, 0.2, 20.0)])
def test_it_is_the_spread_of_many_lengths(step, noise, wavelength):
    vertices = bent(step)
    random = np.random.default_rng(5)
    lengths, said = [], []
    for _ in range(60):
        line = fit_centreline(
            Polyline(vertices + random.normal(0, noise, vertices.shape)), FitSettings(1.0, wavelength)
        )
        lengths.append(line.length)
        said.append(length_sigma_of_vertices(line, vertex_distance=step, wavelength=wavelength))
    assert 0.5 < np.median(said) / np.std(lengths) < 2.0


def test_without_smoothing_nothing_can_be_said():
    line = fit_centreline(Polyline(bent(5.0)), FitSettings(1.0, 0.0))
    assert length_sigma_of_vertices(line, vertex_distance=5.0, wavelength=0.0) is None
    assert length_sigma_of_vertices(line, vertex_distance=10.0, wavelength=20.0) is None
