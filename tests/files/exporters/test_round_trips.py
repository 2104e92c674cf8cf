"""What is written is read back as the same numbers, and by second readers."""

from __future__ import annotations

import csv
import io
import json

import ezdxf
import ezdxf.recover
import numpy as np
import pandas as pd
import pyproj
import pytest

from bobdesk.errors import InputError
from bobdesk.files.exporters.csv_flavours import FLAVOURS
from bobdesk.files.exporters.formats import FORMATS, export_format_of, export_line
from bobdesk.files.importers.formats import read_line
from bobdesk.files.importers.line3d import read_line3d
from bobdesk.plan.projection import Georeference
from tests.files.exporters.exact_line import exact_line

PLACE = Georeference(12.1378, 46.5523)


def _read(tmp_path, content, ending):
    path = tmp_path / f"line{ending}"
    path.write_bytes(content)
    return read_line(path)


@pytest.mark.parametrize("format", ["csv", "json", "dxf"])
def test_metres_come_back_to_the_last_printed_digit(tmp_path, format):
    line = exact_line()
    found = _read(tmp_path, export_line(line, format=format), f".{format}")
    assert np.array_equal(found.polyline.vertices, line.points[:, :2])
    assert np.array_equal(found.elevations, line.elevations)


@pytest.mark.parametrize("flavour", list(FLAVOURS))
def test_every_flavour_of_csv_comes_back(tmp_path, flavour):
    line = exact_line()
    found = _read(tmp_path, export_line(line, flavour=flavour), ".csv")
    assert np.array_equal(found.polyline.vertices, line.points[:, :2])
    assert np.array_equal(found.elevations, line.elevations)


@pytest.mark.parametrize("format", ["geojson", "kml"])
def test_degrees_come_back_to_the_last_printed_digit(tmp_path, format):
    line = exact_line()
    content = export_line(line, format=format, georeference=PLACE)
    found = _read(tmp_path, content, f".{format}")
    assert found.georeference == PLACE
    assert np.abs(found.polyline.vertices - line.points[:, :2]).max() < 1.5e-6
    assert np.array_equal(found.elevations, line.elevations)
    again = read_line3d(tmp_path / f"line.{format}")
    assert np.abs(again.line.points - line.points).max() < 1.5e-6


def test_json_keeps_the_place_on_the_earth(tmp_path):
    found = _read(tmp_path, export_line(exact_line(), format="json", georeference=PLACE), ".json")
    assert found.georeference == PLACE
    assert _read(tmp_path, export_line(exact_line(), format="json"), ".json").georeference is None


def test_json_gives_every_column_and_segment_back(tmp_path):
    line = exact_line(spacing=10, name="Kreisel")
    path = tmp_path / "line.json"
    path.write_bytes(export_line(line, format="json", georeference=PLACE))
    again = read_line3d(path)
    assert export_line(again.line, format="json", georeference=PLACE) == path.read_bytes()
    assert again.line.segments == line.segments
    assert again.georeference == PLACE
    assert again.notes == ()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda d: d["segments"][1].update(from_m=500.0), "segment 2 leaves a gap"),
        (lambda d: d["segments"][0].update(kind="loop"), "segment 1 is not of the kind"),
        (lambda d: d["segments"][0].update(name=7), "segment 1 is not of the kind"),
        (lambda d: d["segments"].append("x"), "segment 3 is not of the kind"),
        (lambda d: d["segments"][0].update(from_m=None), "segment 1 leaves a gap"),
        (lambda d: d["segments"][1].update(to_m=1e300), "segments end at"),
        (lambda d: d.update(segments=[]), "there are no segments"),
        (lambda d: d.update(segments={"kind": "curve"}), "list of segments makes no sense"),
        (lambda d: d["columns"]["gradient"].pop(), "different lengths"),
        (lambda d: d["columns"].update(station_m=d["columns"]["station_m"][::-1]), "must grow from row to row"),
        (
            lambda d: d["columns"].update(segment=[9] * len(d["columns"]["segment"])),
            "names a segment that there is not",
        ),
        (lambda d: d["columns"]["s_m"].__setitem__(3, "x"), "not a finite number"),
        (lambda d: d["columns"]["gradient"].__setitem__(3, 1e300), "gradient holds a number that no track has"),
    ],
)
def test_damaged_json_of_ours_is_one_sentence(tmp_path, change, sentence):
    document = json.loads(export_line(exact_line(spacing=20), format="json"))
    change(document)
    path = tmp_path / "line.json"
    path.write_text(json.dumps(document))
    with pytest.raises(InputError, match=sentence):
        read_line3d(path)


def test_json_without_its_segments_has_them_found(tmp_path):
    document = json.loads(export_line(exact_line(spacing=5), format="json"))
    del document["segments"]
    path = tmp_path / "line.json"
    path.write_text(json.dumps(document))
    found = read_line3d(path)
    assert len(found.line.segments) > 2
    assert any("found anew" in note for note in found.notes)


def test_line_csv_is_written_again_byte_for_byte(tmp_path):
    path = tmp_path / "LINE.csv"
    path.write_bytes(export_line(exact_line()))
    assert export_line(read_line3d(path).line) == path.read_bytes()


