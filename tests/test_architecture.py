"""What holds the house together: imports, the time to start, and the length of files."""

import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}


def python(*arguments, folder=ROOT, environment=ENVIRONMENT):
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip


@pytest.mark.parametrize("heavy", ["numpy", "scipy", "PySide6", "pyqtgraph", "PIL", "shapely"])
def test_the_group_of_commands_loads_nothing_heavy(heavy):
    done = python("-c", f"import sys, bobdesk.cli.main; sys.exit({heavy!r} in sys.modules)")
    assert done.returncode == 0, done.stderr


# What the window needs before it is painted for the first time; scipy alone takes longer than that may.
BEFORE_THE_FIRST_PAINT = [
    "bobdesk.project.project",
    "bobdesk.project.edits",
    "bobdesk.project.history",
    "bobdesk.project.steps",
    "bobdesk.project.derive",
    "bobdesk.project.derive_runs",
    "bobdesk.files.project_file",
    "bobdesk.files.recovery",
    "bobdesk.files.instance_lock",
    "bobdesk.files.importers.formats",
    "bobdesk.files.importers.preview",
    "bobdesk.files.exporters.formats",
    "bobdesk.files.pictures",
    "bobdesk.plan.image",
    "bobdesk.plan.calibration",
    "bobdesk.plan.calibration_fit",
    "bobdesk.plan.calibration_sentences",
    "bobdesk.plan.traced_line",
    "bobdesk.plan.trace_vertices",
    "bobdesk.alignment.fit_settings",
    "bobdesk.alignment.segmentation_settings",
    "bobdesk.solve.settings",
]


@pytest.mark.parametrize("module", BEFORE_THE_FIRST_PAINT)
def test_a_project_and_the_tables_of_formats_load_neither_scipy_nor_shapely(module):
    done = python("-c", f"import sys, {module}; sys.exit(not {{'scipy', 'shapely'}}.isdisjoint(sys.modules))")
    assert done.returncode == 0, done.stderr


def test_an_empty_project_is_shown_without_scipy():
    code = """
import sys
from bobdesk.files.exporters.formats import export_formats
from bobdesk.files.importers.formats import import_formats
from bobdesk.project import derive, edits
from bobdesk.project.project import Project
from bobdesk.project.steps import steps

project = edits.set_length(Project(), 1300.0)
assert import_formats().formats
assert export_formats().formats
assert len(steps(project)) == 6
assert derive.run_inputs(project).value is None
sys.exit(not {'scipy', 'shapely'}.isdisjoint(sys.modules))
"""
    done = python("-c", code)
    assert done.returncode == 0, done.stderr


def test_no_command_but_a_picture_loads_qt():
    modules = "segment, check, reconstruct, compare, study, published".replace(", ", ", bobdesk.cli.")
    code = f"import sys, bobdesk.cli.{modules}; sys.exit('PySide6' in sys.modules or 'pyqtgraph' in sys.modules)"
    done = python("-c", code)
    assert done.returncode == 0, done.stderr


def test_help_takes_under_a_third_of_a_second():
    seconds = []
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        assert python("-m", "bobdesk", "--help").returncode == 0
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    assert min(seconds) < 0.3


def test_no_file_is_longer_than_400_lines():
    files = list((ROOT / "bobdesk").rglob("*.py"))
    assert len(files) > 50
    long = {str(path.relative_to(ROOT)): count for path in files if (count := lines_of(path)) > 400}
    assert long == {}


def lines_of(path: Path) -> int:
    return len(path.read_text("utf-8").splitlines())


OFFENCES = {
    "Dependencies run one way": ("bobdesk/plan/polyline.py", "import bobdesk.alignment.segments"),
    "Qt and pyqtgraph live in ui alone": ("bobdesk/files/atomic.py", "import PySide6"),
    "The calculation never logs, reads a clock": ("bobdesk/solve/targets.py", "import time"),
}


def lint(folder):
    """Run import-linter on the package in a folder."""
    code = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    return python("-c", code, "--no-cache", folder=folder, environment={**ENVIRONMENT, "PYTHONPATH": str(folder)})


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    folder = tmp_path_factory.mktemp("copy")
    shutil.copytree(ROOT / "bobdesk", folder / "bobdesk", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copyfile(ROOT / "pyproject.toml", folder / "pyproject.toml")
    return folder


def test_the_contracts_are_kept(package):
    done = lint(package)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{len(OFFENCES)} kept, 0 broken" in done.stdout


@pytest.mark.parametrize("contract", OFFENCES)
def test_each_contract_fails_when_it_is_broken(package, contract):
    name, offence = OFFENCES[contract]
    path = package / name
    text = path.read_text("utf-8")
    path.write_text(text + f"\n{offence}\n", "utf-8")
    try:
        done = lint(package)
    finally:
        path.write_text(text, "utf-8")
    assert done.returncode != 0
    assert "1 broken" in done.stdout
    broken = [line for line in done.stdout.splitlines() if "BROKEN" in line]
    assert contract[:30] in " ".join(done.stdout[: done.stdout.index("BROKEN")].splitlines()[-2:] + broken)
