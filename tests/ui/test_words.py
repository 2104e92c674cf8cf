"""Every text on the screen can be translated: it is found by lupdate, under the name of its class."""

import ast
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

UI = Path(__file__).parent.parent.parent / "bobdesk" / "ui"
FILES = sorted(UI.rglob("*.py"))


def calls_of_tr():
    for path in FILES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "tr":
                yield path, node


def test_every_tr_has_a_literal():
    wrong = [
        f"{path.relative_to(UI)}:{node.lineno}"
        for path, node in calls_of_tr()
        if not (node.args and isinstance(node.args[0], ast.Constant) and isinstance(node.args[0].value, str))
    ]
    assert wrong == []


def test_nothing_else_is_called_tr():
    aliases = [
        f"{path.relative_to(UI)}:{node.lineno}"
        for path in FILES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "tr"
    ]
    assert aliases == []


def test_lupdate_finds_every_text_in_a_named_context(tmp_path):
    tool = Path(sys.executable).with_name("pyside6-lupdate")
    if not tool.exists():
        found = shutil.which("pyside6-lupdate")
        if found is None:
            pytest.skip("pyside6-lupdate is not installed")
        tool = Path(found)
    out = tmp_path / "bobdesk.ts"
    done = subprocess.run(
        [str(tool), *map(str, FILES), "-ts", str(out)], capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr
    contexts = ET.parse(out).getroot().findall("context")
    names = [context.findtext("name") for context in contexts]
    assert all(names)
    sources = {message.findtext("source") for context in contexts for message in context.findall("message")}
    assert "" not in sources
    missing = {node.args[0].value for _, node in calls_of_tr() if isinstance(node.args[0], ast.Constant)} - sources
    assert missing == set()
