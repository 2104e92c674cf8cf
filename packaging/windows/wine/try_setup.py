"""Try setup.exe under Wine: python packaging/windows/wine/try_setup.py SETUP WORK OUT

SETUP is setup.exe, WORK the folder in which build.py made it; reports and pictures of the screen go to OUT. Says what
it sees, and ends with 1 at the first thing that is wrong. packaging/windows/test installs what this needs.

Run by root, everything is done by two users who own nothing but their homes; else by who runs it.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from house import HOUSE, PACKAGING, identity
from installer import write_setup
from interpreter import STEM
from machine import Machine, TrialError, say, screen, wait_for
from signing import check_signature, make_signer
from static import look_into

HERE = Path(__file__).resolve().parent
ANALYST, COLLEAGUE = 61001, 61002  # users that have no account
FOLDER = r"C:\Programme für Übung\Bob Desk"
PLACE = "Programme für Übung/Bob Desk"
PROJECT = "Bögen & Läufe/Übungsbahn, zweiter Entwurf.bobdesk"
OLDER = "0.0.9"
UNINSTALLER = f"Uninstall {identity.NAME}.exe"
APPS = rf"Software\Microsoft\Windows\CurrentVersion\Uninstall\{identity.NAME}"
KEY = rf"Software\{identity.NAME}"
CLASSES = r"Software\Classes"


def main() -> int:
    setup, work, out = (Path(one).resolve() for one in sys.argv[1:4])
    out.mkdir(parents=True, exist_ok=True)
    try:
        look_into(work / identity.NAME)
        with tempfile.TemporaryDirectory(prefix="bobdesk-wine-") as made:
            place = Path(made)
            place.chmod(0o755)
            try_all(setup, work, out, place)
    except TrialError as error:
        print(f"The test of setup.exe failed: {error}.", file=sys.stderr)
        return 1
    print(f"setup.exe passed; reports and pictures are in {out}.")
    return 0


def try_all(setup: Path, work: Path, out: Path, place: Path) -> None:
    """Try one thing after the other."""
    shims = place / "shims"
    subprocess.run([sys.executable, str(HERE / "shims.py"), str(work / identity.NAME), str(shims)], check=True)
    older = make_older(place, work / "icons", make_signer(place / "signer"))
    check_signature(older, place / "signer")
    shutil.copy(setup, place / "setup.exe")
    linux = out / "selftest-here.json"
    test_here(linux)
    with screen() as display, user(place / "analyst", shims, ANALYST, display) as analyst:
        before = analyst.files()
        refuse_other_files(analyst, older)
        move(analyst, older)
        check_signature(analyst.drive / PLACE / UNINSTALLER, place / "signer")
        say("setup.exe and the uninstaller in it can be signed")
        upgrade(analyst, older, place / "setup.exe")
        look_at_registry(analyst)
        report = self_test(analyst, PLACE, out / "selftest-windows.json", out / "selftest-windows.png")
        same_figures(linux, report)
        use_console(analyst)
        open_by_double_click(analyst, out / "double-click.png")
        stay_while_open(analyst, place / "setup.exe")
        with user(place / "colleague", shims, COLLEAGUE, display) as colleague:
            other_user(colleague, analyst, linux, out / "selftest-other-user.json")
        uninstall(analyst, before)


@contextmanager
def user(home: Path, shims: Path, number: int, display: str) -> Iterator[Machine]:
    """Yield a Windows of a user of its own."""
    home.mkdir()
    machine = Machine(home, shims, number if os.geteuid() == 0 else None, display)
    try:
        yield machine
    finally:
        machine.stop()


def make_older(place: Path, icons: Path, sign: str) -> Path:
    """Return a setup.exe of an older version, which has hardly more files than those that newer ones don't."""
    tree = place / "older"
    gone = ("runtime/gone.pyd", "commands/gone.cmd", "licences/gone.txt")
    for name in (identity.WINDOWS_EXECUTABLE, f"runtime/{STEM}.dll", *gone):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text("of an older version")
    setup = place / "older-setup.exe"
    write_setup(tree, setup, icons, place, sign, version=OLDER)
    return setup


