import pytest

from tests.cli.calls import Caller


@pytest.fixture
def call(tmp_path, capsys):
    folder = tmp_path / "here"
    folder.mkdir()
    return Caller(folder, capsys)
