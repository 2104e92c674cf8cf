"""Options that several commands share: targets, segments, plan."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import reduce
from pathlib import Path
from typing import Any, TypeVar

import click

Function = TypeVar("Function", bound=Callable[..., Any])
FILE = click.Path(path_type=Path)
# Options that take several values in a row, and what their values look like.
_SEVERAL = {
    "--known": re.compile(r"^-?[\d.,eE+-]+(:-?[\d.,eE+-]+){1,2}$"),
    "--via": re.compile(r"^-?[\d.eE+-]+,-?[\d.eE+-]+$"),
}


class SeveralValues(click.Command):
    """A command whose `--known` or `--via` takes several values in a row, or is given several times."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Write such an option before each of its values, then parse as usual."""
        for option, pattern in _SEVERAL.items():
            args = _spread(args, option, pattern)
        return super().parse_args(ctx, args)


def _spread(args: list[str], option: str, pattern: re.Pattern[str]) -> list[str]:
    """Write the option before each of its values."""
    result: list[str] = []
    within = False
    for position, argument in enumerate(args):
        follows_value = within and position and args[position - 1] != option
        if follows_value and pattern.match(argument):
            result.append(option)
        elif argument == option:
            within = True
        elif follows_value:
            within = False
        result.append(argument)
    return result


def combined(*decorators: Callable[[Function], Function]) -> Callable[[Function], Function]:
    """Return several decorators as one."""
    return lambda function: reduce(lambda inner, decorate: decorate(inner), reversed(decorators), function)


def within(lowest: float, highest: float) -> Callable[..., float | None]:
    """Return a check that an option's number lies within limits; NaN does not."""

    def check(_context: click.Context, _option: click.Parameter, value: float | None) -> float | None:
        if value is not None and not lowest <= value <= highest:
            raise click.BadParameter(f"it must lie between {lowest:g} and {highest:g}, not {value:g}.")
        return value

    return check


plan_argument = click.argument("plan", type=FILE)

plan_options = combined(
    click.option(
        "--spacing",
        type=float,
        show_default="1, or a project's",
        callback=within(0.1, 10),
        help="Distance between stations (rows of the result), m.",
    ),
    click.option(
        "--wavelength",
        type=float,
        show_default="15, or a project's",
        callback=within(0, 200),
        help="Smoothing: waves shorter than this are taken for noise, m. 20 suits clicks by hand, 0 is none.",
    ),
)

segment_options = combined(
    click.option(
        "--count", type=click.IntRange(min=1), help="Wanted number of segments; found automatically without it."
    ),
    click.option(
        "--threshold",
        type=float,
        callback=within(1e-5, 1),
        help="Curvature (1 / radius) that parts straight from curve, 1/m; automatic without.",
    ),
)

target_options = combined(
    click.option("--length", type=float, help="3D length of the track, m; a project as PLAN brings its own."),
    click.option("--drop", type=float, help="Height difference from start to lowest point, m; likewise."),
    click.option("--mean-gradient", type=float, help="Mean gradient, as a number: 0.105 is 10.5 %."),
    click.option(
        "--mean-gradient-is",
        type=click.Choice(["drop-per-length", "drop-per-plan", "segments"]),
        show_default="drop-per-length",
        help="How that mean is defined. The first two follow from length and drop and are only checked;"
        " the mean over the segments' gradients is held.",
    ),
    click.option(
        "--min-gradient",
        type=float,
        show_default="-0.2",
        help="Smallest gradient, as a number: fall per metre of plan, uphill is < 0.",
    ),
    click.option("--max-gradient", type=float, show_default="0.25", help="Largest gradient, as a number."),
    click.option(
        "--known",
        multiple=True,
        metavar="STATION:ELEVATION",
        help="A known elevation, m above the lowest point, at a station along the plan, m; several are allowed."
        " A third number is its tolerance, m.",
    ),
    click.option("--unknown-scale", is_flag=True, help="The plan's scale is not known: find the factor f on it."),
)

strict_option = click.option("--strict", is_flag=True, help="Exit with status 4 if the targets cannot be met.")
report_option = click.option("--report", type=FILE, metavar="R.json", help="Write all figures as JSON.")
