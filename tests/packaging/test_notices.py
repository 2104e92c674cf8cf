"""The notices of third parties and the bill of materials tell of what is in the packages, and of nothing else."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

ROOT = Path(__file__).parents[2]
NOTICES = ROOT / "packaging" / "notices"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("notices")
    subprocess.run([sys.executable, str(NOTICES / "make_notices.py"), str(folder)], check=True, timeout=120)
    return folder


@pytest.fixture(scope="module")
def needed():
    call = [sys.executable, str(ROOT / "packaging" / "freeze" / "runtime.py")]
    said = subprocess.run(call, capture_output=True, text=True, check=True).stdout
    return dict(line.split() for line in said.splitlines())


def same(name):
    return name.lower().replace("_", "-")


def test_every_work_is_told_of_with_its_version_and_its_licence(made, needed):
    text = (made / "THIRD-PARTY-NOTICES.txt").read_text(encoding="utf-8")
    table = text.partition("\nWork ")[2].partition("=====")[0]
    told = {same(line.split()[0]): line.split()[1] for line in table.splitlines()[1:] if line}
    for name, version in needed.items():
        assert told[name] == version
    for words in (
        "GNU Lesser General Public License",
        "https://code.qt.io",
        "PYTHON SOFTWARE FOUNDATION LICENSE",
        "Bootloader",
        "tiny-skia",
        "GEOS",
    ):
        assert words in text


def test_the_texts_of_the_gpl_and_the_lgpl_are_whole(made):
    assert "GNU LESSER GENERAL PUBLIC LICENSE" in (made / "LGPL-3.0.txt").read_text(encoding="utf-8")
    gpl = (made / "GPL-3.0.txt").read_text(encoding="utf-8")
    assert "TERMS AND CONDITIONS" in gpl
    assert "END OF TERMS AND CONDITIONS" in gpl


def test_the_bill_lists_what_is_needed_at_run_time_only(made, needed):
    bill = json.loads((made / "bobdesk.cdx.json").read_text(encoding="utf-8"))
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(json.dumps(bill)) is None
    packages = {same(part["name"]): part["version"] for part in bill["components"] if "purl" in part}
    assert packages == needed
    others = {part["name"] for part in bill["components"] if "purl" not in part}
    assert others == {"Python", "pyinstaller"}
    assert str(ROOT) not in json.dumps(bill)
    references = {part["bom-ref"] for part in bill["components"]}
    root = bill["metadata"]["component"]["bom-ref"]
    assert {entry["ref"] for entry in bill["dependencies"]} <= references | {root}
    assert all(set(entry.get("dependsOn", [])) <= references for entry in bill["dependencies"])
