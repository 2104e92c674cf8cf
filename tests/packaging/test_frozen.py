"""The program is frozen, and what came of it tries itself out."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FREEZE = ROOT / "packaging" / "freeze"


def module(name):
    spec = importlib.util.spec_from_file_location(f"freeze_{name}", FREEZE / f"{name}.py")
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


freeze, runtime, contents = module("freeze"), module("runtime"), module("contents")


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    folder = tmp_path_factory.mktemp("frozen") / "Programme für Übung"
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, str(FREEZE / "freeze.py"), str(folder)],
        capture_output=True,
        text=True,
        check=False,
        env=environment,
        timeout=600,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "bobdesk"


def call(program, *arguments, cwd):
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")}
    environment |= {"QT_QPA_PLATFORM": "offscreen", "HOME": str(cwd), "OPENBLAS_NUM_THREADS": "1"}
    return subprocess.run(
        [str(program / "bobdesk"), *arguments],
        cwd=cwd,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=400,
    )


def test_the_frozen_program_passes_its_self_test_and_leaves_its_folder_as_it_was(program, tmp_path):
    before = freeze.digest(program)
    done = call(program, "selftest", "--report", "Bericht für Prüfer.json", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    report = json.loads((tmp_path / "Bericht für Prüfer.json").read_text(encoding="utf-8"))
    assert report["passed"] is True
    assert freeze.digest(program) == before


def test_what_travels_is_what_the_program_needs(program):
    inside = program / "_internal"
    carried = {runtime.normalised(folder.name.split("-")[0]) for folder in inside.glob("*.dist-info")}
    assert carried == set(runtime.runtime_distributions())
    names = [path.relative_to(inside).as_posix() for path in inside.rglob("*")]
    assert [name for name in names if re.search(r"(^|/)(tests?|pytest|PyInstaller|pandas)(/|$)", name)] == []
    assert [name for name in names if re.search(r"Qt6?(Qml|Quick|WebEngine|Designer|Sql)", name)] == []
    for wanted in ("resources/samples/mugello/mugello.bobdesk", "resources/licences/LGPL-3.0.txt"):
        assert wanted in names


def test_no_folder_of_the_machine_that_built_it_is_in_the_modules(program):
    content = (program / "bobdesk").read_bytes()
    assert str(ROOT).encode() not in content
    assert sys.prefix.encode() not in content


def test_a_command_works_without_a_window_and_says_the_version(program, tmp_path):
    from bobdesk import __version__

    done = call(program, "--version", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert __version__ in done.stdout


@pytest.mark.parametrize(
    ("path", "wanted"),
    [
        ("libstdc++.so.6", sys.platform != "linux"),
        ("libxkbcommon-x11.so.0", sys.platform != "linux"),
        ("libxcb-cursor.so.0", True),
        ("pillow.libs/libzstd-40ad5e7e.so.1.5.7", True),
        ("PySide6/Qt/plugins/platforms/libqxcb.so", True),
        ("PySide6/Qt/plugins/platforms/libqeglfs.so", False),
        ("PySide6/plugins/platforms/qwindows.dll", True),
        ("PySide6/plugins/platforms/qdirect2d.dll", False),
        ("PySide6/Qt/lib/libQt6Qml.so.6", False),
        ("PySide6/Qt/lib/libQt6Gui.so.6", True),
        ("PySide6\\Qt6Quick.dll", False),
        ("PySide6/opengl32sw.dll", False),
        ("PySide6/Qt/translations/qtbase_de.qm", True),
        ("PySide6/Qt/translations/designer_de.qm", False),
        ("scipy/optimize/tests/data.npy", False),
        ("resources/samples/mugello/plan.png", True),
    ],
)
def test_files_that_travel_and_files_that_do_not(path, wanted):
    assert contents.travels(path) is wanted


def test_what_the_tests_and_the_build_need_is_foreign():
    foreign = set(runtime.foreign_modules())
    assert {"pytest", "PyInstaller"} <= foreign
    assert not {"numpy", "PIL", "PySide6", "shiboken6", "ezdxf", "bobdesk"} & foreign
