"""The packages for Linux, as far as they can be proved without a root of their own: packaging/linux/test does that."""

import configparser
import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PIL import Image

import bobdesk
from bobdesk.cli.main import COMMANDS

ROOT = Path(__file__).parents[2]
LINUX = ROOT / "packaging" / "linux"


def module(name):
    spec = importlib.util.spec_from_file_location(f"linux_{name}", LINUX / f"{name}.py")
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


layout, build_deb, build_tarball = module("layout"), module("build_deb"), module("build_tarball")
identity = layout.identity
needs_debian = pytest.mark.skipif(
    not (shutil.which("dpkg-deb") and shutil.which("objdump")), reason="needs dpkg-deb and objdump"
)


@pytest.fixture(scope="module")
def usr(tmp_path_factory):
    folder = tmp_path_factory.mktemp("layout")
    layout.lay_out(folder)
    return folder


@pytest.fixture
def program(tmp_path):
    """A program as PyInstaller leaves it, but small."""
    made = tmp_path / "frozen" / "bobdesk"
    (made / "_internal" / "resources").mkdir(parents=True)
    shutil.copy("/bin/true", made / "bobdesk")
    (made / "_internal" / "base_library.zip").write_bytes(b"PK")
    (made / "_internal" / "resources" / "release-feed").write_text("https://somewhere\n", encoding="ascii")
    return made


@pytest.fixture(scope="module")
def notices(tmp_path_factory):
    folder = tmp_path_factory.mktemp("notices")
    build_deb.make_notices.make(folder, None)
    return folder


@pytest.fixture
def notices_at_hand(notices, monkeypatch):
    """Making them takes its time; test_notices looks at them."""

    def copied(folder, _program):
        shutil.copytree(notices, folder, dirs_exist_ok=True)

    monkeypatch.setattr(build_deb.make_notices, "make", copied)


def test_the_menu_entry_has_what_a_desktop_asks_for(usr):
    reader = configparser.ConfigParser(interpolation=None)
    reader.optionxform = str
    reader.read(usr / "share" / "applications" / f"{identity.APP_ID}.desktop", encoding="utf-8")
    entry = reader["Desktop Entry"]
    assert entry["Type"] == "Application"
    assert entry["Exec"] == "bobdesk %f"
    assert entry["Icon"] == identity.APP_ID
    assert entry["MimeType"] == "application/x-bobdesk;"
    assert entry["StartupWMClass"] == "BobDesk"
    assert all(entry[name].endswith(";") for name in ("Categories", "MimeType", "Keywords"))


def test_the_window_says_the_name_of_its_menu_entry(usr):
    text = (ROOT / "bobdesk" / "ui" / "application.py").read_text(encoding="utf-8")
    assert "setDesktopFileName(APPLICATION_ID)" in text
    assert (usr / "share" / "applications" / f"{bobdesk.APPLICATION_ID}.desktop").is_file()


def test_the_file_type_fits_what_projects_are(usr):
    from bobdesk.files.project_archive import begins_like_a_project

    tree = ElementTree.parse(usr / "share" / "mime" / "packages" / f"{identity.APP_ID}.xml")
    space = {"m": "http://www.freedesktop.org/standards/shared-mime-info"}
    of = tree.find("m:mime-type", space)
    assert of.get("type") == identity.MIME_TYPE
    assert of.find("m:glob", space).get("pattern") == "*.bobdesk"
    outer = of.find("m:magic/m:match", space)
    inner = outer.find("m:match", space)
    start = outer.get("value").encode().decode("unicode_escape").encode("latin-1")
    head = start.ljust(int(inner.get("offset")), b"\0") + inner.get("value").encode()
    assert begins_like_a_project(head)
    sample = (ROOT / "resources" / "samples" / "mugello" / "mugello.bobdesk").read_bytes()
    assert sample[: len(start)] == start
    assert sample[int(inner.get("offset")) :].startswith(inner.get("value").encode())


def test_the_catalogue_entry_names_program_version_and_file_type(usr):
    root = ElementTree.parse(usr / "share" / "metainfo" / f"{identity.APP_ID}.metainfo.xml").getroot()
    assert root.findtext("id") == identity.APP_ID
    assert root.findtext("launchable") == f"{identity.APP_ID}.desktop"
    assert root.findtext("provides/mediatype") == identity.MIME_TYPE
    assert root.find("releases/release").get("version") == bobdesk.__version__
    assert len(root.findtext("summary")) < 80


def test_icons_have_the_sizes_of_their_folders(usr):
    theme = usr / "share" / "icons" / "hicolor"
    pictures = list(theme.rglob("*.png"))
    assert {path.name for path in pictures} == {f"{identity.APP_ID}.png", "application-x-bobdesk.png"}
    for path in pictures:
        size = int(path.relative_to(theme).parts[0].split("x")[0])
        with Image.open(path) as picture:
            assert picture.size == (size, size)
            assert picture.mode == "RGBA"
    assert {16, 22, 24, 32, 48, 64, 128, 256} <= {int(path.parents[1].name.split("x")[0]) for path in pictures}


def test_icons_for_other_systems_hold_all_sizes(tmp_path):
    maker = ROOT / "packaging" / "icons" / "make_icons.py"
    subprocess.run([sys.executable, str(maker), str(tmp_path)], check=True)
    for name in ("bobdesk", "bobdesk-project"):
        with Image.open(tmp_path / f"{name}.ico") as picture:
            assert {(16, 16), (32, 32), (48, 48), (256, 256)} <= picture.info["sizes"]
        with Image.open(tmp_path / f"{name}.icns") as picture:
            assert (512, 512, 2) in picture.info["sizes"]