def test_here(report: Path) -> None:
    """Have the program on this machine test itself, to compare with."""
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "PYTHONPATH": str(HOUSE)}
    command = [sys.executable, "-m", "bobdesk", "selftest", "--report", str(report)]
    if subprocess.run(command, env=environment, capture_output=True, check=False).returncode:
        raise TrialError(f"the self-test on this machine failed, see {report}")


def install(machine: Machine, setup: Path, *words: str, folder: str = "", status: int = 0) -> float:
    """Install silently and return the seconds it took."""
    started = time.monotonic()
    # The folder goes without quotes, whatever it is called.
    machine.run(f"Z:{setup}", "/S", *words, *(f"/D={folder}".split(" ") if folder else ()), status=status)
    return time.monotonic() - started


def refuse_other_files(machine: Machine, setup: Path) -> None:
    """A folder with other files in it is left alone."""
    folder = machine.drive / "Other things"
    folder.mkdir()
    (folder / "letter.txt").write_text("mine")
    machine.give(folder)
    install(machine, setup, folder=r"C:\Other things", status=5)
    if [path.name for path in folder.iterdir()] != ["letter.txt"]:
        raise TrialError("an installation went into a folder with other files")
    shutil.rmtree(folder)
    say("a folder with other files is refused with status 5")


def move(machine: Machine, setup: Path) -> None:
    """An installation in another folder takes the place of the one before."""
    usual = machine.drive / "users" / "analyst" / "AppData" / "Local" / "Programs" / identity.NAME
    install(machine, setup)
    if not (usual / UNINSTALLER).exists():
        raise TrialError(f"the usual folder is not {usual}")
    install(machine, setup, folder=FOLDER)
    if usual.exists():
        raise TrialError("an installation in another folder leaves the one before")
    say(f"version {OLDER}: installed in the usual folder, then in {FOLDER}; the first is gone")


def upgrade(machine: Machine, older: Path, setup: Path) -> None:
    """A newer version goes where the older one was, and what it no longer has goes away."""
    folder = machine.drive / PLACE
    if machine.registry(APPS, "DisplayVersion") != OLDER:
        raise TrialError(f"version {OLDER} is not in the list of programs")
    seconds = install(machine, setup, "/DESKTOP")
    left = [str(path.relative_to(folder)) for path in folder.rglob("*") if path.stem == "gone" or ".old" in path.name]
    if left:
        raise TrialError(f"files of the older version are left: {', '.join(left)}")
    if list(machine.drive.rglob("ucrtbas0.dll")) != [machine.drive / "windows" / "system32" / "ucrtbas0.dll"]:
        raise TrialError("what is for the test alone came with setup.exe")
    megabytes = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6
    say(f"version {identity.VERSION} over {OLDER}: {seconds:.0f} s, {megabytes:.0f} MB; old files are gone")


def look_at_registry(machine: Machine) -> None:
    """The list of programs, the file type and the shortcuts are what they should be."""
    program = rf"{FOLDER}\{identity.WINDOWS_EXECUTABLE}"
    wanted = {
        (APPS, "DisplayName"): identity.NAME,
        (APPS, "DisplayVersion"): identity.VERSION,
        (APPS, "Publisher"): identity.AUTHORS,
        (APPS, "InstallLocation"): FOLDER,
        (APPS, "UninstallString"): rf'"{FOLDER}\{UNINSTALLER}"',
        (APPS, "QuietUninstallString"): rf'"{FOLDER}\{UNINSTALLER}" /S',
        (rf"{CLASSES}\.{identity.FILE_SUFFIX}", ""): identity.FILE_TYPE_PROGID,
        (rf"{CLASSES}\.{identity.FILE_SUFFIX}", "Content Type"): identity.MIME_TYPE,
        (rf"{CLASSES}\{identity.FILE_TYPE_PROGID}\shell\open\command", ""): f'"{program}" "%1"',
        (rf"{CLASSES}\{identity.FILE_TYPE_PROGID}\DefaultIcon", ""): f'"{program}",1',
    }
    for (key, name), value in wanted.items():
        if (found := machine.registry(key, name)) != value:
            raise TrialError(f"HKCU\\{key} {name or '(default)'} is {found!r}, not {value!r}")
    size = int(machine.registry(APPS, "EstimatedSize") or "0", 0)
    shortcuts = sorted(path.name for path in machine.home.rglob(f"*{identity.NAME}*.lnk"))
    if size < 100_000 or len(shortcuts) != 4:
        raise TrialError(f"the size is {size} KB, the shortcuts are {', '.join(shortcuts)}")
    say(f"in the list of programs with {size / 1000:.0f} MB; shortcuts: {', '.join(shortcuts)}")


