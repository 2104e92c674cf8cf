"""What can be proved of the package for Windows without Windows and without Wine."""

import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
WINDOWS = ROOT / "packaging" / "windows"


@pytest.fixture(scope="module", autouse=True)
def modules():
    """The package's modules import each other by their bare names, as scripts of one folder do."""
    before, known = list(sys.path), set(sys.modules)
    sys.path.insert(0, str(WINDOWS))
    yield
    sys.path[:] = before
    for name in set(sys.modules) - known:
        file = getattr(sys.modules[name], "__file__", None) or ""
        if Path(file).is_relative_to(ROOT / "packaging"):
            del sys.modules[name]


@pytest.fixture(scope="module")
def icons(tmp_path_factory):
    folder = tmp_path_factory.mktemp("icons")
    subprocess.run([sys.executable, str(ROOT / "packaging" / "icons" / "make_icons.py"), str(folder)], check=True)
    return folder


@pytest.fixture(scope="module")
def small_tree(tmp_path_factory):
    """A program of four files."""
    tree = tmp_path_factory.mktemp("small") / "tree"
    for name in ("BobDesk.exe", "runtime/python311.dll", "runtime/site-packages/a/b.py", "licences/LICENSE.txt"):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text(name)
    return tree


def script():
    return (WINDOWS / "installer.nsi").read_text(encoding="utf-8")


def code_of_script():
    return "\n".join(line for line in script().splitlines() if not line.lstrip().startswith(";"))


def test_names_and_versions_of_the_installer_come_from_the_one_place():
    from house import identity
    from installer import defined

    for value in (identity.NAME, identity.VERSION, identity.AUTHORS, identity.APP_ID, f".{identity.FILE_SUFFIX}"):
        assert value not in code_of_script()
    assert defined("1.2.3")["VERSION"] == "1.2.3"
    assert defined("1.2.3")["VERSION_DOTS"] == "1.2.3.0"
    assert identity.VERSION in defined(identity.VERSION).values()


def test_every_name_in_the_installer_has_a_value():
    from installer import defined

    own = set(re.findall(r"^!define (\w+)", script(), re.MULTILINE))
    handed_over = {*defined("1.0"), "SIZE_KB", "LICENCE_FILE", "ICON", "SIDE_PICTURE", "FILES", "OUT", "SIGN"}
    used = set(re.findall(r"\$\{([A-Z_0-9]+)\}", script()))
    assert used - own == handed_over


def test_nothing_of_the_installer_goes_to_the_machine():
    code = code_of_script()
    assert "RequestExecutionLevel user" in code
    assert not re.search(r"\b(HKLM|HKCR|HKEY_LOCAL_MACHINE|SetShellVarContext all|PROGRAMFILES)", code)


def test_what_the_uninstaller_removes_whole_are_folders_of_the_program_alone():
    wholly = re.findall(r'RMDir /r "([^"]+)"', script())
    assert set(wholly) == {
        r"$INSTDIR\runtime",
        r"$INSTDIR\runtime.new",
        r"$INSTDIR\runtime.old",
        r"$INSTDIR\commands",
        r"$INSTDIR\licences",
    }


def test_files_are_listed_in_one_order_and_the_runtime_arrives_beside_the_old_one(small_tree):
    from installer import instructions

    lines = list(instructions(small_tree))
    assert lines == list(instructions(small_tree))
    assert [line for line in lines if line.startswith("SetOutPath")] == [
        'SetOutPath "$INSTDIR"',
        r'SetOutPath "$INSTDIR\runtime.new"',
        r'SetOutPath "$INSTDIR\runtime.new\site-packages\a"',
        r'SetOutPath "$INSTDIR\licences"',
    ]
    assert sum(line.startswith("File") for line in lines) == 4


@pytest.mark.skipif(shutil.which("makensis") is None, reason="NSIS is not installed")
def test_two_setups_of_the_same_files_are_the_same(small_tree, icons, tmp_path):
    from installer import write_setup
    from tree import date_everything

    date_everything(small_tree, 1_700_000_000)
    for number in "12":
        write_setup(small_tree, tmp_path / f"{number}.exe", icons, tmp_path, version="3.2.1")
    assert (tmp_path / "1.exe").read_bytes() == (tmp_path / "2.exe").read_bytes()
    assert "3.2.1.0".encode("utf-16le") in (tmp_path / "1.exe").read_bytes()


def test_the_manifest_asks_for_no_rights_and_for_scales_long_paths_and_utf_8():
    from house import identity
    from launchers import fill, version_of_four

    root = ET.fromstring(fill(WINDOWS / "launcher.manifest.in", {}))
    found = {element.tag.split("}")[1]: element for element in root.iter()}
    assert found["requestedExecutionLevel"].get("level") == "asInvoker"
    assert found["dpiAwareness"].text.startswith("PerMonitorV2")
    assert found["longPathAware"].text == "true"
    assert found["activeCodePage"].text == "UTF-8"
    assert root.find("{*}assemblyIdentity").get("version") == ".".join(map(str, version_of_four(identity.VERSION)))


def test_versions_are_four_numbers_for_windows():
    from launchers import version_of_four

    assert version_of_four("1.2") == (1, 2, 0, 0)
    assert version_of_four("1.2.3rc4") == (1, 2, 3, 4)


