"""A track from longitudes and latitudes goes back there: import, project, run, export."""

from __future__ import annotations

import json

import numpy as np
import pyproj
import pytest
import shapely

from bobdesk.files.importers.formats import read_line
from bobdesk.files.project_file import load_project, save_project
from bobdesk.plan.world import PixelToWorld
from bobdesk.project import derive, edits
from bobdesk.project.derive_runs import run_georeference, run_line
from bobdesk.project.project import Picture, Project, SourceLine
from tests.project.made_projects import ready_project, solved_run

_ORIGIN = (12.1378, 46.5523)
_LOCAL = pyproj.CRS.from_proj4(f"+proj=tmerc +lat_0={_ORIGIN[1]} +lon_0={_ORIGIN[0]} +k=1 +datum=WGS84 +units=m")
_TO_METRES = pyproj.Transformer.from_crs("EPSG:4326", _LOCAL, always_xy=True)


def drawn_geojson(path):
    """Write a straight, a curve of 80 m radius and a straight, a point a metre, by PROJ; return the metres."""
    turn = np.arange(0.0, 200.0) / 80
    curve = 80 * np.column_stack([np.sin(turn), 1 - np.cos(turn)])
    way = np.array([np.cos(turn[-1]), np.sin(turn[-1])])
    before = np.column_stack([np.arange(-200.0, 0.0), np.zeros(200)])
    points = np.concatenate([before, curve, curve[-1] + np.arange(1.0, 250)[:, None] * way])
    points -= points[0]
    degrees = np.column_stack(_TO_METRES.transform(*points.T, direction="INVERSE"))
    path.write_text(json.dumps({"type": "LineString", "coordinates": degrees.tolist()}))
    return points


def solved_project(path):
    found = read_line(path)
    place = found.georeference
    source = SourceLine(path.name, found.polyline, place.longitude, place.latitude)
    project = edits.set_smoothing(edits.open_coordinates(Project(), source), 0.0)
    length = derive.centreline(project).needed().length
    project = edits.set_drop(edits.set_length(project, round(1.0045 * length, 2)), round(0.09 * length, 2))
    return edits.keep_run(project, solved_run(project))


@pytest.mark.parametrize("ending", ["geojson", "kml"])
def test_a_track_from_degrees_returns_to_the_same_degrees(call, ending):
    points = drawn_geojson(call.path("track.geojson"))
    project = solved_project(call.path("track.geojson"))
    save_project(project, call.path("p.bobdesk"))
    said = call("export", call.path("p.bobdesk"), "-o", call.path(f"out.{ending}"))
    assert (said.status, said.err) == (0, "")
    text = call.path(f"out.{ending}").read_text("utf-8")
    if ending == "geojson":
        rows = np.array(json.loads(text)["features"][0]["geometry"]["coordinates"])
    else:
        inside = text.split("<coordinates>")[1].split("</coordinates>")[0]
        rows = np.array([[float(cell) for cell in row.split(",")] for row in inside.split()])
    metres = np.column_stack(_TO_METRES.transform(rows[:, 0], rows[:, 1]))
    line = run_line(project.run).points
    # Printed to ten decimals of a degree, which is 0.01 mm.
    assert np.abs(metres - line[:, :2]).max() < 2e-5
    assert np.array_equal(rows[:, 2], line[:, 2])
    assert np.abs(metres[0] - points[0]).max() < 2e-5
    assert np.abs(metres[-1] - points[-1]).max() < 2e-5
    # Between points a metre apart the line is a curve of 80 m radius, 1.6 mm beside the chord.
    drawn = shapely.LineString(points)
    assert max(drawn.distance(shapely.Point(place)) for place in metres) < 2e-3
    again = read_line(call.path(f"out.{ending}"))
    assert again.georeference == derive.georeference(project)
    assert np.abs(again.polyline.vertices - line[:, :2]).max() < 2e-6


def test_the_place_survives_the_file_and_a_change_of_direction(call):
    drawn_geojson(call.path("track.geojson"))
    project = edits.reverse_line(solved_project(call.path("track.geojson")))
    save_project(project, call.path("p.bobdesk"))
    place = derive.georeference(load_project(call.path("p.bobdesk")))
    assert (place.longitude, place.latitude) == pytest.approx(_ORIGIN, abs=1e-12)


def test_a_line_that_does_not_lie_there_has_no_degrees(call):
    drawn_geojson(call.path("track.geojson"))
    project = solved_project(call.path("track.geojson"))
    run = project.run
    assert run_georeference(project, run) is not None
    assert run_georeference(edits.set_finish(project, 300.0), run) is None
    scaled = edits.find_the_scale(project)
    assert derive.georeference(scaled) is None
    assert run_georeference(scaled, solved_run(scaled)) is None
    placed = PixelToWorld(0.5, 0.0, 720_000.0, 0.0, -0.5, 5_160_000.0)
    picture = Picture(b"\x89PNG", "plan.tif", size_px=(900, 900), world=placed)
    project = edits.open_picture(Project(), picture)
    project = edits.take_trace(project, ready_project().trace)
    assert derive.polyline(project).value is not None
    assert derive.georeference(project) is None
    length = derive.centreline(project).needed().length
    project = edits.set_drop(edits.set_length(project, round(1.0045 * length, 2)), round(0.09 * length, 2))
    save_project(edits.keep_run(project, solved_run(project)), call.path("p.bobdesk"))
    said = call.refused("export", call.path("p.bobdesk"), "-o", call.path("l.geojson"), status=3)
    assert "no place on the Earth" in said
