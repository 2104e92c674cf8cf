"""The paper's tables made again."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tests.alignment.made_lines import made_plan

ROOT = Path(__file__).parents[2]


@pytest.fixture
def table(call):
    said = call("published", "-o", call.path("t.csv"))
    assert said.status == 0, said.err
    assert "coordinates are not public" in said.out
    return pd.read_csv(call.path("t.csv")), said.out


def test_every_row_of_the_paper_is_there_and_ours_meet_what_can_be_met(table):
    rows, said = table
    source = json.loads((ROOT / "resources" / "published" / "tables.json").read_text("utf-8"))
    counts = [len(source["table_1"]), len(source["table_2_scaled_90_percent"])]
    counts += [sum(len(each) for each in source[name].values()) for name in ("by_segment_count", "by_height_weight_b")]
    assert list(rows.table.value_counts(sort=False)) == counts
    assert (rows.pgd_drop_percent == 0).all()
    assert (rows.pgd_mean_gradient_percent == 0).all()
    assert (rows.pgd_length_percent.abs() <= rows.paper_length_percent.abs()).all()
    # A plan without a scale leaves nothing that could not be met.
    assert (rows.pgd_length_percent[rows.scale_unknown == "yes"] == 0).all()
    # The paper's own deviations, as it states them.
    first = rows[(rows.table == "table 1") & (rows.track == "Whistler")].iloc[0]
    assert (first.paper_length_percent, first.paper_drop_percent) == (0.681, -0.402)
    assert "Whistler, 33 segments, pgd: Converged, but the length cannot be met" in said


def test_a_real_plan_takes_the_place_of_a_stand_in(call):
    points = made_plan(4, curves=16)
    np.savetxt(call.path("w.csv"), points, delimiter=",", header="x_m,y_m", comments="")
    said = call("published", "--plan", f"whistler={call.path('w.csv')}", "-o", call.path("t.csv"))
    assert said.status == 0, said.err
    rows = pd.read_csv(call.path("t.csv"))
    length = np.hypot(*np.diff(points, axis=0).T).sum()
    used = rows[(rows.track == "Whistler") & (rows.table == "table 1")].plan_length_m.iloc[0]
    assert used == pytest.approx(length, rel=0.002)
    assert rows[rows.track == "Cesana"].plan_length_m.min() > 1300


def test_a_plan_of_no_known_track_is_refused(call):
    assert "NAME=FILE with a name of Whistler" in call.refused("published", "--plan", "Oslo=x.csv", status=2)
    assert "no such file" in call.refused("published", "--plan", "Cesana=x.csv", status=3).lower()
