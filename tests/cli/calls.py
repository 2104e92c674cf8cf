"""Call a command inside this process and look at what it says and leaves."""

import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest

from bobdesk.cli.main import run

MUGELLO = Path(__file__).parents[2] / "resources" / "samples" / "mugello" / "mugello.csv"
TARGETS = ("--length", "703", "--drop", "30")


@dataclass(frozen=True)
class Said:
    status: int
    out: str
    err: str


class Caller:
    """Runs commands in a folder of its own that holds a copy of the plan."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder = folder
        self.capsys = capsys
        self.plan = folder / "plan.csv"
        shutil.copyfile(MUGELLO, self.plan)

    def __call__(self, *arguments: object) -> Said:
        self.capsys.readouterr()
        status = run([str(argument) for argument in arguments])
        out, err = self.capsys.readouterr()
        return Said(status, out, err)

    def path(self, name: str) -> Path:
        return self.folder / name

    def refused(self, *arguments: object, status: int) -> str:
        """Expect one sentence, the status, nothing on stdout, and a folder that is as it was."""
        before = contents(self.folder)
        said = self(*arguments)
        assert said.status == status, said
        assert said.out == ""
        assert contents(self.folder) == before
        return one_sentence(said.err)


def one_sentence(err: str) -> str:
    assert err.startswith("bobdesk: "), err
    assert err.endswith((".\n", "?\n")), err
    assert not err.endswith(("..\n", "?.\n")), err
    assert err.count("\n") == 1, err
    assert "Traceback" not in err
    return err


def contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
