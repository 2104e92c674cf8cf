"""The names that scripts outside the project rely on."""

import itertools
import json
import math

import numpy as np
import pandas as pd
import pytest

from tests.cli.calls import TARGETS

LINE = [
    "station_m",
    "s_m",
    "x_m",
    "y_m",
    "z_m",
    "heading_rad",
    "gradient",
    "curvature_plan_per_m",
    "curvature_per_m",
    "segment",
    "kind",
]


@pytest.fixture
def results(call):
    names = {"--report": "r.json", "--envelope": "e.csv"}
    options = itertools.chain.from_iterable((option, call.path(name)) for option, name in names.items())
    said = call("reconstruct", call.plan, "-o", call.path("line.csv"), *TARGETS, "--mean-gradient", "0.0427", *options)
    assert said.status == 0, said
    assert said.err == ""
    return call


def test_the_columns_of_line_csv(results):
    table = pd.read_csv(results.path("line.csv"))
    assert list(table.columns) == LINE
    assert set(table.kind) == {"straight", "curve"}
    assert table.station_m.iloc[0] == 0
    assert (np.diff(table.station_m) > 0).all()
    assert (np.diff(table.segment) >= 0).all()
    assert set(np.diff(table.segment)) <= {0, 1}
    assert table.z_m.min() == 0
    assert table.z_m.iloc[0] == 30


def test_the_columns_of_the_envelope_and_that_it_holds_the_line(results):
    band = pd.read_csv(results.path("e.csv"))
    assert list(band.columns) == ["station_m", "z_min_m", "z_max_m"]
    line = pd.read_csv(results.path("line.csv"))
    assert (line.z_m >= band.z_min_m - 2e-6).all()
    assert (line.z_m <= band.z_max_m + 2e-6).all()


def test_the_columns_of_segments_csv(call):
    assert call("segment", call.plan, "-o", call.path("s.csv")).status == 0
    table = pd.read_csv(call.path("s.csv"))
    assert list(table.columns) == ["segment", "kind", "from_m", "to_m", "radius_m", "turn_rad"]
    assert list(table.segment) == list(range(1, len(table) + 1))
    assert (table.from_m[1:].to_numpy() == table.to_m[:-1].to_numpy()).all()
    assert table.radius_m[table.kind == "straight"].isna().all()
    assert (table.radius_m[table.kind == "curve"] > 0).all()


def test_the_keys_of_the_report(results):
    report = json.loads(results.path("r.json").read_text("utf-8"))
    assert {"length_m", "drop_m", "mean_gradient"} <= set(report["targets"])
    assert set(report["achieved"]) == {
        "length_m",
        "drop_m",
        "mean_gradient_drop_per_length",
        "mean_gradient_drop_per_plan",
        "mean_gradient_segments",
        "max_gradient",
        "min_gradient",
        "mean_curvature_difference_per_m",
    }
    assert set(report) >= {
        "targets",
        "achieved",
        "deviation_percent",
        "scale",
        "plan_length_m",
        "feasible",
        "feasibility",
        "reachable_length_m",
        "method",
        "iterations",
        "evaluations",
        "seconds",
        "status",
        "objective",
        "optimality",
        "segments",
    }
    assert report["feasible"] is True
    low, high = report["reachable_length_m"]
    assert low < 703 < high
    for segment in report["segments"]:
        assert set(segment) == {"kind", "from_m", "to_m", "gradient", "radius_m"}


def test_the_report_is_recomputed_from_the_written_rows(results):
    table = pd.read_csv(results.path("line.csv"))
    report = json.loads(results.path("r.json").read_text("utf-8"))
    achieved = report["achieved"]
    points = table[["x_m", "y_m", "z_m"]].to_numpy()
    length = math.fsum(np.linalg.norm(np.diff(points, axis=0), axis=1))
    plan = math.fsum(np.hypot(*np.diff(points[:, :2], axis=0).T))
    drop = points[0, 2] - points[:, 2].min()
    assert achieved["length_m"] == pytest.approx(length, rel=1e-9)
    assert achieved["drop_m"] == pytest.approx(drop, abs=1e-9)
    assert achieved["mean_gradient_drop_per_length"] == pytest.approx(drop / length, rel=1e-9)
    assert achieved["mean_gradient_drop_per_plan"] == pytest.approx(drop / plan, rel=1e-9)
    # Gradients are written to nine places.
    assert achieved["max_gradient"] == pytest.approx(table.gradient.max(), abs=6e-10)
    assert achieved["min_gradient"] == pytest.approx(table.gradient.min(), abs=6e-10)
    difference = (table.curvature_plan_per_m.abs() - table.curvature_per_m.abs()).abs().mean()
    assert achieved["mean_curvature_difference_per_m"] == pytest.approx(difference, abs=2e-9)
    gradients = [
        -np.diff(np.interp([part["from_m"], part["to_m"]], table.station_m, table.z_m))[0]
        / (part["to_m"] - part["from_m"])
        for part in report["segments"]
    ]
    # A metre of elevation is written to six places, the shortest segment is a few metres long.
    assert [part["gradient"] for part in report["segments"]] == pytest.approx(gradients, abs=1e-6)
    assert achieved["mean_gradient_segments"] == pytest.approx(np.mean(gradients), abs=1e-6)
    assert report["deviation_percent"]["length_m"] == pytest.approx(100 * (length / 703 - 1), abs=1e-9)
    assert report["deviation_percent"]["mean_gradient"] == pytest.approx(100 * (drop / length / 0.0427 - 1), abs=1e-6)