def test_the_manual_has_every_command_and_the_version():
    page = layout.manual()
    assert "@" not in page.replace("@NAME@", "")
    assert f"BobDesk {bobdesk.__version__}" in page
    assert all(f".B {name}\n" in page for name in COMMANDS)


def test_versions_are_equal_everywhere():
    assert bobdesk.__version__ == identity.VERSION
    said = subprocess.run(
        [sys.executable, str(ROOT / "packaging" / "identity.py"), "VERSION"], capture_output=True, text=True, check=True
    )
    assert said.stdout.strip() == bobdesk.__version__
    newest = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert newest[1] == bobdesk.__version__


def test_a_shell_reads_the_names():
    call = f'eval "$({sys.executable} {ROOT / "packaging" / "identity.py"})"; printf %s "$GENERIC_NAME"'
    said = subprocess.run(["sh", "-c", call], capture_output=True, text=True, check=True)
    assert said.stdout == identity.GENERIC_NAME


def test_every_accepted_word_of_lintian_has_its_reason():
    lines = (LINUX / "lintian-overrides").read_text(encoding="utf-8").splitlines()
    tags = [line for line in lines if line.startswith("bobdesk: ")]
    assert len(tags) == len(set(tags)) < 20
    for number, line in enumerate(lines):
        if line.startswith("bobdesk: "):
            above = next(other for other in reversed(lines[:number]) if not other.startswith("bobdesk: "))
            assert above.startswith("# "), line


@needs_debian
@pytest.mark.usefixtures("notices_at_hand")
def test_two_debian_packages_of_one_program_are_the_same_bytes(program, tmp_path):
    sums = set()
    for number in range(2):
        package = build_deb.build(program, tmp_path / str(number))
        sums.add(hashlib.sha256(package.read_bytes()).hexdigest())
    assert len(sums) == 1
    fields = subprocess.run(["dpkg-deb", "--field", str(package)], capture_output=True, text=True, check=True).stdout
    assert f"Version: {bobdesk.__version__}\n" in fields
    assert re.search(r"Depends: libc6 \(>= 2\.\d+\), .*libegl1", fields)
    unpacked = tmp_path / "unpacked"
    subprocess.run(["dpkg-deb", "--extract", str(package), str(unpacked)], check=True)
    assert (unpacked / "usr" / "bin" / "bobdesk").resolve() == unpacked / "usr" / "lib" / "bobdesk" / "bobdesk"
    assert os.access(unpacked / "usr" / "lib" / "bobdesk" / "bobdesk", os.X_OK)
    # Its versions come by the package manager.
    assert not list(unpacked.rglob("release-feed"))
    documents = unpacked / "usr" / "share" / "doc" / "bobdesk"
    assert {"copyright", "changelog.gz", "THIRD-PARTY-NOTICES.txt.gz", "bobdesk.cdx.json.gz"} == {
        path.name for path in documents.iterdir()
    }


@needs_debian
@pytest.mark.usefixtures("notices_at_hand")
def test_the_archive_installs_itself_anywhere_and_takes_itself_away(program, tmp_path):
    archive = build_tarball.build(program, tmp_path)
    assert archive.read_bytes() == build_tarball.build(program, tmp_path / "again").read_bytes()
    with tarfile.open(archive) as tar:
        tar.extractall(tmp_path, filter="data")
    top = tmp_path / archive.name.removesuffix(".tar.xz")
    prefix = tmp_path / "Programme & Übung" / "local"
    kept = prefix / "share" / "applications" / "other.desktop"
    kept.parent.mkdir(parents=True)
    kept.touch()
    # The second time over the first.
    for _ in range(2):
        subprocess.run([str(top / "install"), str(prefix)], check=True, capture_output=True)
    subprocess.run([str(prefix / "bin" / "bobdesk")], check=True)
    entry = (prefix / "share" / "applications" / f"{identity.APP_ID}.desktop").read_text(encoding="utf-8")
    assert f'Exec="{prefix}/lib/bobdesk/bobdesk" %f\n' in entry
    assert (prefix / "lib" / "bobdesk" / "licences" / "LGPL-3.0.txt").is_file()
    subprocess.run([str(top / "install"), "--remove", str(prefix)], check=True, capture_output=True)
    left = [path for path in prefix.rglob("*") if not path.is_dir() and "mime" not in path.parts]
    assert {path for path in left if path.name != "mimeinfo.cache"} == {kept}


def test_the_archive_does_not_install_over_what_is_not_its_own(program, tmp_path):
    top, prefix = tmp_path / "top", tmp_path / "prefix"
    shutil.copytree(program, top / "program")
    layout.lay_out(top)
    (top / "licences").mkdir()
    script = top / "install"
    script.write_text(identity.fill((LINUX / "install.in").read_text(encoding="utf-8")), encoding="utf-8")
    theirs = prefix / "lib" / "bobdesk" / "thesis.txt"
    theirs.parent.mkdir(parents=True)
    theirs.write_text("years of work", encoding="utf-8")
    done = subprocess.run(["sh", str(script), str(prefix)], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "something else" in done.stderr
    assert theirs.read_text(encoding="utf-8") == "years of work"


def test_an_appimage_wants_a_runtime_with_the_right_checksum(tmp_path):
    runtime = tmp_path / "runtime"
    runtime.write_bytes(b"not the one")
    environment = os.environ | {"RUNTIME": str(runtime), "RUNTIME_SHA256": "0" * 64}
    script = LINUX / "build-appimage"
    done = subprocess.run([str(script)], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "does not have the checksum" in done.stderr