@pytest.mark.parametrize(
    ("flavour", "separator", "decimal"), [("default", ",", "."), ("excel-european", ";", ","), ("tab", "\t", ".")]
)
def test_pandas_numpy_and_csv_read_the_flavours(flavour, separator, decimal):
    line = exact_line(spacing=10)
    content = export_line(line, flavour=flavour)
    table = pd.read_csv(io.BytesIO(content), sep=separator, decimal=decimal, encoding="utf-8-sig")
    assert np.array_equal(table[["x_m", "y_m", "z_m"]].to_numpy(), line.points)
    text = content.decode("utf-8-sig")
    rows = list(csv.DictReader(io.StringIO(text), delimiter=separator))
    assert [float(row["z_m"].replace(",", ".")) for row in rows] == line.elevations.tolist()
    columns = np.loadtxt(
        io.StringIO(text.replace(",", ".") if decimal == "," else text),
        delimiter=separator,
        skiprows=1,
        usecols=(2, 3, 4),
    )
    assert np.array_equal(columns, line.points)


def test_the_length_is_that_of_the_rounded_rows(tmp_path):
    line = exact_line()
    rows = pd.read_csv(io.BytesIO(export_line(line)))
    length = np.linalg.norm(np.diff(rows[["x_m", "y_m", "z_m"]].to_numpy(), axis=0), axis=1).sum()
    assert rows["s_m"].iloc[-1] == pytest.approx(length, abs=5.1e-7)
    figures = pd.read_csv(io.BytesIO(export_line(line, format="figures"))).set_index("figure")["value"]
    assert figures["length"] == pytest.approx(length, abs=5.1e-7)
    assert figures["drop"] == pytest.approx(rows["z_m"].iloc[0] - rows["z_m"].min(), abs=1e-9)


def test_ezdxf_reads_the_drawing_without_a_fault(tmp_path):
    line = exact_line()
    path = tmp_path / "line.dxf"
    path.write_bytes(export_line(line, format="dxf"))
    drawing = ezdxf.readfile(path)
    assert not drawing.audit().has_errors
    assert not ezdxf.recover.readfile(path)[1].has_errors
    (polyline,) = drawing.modelspace()
    assert polyline.is_3d_polyline
    assert not polyline.is_closed
    assert np.array_equal([vertex.dxf.location.xyz for vertex in polyline.vertices], line.points)


def test_pyproj_finds_the_exported_degrees_at_the_same_metres():
    line = exact_line(spacing=20)
    text = export_line(line, format="kml", georeference=PLACE).decode()
    inside = text.split("<coordinates>")[1].split("</coordinates>")[0]
    rows = np.array([[float(cell) for cell in row.split(",")] for row in inside.split()])
    local = pyproj.CRS.from_proj4(
        f"+proj=tmerc +lat_0={PLACE.latitude} +lon_0={PLACE.longitude} +k=1 +datum=WGS84 +units=m"
    )
    x, y = pyproj.Transformer.from_crs("EPSG:4326", local, always_xy=True).transform(rows[:, 0], rows[:, 1])
    assert np.abs(np.column_stack([x, y]) - line.points[:, :2]).max() < 1e-5
    assert np.array_equal(rows[:, 2], line.elevations)


@pytest.mark.parametrize("format", ["geojson", "kml"])
def test_without_a_place_on_the_earth_there_are_no_degrees(format):
    with pytest.raises(InputError, match="no place on the Earth"):
        export_line(exact_line(spacing=20), format=format)


@pytest.mark.parametrize("format", [known.key for known in FORMATS])
def test_the_same_line_gives_the_same_bytes(format):
    line = exact_line(spacing=20)
    assert export_line(line, format=format, georeference=PLACE) == export_line(line, format=format, georeference=PLACE)


def test_unknown_formats_flavours_and_endings_are_refused(tmp_path):
    for wrong in ({"format": "docx"}, {"flavour": "martian"}):
        with pytest.raises(InputError, match="there is no"):
            export_line(exact_line(spacing=20), **wrong)
    with pytest.raises(InputError, match="names no format"):
        export_format_of(tmp_path / "line.docx")
    assert export_format_of(tmp_path / "a.figures.csv").key == "figures"
    assert export_format_of(tmp_path / "a.csv").key == "csv"


@pytest.mark.parametrize("flavour", ["default", "excel-european", "tab"])
@pytest.mark.parametrize(
    "name", ["=1+1", "+A1", "-A1", "@SUM(A1)", '=HYPERLINK("x";"y")', "\t=1", "\r=1", 'a"b', "a;b,c\td"]
)
def test_no_name_becomes_a_formula_or_two_cells(flavour, name):
    content = export_line(exact_line(spacing=20, name=name), format="figures", flavour=flavour)
    chosen = FLAVOURS[flavour]
    text = content.decode("utf-8-sig")
    rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=chosen.separator))
    assert {len(row) for row in rows} == {6}
    cells = {row[5] for row in rows[1:] if row[3] == "1"}
    assert len(cells) == 1
    (cell,) = cells
    assert not cell.startswith(("=", "+", "-", "@", "\t", "\r"))
    assert cell.lstrip("'") == name
