"""What a command writes, another command reads."""

import json

import numpy as np
import pandas as pd
import pytest

from tests.cli.calls import TARGETS


def reconstruct(call, name, *options, plan=None):
    said = call("reconstruct", plan or call.plan, *TARGETS, "-o", call.path(name), *options)
    assert said.status == 0, said
    return call.path(name)


@pytest.mark.parametrize("options", [("--count", "5"), ("--spacing", "2"), ("--wavelength", "20")])
def test_segments_that_were_written_give_the_same_line(call, options):
    assert call("segment", call.plan, "-o", call.path("s.csv"), *options).status == 0
    fit = options if "--count" not in options else ()
    first = pd.read_csv(reconstruct(call, "a.csv", *options))
    second = pd.read_csv(reconstruct(call, "b.csv", *fit, "--segments", call.path("s.csv")))
    assert len(first) == len(second)
    for column in ("station_m", "x_m", "y_m"):
        assert second[column].to_numpy() == pytest.approx(first[column].to_numpy(), abs=1e-3)
    assert (first.kind == second.kind).mean() > 0.99


@pytest.mark.parametrize("options", [(), ("--known", "100:26", "400:12")])
def test_segments_that_were_written_give_the_same_smoothest_profile(call, options):
    call("segment", call.plan, "-o", call.path("s.csv"))
    first = pd.read_csv(reconstruct(call, "a.csv", "--smoothest", *options))
    second = pd.read_csv(reconstruct(call, "b.csv", "--smoothest", *options, "--segments", call.path("s.csv")))
    # Boundaries are written to the millimetre.
    assert second.z_m.to_numpy() == pytest.approx(first.z_m.to_numpy(), abs=1e-3)


def test_corrected_segments_are_used(call):
    call.path("s.csv").write_text("kind,from_m,to_m\nstraight,0,300\ncurve,300,702.1\n", "utf-8")
    line = pd.read_csv(reconstruct(call, "l.csv", "--segments", call.path("s.csv")))
    assert set(line.segment) == {1, 2}
    assert line.station_m[line.segment == 2].iloc[0] == pytest.approx(300, abs=1.01)


def test_a_line_compared_with_itself_differs_by_nothing(call):
    for path in (call.plan, reconstruct(call, "l.csv")):
        said = call("compare", path, path, "--report", call.path("r.json"))
        assert (said.status, said.err) == (0, "")
        report = json.loads(call.path("r.json").read_text("utf-8"))
        figures = [value for key, value in report.items() if not isinstance(value, dict) and key != "z_max_station_m"]
        assert figures == [0.0] * len(figures)
        assert list(report["deviation_percent"].values()) == [0.0] * 4


def test_compare_finds_a_known_difference(call):
    table = pd.read_csv(call.plan)
    table["z_m"] = np.linspace(20, 0, len(table))
    table.to_csv(call.path("a.csv"), index=False)
    table["z_m"] *= 1.1
    table.to_csv(call.path("b.csv"), index=False)
    assert call("compare", call.path("b.csv"), call.path("a.csv"), "--report", call.path("r.json")).status == 0
    report = json.loads(call.path("r.json").read_text("utf-8"))
    assert report["deviation_percent"]["drop_m"] == pytest.approx(10, abs=1e-9)
    assert report["deviation_percent"]["plan_length_m"] == pytest.approx(0, abs=1e-12)
    assert report["z_max_m"] == pytest.approx(2, abs=1e-9)
    assert report["z_max_station_m"] == 0


def test_an_elevation_offset_is_no_difference(call):
    table = pd.read_csv(call.plan)
    table["z_m"] += 1000
    table.to_csv(call.path("high.csv"), index=False)
    call("compare", call.path("high.csv"), call.plan, "--report", call.path("r.json"))
    assert json.loads(call.path("r.json").read_text("utf-8"))["z_max_m"] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("flavour", ["default", "excel-european", "tab", "xyz"])
def test_a_line_of_each_flavour_is_accepted_as_a_plan(call, flavour):
    line = reconstruct(call, "l.csv", "--flavour", flavour)
    said = call("check", line, *TARGETS)
    assert said.status == 0
    assert "can all be met" in said.out
    # A line without a header is taken for x, y, z, and that is said where notes belong.
    assert ("note: " in said.err) == (flavour == "xyz")
    assert call("compare", line, line).status == 0


def test_a_line_given_back_as_plan_gives_the_line_again(call):
    first = reconstruct(call, "a.csv", "--wavelength", "0")
    second = reconstruct(call, "b.csv", "--wavelength", "0", plan=first)
    one, two = pd.read_csv(first), pd.read_csv(second)
    assert len(one) == len(two)
    assert two[["x_m", "y_m"]].to_numpy() == pytest.approx(one[["x_m", "y_m"]].to_numpy(), abs=2e-3)


def test_repeated_points_are_merged_with_a_note_on_stderr(call):
    rows = call.plan.read_text("utf-8").splitlines()
    call.plan.write_text("\n".join([*rows[:9], rows[8], *rows[9:], rows[-1]]) + "\n", "utf-8")
    said = call("segment", call.plan, "-o", call.path("s.csv"))
    assert said.status == 0
    assert said.err.startswith("note: ")
    assert "2 repeated points were left out" in said.err
    assert "note" not in said.out
