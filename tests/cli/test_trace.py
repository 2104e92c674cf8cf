"""`bobdesk trace` on pictures whose line is known."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image

from bobdesk.cli.main import run

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "resources" / "samples" / "made_thin"
LOOP = ROOT / "tests" / "data" / "plans"


@pytest.fixture(scope="module")
def truth() -> dict[str, Any]:
    return json.loads((SAMPLE / "truth.json").read_text())


def columns(path: Path) -> dict[str, np.ndarray]:
    with path.open() as stream:
        rows = list(csv.DictReader(stream))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def clicks(truth: dict[str, Any]) -> list[str]:
    start, end = (f"{x:.0f},{y:.0f}" for x, y in (truth["start_px"], truth["end_px"]))
    return ["--start", start, "--end", end]


def test_two_clicks_give_the_line_in_metres(tmp_path: Path, truth: dict[str, Any]) -> None:
    plan, report = tmp_path / "plan.csv", tmp_path / "r.json"
    scale = truth["metres_per_pixel"]
    call = ["trace", str(SAMPLE / "plan.jpg"), "-o", str(plan), "--scale", str(scale), "--report", str(report)]
    assert run([*call, *clicks(truth)]) == 0

    traced = columns(plan)
    assert list(traced) == ["x_m", "y_m", "px", "py", "confidence"]
    assert (traced["x_m"][0], traced["y_m"][0]) == (0, 0)
    np.testing.assert_allclose(traced["x_m"], scale * (traced["px"] - traced["px"][0]), atol=1e-3)
    np.testing.assert_allclose(traced["y_m"], -scale * (traced["py"] - traced["py"][0]), atol=1e-3)

    drawn = columns(SAMPLE / "truth.csv")
    line = shapely.LineString(np.column_stack([traced["px"], traced["py"]]))
    apart = shapely.distance(line, shapely.points(drawn["px"], drawn["py"]))
    assert apart.mean() < 0.1
    assert apart.max() < 1.5

    found = json.loads(report.read_text())
    assert found["clicks"] == 2
    assert abs(found["plan_length_m"] - truth["plan_length_m"]) < 3 * found["plan_length_sigma_m"]
    assert found["confidence_mean"] > 0.9


def test_from_picture_to_segments_with_defaults(tmp_path: Path, truth: dict[str, Any]) -> None:
    plan, segments = tmp_path / "plan.csv", tmp_path / "segments.csv"
    call = ["trace", str(SAMPLE / "plan.jpg"), "-o", str(plan), "--scale", str(truth["metres_per_pixel"])]
    assert run([*call, *clicks(truth)]) == 0
    assert run(["segment", str(plan), "-o", str(segments)]) == 0
    with segments.open() as stream:
        found = [float(row["from_m"]) for row in csv.DictReader(stream)][1:]
    true = [segment["from_m"] for segment in truth["segments"]][1:]
    free = set(range(len(found)))
    hits = 0
    for boundary in true:
        near = min(free, key=lambda index: abs(found[index] - boundary), default=None)
        if near is not None and abs(found[near] - boundary) <= 5:
            free.discard(near)
            hits += 1
    assert 2 * hits / (len(found) + len(true)) >= 0.93


def test_a_mirrored_picture_swaps_left_and_right_only(tmp_path: Path, truth: dict[str, Any]) -> None:
    mirrored = tmp_path / "mirrored.png"
    picture = Image.open(SAMPLE / "plan.jpg")
    picture.transpose(Image.Transpose.FLIP_LEFT_RIGHT).save(mirrored)
    turned = dict(truth)
    for end in ("start_px", "end_px"):
        turned[end] = [picture.width - 1 - truth[end][0], truth[end][1]]
    turns = []
    for path, ends in ((SAMPLE / "plan.jpg", truth), (mirrored, turned)):
        plan, segments = tmp_path / "plan.csv", tmp_path / "segments.csv"
        assert run(["trace", str(path), "-o", str(plan), "--scale", "0.54", *clicks(ends)]) == 0
        assert run(["segment", str(plan), "-o", str(segments)]) == 0
        with segments.open() as stream:
            turns.append([float(row["turn_rad"]) for row in csv.DictReader(stream) if row["kind"] == "curve"])
    np.testing.assert_allclose(turns[0], -np.array(turns[1]), atol=0.05)


def test_points_on_the_way_lead_around_a_loop(tmp_path: Path) -> None:
    index = json.loads((LOOP / "index.json").read_text())
    plan = next(item for item in index if item["crosses_itself"] and (LOOP / item["file"]).exists())
    drawn = columns(LOOP / plan["truth"])
    (before, after), *_ = plan["crossing_stations_m"]
    rows = [round(before + share * (after - before)) for share in (1 / 3, 2 / 3)]
    via = [f"{drawn['px'][row]:.0f},{drawn['py'][row]:.0f}" for row in rows]
    output = tmp_path / "plan.csv"
    call = ["trace", str(LOOP / plan["file"]), "-o", str(output), "--scale", str(plan["metres_per_pixel"])]
    assert run([*call, *clicks(plan), "--via", *via]) == 0
    traced = columns(output)
    length = np.hypot(np.diff(traced["x_m"]), np.diff(traced["y_m"])).sum()
    assert abs(length - plan["plan_length_m"]) < 1.0


def test_a_world_file_gives_the_scale(tmp_path: Path, truth: dict[str, Any]) -> None:
    picture = tmp_path / "plan.jpg"
    picture.write_bytes((SAMPLE / "plan.jpg").read_bytes())
    (tmp_path / "plan.jgw").write_text("0.25\n0\n0\n-0.25\n600000\n5200000\n")
    output = tmp_path / "plan.csv"
    assert run(["trace", str(picture), "-o", str(output), *clicks(truth)]) == 0
    traced = columns(output)
    assert (traced["x_m"][0], traced["y_m"][0]) == (0, 0)
    np.testing.assert_allclose(traced["x_m"], 0.25 * (traced["px"] - traced["px"][0]), atol=1e-3)


def test_a_scale_that_is_given_goes_before_a_world_file_and_says_so(
    tmp_path: Path, truth: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "plan.jpg"
    picture.write_bytes((SAMPLE / "plan.jpg").read_bytes())
    (tmp_path / "plan.jgw").write_text("0.25\n0\n0\n-0.25\n600000\n5200000\n")
    output, report = tmp_path / "plan.csv", tmp_path / "r.json"
    call = ["trace", str(picture), "-o", str(output), "--scale", "0.5", "--report", str(report)]
    assert run([*call, *clicks(truth)]) == 0
    assert "world file or its tags, was not used" in capsys.readouterr().err
    found = json.loads(report.read_text())
    assert found["metres_per_pixel"] == 0.5
    assert any("was not used" in note for note in found["notes"])


def test_control_points_that_do_not_fit_together_are_a_warning(
    tmp_path: Path, truth: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    points = tmp_path / "p.points"
    rows = ["0,0,100,-900,1", "200,0,500,-900,1", "0,200,100,-500,1", "200,500,500,-500,1"]
    points.write_text("\n".join(["mapX,mapY,pixelX,pixelY,enable", *rows]))
    call = ["trace", str(SAMPLE / "plan.jpg"), "-o", str(tmp_path / "plan.csv"), "--points", str(points)]
    assert run([*call, *clicks(truth)]) == 0
    assert "warning: The control points do not fit together" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (["--end", "850,177"], 2, "--start"),
        (["--start", "97,1929", "--end", "850;177"], 2, "is no pixel"),
        (["--start", "97,1929", "--end", "85000,177"], 3, "outside"),
        (["--start", "97,1929", "--end", "850,177", "--scale", "-1"], 2, "--scale"),
        (["--start", "97,1929", "--end", "850,177", "--scale", "1e300"], 2, "between 1e-06 and 1e+06"),
        (["--start", "97,1929", "--end", "850,177", "--scale", "1e-300"], 2, "between 1e-06 and 1e+06"),
        (["--start", "97,1929", "--end", "850,177", "--scale", "nan"], 2, "--scale"),
        (["--start", "97,1929", "--end", "850,177", "--unknown-scale"], 2, "contradict"),
        (["--start", "97,1929", "--end", "97,1929"], 3, "same"),
    ],
)
def test_wrong_clicks_get_one_sentence(
    arguments: list[str], status: int, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "plan.csv"
    scale = [] if "--scale" in arguments else ["--scale", "0.5"]
    assert run(["trace", str(SAMPLE / "plan.jpg"), "-o", str(output), *scale, *arguments]) == status
    error = capsys.readouterr().err
    assert error.startswith("bobdesk: ")
    assert error.count("\n") == 1
    assert said in error
    assert not output.exists()


def test_a_picture_without_scale_asks_for_one(
    tmp_path: Path, truth: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "plan.csv"
    assert run(["trace", str(SAMPLE / "plan.jpg"), "-o", str(output), *clicks(truth)]) == 2
    assert "--scale" in capsys.readouterr().err
    assert not output.exists()


def test_the_demo_leaves_line_and_picture(tmp_path: Path) -> None:
    for name in ("packaging", "resources"):
        (tmp_path / name).symlink_to(ROOT / name)
    command = tmp_path / "bobdesk"
    command.write_text(f'#!/bin/sh\nPYTHONPATH="{ROOT}" exec "{sys.executable}" -m bobdesk "$@"\n')
    command.chmod(0o755)
    script = (ROOT / "packaging" / "demo").read_text().replace('cd "$(dirname "$0")/.."', f'cd "{tmp_path}"')
    done = subprocess.run(
        ["sh", "-c", script],
        env={**os.environ, "BOBDESK": str(command)},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "centreline.png").read_bytes().startswith(b"\x89PNG")
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["feasible"]
    assert abs(report["deviation_percent"]["length_m"]) < 1e-3
