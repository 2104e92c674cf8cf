"""What is written is read by others: the csv module, numpy, pandas, and BobDesk itself."""

import csv
import io
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.segments import Segment
from bobdesk.errors import InputError
from bobdesk.files.exporters.csv_flavours import FLAVOURS, text_cell, to_csv
from bobdesk.files.exporters.tables import LINE_COLUMNS, line_table, segments_table
from bobdesk.files.importers.csv_points import read_csv_points
from bobdesk.files.importers.segments_csv import read_segments
from bobdesk.plan.polyline import Polyline
from bobdesk.progress import finish
from bobdesk.solve.pgd import pgd
from bobdesk.solve.targets import Targets
from bobdesk.track.centreline3d import make_centreline3d


@pytest.fixture(scope="module")
def line():
    """A straight of 60 m, a quarter circle of 40 m radius to the left, a straight of 60 m."""
    angles = np.linspace(0, np.pi / 2, 30)
    bend = np.column_stack([60 + 40 * np.sin(angles), 40 - 40 * np.cos(angles)])
    before, after = np.linspace([0, 0], [58, 0], 30), np.linspace([100, 42], [100, 100], 30)
    centreline = fit_centreline(Polyline(np.concatenate([before, bend, after])))
    bounds = (0.0, 60.0, 60 + 20 * np.pi, centreline.length)
    kinds = ("straight", "curve", "straight")
    segments = tuple(Segment(kind, bounds[i], bounds[i + 1]) for i, kind in enumerate(kinds))
    solution = finish(pgd(centreline, segments, Targets(length=183.5, drop=12)))
    return centreline, segments, make_centreline3d(centreline, segments, solution)


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_three_readers_give_the_printed_digits(line, flavour, tmp_path):
    _, _, line3d = line
    chosen = FLAVOURS[flavour]
    path = tmp_path / "line.csv"
    path.write_bytes(line_table(line3d, flavour=flavour))
    names = LINE_COLUMNS if flavour != "xyz" else ("x_m", "y_m", "z_m")
    header = 0 if flavour != "xyz" else None
    table = pd.read_csv(path, sep=chosen.separator, decimal=chosen.decimal, header=header, encoding="utf-8-sig")
    table.columns = list(names) if header is None else table.columns
    assert tuple(table.columns) == names
    assert len(table) == len(line3d.stations)
    text = path.read_text("utf-8-sig")
    rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=chosen.separator))
    numbers = [name for name in names if name != "kind"]
    by_csv = np.array([[float(cell.replace(",", ".")) for cell in row[: len(numbers)]] for row in rows[header == 0 :]])
    by_numpy = np.loadtxt(
        io.StringIO(text.replace(",", ".") if chosen.decimal == "," else text),
        delimiter=chosen.separator, skiprows=int(header == 0), usecols=range(len(numbers)),
    )  # fmt: skip
    assert np.array_equal(table[numbers].to_numpy(float), by_csv)
    assert np.array_equal(by_numpy, by_csv)
    assert table[["x_m", "y_m", "z_m"]].to_numpy() == pytest.approx(line3d.points, abs=5.1e-7)
    again = read_csv_points(path)
    assert np.array_equal(again.polyline.vertices, table[["x_m", "y_m"]].to_numpy())
    assert np.array_equal(again.elevations, table.z_m.to_numpy())
    if flavour != "xyz":
        assert table.gradient.to_numpy() == pytest.approx(line3d.gradients, abs=5.1e-10)
        assert table.s_m.to_numpy() == pytest.approx(line3d.slope_lengths, abs=5.1e-7)
        assert table.heading_rad.to_numpy() == pytest.approx(line3d.headings, abs=5.1e-10)
        assert list(table.kind) == [line3d.segments[index].kind for index in line3d.segment_of]


