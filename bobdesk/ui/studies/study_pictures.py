"""What the pictures of a study show, worked out beside the window: of 100,000 rows that takes a second."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from bobdesk.track.study_pivot import FIGURES, Row, figures_in, varied
from bobdesk.ui.plots.chart import Chart
from bobdesk.ui.plots.heat_map import HeatMap
from bobdesk.ui.plots.study_drawings import chart, heat_map


@dataclass(frozen=True)
class PictureChoice:
    """What the user has chosen of the pictures.

    Attributes
    ----------
    is_heat_map
        Which of the two is shown.
    figure
        Of both.
    down, across, over
        Axes; "" where the user has not chosen, and what is varied is shown.
    """

    is_heat_map: bool
    figure: str
    down: str = ""
    across: str = ""
    over: str = ""


@dataclass(frozen=True, eq=False)
class StudyPicture:
    """A picture and what it shows.

    Attributes
    ----------
    choice
        With the axes that are shown.
    figures
        That any row has.
    drawing
        The one or the other.
    """

    choice: PictureChoice
    figures: tuple[str, ...]
    drawing: HeatMap | Chart


def study_picture(rows: Sequence[Row], choice: PictureChoice, *, title: str = "") -> StudyPicture:
    """Return the picture of some rows; a figure that none of them has gives way to one that they have."""
    there = figures_in(rows) or FIGURES
    choice = _with_axes(rows, choice)
    if choice.figure not in there:
        choice = replace(choice, figure=there[0])
    if not choice.is_heat_map:
        return StudyPicture(choice, there, chart(rows, choice.over, choice.figure, title=title))
    across = () if choice.across == choice.down else (choice.across,)
    return StudyPicture(choice, there, heat_map(rows, (choice.down,), across, choice.figure, title=title))


def _with_axes(rows: Sequence[Row], choice: PictureChoice) -> PictureChoice:
    if choice.down and choice.across and choice.over:
        return choice
    there = varied(rows)
    order = [axis for axis in ("segments", "plan", "known", "height_weight") if axis in there]
    down = order[0] if order else "segments"
    across = "method" if "method" in there else next((axis for axis in order if axis != down), "method")
    over = next((axis for axis in ("segments", "height_weight", "known", "plan") if axis in there), "segments")
    return replace(choice, down=choice.down or down, across=choice.across or across, over=choice.over or over)
