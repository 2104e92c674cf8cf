"""What can be proved of the Mac's package without a Mac."""

import importlib.util
import json
import os
import plistlib
import re
import subprocess
import sys
import types
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MACOS = ROOT / "packaging" / "macos"


def module(name):
    spec = importlib.util.spec_from_file_location(f"macos_{name}", MACOS / f"{name}.py")
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


bundle = module("bundle")
identity = bundle.identity


@pytest.fixture(scope="module")
def icons(tmp_path_factory):
    folder = tmp_path_factory.mktemp("icons")
    subprocess.run([sys.executable, str(ROOT / "packaging" / "icons" / "make_icons.py"), str(folder)], check=True)
    return folder


def test_info_plist_can_be_written_and_names_one_file_type_of_its_own():
    found = plistlib.loads(plistlib.dumps(bundle.info_plist()))
    assert found == bundle.info_plist()
    assert re.fullmatch(r"[A-Za-z0-9.-]+", found["CFBundleIdentifier"])
    assert re.fullmatch(r"\d+(\.\d+){0,2}", found["CFBundleVersion"])
    assert re.fullmatch(r"\d+\.\d+", found["LSMinimumSystemVersion"])
    (exported,) = found["UTExportedTypeDeclarations"]
    assert exported["UTTypeTagSpecification"]["public.filename-extension"] == ["bobdesk"]
    owned = [kind for kind in found["CFBundleDocumentTypes"] if kind["LSHandlerRank"] == "Owner"]
    assert [kind["LSItemContentTypes"] for kind in owned] == [[exported["UTTypeIdentifier"]]]
    # Of the kinds that are not our own, none may be taken from the program that the user has for them.
    others = [kind for kind in found["CFBundleDocumentTypes"] if kind not in owned]
    assert {kind["LSHandlerRank"] for kind in others} == {"Alternate"}
    assert all(name.startswith(("public.", "com.adobe.")) for kind in others for name in kind["LSItemContentTypes"])


def test_entitlements_are_the_two_that_have_a_reason():
    text = (MACOS / "entitlements.plist").read_bytes()
    assert plistlib.loads(text) == {
        "com.apple.security.cs.allow-unsigned-executable-memory": True,
        "com.apple.security.cs.disable-library-validation": True,
    }
    # codesign reads comments, but one that is not ASCII or holds "--" has made it refuse the file.
    assert text.isascii()


@pytest.mark.parametrize("name", [bundle.APP_ICON, bundle.FILE_ICON])
def test_icons_are_what_they_are_named(icons, name):
    data = (icons / name).read_bytes()
    assert data[:4] == b"icns"
    assert int.from_bytes(data[4:8], "big") == len(data)
    kinds, at = set(), 8
    while at < len(data):
        kinds.add(data[at : at + 4].decode())
        at += int.from_bytes(data[at + 4 : at + 8], "big")
    assert at == len(data)
    # 256, 512 and 1024 pixels, the last one for retina displays.
    assert {"ic08", "ic09", "ic10"} <= kinds


class Made:
    """Stands for what PyInstaller makes, and remembers how it was asked to."""

    binaries: tuple = ()
    pure: tuple = ()
    scripts: tuple = ()

    def __init__(self, *arguments, **options):
        self.arguments, self.options = arguments, options
        self.datas = options.get("datas", [])


def run_spec(monkeypatch, icons, platform, **environment):
    """Run the spec as PyInstaller would on another system, and return what it asked for by name."""
    hooks = types.ModuleType("PyInstaller.utils.hooks")
    hooks.collect_submodules = lambda name: [name]
    hooks.copy_metadata = lambda name: []
    for name in ("PyInstaller", "PyInstaller.utils"):
        monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
    monkeypatch.setitem(sys.modules, "PyInstaller.utils.hooks", hooks)
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setattr(sys, "path", [*sys.path])
    monkeypatch.setenv("BOBDESK_ICONS", str(icons))
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    asked = {}

    def step(name):
        def make(*arguments, **options):
            asked[name] = Made(*arguments, **options)
            return asked[name]

        return make

    path = ROOT / "packaging" / "freeze" / "bobdesk.spec"
    names = {name: step(name) for name in ("Analysis", "PYZ", "EXE", "COLLECT", "BUNDLE")}
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), {"SPECPATH": str(path.parent), **names})
    return asked