def self_test(machine: Machine, place: str, report: Path, picture: Path | None = None, drive: str = "C:") -> Path:
    """Have the installed program, the one without a console, test itself."""
    folder = machine.give(_made(machine.home / "Prüfbericht mit Bild"))
    words = ["--report", f"Z:{folder}/bericht.json"]
    if picture is not None:
        words += ["--picture", f"Z:{folder}/bild.png"]
    started = time.monotonic()
    program = f"{drive}/{place}/{identity.WINDOWS_EXECUTABLE}".replace("/", "\\")
    try:
        machine.run(program, "selftest", *(word.replace("/", "\\") for word in words))
    finally:
        if (folder / "bericht.json").exists():
            shutil.copy(folder / "bericht.json", report)
    if picture is not None:
        shutil.copy(folder / "bild.png", picture)
    say(f"self-test passed in {time.monotonic() - started:.0f} s")
    return report


def same_figures(linux: Path, windows: Path) -> None:
    """The figures are those of this machine."""
    command = [sys.executable, str(PACKAGING / "same_figures.py"), str(linux), str(windows)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    print("".join(f"    {line}\n" for line in (done.stdout + done.stderr).splitlines()), end="")
    if done.returncode:
        raise TrialError("the figures are not those of this machine")


def use_console(machine: Machine) -> None:
    """The program for the console speaks, and its commands work on files with any name."""
    program = rf"{FOLDER}\{identity.WINDOWS_CONSOLE}".replace("/", "\\")
    if identity.VERSION not in machine.run(program, "--version"):
        raise TrialError("the program for the console does not say its version")
    plan = machine.drive / "Pläne" / "Mugello außen.csv"
    plan.parent.mkdir()
    shutil.copy(HOUSE / "resources" / "samples" / "mugello" / "mugello.csv", plan)
    machine.give(plan.parent)
    words = [r"C:\Pläne\Mugello außen.csv", "--length", "703.7", "--drop", "35.73"]
    said = machine.run(program, "check", *words)
    machine.run(program, "check", r"C:\Pläne\nicht da.csv", "--length", "703.7", "--drop", "35.73", status=3)
    shutil.rmtree(plan.parent)
    say(f"console: {said.strip().splitlines()[0]}")


def open_by_double_click(machine: Machine, picture: Path) -> None:
    """A project opens in the window by its file type."""
    project = machine.drive / PROJECT
    project.parent.mkdir()
    shutil.copy(HOUSE / "resources" / "samples" / "mugello" / "mugello.bobdesk", project)
    machine.give(project.parent)
    # Wine 8 does not look for file types among the user's own (HKCU\Software\Classes), as Windows does.
    for name in (f".{identity.FILE_SUFFIX}", identity.FILE_TYPE_PROGID):
        machine.run("reg", "copy", rf"HKCU\{CLASSES}\{name}", rf"HKLM\{CLASSES}\{name}", "/s", "/f")
    started = time.monotonic()
    # Not waited for: the program would hold the pipes of what started it.
    machine.start("start", "/unix", str(project))
    wait_for(lambda: any(project.stem in title for title in machine.windows()), "the window of a project")
    say(f"a double click on {project.name} opens it in {time.monotonic() - started:.0f} s")
    time.sleep(15)  # for the picture: plots and pictures come after the window
    machine.photograph(picture)


def stay_while_open(machine: Machine, setup: Path) -> None:
    """While the window is open nothing is taken away; setup.exe waits, and goes on once it is closed."""
    folder = machine.drive / PLACE
    before = sorted(folder.rglob("*"))
    machine.run(rf"{FOLDER}\{UNINSTALLER}", "/S", *f"_?={FOLDER}".split(" "), status=4)
    if sorted(folder.rglob("*")) != before:
        raise TrialError("the uninstaller took files away while the window was open")
    say("the uninstaller leaves an open program alone, with status 4")
    waiting = machine.start(f"Z:{setup}", "/S")
    time.sleep(5)
    if waiting.poll() is not None:
        raise TrialError(f"setup.exe does not wait for an open window, but ends with {waiting.returncode}")
    machine.run("taskkill", "/im", identity.WINDOWS_EXECUTABLE, status=None)
    waiting.communicate(timeout=300)
    if waiting.returncode != 0:
        raise TrialError(f"setup.exe ended with {waiting.returncode} after the window was closed")
    say("setup.exe waits until the window is closed")


def other_user(machine: Machine, owner: Machine, linux: Path, report: Path) -> None:
    """Another user, who may not write to the program's folder, has settings of his own."""
    folder = owner.drive / PLACE
    for path in (folder, *folder.rglob("*")):
        path.chmod(0o555 if path.is_dir() else 0o444)
    try:
        place = str(folder).lstrip("/")
        same_figures(linux, self_test(machine, place, report, drive="Z:"))
        if json.loads(report.read_text(encoding="utf-8"))["folders"]["program"]["writable"]:
            raise TrialError("the program's folder can be written to: nothing was tested")
    finally:
        for path in (folder, *folder.rglob("*")):
            path.chmod(0o755 if path.is_dir() else 0o644)
    say("a second user, who may not write to the program's folder, has the same figures")


def uninstall(machine: Machine, before: set[str]) -> None:
    """Nothing is left but the user's own: settings, recovery copies, projects."""
    settings = machine.drive / "users" / "analyst" / "AppData" / "Local" / identity.PROGRAM
    if not settings.exists():
        raise TrialError(f"there are no settings in {settings}")
    kept = {path: path.read_bytes() for path in settings.rglob("*") if path.is_file()}
    machine.run(rf"{FOLDER}\{UNINSTALLER}", "/S")
    wait_for(lambda: not (machine.drive / PLACE).exists(), "the program's folder goes away", 60)
    time.sleep(2)
    now = {path: path.read_bytes() for path in settings.rglob("*") if path.is_file()}
    if now != kept:
        changed = sorted(path.name for path in {*kept, *now} if kept.get(path) != now.get(path))
        raise TrialError(f"settings were changed or taken away: {', '.join(changed)}")
    mine = (settings, machine.drive / Path(PROJECT).parts[0], machine.drive / Path(PLACE).parts[0])
    found = (machine.home / name for name in machine.files() - before)
    new = sorted(path.relative_to(machine.home).as_posix() for path in found if not any(map(path.is_relative_to, mine)))
    left = [name for name in new if identity.PROGRAM in name.lower() or name.endswith(".lnk")]
    types = (f".{identity.FILE_SUFFIX}", identity.FILE_TYPE_PROGID, rf"Applications\{identity.WINDOWS_EXECUTABLE}")
    keys = [key for key in (APPS, KEY, *(rf"{CLASSES}\{name}" for name in types)) if machine.has_key(key)]
    if left or keys:
        raise TrialError(f"left behind: {', '.join([*left, *keys])}")
    say(f"uninstalled; kept: {', '.join(sorted(path.name for path in kept))}")
    say(f"new beside that: {', '.join(new) or 'nothing'}")


def _made(folder: Path) -> Path:
    folder.mkdir()
    return folder


if __name__ == "__main__":
    sys.exit(main())
