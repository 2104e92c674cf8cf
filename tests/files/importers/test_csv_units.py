"""Tables in other units than metres, when a person says so."""

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.files.importers.csv_points import CsvChoice, line_of_csv
from bobdesk.plan.projection import to_degrees

TABLE = b"x,y,z\n0,0,100\n1000,0,90\n2000,500,80\n"


@pytest.mark.parametrize(
    ("unit", "factor"), [("metres", 1.0), ("millimetres", 0.001), ("feet", 0.3048), ("US survey feet", 0.3048006096)]
)
def test_plan_and_elevations_become_metres(unit, factor):
    line = line_of_csv(TABLE, name="a.csv", choice=CsvChoice(unit=unit))
    np.testing.assert_allclose(line.polyline.vertices[-1], [2000 * factor, 500 * factor], rtol=1e-9)
    np.testing.assert_allclose(line.elevations, np.array([100, 90, 80]) * factor, rtol=1e-9)


def test_degrees_go_to_metres_and_back():
    text = b"name,lat,lon\na,46.5,12.1\nb,46.501,12.1\nc,46.502,12.102\n"
    line = line_of_csv(text, name="a.csv", choice=CsvChoice(columns=(2, 1, None), unit="degrees"))
    assert line.georeference is not None
    np.testing.assert_allclose(
        to_degrees(line.polyline.vertices, line.georeference), [[12.1, 46.5], [12.1, 46.501], [12.102, 46.502]]
    )


def test_degrees_across_the_date_line_stay_together():
    text = b"x,y\n179.999,10\n-179.999,10\n-179.998,10.001\n"
    line = line_of_csv(text, name="a.csv", choice=CsvChoice(unit="degrees"))
    assert np.ptp(line.polyline.vertices[:, 0]) < 400


@pytest.mark.parametrize(
    ("rows", "words"), [("500,0\n501,0\n502,1", "out of its range"), ("0,0\n0,30\n1,31", "kilometres apart")]
)
def test_degrees_that_are_none_are_refused(rows, words):
    with pytest.raises(InputError, match=words):
        line_of_csv(f"x,y\n{rows}\n".encode(), name="a.csv", choice=CsvChoice(unit="degrees"))
