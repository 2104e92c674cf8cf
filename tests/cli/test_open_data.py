"""The error budget and the methods side by side, from the command line."""

import pandas as pd
import pytest

from tests.cli.calls import TARGETS


def test_the_error_budget_its_band_and_its_sentence(call):
    budget, band = call.path("b.csv"), call.path("s.csv")
    said = call(
        "reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), "--error-budget", budget, "--error-band", band,
        "--plan-error", "0.001",
    )  # fmt: skip
    assert said.status == 0, said.err
    table = pd.read_csv(budget).set_index("source")
    assert list(table.columns) == ["plan_length_m", "scale", "elevation_rms_m", "gradient_rms"]
    assert list(table.index)[-2:] == ["left open by the data", "all together"]
    assert table.loc["calibration", "scale"] == pytest.approx(0.00196)
    assert table.loc["rounding of the drop", "elevation_rms_m"] > 0.1
    rows = pd.read_csv(band)
    assert list(rows.columns) == ["station_m", "z_m", "z_error_m", "gradient", "gradient_error"]
    line = pd.read_csv(call.path("l.csv"))
    assert rows.z_m.to_numpy() == pytest.approx(line.z_m.to_numpy(), abs=1e-4)
    assert "With 95 % the plan length is" in said.out


def test_all_methods_side_by_side(call):
    table = call.path("m.csv")
    known = ("--known", "350:14")
    said = call("reconstruct", call.plan, *TARGETS, *known, "-o", call.path("l.csv"), "--second-opinions", table)
    assert said.status == 0, said.err
    rows = pd.read_csv(table).set_index("method")
    assert list(rows.index) == ["pgd", "published", "lbfgsb", "slsqp", "trustconstr", "de"]
    assert (rows.seconds > 0).all()
    assert (rows.evaluations > 0).all()
    assert rows.loc["pgd", "drop_percent"] == pytest.approx(0, abs=1e-6)
    assert rows.objective.notna().all()
    assert rows.loc["lbfgsb", "objective"] <= rows.loc["published", "objective"]


def test_a_method_is_judged_by_its_line_and_not_by_what_it_says_of_itself(call):
    table = call.path("m.csv")
    known = ("--known", "350:14")
    said = call("reconstruct", call.plan, *TARGETS, *known, "-o", call.path("l.csv"), "--second-opinions", table)
    rows = pd.read_csv(table, keep_default_na=False).set_index("method")
    assert rows.loc["lbfgsb", "message"].startswith("Convergence")
    assert rows.loc["lbfgsb", "status"] == "not met"
    assert rows.loc["lbfgsb", "missed"].endswith("known elevation at 350 m missed by 1.04 m")
    assert (rows.loc["pgd", "status"], rows.loc["pgd", "missed"]) == ("met", "")
    assert "the targets are met within 0.01 % by pgd, slsqp and trustconstr\n" in said.out
    assert f"lbfgsb does not meet them: {rows.loc['lbfgsb', 'missed']}\n" in said.out
    # Differential evolution has its small J from ups and downs.
    assert rows.loc["de", "objective"] < rows.loc["lbfgsb", "objective"]
    assert float(rows.loc["de", "drop_percent"]) < -5
    assert "the objective J counts rises like falls: it sees a height difference of 29.99 m where de has" in said.out
    assert "it does not show what is missed of them by published, lbfgsb and de\n" in said.out


def test_a_line_that_misses_targets_says_so_whatever_its_method_says(call):
    arguments = ("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), "--method")
    said = call(*arguments, "lbfgsb")
    assert "Convergence" in said.out
    assert "note: the line of the method lbfgsb does not meet the targets: drop 0.0365 % too large; length" in said.err
    assert "does not meet" not in call(*arguments, "pgd").err


def test_a_method_that_fails_is_a_row_with_its_reason(call):
    table = call.path("m.csv")
    said = call(
        "reconstruct", call.plan, *TARGETS, "--unknown-scale", "-o", call.path("l.csv"), "--second-opinions", table
    )
    assert said.status == 0, said.err
    rows = pd.read_csv(table).set_index("method")
    assert "cannot find an unknown scale" in rows.loc["slsqp", "message"]
    assert pd.isna(rows.loc["slsqp", "objective"])
    assert rows.loc["pgd", "objective"] >= 0


def test_the_budget_goes_with_pgd_alone(call):
    arguments = ("--method", "published", "--error-budget", call.path("b.csv"))
    sentence = call.refused("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), *arguments, status=2)
    assert "pgd alone" in sentence


@pytest.mark.parametrize("number", ["nan", "inf", "0", "-0.002"])
def test_a_change_of_gradient_that_is_no_limit_is_refused(call, number):
    asked = ("--envelope", call.path("e.csv"), "--gradient-change", number)
    sentence = call.refused("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), *asked, status=2)
    assert "more than 0 and at most 1 per metre" in sentence


@pytest.mark.parametrize("number", ["nan", "0.6", "-0.1"])
def test_a_plan_error_that_is_no_share_is_refused(call, number):
    asked = ("--error-budget", call.path("b.csv"), "--plan-error", number)
    sentence = call.refused("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), *asked, status=2)
    assert "between 0 and 0.5" in sentence


def test_advice_can_be_left_out(call):
    arguments = ("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), "--envelope", call.path("e.csv"))
    said = call(*arguments, "--no-advice")
    assert said.status == 0, said.err
    assert "help most" not in said.out
    assert call.path("e.csv").exists()