@pytest.mark.parametrize(
    "options",
    [
        ("--known", "100:26", "--known", "200:20"),
        ("--known", "100:26", "200:20:0.5"),
        ("--min-gradient", "-0.05", "--max-gradient", "0.2", "--mean-gradient", "0.05"),
        ("--mean-gradient", "0.05", "--mean-gradient-is", "segments", "--spacing", "5", "--count", "3"),
        ("--mean-gradient", "0.0427", "--mean-gradient-is", "drop-per-plan", "--count", "5", "--threshold", "0.004"),
        ("--unknown-scale", "--count", "5"),
        ("--strict", "--threshold", "0.004"),
    ],
)
def test_options_of_check_and_reconstruct_agree(call, options):
    said = call("check", call.plan, *TARGETS, *options, "--report", call.path("check.json"))
    assert (said.status, said.err) == (0, "")
    again = call(
        "reconstruct", call.plan, *TARGETS, *options, "--report", call.path("r.json"), "-o", call.path("line.csv")
    )
    assert again.status == 0, again
    checked, reached = (json.loads(call.path(name).read_text("utf-8")) for name in ("check.json", "r.json"))
    assert checked["feasible"] is True
    for key, value in checked.items():
        if key != "scale":
            assert reached[key] == value, key
    assert reached["achieved"]["length_m"] == pytest.approx(703, abs=1e-3)
    assert reached["achieved"]["drop_m"] == pytest.approx(30, abs=1e-6)


def test_known_elevations_are_met_by_the_written_rows(call):
    call("reconstruct", call.plan, *TARGETS, "-o", call.path("line.csv"), "--known", "100:26", "400:12")
    table = pd.read_csv(call.path("line.csv"))
    assert np.interp([100, 400], table.station_m, table.z_m) == pytest.approx([26, 12], abs=1e-6)


@pytest.mark.parametrize("method", ["pgd", "published", "lbfgsb", "slsqp", "trustconstr", "de"])
def test_every_method_with_weights_writes_a_whole_line(call, method):
    weights = ("--weight-length", 2, "--weight-height", 2, "--weight-curvature", 0, "--weight-gradient", 0.5)
    said = call(
        "reconstruct", call.plan, *TARGETS, "--method", method, *weights, "-o", call.path("line.csv"),
        "--report", call.path("r.json"), "--count", 3,
    )  # fmt: skip
    assert said.status == 0
    assert ("the method pgd has none" in said.err) == (method == "pgd")
    assert json.loads(call.path("r.json").read_text("utf-8"))["method"] == method
    assert np.isfinite(pd.read_csv(call.path("line.csv")).drop(columns="kind").to_numpy()).all()


@pytest.mark.parametrize("method", ["published", "lbfgsb", "de"])
def test_a_method_that_leaves_known_elevations_out_says_so_on_stderr(call, method):
    said = call(
        "reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), "--known", "200:20", "--method", method
    )  # fmt: skip
    assert said.status == 0
    assert said.err.startswith("note: ")
    assert "known elevations" in said.err


def test_smoothest_and_no_transition_act(call):
    lines = {}
    for option in ("--meet-length", "--smoothest"):
        call("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), option, "--transition", "0")
        lines[option] = pd.read_csv(call.path("l.csv"))
    assert lines["--meet-length"].s_m.iloc[-1] == pytest.approx(703, abs=1e-3)
    roughness = {name: line.gradient.diff().abs().sum() for name, line in lines.items()}
    assert roughness["--smoothest"] < 0.2 * roughness["--meet-length"]
    assert lines["--smoothest"].s_m.iloc[-1] < 702.8


def test_the_scale_is_found_on_a_plan_drawn_at_half_size(call):
    table = pd.read_csv(call.plan)
    table[["x_m", "y_m"]] /= 2
    table.to_csv(call.path("half.csv"), index=False)
    said = call(
        "reconstruct", call.path("half.csv"), *TARGETS, "--unknown-scale", "-o", call.path("l.csv"),
        "--report", call.path("r.json"),
    )  # fmt: skip
    assert said.status == 0
    report = json.loads(call.path("r.json").read_text("utf-8"))
    assert report["scale"] == pytest.approx(2, rel=2e-3)
    line = pd.read_csv(call.path("l.csv"))
    assert line.s_m.iloc[-1] == pytest.approx(703, abs=1e-3)
    assert report["plan_length_m"] * report["scale"] == pytest.approx(line.station_m.iloc[-1], rel=1e-9)


def test_level_out_lets_the_gradient_die_out_before_the_end(call):
    ends = []
    for level_out in (0, 30):
        said = call(
            "reconstruct", call.plan, *TARGETS, "--smoothest", "--level-out", level_out, "-o", call.path("l.csv")
        )  # fmt: skip
        assert said.status == 0
        ends.append(pd.read_csv(call.path("l.csv")).gradient.iloc[-1])
    assert ends[1] < 0.7 * ends[0]
    call.refused(
        "reconstruct", call.plan, *TARGETS, "--level-out", -1, "-o", call.path("m.csv"), status=2
    )  # fmt: skip


def test_a_bounded_change_of_gradient_narrows_the_envelope(call, results):
    wide = pd.read_csv(results.path("e.csv"))
    said = call(
        "reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), "--envelope", call.path("e.csv"),
        "--gradient-change", "0.001",
    )  # fmt: skip
    assert said.status == 0, said.err
    tight = pd.read_csv(call.path("e.csv"))
    assert (tight.z_max_m - tight.z_min_m).mean() < (wide.z_max_m - wide.z_min_m).mean()


def test_the_report_says_where_one_more_known_elevation_helps_most(results):
    advice = json.loads(results.path("r.json").read_text("utf-8"))["next_known_elevation"]
    assert 100 < advice["station"] < 600
    assert 0 < advice["envelope_mean_width_with_it_m"] < 0.8 * advice["envelope_mean_width_m"]