def test_bytes_of_each_flavour(line):
    _, _, line3d = line
    default, excel, tab, xyz = (line_table(line3d, flavour=name) for name in FLAVOURS)
    assert default.startswith(b"station_m,")
    assert b"\r" not in default
    assert excel.startswith(b"\xef\xbb\xbfstation_m;")
    assert excel.count(b"\r\n") == excel.count(b"\n") == default.count(b"\n")
    assert b"." not in excel
    assert tab.startswith(b"station_m\ts_m")
    assert xyz.count(b"\n") == default.count(b"\n") - 1
    assert all(table.endswith(b"\n") and b"-0.000000," not in table for table in (default, excel, tab, xyz))


def test_curvature_and_heading_have_the_signs_of_the_contract(line):
    _, _, line3d = line
    middle = int(np.searchsorted(line3d.stations, 60 + 10 * np.pi))
    assert line3d.plan_curvature[middle] == pytest.approx(1 / 40, rel=0.02)
    assert line3d.headings[0] == pytest.approx(0, abs=1e-3)
    assert line3d.headings[-1] == pytest.approx(np.pi / 2, abs=1e-3)
    assert line3d.gradients.mean() > 0


def test_segments_are_read_back(line, tmp_path):
    centreline, segments, _ = line
    for flavour in FLAVOURS.values():
        if flavour.header:
            path = tmp_path / "s.csv"
            path.write_bytes(segments_table(centreline, segments, flavour=flavour))
            again = read_segments(path, length=centreline.length)
            assert [segment.kind for segment in again] == [segment.kind for segment in segments]
            assert [segment.end for segment in again] == pytest.approx([segment.end for segment in segments], abs=6e-4)
            twice = read_segments(path, length=3 * centreline.length, scale=3.0)
            assert twice[-1].end == pytest.approx(3 * centreline.length, abs=1e-6)


def test_names_and_locks_come_back_and_have_columns_only_where_there_are_any(line, tmp_path):
    centreline, segments, _ = line
    path = tmp_path / "s.csv"
    marked = (replace(segments[0], name='=1 "Kreisel", upper'), replace(segments[1], locked=True), *segments[2:])
    for flavour in FLAVOURS.values():
        if flavour.header:
            path.write_bytes(segments_table(centreline, marked, flavour=flavour))
            again = read_segments(path, length=centreline.length)
            assert [(one.name, one.locked) for one in again] == [(one.name, one.locked) for one in marked]
    assert b"name" not in segments_table(centreline, segments)
    path.write_text("kind,from_m,to_m,locked\nstraight,0,50,perhaps\n")
    with pytest.raises(InputError, match="line 2, column locked holds 'perhaps'"):
        read_segments(path, length=50.0)


def test_figures_of_segments(line):
    centreline, segments, _ = line
    table = pd.read_csv(io.BytesIO(segments_table(centreline, segments)))
    assert table.radius_m[1] == pytest.approx(40, rel=0.03)
    # The ends of a curve are smoothed, so some of the turn of 90 degrees lies beside it.
    assert table.turn_rad[1] == pytest.approx(np.pi / 2, rel=0.06)
    assert table.turn_rad.sum() == pytest.approx(np.pi / 2, abs=2e-3)


@settings(deadline=None, derandomize=True, max_examples=100)
@given(st.text(max_size=30), st.sampled_from(sorted(FLAVOURS)))
def test_free_text_is_one_cell_and_no_formula(text, flavour):
    chosen = FLAVOURS[flavour]
    cell = text_cell(text, chosen)
    assert not cell.lstrip('"').startswith(("=", "+", "-", "@", "\t", "\r"))
    row = next(csv.reader(io.StringIO(cell + chosen.separator + "1", newline=""), delimiter=chosen.separator))
    assert row[-1] == "1"
    assert row[0] in (text, "'" + text)


def test_a_table_of_no_rows_is_its_header():
    assert to_csv(("a", "b"), [], FLAVOURS["default"]) == b"a,b\n"
