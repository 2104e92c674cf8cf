"""Every format gives the same track; what was dropped is said."""

from __future__ import annotations

import json
import sys

import ezdxf
import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.files.importers.csv_points import CsvChoice
from bobdesk.files.importers.dialect import Dialect
from bobdesk.files.importers.formats import read_line
from bobdesk.files.importers.preview import preview
from tests.files.importers import made_files as made


@pytest.fixture
def read(tmp_path):
    def reader(content, name="track"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_line(path)

    return reader


@pytest.mark.parametrize("format", ["kml", "kmz", "gpx", "geojson", "osm", "json"])
def test_degrees_become_the_metres_that_proj_finds(read, format):
    found = read(made.ALL[format](), f"track.{format}")
    assert np.abs(found.polyline.vertices - made.metres_by_pyproj(made.PLACES)).max() < 1e-3
    assert found.georeference.longitude == made.PLACES[0, 0]
    assert found.georeference.latitude == made.PLACES[0, 1]


@pytest.mark.parametrize("format", ["csv", "kml", "kmz", "gpx", "geojson", "dxf"])
def test_elevations_come_with_the_line(read, format):
    assert np.array_equal(read(made.ALL[format](), f"track.{format}").elevations, made.Z)


@pytest.mark.parametrize("format", ["csv", "svg", "dxf", "bobdesk"])
def test_metres_stay_as_they_are(read, format):
    found = read(made.ALL[format](), f"track.{format}")
    assert np.abs(found.polyline.vertices - made.PLAN).max() < 1e-9
    assert (found.georeference is None) == (format != "bobdesk")


@pytest.mark.parametrize("format", list(made.ALL))
def test_the_content_decides_and_not_the_ending(read, format):
    found = read(made.ALL[format](), "track.txt")
    assert len(found.polyline.vertices) == 60


def test_tracks_of_openstreetmap_are_found_and_joined_by_themselves(read):
    for content in (made.osm_xml(), made.overpass(), made.overpass(geometry=True)):
        found = read(content)
        assert len(found.polyline.vertices) == 60
        assert any("2 ways without" in note for note in found.notes)
        assert any("3 lines were joined" in note for note in found.notes)


def test_a_branch_is_left_out_and_the_longest_way_taken(read):
    rows = made.PLACES.tolist()
    ladies = [[rows[10][0], rows[10][1] + 0.001], rows[10]]
    parts = [rows[:11], rows[10:][::-1], ladies]
    found = read(json.dumps({"type": "MultiLineString", "coordinates": parts}))
    assert len(found.polyline.vertices) == 60
    assert any("1 other was left out" in note for note in found.notes)


def test_osm_without_a_track_is_refused_with_the_number_of_ways(read):
    content = made.osm_xml().replace(b"bobsleigh", b"tennis").replace(b"luge", b"golf")
    with pytest.raises(InputError, match="none of its 5 ways has sport=bobsleigh or luge"):
        read(content)


def test_a_line_drawn_in_both_directions_runs_downhill(read):
    rows = [[x, y, z] for (x, y), z in zip(made.PLACES.tolist(), made.Z.tolist(), strict=True)]
    found = read(json.dumps({"type": "MultiLineString", "coordinates": [rows[:11], rows[10:][::-1]]}))
    assert found.elevations[0] == made.Z[0]
    uphill = read(json.dumps({"type": "LineString", "coordinates": rows[::-1]}))
    assert uphill.elevations[0] == made.Z[-1]  # drawn in one direction: that is the user's


def test_elevations_of_zero_or_of_some_points_are_missing(read):
    flat = read(made.kml(z=0 * made.Z))
    assert flat.elevations is None
    assert any("all elevations are 0" in note for note in flat.notes)
    rows = [[x, y, 5.0] for x, y in made.PLACES.tolist()]
    del rows[3][2]
    some = read(json.dumps({"type": "LineString", "coordinates": rows}))
    assert some.elevations is None
    assert any("1 of 60 points have no elevation" in note for note in some.notes)


def test_geojson_in_metres_is_taken_for_metres_and_says_so(read):
    document = {
        "type": "LineString",
        "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
        "coordinates": (made.PLAN / 10).tolist(),
    }
    found = read(json.dumps(document))
    assert np.array_equal(found.polyline.vertices, made.PLAN / 10)
    assert any("metres" in note for note in found.notes)
    del document["crs"]
    document["coordinates"] = (made.PLAN + 720_000).tolist()
    assert np.array_equal(read(json.dumps(document)).polyline.vertices, made.PLAN + 720_000)


def test_a_track_across_the_date_line_stays_whole(read):
    rows = [[179.999 + 0.0002 * i - (360 if i > 4 else 0), 50 + 0.0001 * i] for i in range(10)]
    steps = np.hypot(
        *np.diff(read(json.dumps({"type": "LineString", "coordinates": rows})).polyline.vertices, axis=0).T
    )
    assert np.ptp(steps) < 1e-2


def test_crossings_and_repeated_points_are_said(read):
    text = "x,y\n0,0\n0,0.0005\n100,0\n100,50\n50,50\n50,-50\n"
    notes = read(text).notes
    assert any("1 repeated point was left out" in note for note in notes)
    assert any("crosses itself" in note for note in notes)
    assert not any("crosses itself" in note for note in read(made.csv_text()).notes)


def test_a_drawing_in_millimetres_comes_in_metres(read):
    found = read(made.dxf(units=4))
    assert np.abs(found.polyline.vertices - made.PLAN).max() < 1e-9
    assert any("millimetres" in note for note in found.notes)
    assert any("1 TEXT" in note for note in found.notes)


def test_arcs_bulges_splines_and_blocks_of_a_drawing_are_followed(read, tmp_path):
    drawing = ezdxf.new("R2010")
    drawing.header["$INSUNITS"] = 6
    block = drawing.blocks.new("PART")
    block.add_line((0, 0), (100, 0))
    block.add_arc((100, 50), 50, 270, 360)
    space = drawing.modelspace()
    space.add_blockref("PART", (10, 20))
    space.add_lwpolyline([(160, 70, 0, 0, 1), (160, 170, 0, 0, 0)])  # half a circle to the right
    drawing.saveas(tmp_path / "a.dxf")
    found = read((tmp_path / "a.dxf").read_bytes())
    length = np.hypot(*np.diff(found.polyline.vertices, axis=0).T).sum()
    assert length == pytest.approx(100 + 25 * np.pi + 50 * np.pi, rel=1e-4)
    assert found.polyline.vertices[0] == pytest.approx([10, 20])
    assert found.polyline.vertices[-1] == pytest.approx([160, 170])


def test_without_ezdxf_a_drawing_says_what_to_install(read, monkeypatch):
    content = made.dxf()
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(InputError, match=r'pip install "bobdesk\[cad\]"'):
        read(content)


def test_curves_and_transforms_of_svg_are_exact(read):
    content = (
        '<svg xmlns="http://www.w3.org/2000/svg"><g transform="translate(10 20) rotate(90)"><g transform="scale(2)">'
        '<path d="M0,0h10a10 10 0 0 1 10 10v5q0 5 5 5t5 5c0 1 1 2 2 2s2 1 2 2z m3 3"/></g></g>'
        '<defs><path d="M0 0h1000"/></defs><g style="display: none"><path d="M0 0h1000"/></g></svg>'
    )
    vertices = read(content).polyline.vertices
    assert vertices[0] == pytest.approx([10, -20])
    assert vertices[-1] == pytest.approx([10, -20])  # closed
    assert vertices[1] == pytest.approx([10, -40])  # h10, doubled, turned to point down
    centre = np.array([10 - 20, -40.0])  # of the arc, radius 20
    on_arc = vertices[2:6]
    assert np.hypot(*(on_arc - centre).T) == pytest.approx(20, abs=1e-4)


def test_a_table_can_be_read_as_a_person_says(tmp_path):
    path = tmp_path / "odd.csv"
    path.write_text("p;q;r\n1;10,5;2\n2;11,5;3\n3;14,5;9\n")
    first = preview(path)
    assert "there is no column x_m and y_m" in first.problem
    assert (first.separator, first.decimal) == ("semicolon", ",")
    assert first.columns == ("p", "q", "r")
    assert first.rows[0] == ("1", "10,5", "2")
    assert first.line is None
    said = preview(path, choice=CsvChoice(Dialect(";", ","), (1, 2, None)))
    assert said.problem is None
    assert said.line.polyline.vertices.tolist() == [[10.5, 2], [11.5, 3], [14.5, 9]]


@pytest.mark.parametrize("format", list(made.ALL))
def test_every_format_has_a_preview(tmp_path, format):
    path = tmp_path / f"a.{format}"
    path.write_bytes(made.ALL[format]())
    found = preview(path)
    assert found.count == 60
    assert 3 <= len(found.thumbnail) <= 200
    assert found.unit == ("metres" if format in ("csv", "svg", "dxf", "bobdesk") else "degrees")
    assert found.has_elevations == (format not in ("osm", "json", "svg", "bobdesk"))
    assert len(found.rows) == 8
    assert len(found.columns) == len(found.rows[0])


def test_a_preview_of_a_long_line_has_200_points_and_both_ends(tmp_path):
    path = tmp_path / "a.csv"
    t = np.arange(5000.0)
    np.savetxt(path, np.column_stack([t, np.sin(t / 100)]), delimiter=",", header="x_m,y_m", comments="")
    found = preview(path)
    assert len(found.thumbnail) == 200
    assert found.thumbnail[[0, -1], 0].tolist() == [0.0, 4999.0]


def test_a_drawing_is_read_without_a_look_at_fonts_and_leaves_nothing_in_the_home(tmp_path, monkeypatch):
    home, temporary = tmp_path / "home", tmp_path / "temporary"
    for folder in (home, temporary):
        folder.mkdir()
    for name in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(home))
    for name in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.setenv(name, str(temporary))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    drawing = tmp_path / "plan.dxf"
    drawing.write_bytes(made.ALL["dxf"]())
    assert len(read_line(drawing).polyline.vertices) == len(made.PLAN)
    assert [path for path in tmp_path.rglob("*") if path not in (home, temporary, drawing)] == []
