"""The known elevations of the finished samples are those of their actual tracks."""

from pathlib import Path

import numpy as np
import pytest

from bobdesk.files.project_file import load_project

SAMPLES = Path(__file__).parents[2] / "resources" / "samples"


@pytest.mark.parametrize("path", sorted(SAMPLES.glob("*/*.bobdesk")), ids=lambda path: path.stem)
def test_they_lie_on_the_actual_track(path):
    project = load_project(path)
    points = project.actual.points
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points[:, :2], axis=0).T))])
    # Cortina's track climbs to its end: its lowest point and its end are known as well.
    assert len(project.known_elevations) == (5 if path.stem == "cortina_2026_design" else 3)
    for known in project.known_elevations:
        expected = np.interp(known.station, along, points[:, 2]) - points[:, 2].min()
        # Stations are rounded to a metre in some, where the track falls by up to 22 % of it.
        assert known.elevation == pytest.approx(expected, abs=0.25)


def test_the_demo_gives_true_elevations():
    table = np.genfromtxt(SAMPLES / "mugello" / "mugello.csv", delimiter=",", names=True)
    text = (SAMPLES.parents[1] / "packaging" / "demo").read_text("utf-8")
    given = text.split("--known ")[1].split("\\")[0].split()
    assert len(given) == 3
    for pair in given:
        station, elevation = map(float, pair.split(":"))
        expected = np.interp(station, table["s2d_m"], table["z_m"]) - table["z_m"].min()
        assert elevation == pytest.approx(expected, abs=0.02)
