"""The OpenDRIVE file keeps the rules of the published schema, and the check of them finds what is wrong."""

from __future__ import annotations

import pytest

from bobdesk.files.exporters.formats import export_line
from bobdesk.plan.projection import Georeference
from bobdesk.project.derive_runs import run_line
from tests.files.exporters.exact_line import exact_line
from tests.files.exporters.opendrive_rules import faults
from tests.project.made_projects import full_project


@pytest.mark.parametrize("place", [None, Georeference(12.5, 46.25)])
@pytest.mark.parametrize("line", [exact_line(), exact_line(spacing=20)], ids=["1 m", "20 m"])
def test_a_road_keeps_the_schema(line, place):
    assert faults(export_line(line, format="xodr", georeference=place)) == []


def test_the_road_of_a_run_keeps_the_schema():
    assert faults(export_line(run_line(full_project().run), format="xodr")) == []


@pytest.mark.parametrize(
    ("good", "bad", "fault"),
    [
        (b' id="1"', b"", "lacks id"),
        (b' revMinor="6"', b' revMinor="six"', "revMinor='six'"),
        (b' pRange="arcLength"', b"", "lacks pRange"),
        (b' pRange="arcLength"', b' pRange="arclength"', "pRange='arclength'"),
        (b' s="0"', b' s="-1"', "s='-1'"),
        (b' hdg="', b' hdg="nan" was="', "hdg='nan'"),
        (b' hdg="', b' hdg="1,5" was="', "hdg='1,5'"),
        (b"<lanes>", b"<lanes/><lanes>", "holds 2 lanes"),
        (b"<elevationProfile>", b"<lateralProfile/><elevationProfile>", "in this order"),
        (b"<planView>", b"<planView>text", "holds text"),
        (b"<geometry", b"<geometrie/><geometry", "in this order"),
        (b"<paramPoly3", b"<line/><paramPoly3", "planView/geometry holds"),
        (b'type="driving"', b'type="racing"', "type='racing'"),
        (b'<lane id="-1"', b'<lane id="1"', "id='1'"),
        (b'aU="0"', b'aU="0.1"', "a cubic does not begin"),
        (b'<elevation s="0"', b'<elevation s="1"', "elevation does not ascend"),
        (b'<road name="centreline" length="1', b'<road name="centreline" length="2', "not as long as its pieces"),
        (b"<OpenDRIVE>", b'<OpenDRIVE kind="x">', "kind='x'"),
    ],
)
def test_what_breaks_the_schema_is_found(good, bad, fault):
    content = export_line(exact_line(spacing=20), format="xodr")
    assert good in content
    found = faults(content.replace(good, bad, 1))
    assert any(fault in each for each in found), found