@pytest.mark.skipif(shutil.which("x86_64-w64-mingw32-gcc") is None, reason="mingw-w64 is not installed")
def test_the_launchers_compile_to_the_same_bytes_with_version_and_manifest(icons, tmp_path):
    from house import identity
    from launchers import write_launchers
    from pe import PortableExecutable

    first, second = (write_launchers(tmp_path / number, icons, tmp_path / number / "work") for number in "12")
    assert [path.relative_to(tmp_path / "1").as_posix() for path in first] == ["BobDesk.exe", "commands/bobdesk.exe"]
    for one, other in zip(first, second, strict=True):
        data = one.read_bytes()
        assert data == other.read_bytes()
        assert identity.VERSION.encode("utf-16le") in data
        assert b"longPathAware" in data
        # Nothing but what every Windows has.
        assert set(PortableExecutable(one).imports()) <= {"kernel32.dll", "msvcrt.dll", "shell32.dll", "user32.dll"}
        assert str(tmp_path).encode() not in data


@pytest.mark.skipif(shutil.which("x86_64-w64-mingw32-gcc") is None, reason="mingw-w64 is not installed")
def test_the_forwarder_offers_what_the_library_offers_wherever_it_is_made(tmp_path):
    from interpreter import GCC, write_forwarder
    from pe import PortableExecutable

    code = tmp_path / "code.c"
    code.write_text("__declspec(dllexport) int one(void) { return 1; }\n__declspec(dllexport) int two = 2;\n")
    library = tmp_path / "python399.dll"
    subprocess.run([GCC, "-shared", "-s", "-o", str(library), str(code)], check=True)
    places = [tmp_path / name / "python3.dll" for name in ("a", "another")]
    for place in places:
        place.parent.mkdir()
        write_forwarder(library, place)
    assert PortableExecutable(places[0]).exports() == PortableExecutable(library).exports() == {"one", "two"}
    assert b"python399.two" in places[0].read_bytes()
    assert places[0].read_bytes() == places[1].read_bytes()
    assert [path.name for path in places[0].parent.iterdir()] == ["python3.dll"]


def test_what_is_left_out_and_what_is_not():
    from trim import wants_file, wants_interpreter, wants_library

    kept = (
        "PySide6/QtCore.pyd",
        "PySide6/Qt6Core.dll",
        "PySide6/plugins/platforms/qwindows.dll",
        "numpy/f2py/rules.py",
    )
    kept += ("scipy/optimize/_lbfgsb.pyd", "click-8.0.dist-info/RECORD", "bobdesk/resources/samples/x/plan.jpg")
    gone = ("PySide6/Qt6Quick.dll", "PySide6/designer.exe", "PySide6/qml/a.dll", "numpy/tests/test_a.py", "a/b.pyi")
    gone += ("scipy/signal/_a.pyd", "PIL/_avif.cp311-win_amd64.pyd", "shiboken6/msvcp140.dll")
    assert [name for name in kept if not wants_file(name)] == []
    assert [name for name in gone if wants_file(name)] == []
    assert wants_library("json/decoder.py")
    assert wants_library("pydoc.py")
    assert not wants_library("test/test_json.py")
    assert not wants_library("tkinter/ttk.py")
    assert wants_interpreter("_ctypes.pyd")
    assert not wants_interpreter("tcl86t.dll")


def test_every_run_time_package_has_a_version_and_markers_are_those_of_windows(tmp_path):
    from house import runtime
    from packaging.requirements import Requirement
    from wheels import applies, own_requirements, read_pins, wheel_requirements

    pins = read_pins(ROOT / "constraints.txt")
    wanted = [one for one in own_requirements(ROOT / "pyproject.toml") if applies(one)]
    assert {runtime.normalised(one.name) for one in wanted} <= set(pins)
    (qt,) = (one for one in wanted if one.name == "PySide6-Essentials")
    assert qt.specifier.contains(pins["pyside6-essentials"])

    wheel = tmp_path / "a-1.0-py3-none-any.whl"
    lines = ["Name: a", 'Requires-Dist: colorama; sys_platform == "win32"', 'Requires-Dist: uvloop; os_name == "posix"']
    lines += ['Requires-Dist: extra; extra == "more"', "Requires-Dist: b>=2", "", ""]
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr("a-1.0.dist-info/METADATA", "\n".join(lines))
    assert wheel_requirements(wheel, ()) == [Requirement('colorama; sys_platform == "win32"'), Requirement("b>=2")]
    assert [one.name for one in wheel_requirements(wheel, ["more"])] == ["colorama", "extra", "b"]


def test_what_fails_without_a_console_is_shown(monkeypatch):
    import launch

    shown = []
    monkeypatch.setattr(launch, "show", shown.append)
    monkeypatch.setattr(sys, "frozen", False, raising=False)
    monkeypatch.setattr(sys, "stderr", None)
    monkeypatch.setattr(sys, "argv", ["launch.py", "chek"])
    assert launch.main() == 2
    assert len(shown) == 1
    assert "chek" in shown[0]
    assert sys.frozen is True
    monkeypatch.setattr(sys, "stderr", None)
    monkeypatch.setattr(sys, "argv", ["launch.py", "selftest", "--report"])
    assert launch.main() == 2
    assert len(shown) == 1, "nobody would close the box of a self-test"


def test_no_file_names_a_place_of_some_machine():
    told = re.compile(r"/(home|root|tmp|work|opt|mnt)/|[A-Z]:\\Users\\", re.IGNORECASE)
    for path in sorted(WINDOWS.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            assert not told.search(path.read_text(encoding="utf-8")), path