def test_the_spec_makes_a_bundle_on_macos_and_nowhere_else(monkeypatch, icons):
    asked = run_spec(monkeypatch, icons, "darwin", BOBDESK_CODESIGN_ID="Developer ID Application: Nobody (X)")
    made = asked["BUNDLE"]
    assert made.arguments[0] is asked["COLLECT"]
    assert made.options["name"] == "BobDesk.app"
    assert made.options["info_plist"] == bundle.info_plist()
    assert Path(made.options["icon"]).is_file()
    program = asked["EXE"].options
    assert program["console"] is False
    assert program["codesign_identity"] == "Developer ID Application: Nobody (X)"
    assert Path(program["entitlements_file"]) == MACOS / "entitlements.plist"
    assert (str(icons / bundle.FILE_ICON), ".") in asked["Analysis"].datas
    assert "BUNDLE" not in run_spec(monkeypatch, icons, "linux")


def test_newer_versions_are_offered_only_where_an_address_is_given(monkeypatch, icons, tmp_path):
    place = tmp_path / "release-feed"
    place.write_text("https://example.org/feed\n")
    asked = run_spec(monkeypatch, icons, "darwin", BOBDESK_FEED_FILE=str(place))
    assert (str(place), "resources") in asked["Analysis"].datas
    monkeypatch.delenv("BOBDESK_FEED_FILE")
    asked = run_spec(monkeypatch, icons, "darwin")
    assert not [source for source, _ in asked["Analysis"].datas if "release-feed" in source]


def made_app(folder):
    contents = folder / "BobDesk.app" / "Contents"
    (contents / "MacOS").mkdir(parents=True)
    (contents / "Resources" / "resources" / "samples").mkdir(parents=True)
    (contents / "MacOS" / identity.PROGRAM).touch()
    for name in (bundle.APP_ICON, bundle.FILE_ICON):
        (contents / "Resources" / name).touch()
    (contents / "Info.plist").write_bytes(plistlib.dumps(bundle.info_plist() | {"DTCompiler": "more"}))
    return folder / "BobDesk.app"


def test_a_bundle_is_compared_with_what_it_should_be(tmp_path):
    app = made_app(tmp_path)
    assert bundle.problems(app) == []
    (app / "Contents" / "Resources" / bundle.FILE_ICON).unlink()
    (app / "Contents" / "Info.plist").write_bytes(plistlib.dumps(bundle.info_plist() | {"CFBundleVersion": "0"}))
    version, icon = bundle.problems(app)
    assert "CFBundleVersion" in version
    assert bundle.FILE_ICON in icon


def test_settings_of_the_disk_image_can_be_run_and_name_what_is_in_it():
    names = {"defines": {"app": "somewhere/BobDesk.app"}}
    exec((MACOS / "dmg_settings.py").read_text(encoding="utf-8"), names)
    inside = {Path(path).name for path in names["files"]} | set(names["symlinks"])
    assert set(names["icon_locations"]) == inside == {"BobDesk.app", "Applications"}
    (_, (width, height)) = names["window_rect"]
    assert all(0 < x < width and 0 < y < height for x, y in names["icon_locations"].values())


def test_the_script_is_sound_and_refuses_other_systems(tmp_path):
    script = MACOS / "make-dmg"
    assert os.access(script, os.X_OK)
    subprocess.run(["sh", "-n", str(script)], check=True)
    if sys.platform != "darwin":
        done = subprocess.run([str(script), str(tmp_path)], capture_output=True, text=True, check=False)
        assert done.returncode == 2
        assert "needs a Mac" in done.stderr
        assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not os.environ.get("BOBDESK_TEST_WHEELS"), reason="asks the package index: BOBDESK_TEST_WHEELS=1")
@pytest.mark.parametrize("machine", ["arm64", "x86_64"])
def test_every_package_has_a_wheel_for_the_oldest_macos_on_both_kinds_of_macs(tmp_path, machine):
    wanted = tmp_path / "requirements.txt"
    wanted.write_text("\n".join(module("requirements").requirements()))
    report = tmp_path / "report.json"
    system = f"macosx_{identity.MACOS_MINIMUM.replace('.', '_')}_{machine}"
    done = subprocess.run(
        [
            sys.executable, "-m", "pip", "install", "--quiet", "--dry-run", "--ignore-installed", "--no-deps",
            "--only-binary=:all:", "--platform", system, "--target", str(tmp_path / "target"),
            "--constraint", str(ROOT / "constraints.txt"), "--requirement", str(wanted), "--report", str(report),
        ],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    wheels = [item["download_info"]["url"].rsplit("/", 1)[1] for item in json.loads(report.read_text())["install"]]
    assert len(wheels) == len(wanted.read_text().splitlines()) - 1  # PySide6 stands there twice, for two Pythons
    assert all(machine in name or "universal2" in name or "none-any" in name for name in wheels)
