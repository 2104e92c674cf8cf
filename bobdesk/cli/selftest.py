"""`bobdesk selftest`: does what is installed here work? For installers, and for reports of faults."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from pathlib import Path

import click

from bobdesk.cli.options import FILE
from bobdesk.cli.steps import check_outputs
from bobdesk.ui.selftest.record import Record, SelfTestError, Watchdog

# With spaces and letters that are not ASCII, as folders of analysts have them.
_FOLDER = "Büro Nürnberg, Bahn süd"
_FAILED = 1


@click.command("selftest")
@click.option("--report", type=FILE, metavar="FILE", help="Write what was found as JSON, after every step.")
@click.option("--picture", type=FILE, metavar="FILE.png", help="Write a picture of the window.")
@click.option(
    "--limit", type=click.FloatRange(min=1), default=300.0, show_default=True, help="Seconds for all steps together."
)
def command(report: Path | None, picture: Path | None, limit: float) -> None:
    """Open the window unseen, reconstruct the bundled sample, and compare it with its stored truth.

    Settings, recent files and recovery copies of the user are left alone, and nothing stays behind.
    Exit status 0 if all is well, 1 if not: the report names the step that failed, and says why. A program
    with a window has no standard output on Windows: there the report is all that is said.
    """
    check_outputs([report, picture], inputs=[])
    record = Record(report, lambda name: click.echo(name, err=True))
    # A name that is short: Windows allows 260 characters to a path.
    folder = Path(tempfile.mkdtemp(prefix="bobdesk-"))
    watchdog = Watchdog(record, limit, folder)
    try:
        _try(record, folder, picture)
        with record.step("leave nothing behind"):
            shutil.rmtree(folder)
        record.pass_()
    except Exception as error:  # noqa: BLE001 - whatever fails is what the report is for
        record.fail(error)
    finally:
        watchdog.end()
        shutil.rmtree(folder, ignore_errors=True)
    record.write()
    if not record.passed:
        click.echo(f"bobdesk: the self-test failed: {record.found['step']}: {record.found['error']}", err=True)
        raise click.exceptions.Exit(_FAILED)
    click.echo("the self-test passed")


def _try(record: Record, folder: Path, picture: Path | None) -> None:
    from bobdesk.files.recovery import user_data_folder
    from bobdesk.ui.selftest import surroundings

    with record.step("look around"):
        record.put("system", surroundings.system())
        record.put("versions", surroundings.versions())
    _choose_platform(record)
    with record.step("start Qt"):
        from bobdesk.ui.selftest.made_pictures import decode_made_pictures
        from bobdesk.ui.selftest.main_job import MainJob
        from bobdesk.ui.selftest.unseen_window import UnseenWindow
        from bobdesk.ui.settings import user_settings_file

        record.put("folders", surroundings.folders(user_settings_file().parent, user_data_folder()))
    with record.step("open the window"):
        unseen = UnseenWindow(folder / "own")
        record.put("qt", unseen.shown())
        unseen.check_letters()
        unseen.window.warm_up()
        unseen.until_quiet()
    try:
        with record.step("decode pictures of all kinds"):
            record.put("pictures", decode_made_pictures())
        work = folder / _FOLDER
        work.mkdir()
        MainJob(unseen, record, work).do()
        if picture is not None:
            with record.step("take a picture of the window"):
                unseen.window.go_to("Solve")
                unseen.until_quiet()
                unseen.save_picture(picture)
        with record.step("close the window"):
            unseen.close()
            _check_recovery(folder / "own" / "data" / "recovery")
    except Exception:
        unseen.abandon()
        raise
    finally:
        record.put("qt_messages", unseen.messages)


def _check_recovery(folder: Path) -> None:
    """All was saved: there must be nothing to recover."""
    left = [place.name for place in folder.glob("*")]
    if left:
        raise SelfTestError(f"recovery copies are left behind: {', '.join(left)}")


def _choose_platform(record: Record) -> None:
    """Let Qt do without a screen where there is none."""
    if sys.platform != "linux" or any(
        os.environ.get(name) for name in ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY")
    ):
        return
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    record.note("there is no screen: the window is opened on Qt's platform without one (offscreen)")
