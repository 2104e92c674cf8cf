"""What can be proved of the release workflow without running it."""

import re
import subprocess
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
PATH = ROOT / ".github" / "workflows" / "release.yml"
TEXT = PATH.read_text(encoding="utf-8")
WORKFLOW = yaml.safe_load(TEXT)
JOBS = WORKFLOW["jobs"]


def steps():
    return [(job, step) for job in JOBS.values() for step in job["steps"]]


def test_every_action_is_pinned_to_a_commit_with_its_version_beside_it():
    used = re.findall(r"uses: (\S+)(.*)", TEXT)
    assert len(used) == sum("uses" in step for _, step in steps())
    for action, comment in used:
        assert re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40}", action)
        assert re.fullmatch(r" # v\d+\.\d+\.\d+", comment)


def test_nothing_may_be_written_but_the_draft_release():
    assert WORKFLOW["permissions"] == {}
    assert all("permissions" in job and "timeout-minutes" in job for job in JOBS.values())
    writers = {name for name, job in JOBS.items() if "write" in job["permissions"].values()}
    assert writers == {"release"}
    assert "--draft" in JOBS["release"]["steps"][-1]["run"]
    assert JOBS["release"]["if"] == "github.ref_type == 'tag'"
    assert "secrets." not in TEXT
    checkouts = [step for _, step in steps() if "actions/checkout" in step.get("uses", "")]
    assert all(step["with"]["persist-credentials"] is False for step in checkouts)


def test_nothing_is_released_that_was_not_tried_out_on_every_system():
    needed, pending = set(), ["release"]
    while pending:
        of = JOBS[pending.pop()].get("needs", [])
        pending += [of] if isinstance(of, str) else of
        needed |= {of} if isinstance(of, str) else set(of)
    assert needed == set(JOBS) - {"release"}
    for name in ("linux", "windows", "macos"):
        assert any("selftest" in step.get("run", "") for step in JOBS[name]["steps"]), name


def test_no_expression_is_put_into_a_script():
    assert all("${{" not in step.get("run", "") for _, step in steps())


@pytest.mark.parametrize(
    "script",
    [
        step["run"]
        for job, step in steps()
        if "run" in step and job.get("defaults", {}).get("run", {}).get("shell") != "pwsh"
    ],
)
def test_scripts_are_sound(script):
    subprocess.run(["bash", "-n"], input=script, text=True, check=True)


def test_what_is_called_is_there():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in re.findall(r"make ([a-z-]+)$", "\n".join(step.get("run", "") for _, step in steps()), re.MULTILINE):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target
    called = re.findall(r"\bpackaging/[\w./-]+", "\n".join(step.get("run", "") for _, step in steps()))
    assert called
    assert all((ROOT / path).is_file() for path in called)
