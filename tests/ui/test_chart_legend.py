"""The legends of charts: whole names beside the curves or below them, and how many are left out."""

import re
from html import unescape

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF
from PySide6.QtGui import QFontMetricsF

from bobdesk.track.study import STUDY_COLUMNS
from bobdesk.ui.plots.chart import Chart, Series, draw_chart, size_with_legend
from bobdesk.ui.plots.legend import MOST_NAMED, PLOT_HEIGHT, legend_of, wrapped
from bobdesk.ui.plots.study_picture import draw_study, picture_bytes, picture_font

LONG = "a plan of some track, {} segments, b = 0.5, published, known 250:98.5 600:40"


@pytest.fixture
def metrics(qapp):
    return QFontMetricsF(picture_font())


def chart_of(names):
    x = np.arange(4.0)
    return Chart("", "x", "y", tuple(Series(name, x, x + number, number) for number, name in enumerate(names)))


def words_of(legend):
    return [" ".join(lines) for _, lines in legend.names]


@pytest.mark.parametrize("width", [40.0, 90.0, 200.0, 900.0])
def test_a_wrapped_name_loses_nothing_and_fits(metrics, width):
    name = f"{LONG.format(12)}, {'x' * 60}"
    lines = wrapped(name, metrics, width)
    assert "".join(lines).replace(" ", "") == name.replace(" ", "")
    assert max(map(metrics.horizontalAdvance, lines)) <= width
    assert len(lines) > 1 or width == 900.0


def test_a_name_is_parted_at_its_commas_first(metrics):
    width = metrics.horizontalAdvance("made, 12 segments, b =") + 1
    assert wrapped("made, 12 segments, b = 0.5", metrics, width) == ("made, 12 segments,", "b = 0.5")


def test_short_names_stand_beside_the_curves(metrics):
    legend = legend_of(["pgd", "published", "slsqp"], metrics, QSizeF(800, 300))
    assert not legend.is_below
    assert words_of(legend) == ["pgd", "published", "slsqp"]
    assert legend.more == 0
    at, rest = legend.beside(QRectF(0, 0, 800, 300))
    assert rest.right() < at.x()
    assert legend_of(["pgd"], metrics, QSizeF(800, 300)) is None


@pytest.mark.parametrize("count", [3, 12, 24])
@pytest.mark.parametrize("width", [300, 760, 1400])
def test_names_lie_in_their_area_and_not_over_each_other(metrics, count, width):
    names = [LONG.format(number) for number in range(count)]
    area = QRectF(0, 0, width, 600)
    legend = legend_of(names, metrics, area.size())
    assert words_of(legend) == names[: len(legend.names)]
    assert len(legend.names) + legend.more == count
    at, rest = legend.beside(area)
    boxes = []
    for corner, lines in legend.names:
        wide = 28 + 16 + max(map(metrics.horizontalAdvance, lines))
        boxes.append(QRectF(at + corner, QSizeF(wide, metrics.height() * len(lines))))
    for number, box in enumerate(boxes):
        assert area.contains(box)
        assert not rest.intersects(box)
        assert not any(box.intersects(other) for other in boxes[:number])
    assert rest.height() >= min(PLOT_HEIGHT, 0.5 * area.height())


def test_what_does_not_fit_is_counted(metrics):
    names = [LONG.format(number) for number in range(30)]
    legend = legend_of(names, metrics, QSizeF(300, 200))
    assert legend.more == 30 - len(legend.names) > 0
    assert f"and {legend.more} more" in texts_of(chart_of(names), QSize(316, 216))


def test_a_saved_chart_grows_until_all_names_are_there(metrics):
    names = [LONG.format(number) for number in range(24)]
    size = size_with_legend(chart_of(names), picture_font(), QSize(760, 300))
    assert size.width() == 760
    legend = legend_of(names, metrics, QSizeF(size.width() - 16, size.height() - 16))
    assert legend.is_below
    assert size.height() == pytest.approx(300 + legend.size.height(), abs=10)
    said = texts_of(chart_of(names), size)
    assert all(name.replace(" ", "") in said.replace(" ", "") for name in names)
    assert "more" not in said
    assert "…" not in said
    assert size_with_legend(chart_of(["a", "b"]), picture_font(), QSize(760, 300)) == QSize(760, 300)


def test_only_as_many_are_named_as_can_be_told_apart(metrics):
    names = [f"n{number}" for number in range(60)]
    chart = chart_of(names)
    said = texts_of(chart, size_with_legend(chart, picture_font(), QSize(760, 300)))
    assert f"n{MOST_NAMED - 1} " in f"{said} "
    assert "and 20 more" in said


def test_the_picture_of_a_study_has_every_name_whole(qapp):
    rows = []
    for count in ("1", "2"):
        for plan in range(13):
            cells = dict.fromkeys(STUDY_COLUMNS, "")
            cells |= {"plan": f"a plan with quite a long name of its own, {plan}", "wanted_segments": count}
            cells |= {"segments": count, "method": "pgd", "length_percent": f"0.{plan}{count}", "status": "met"}
            rows.append(tuple(cells.values()))
    said = read_texts(draw_study(rows, kind=".svg"))
    for plan in range(13):
        assert f"aplanwithquitealongnameofitsown,{plan}" in said.replace(" ", "")
    assert "1 segment" in said
    assert "1 segments" not in said
    assert "…" not in said


def texts_of(chart, size):
    def draw(painter):
        draw_chart(painter, QRectF(QPointF(0, 0), QSizeF(size)), chart)

    return read_texts(picture_bytes(draw, size, ".svg"))


def read_texts(svg):
    return " ".join(unescape(text).strip() for text in re.findall(r"<text[^>]*>([^<]*)</text>", svg.decode()))
