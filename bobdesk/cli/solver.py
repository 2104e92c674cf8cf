"""Options of the solver, and from a project where the command line says nothing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import click

from bobdesk.cli.options import combined
from bobdesk.files.solvers import solver_methods
from bobdesk.solve.settings import SolverSettings

_WEIGHTS = ("length", "height", "curvature", "gradient")

solver_options = combined(
    click.option(
        "--method",
        metavar="NAME",
        show_default="pgd",
        help="pgd is recommended: it holds drop and known elevations exactly. published is the paper's; lbfgsb, slsqp,"
        " trustconstr and de are SciPy's on the paper's objective, to compare with. Other packages can add more.",
    ),
    *(
        click.option(f"--weight-{name}", type=float, show_default="1", help=f"{letter} of the published objective.")
        for name, letter in zip(_WEIGHTS, "abcd", strict=True)
    ),
    click.option(
        "--rate", type=float, help="Learning rate of the published method; 1e-5, and less where the scale is unknown."
    ),
    click.option("--transition", type=float, show_default="8", help="Length of vertical transitions, m (pgd)."),
    click.option(
        "--level-out",
        type=float,
        show_default="30",
        help="A lowest point is level: let the gradient die out over this length before an end there, m (pgd).",
    ),
    click.option(
        "--meet-length/--smoothest",
        default=None,
        show_default="meet-length",
        help="Meet the length, or stay smoothest (pgd).",
    ),
)


@dataclass(frozen=True)
class SolverOptions:
    """What the command line says of the solver; settings that it does not name are missing."""

    method: str | None
    rate: float | None
    weights: dict[str, float]
    pgd: dict[str, Any]

    def on(self, usual: SolverSettings) -> SolverSettings:
        """Return the usual settings, or a project's, with what the command line says."""
        return replace(
            usual,
            method=self.method or usual.method,
            rate=usual.rate if self.rate is None else self.rate,
            weights=replace(usual.weights, **self.weights),
            pgd=replace(usual.pgd, **self.pgd),
        )


def taken_solver_options(options: dict[str, Any]) -> SolverOptions:
    """Take the solver's options out of all; what cannot be used is a wrong call."""
    method, rate = options.pop("method"), options.pop("rate")
    weights = {name: options.pop(f"weight_{name}") for name in _WEIGHTS}
    pgd = {name: options.pop(name) for name in ("transition", "level_out", "meet_length")}
    if method is not None:
        known = solver_methods()
        keys = [each.key for each in known.formats]
        if method not in keys:
            raise click.UsageError(f"--method must be one of {', '.join(keys)}, not '{method}'")
        for finding in known.findings:
            click.echo(f"note: {finding.sentence}", err=True)
    for name, longest in (("transition", 200), ("level_out", 1000)):
        if pgd[name] is not None and not 0 <= pgd[name] <= longest:
            option = name.replace("_", "-")
            raise click.UsageError(f"--{option} must lie between 0 and {longest} m, not {pgd[name]:g}")
    if not all(weight is None or 0 <= weight < float("inf") for weight in weights.values()):
        raise click.UsageError("the weights must be numbers of 0 or more")
    if rate is not None and not 0 < rate < float("inf"):
        raise click.UsageError(f"--rate must be more than 0, not {rate:g}")
    return SolverOptions(method, rate, _given(weights), _given(pgd))


def _given(options: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}
