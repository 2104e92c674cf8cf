"""The group of commands, the exit status, and the one sentence that a failure says."""

from __future__ import annotations

import importlib
import io
import sys
from collections.abc import Sequence

import click

from bobdesk import __version__
from bobdesk.cli.window import open_window, wants_window
from bobdesk.errors import InputError, TargetError
from bobdesk.sentences import ended

DONE, WRONG_CALL, UNUSABLE_INPUT, UNMET_TARGETS = 0, 2, 3, 4

# Name, module, and the line that --help shows. Modules are imported when their command is called,
# so that `bobdesk --help` needs neither numpy nor scipy.
COMMANDS = {
    "trace": "Follow the drawn line of a plan picture, and bring it to metres.",
    "segment": "Find the straights and curves of a plan.",
    "check": "Say whether length, drop and limits can be met, before any run.",
    "reconstruct": "Make the 3D centreline from plan, length and drop.",
    "study": "Solve plans in many ways: segment counts, weights, methods, known elevations.",
    "published": "The paper's tables beside what our methods make of the same targets.",
    "rules": "Judge a 3D line by design rules, each with its source.",
    "compare": "Compare a 3D line with the actual track.",
    "export": "Write the result of a project, or any 3D line, in another format.",
    "selftest": "Try out what is installed: open the window unseen, and reconstruct a sample.",
}


class UnmetTargetsError(Exception):
    """The targets cannot be met and `--strict` was given; the message is the sentence."""


class _Commands(click.Group):
    """A group that imports a command only when it is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        command = importlib.import_module(f"bobdesk.cli.{cmd_name}").command
        if not isinstance(command, click.Command):
            raise TypeError(f"bobdesk.cli.{cmd_name} has no command")
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.command(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="BobDesk")
def bobdesk() -> None:
    """From the plan of a bobsleigh track to a 3D centreline for simulation.

    Without a command the window opens: bobdesk [FILE], on a project, a picture or coordinates.
    Commands work without it. Give a plan in metres, the track's length and its height difference:

    \b
      bobdesk check PLAN.csv --length 1300 --drop 120
      bobdesk reconstruct PLAN.csv -o LINE.csv --length 1300 --drop 120

    Each command has its own help: bobdesk reconstruct --help
    """  # noqa: D301 - click reads the backspace as "do not fill this paragraph"


def run(arguments: Sequence[str]) -> int:
    """Run a command and return the exit status; every failure says one sentence on stderr."""
    _say_what_can_be_said()
    try:
        if wants_window(arguments, COMMANDS):
            return open_window(arguments[0] if arguments else None)
        # What a command ends with by `click.exceptions.Exit` comes back as a value.
        status = bobdesk.main(list(arguments), prog_name="bobdesk", standalone_mode=False)
    except click.ClickException as error:
        return _failed(error.format_message(), WRONG_CALL)
    except (click.Abort, KeyboardInterrupt) as stop:
        # A command that keeps what it has so far says so itself.
        return _failed(str(stop) or "stopped; nothing was written", 130)
    except UnmetTargetsError as error:
        return _failed(str(error), UNMET_TARGETS)
    except (InputError, TargetError) as error:
        return _failed(str(error), UNUSABLE_INPUT)
    except MemoryError:
        return _failed("there is not enough memory for this input", UNUSABLE_INPUT)
    except BrokenPipeError:
        return DONE
    return status if isinstance(status, int) else DONE


def _say_what_can_be_said() -> None:
    """Let signs that a pipe's encoding has not (cp1252 has no "−") become question marks, not faults."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")


def _failed(sentence: str, status: int) -> int:
    click.echo(f"bobdesk: {ended(' '.join(sentence.split()))}", err=True)
    return status
