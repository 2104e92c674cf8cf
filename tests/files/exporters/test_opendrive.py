"""The OpenDRIVE file, evaluated here by code of its own, lies on the exact line."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest

from bobdesk.files.exporters.formats import export_line
from bobdesk.plan.projection import Georeference
from tests.files.exporters.exact_line import LENGTH, elevation_at, exact_line, heading_at, plan_at


def _road(content):
    root = ElementTree.fromstring(content)
    assert root.tag == "OpenDRIVE"
    assert (root.find("header").get("revMajor"), root.find("header").get("revMinor")) == ("1", "6")
    return root.find("road")


def _number(element, *names):
    return np.array([float(element.get(name)) for name in names])


def _geometries(road):
    return [
        (
            *_number(g, "s", "x", "y", "hdg", "length"),
            _number(g[0], "aU", "bU", "cU", "dU"),
            _number(g[0], "aV", "bV", "cV", "dV"),
        )
        for g in road.find("planView")
    ]


def plan_of(road, station):
    """Evaluate the plan at a station, one number at a time, as the standard describes it."""
    for s, x, y, heading, length, u, v in reversed(_geometries(road)):
        if s <= station:
            p = min(station - s, length)
            local_u = sum(c * p**i for i, c in enumerate(u))
            local_v = sum(c * p**i for i, c in enumerate(v))
            way_u = sum(i * c * p ** (i - 1) for i, c in enumerate(u) if i)
            way_v = sum(i * c * p ** (i - 1) for i, c in enumerate(v) if i)
            return (
                x + local_u * np.cos(heading) - local_v * np.sin(heading),
                y + local_u * np.sin(heading) + local_v * np.cos(heading),
                heading + np.arctan2(way_v, way_u),
            )
    raise AssertionError("no geometry begins at 0")


def elevation_of(road, station):
    for piece in reversed(list(road.find("elevationProfile"))):
        s, a, b, c, d = _number(piece, "s", "a", "b", "c", "d")
        if s <= station:
            ds = station - s
            return a + b * ds + c * ds**2 + d * ds**3
    raise AssertionError("no elevation begins at 0")


@pytest.mark.parametrize(("spacing", "count"), [(1.0, 601), (2.0, 301)])
def test_the_road_lies_on_the_exact_line(spacing, count):
    road = _road(export_line(exact_line(spacing=spacing), format="xodr"))
    stations = np.linspace(0.0, LENGTH, count) + 0.37
    stations = stations[stations < LENGTH]
    # The rows are rounded to a micrometre, so the length differs from the exact one by little.
    assert abs(float(road.get("length")) - LENGTH) < 1e-3
    found = np.array([plan_of(road, s) for s in stations])
    assert np.hypot(*(found[:, :2] - plan_at(stations)).T).max() < 2e-3
    assert np.abs(np.angle(np.exp(1j * (found[:, 2] - heading_at(stations))))).max() < 2e-3
    z = np.array([elevation_of(road, s) for s in stations])
    assert np.abs(z - elevation_at(stations)).max() < 1e-3


def test_pieces_follow_each_other_without_gap_or_kink():
    road = _road(export_line(exact_line(), format="xodr"))
    geometries = _geometries(road)
    assert geometries[0][0] == 0
    for (s, _x, _y, _heading, length, _u, _v), after in pairwise(geometries):
        assert s + length == pytest.approx(after[0], abs=1e-9)
        at = plan_of(road, np.nextafter(after[0], 0))
        assert np.hypot(at[0] - after[1], at[1] - after[2]) < 1e-8
        assert abs(np.angle(np.exp(1j * (at[2] - after[3])))) < 1e-8
    last = geometries[-1]
    assert last[0] + last[4] == pytest.approx(float(road.get("length")), abs=1e-9)
    assert len(geometries) < 600  # few pieces, not one a row


def test_a_straight_and_a_kinked_profile_stay_exact_at_every_row():
    line = exact_line(spacing=2)
    s = np.linspace(0.0, 500.0, 501)
    z = np.where(s < 200, 60 - 0.15 * s, 30 - 0.1 * (s - 200)) + 0.0
    line = replace(line, stations=s, points=np.column_stack([s, 0 * s, z]), slope_lengths=s)
    road = _road(export_line(line, format="xodr"))
    assert max(abs(plan_of(road, x)[0] - x) + abs(plan_of(road, x)[1]) for x in s) < 1e-9
    assert max(abs(elevation_of(road, x) - height) for x, height in zip(s, z, strict=True)) < 1e-9
    between = s[:-1] + 0.5
    exact = np.interp(between, s, z)
    assert max(abs(elevation_of(road, x) - height) for x, height in zip(between, exact, strict=True)) < 1e-9


def test_the_lane_lies_with_its_middle_on_the_centreline():
    lanes = _road(export_line(exact_line(spacing=10), format="xodr")).find("lanes")
    offset = float(lanes.find("laneOffset").get("a"))
    width = float(lanes.find("laneSection/right/lane/width").get("a"))
    assert offset - width / 2 == 0


def test_the_place_on_the_earth_is_named():
    root = ElementTree.fromstring(
        export_line(exact_line(spacing=10), format="xodr", georeference=Georeference(12.5, 46.25))
    )
    text = root.find("header/geoReference").text
    assert "+proj=tmerc" in text
    assert "+lat_0=46.25" in text
    assert "+lon_0=12.5" in text
