"""Every dialect and encoding that a spreadsheet or an editor writes gives the same numbers."""

import contextlib
import csv
import io

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from bobdesk.errors import InputError
from bobdesk.files.importers.csv_points import read_csv_points
from bobdesk.files.importers.segments_csv import read_segments
from bobdesk.files.importers.table import read_table

POINTS = [(0.5, 1.25, 30.0), (10.25, 3.5, 29.5), (20.125, -9.75, 28.0), (31.0, -12.5, 27.25)]
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252", "utf-32"]
DIALECTS = [(separator, ".") for separator in (",", ";", "\t", "|", " ")]
DIALECTS += [(separator, ",") for separator in (";", "\t", "|", " ")]
QUIET = settings(
    deadline=None, derandomize=True, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def written(rows, *, header=("x_m", "y_m", "z_m"), separator=",", decimal=".", line_end="\n"):
    lines = [separator.join(header)] if header else []
    lines += [separator.join(repr(float(value)).replace(".", decimal) for value in row) for row in rows]
    return line_end.join(lines) + line_end


def read(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "plan.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode(encoding))
    return read_csv_points(path)


def assert_same(line, rows):
    rows = np.array(rows)
    assert np.array_equal(line.polyline.vertices, rows[:, :2])
    if rows.shape[1] > 2:
        assert np.array_equal(line.elevations, rows[:, 2])


@pytest.mark.parametrize(("separator", "decimal"), DIALECTS)
@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_separator_decimal_sign_and_encoding(tmp_path, separator, decimal, encoding, line_end):
    text = written(POINTS, separator=separator, decimal=decimal, line_end=line_end)
    line = read(tmp_path, text, encoding)
    assert_same(line, POINTS)
    assert line.notes == ()


finite = st.floats(-9e7, 9e7, allow_nan=False, allow_infinity=False)
tables = st.lists(st.tuples(finite, finite, finite), min_size=3, max_size=12)


@QUIET
@given(tables, st.sampled_from(DIALECTS), st.sampled_from(ENCODINGS), st.booleans(), st.booleans())
def test_any_table_of_floats_is_read_back(tmp_path, rows, dialect, encoding, quoted, header):
    steps = np.hypot(*np.diff(np.array(rows)[:, :2], axis=0).T)
    assume((steps > 2e-3).all())
    separator, decimal = dialect
    text = written(rows, header=("x", "y", "z") if header else None, separator=separator, decimal=decimal)
    if quoted and separator != " ":
        cells = [line.split(separator) for line in text.splitlines()]
        stream = io.StringIO()
        csv.writer(stream, delimiter=separator, quoting=csv.QUOTE_ALL).writerows(cells)
        text = stream.getvalue()
    assert_same(read(tmp_path, text, encoding), rows)


@pytest.mark.parametrize(
    "header",
    ["x,y", "X_M,Y_M", "x_m,y_m", "Easting,Northing", '"x_m","y_m"', "X [m],Y [m]", "x (m),y (m)", " x , y ", "\ufeffx,y"],  # noqa: E501
)  # fmt: skip
def test_headers(tmp_path, header):
    rows = [row[:2] for row in POINTS]
    line = read(tmp_path, header + "\n" + written(rows, header=None))
    assert_same(line, rows)
    assert line.elevations is None
    assert line.notes == ()


def test_columns_are_found_by_name_wherever_they_stand(tmp_path):
    rows = "name;y_m;größe;x_m;z_m\nA;1,25;7;0,5;30\nB;3,5;7;10,25;29,5\nC;-9,75;7;20,125;28\nD;-12,5;7;31;27,25\n"
    assert_same(read(tmp_path, rows, "cp1252"), POINTS)


def test_no_header_is_taken_for_x_y_z_and_noted(tmp_path):
    line = read(tmp_path, written(POINTS, header=None))
    assert_same(line, POINTS)
    assert "no header" in line.notes[0]


def test_decimal_commas_in_quotes_between_commas(tmp_path):
    rows = "".join('"{}","{}"\n'.format(*(str(value).replace(".", ",") for value in row[:2])) for row in POINTS)
    for header in ("x_m,y_m\n", ""):
        assert_same(read(tmp_path, header + rows), [row[:2] for row in POINTS])


def test_decimal_commas_between_commas_are_never_read_as_other_numbers(tmp_path):
    with pytest.raises(InputError, match="line 2"):
        read(tmp_path, "x_m,y_m\n0,5,1,25\n10,25,3,5\n20,125,-9,75\n")
    with pytest.raises(InputError, match="no header, and 4 columns"):
        read(tmp_path, "0,5,1,25\n10,25,3,5\n20,125,-9,75\n")


def test_quoted_text_beside_the_numbers_may_hold_separators_and_quotes(tmp_path):
    text = 'name,x_m,y_m\n"Turn 3, the ""wall""",0.5,1.25\n"B, C",10.25,3.5\nD,20.125,-9.75\n,31,-12.5\n'
    assert_same(read(tmp_path, text), [row[:2] for row in POINTS])


def test_comments_blank_lines_and_trailing_separators(tmp_path):
    text = "# from a survey\n\nx_m,y_m,\n  # more\n0.5,1.25,\n\n10.25,3.5,\n20.125,-9.75,\n"
    assert_same(read(tmp_path, text), [row[:2] for row in POINTS[:3]])


def test_signs_and_exponents(tmp_path):
    text = "x_m,y_m\n+0.5,1.25E0\n1.025e1,.35e+1\n20.125,\u22129.75\n"
    assert_same(read(tmp_path, text), [row[:2] for row in POINTS[:3]])


@pytest.mark.parametrize("cell", ["1_000", "1.234,5", "1 000", "0x10", "1e999", "--3", "5m", "١٢x"])
def test_what_only_looks_like_a_number_is_refused(tmp_path, cell):
    with pytest.raises(InputError, match=r"line 3, column y_m holds"):
        read(tmp_path, f"x_m;y_m\n0.5;1.25\n10.25;{cell}\n20.125;-9.75\n1.5;2.5\n1.5;3.5\n")


def test_repeated_points_are_merged_with_their_elevations(tmp_path):
    rows = [POINTS[0], POINTS[0], POINTS[1], POINTS[2], (POINTS[2][0], POINTS[2][1] + 5e-4, 99.0), POINTS[3]]
    line = read(tmp_path, written(rows))
    assert_same(line, POINTS)
    assert line.notes == ("2 repeated points were left out",)


def test_a_name_without_its_line_is_never_all_that_an_error_says(tmp_path):
    with pytest.raises(InputError, match=r"plan\.csv, line 5, column z_m holds 'inf'"):
        read(tmp_path, "# a\n# b\nx_m,y_m,z_m\n0,0,1\n5,5,inf\n9,9,1\n")


BYTES = sorted({*b',;\t "\n\r#.-eE0\x00\xff\x85_\x0c', 200})


def only_input_errors(path):
    for reader in (read_table, read_csv_points, lambda at: read_segments(at, length=100.0)):
        with contextlib.suppress(InputError):
            reader(path)


@QUIET
@given(st.binary(max_size=400))
def test_random_bytes_raise_input_errors_only(tmp_path, data):
    path = tmp_path / "random.csv"
    path.write_bytes(data)
    only_input_errors(path)


@QUIET
@given(
    st.sampled_from(["x_m,y_m,z_m", "kind,from_m,to_m"]),
    st.lists(st.tuples(st.integers(0, 90), st.sampled_from(BYTES)), max_size=8),
)  # fmt: skip
def test_mutated_tables_raise_input_errors_only(tmp_path, header, changes):
    data = bytearray(written(POINTS * 2, header=header.split(",")).encode())
    for position, byte in changes:
        data[position % len(data)] = byte
    path = tmp_path / "mutated.csv"
    path.write_bytes(bytes(data))
    only_input_errors(path)


@QUIET
@given(st.text(alphabet="0123456789.,;:\"'\n\r\t |#xyzm_-+eE\u2028\x0b\ufeff", max_size=300))
def test_text_of_the_right_letters_raises_input_errors_only(tmp_path, text):
    path = tmp_path / "text.csv"
    path.write_text(text, "utf-8", newline="")
    only_input_errors(path)


def test_limits_of_size(tmp_path, monkeypatch):
    monkeypatch.setattr("bobdesk.files.importers.table._MOST_CELLS", 10)
    with pytest.raises(InputError, match="over 10 cells"):
        read(tmp_path, "x_m,y_m,a,b,c,d\n1,2,3,4,5,6\n7,8,9,0,1,2\n")
    monkeypatch.setattr("bobdesk.files.importers.table._LARGEST_FILE", 20)
    with pytest.raises(InputError, match="too large"):
        read(tmp_path, written(POINTS))


@pytest.mark.parametrize("line_end", ["\n", "\r", "\r\n"])
def test_rows_are_counted_before_they_are_cut(tmp_path, line_end, monkeypatch):
    monkeypatch.setattr("bobdesk.files.importers.table.MOST_VERTICES", 1000)
    with pytest.raises(InputError, match="thin it out"):
        read(tmp_path, ("1,2" + line_end) * 2100)
