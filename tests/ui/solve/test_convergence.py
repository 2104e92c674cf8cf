from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt

from bobdesk.files.project_file import load_project, save_project
from bobdesk.project.record import COLUMNS
from bobdesk.ui.plots import convergence_data
from bobdesk.ui.plots.convergence import ConvergencePlot
from bobdesk.ui.plots.convergence_data import NOTHING, SERIES, ConvergenceData, extremes, logarithms
from bobdesk.ui.solve.convergence_part import ConvergencePart
from bobdesk.ui.widgets.panel import Panel
from tests.project.made_projects import full_project


@pytest.fixture
def inputs():
    return full_project().runs[0].inputs


def rows(objective):
    objective = np.asarray(objective, dtype=float)
    found = np.full((len(objective), len(COLUMNS)), np.nan)
    found[:, 0], found[:, 1], found[:, 2] = np.arange(len(objective)), 0, objective
    found[:, 3], found[:, 4], found[:, 7] = 100.0, 10.0, 1.0
    return found


def pixels_of(plot):
    image = plot.grab().toImage()
    buffer = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), image.bytesPerLine())
    return buffer[:, : 4 * image.width()].reshape(image.height(), image.width(), 4)[:, :, :3].copy()


@pytest.fixture(params=["grows", "as it is"], autouse=True)
def room(request, monkeypatch):
    """Most runs never fill the first room; here it is filled as well."""
    if request.param == "grows":
        monkeypatch.setattr(convergence_data, "_FIRST_ROOM", 128)


@pytest.mark.parametrize(
    "values",
    [[0.0, 0.0, 0.0], [1.0, 0.0, 1e-3], [-5.0, -1.0, -0.1], [1.0], [1e300, 1e-300, 0.0], [np.inf, 1.0, 0.1],
     [np.nan, 1.0, np.nan, 2.0]],
)  # fmt: skip
def test_a_curve_is_never_nothing(qtbot, inputs, values):
    plot = ConvergencePlot()
    qtbot.addWidget(plot)
    plot.resize(380, 190)
    plot.show_series(("objective",))
    data = ConvergenceData(inputs)
    data.add(rows(values))
    plot.show_series(())
    plot.show_data(data, ("published",), may_scrub=True)
    without = pixels_of(plot)
    plot.show_series(("objective",))
    assert (pixels_of(plot) != without).any()


def test_logarithms_of_nothing():
    found = logarithms(np.array([10.0, 0.0, -1.0, np.nan, np.inf]))
    assert found[:3].tolist() == [1.0, NOTHING, NOTHING]
    assert np.isnan(found[3])
    assert np.isposinf(found[4])


def test_thinning_keeps_every_spike():
    x = np.arange(100_000.0)
    y = np.sin(x / 500)
    y[12_345], y[77_777] = 9.0, -9.0
    thin_x, thin_y = extremes(x, y, 400)
    assert len(thin_x) <= 800
    assert thin_y.max() == 9.0
    assert thin_y.min() == -9.0


def test_data_grows_and_ends_at_the_last_iterate(inputs):
    data = ConvergenceData(inputs)
    whole = rows(np.geomspace(1, 1e-9, 5000))
    for start in range(0, 5000, 700):
        data.add(whole[start : start + 700])
    assert data.count == 5000
    assert data.values("objective")[-1] == whole[-1, 2]
    assert data.values("length")[0] == pytest.approx(100 * abs(inputs.targets.length - 100) / inputs.targets.length)
    assert set(SERIES) >= {"objective", "length", "drop", "optimality", "step", "scale"}


def test_however_many_iterates_are_drawn_from_blocks_as_from_all_of_them(inputs):
    objective = np.exp(np.random.default_rng(1).normal(size=40_000))
    objective[[100, 12_345, 39_999]] = 1e9, 0.0, 1e-9
    objective[20_000:20_200] = np.nan
    data = ConvergenceData(inputs)
    for start in range(0, 40_000, 777):
        data.add(rows(objective)[start : start + 777])
    for first, last in ((0, 40_000), (70, 39_000), (12_340, 12_350), (20_010, 20_100), (13, 39_999)):
        logs = logarithms(objective[first:last])
        drawn = logs[np.isfinite(logs) & (logs > NOTHING)]
        expected = (drawn.min(), drawn.max()) if len(drawn) else None
        assert data.range_of("objective", first, last) == expected
    for columns in (100, 400):
        x, y = data.curve("objective", 0, 40_000, columns)
        assert len(x) <= 2 * columns
        assert (np.diff(x) >= 0).all()
        assert np.nanmin(y) == NOTHING
        assert np.nanmax(y) == 9.0
        peak = x[np.nanargmax(y)]
        assert abs(peak - 100) <= 40_000 / columns + 64


def test_zoom_holds_and_double_click_follows(qtbot, inputs):
    plot = ConvergencePlot()
    qtbot.addWidget(plot)
    plot.resize(380, 190)
    data = ConvergenceData(inputs)
    data.add(rows(np.geomspace(1, 1e-9, 500)))
    plot.show_data(data, ("published",), may_scrub=True)
    plot.hold()
    assert not plot.follows
    qtbot.mouseDClick(plot, Qt.MouseButton.LeftButton, pos=QPoint(200, 90))
    assert plot.follows


def test_the_end_of_the_curve_is_the_reported_objective_and_iterates_can_be_seen(desk, opened, solving, idle, qtbot):
    panel = Panel(desk)
    qtbot.addWidget(panel)
    part = ConvergencePart(panel)
    solving.run()
    idle()
    run = desk.session.project.run
    assert part.plot.data.count == run.nit + 1
    assert part.plot.data.values("objective")[-1] == run.objective
    shown = part.shown
    idle()
    end = shown.line
    part.plot.chosen.emit(run.nit // 2)
    assert shown.scrubbed is not None
    assert shown.line is not end
    assert f"{int(run.iterates.numbers[shown.scrubbed]):,}" in part.reading.text()
    part.plot.setFocus()
    qtbot.keyClick(part.plot, Qt.Key.Key_End)
    assert shown.scrubbed is None


def test_iterates_of_a_run_from_a_file_are_shown_too(desk, opened, solving, idle, qtbot, tmp_path):
    solving.run()
    idle()
    save_project(desk.session.project, tmp_path / "run.bobdesk")
    desk.session.open(load_project(tmp_path / "run.bobdesk"), None)
    panel = Panel(desk)
    qtbot.addWidget(panel)
    part = ConvergencePart(panel)
    idle()
    run = desk.session.project.run
    end = part.shown.line
    part.plot.chosen.emit(run.nit // 2)
    line = part.shown.line
    assert line is not end
    number = int(run.iterates.numbers[part.shown.scrubbed])
    row = run.history[run.history[:, 0] == number][0]
    assert line.slope_lengths[-1] == pytest.approx(row[3], rel=1e-9)
    part.plot.chosen.emit(run.nit)
    assert part.shown.line is end


def test_a_run_of_an_older_file_shows_its_way_without_lines(desk, qtbot):
    project = full_project()
    desk.session.open(replace(project, runs=tuple(replace(run, iterates=None) for run in project.runs)), None)
    panel = Panel(desk)
    qtbot.addWidget(panel)
    part = ConvergencePart(panel)
    run = desk.session.project.run
    assert part.plot.data.count == len(run.history)
    part.plot.chosen.emit(3)
    assert part.plot.cursor_number == 3
    assert "not in its file" in part.reading.text()
