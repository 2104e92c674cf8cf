"""The local transverse Mercator projection beside PROJ's."""

from __future__ import annotations

import numpy as np
import pyproj
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.plan.projection import Georeference, to_degrees, to_metres


def _proj(place):
    local = f"+proj=tmerc +lat_0={place.latitude} +lon_0={place.longitude} +k=1 +datum=WGS84 +units=m"
    return pyproj.Transformer.from_crs("EPSG:4326", local.replace("", ""), always_xy=True)


@pytest.mark.parametrize(
    "place",
    [(12.14, 46.55), (-122.95, 50.1), (179.999, -43.2), (-180.0, 0.0), (20.0, 78.0), (0.0, 89.0), (7.0, -65.0)],
)
def test_it_agrees_with_proj_to_a_tenth_of_a_millimetre_within_100_km(place):
    georeference = Georeference(*place)
    reach = 5_000 if place[1] == 89.0 else 100_000
    metres = np.random.default_rng(3).uniform(-reach, reach, (400, 2))
    degrees = to_degrees(metres, georeference)
    x, y = _proj(georeference).transform(degrees[:, 0], degrees[:, 1])
    assert np.abs(np.column_stack([x, y]) - metres).max() < 1e-4
    assert np.abs(to_metres(degrees, georeference) - metres).max() < 1e-5


@settings(deadline=None, max_examples=60, derandomize=True)
@given(
    st.floats(-180, 180),
    st.floats(-80, 80),
    st.floats(-3000, 3000),
    st.floats(-3000, 3000),
)
def test_there_and_back_is_the_same_place(longitude, latitude, x, y):
    georeference = Georeference(longitude, latitude)
    metres = np.array([[x, y], [0.0, 0.0]])
    degrees = to_degrees(metres, georeference)
    assert np.abs(degrees[1, 1] - latitude) < 1e-12 * 180
    assert (np.abs(degrees[:, 0]) <= 180).all()
    assert np.abs(to_metres(degrees, georeference) - metres).max() < 1e-6


def test_north_is_up_and_east_is_right():
    georeference = Georeference(12.0, 46.0)
    points = to_metres(np.array([[12.0, 46.001], [12.001, 46.0], [12.0 - 360, 46.0]]), georeference)
    assert points[0] == pytest.approx([0.0, 111.15], abs=0.1)
    assert points[1] == pytest.approx([77.46, 0.0], abs=0.1)
    assert points[2] == pytest.approx([0.0, 0.0], abs=1e-6)
