"""`bobdesk trace`: follow the drawn line of a plan picture, and bring it to metres."""

from __future__ import annotations

import math
import time
from pathlib import Path

import click
import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.cli.options import FILE, SeveralValues, report_option
from bobdesk.cli.steps import check_outputs, to_json, with_progress
from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.files.exporters.tables import trace_table
from bobdesk.files.importers.table import read_bytes
from bobdesk.files.importers.text import decode_text
from bobdesk.files.pictures import read_picture
from bobdesk.plan import calibration as calibrations
from bobdesk.plan.calibration import Calibration
from bobdesk.plan.calibration_fit import fit_calibration
from bobdesk.plan.calibration_sentences import calibration_sentences, misfit_sentence
from bobdesk.plan.image import PlanImage
from bobdesk.plan.qgis_points import parse_qgis_points
from bobdesk.plan.trace import TraceSettings, propose_loops, trace_line
from bobdesk.plan.traced_line import Trace

# An end of the line is clicked to about this, 1 sigma, pixels.
_END_SIGMA_PX = 1.0
_SHORTEST_PX = 10.0
# From electron microscopes to planets, metres per pixel.
_SCALES = (1e-6, 1e6)
_NO_LINE = 0.15


def _pixel(text: str) -> tuple[float, float]:
    """Return x and y of PX,PY."""
    parts = text.split(",")
    try:
        numbers = [float(part) for part in parts]
    except ValueError:
        numbers = []
    if len(numbers) != 2 or not all(math.isfinite(number) for number in numbers):
        raise click.UsageError(f"'{text}' is no pixel; it takes two numbers such as 412.5,1033")
    return numbers[0], numbers[1]


@click.command("trace", cls=SeveralValues)
@click.argument("picture", type=FILE)
@click.option("-o", "--output", type=FILE, required=True, metavar="PLAN.csv", help="Where to write the plan.")
@click.option(
    "--scale",
    type=float,
    metavar="M_PER_PX",
    help="Metres per pixel; not needed with a world file, GeoTIFF tags or --points.",
)
@click.option("--points", type=FILE, metavar="FILE.points", help="Control points as QGIS writes them.")
@click.option("--unknown-scale", is_flag=True, help="The scale is not known: write pixels as if they were metres.")
@click.option("--start", metavar="PX,PY", help="Where the line starts.")
@click.option("--end", metavar="PX,PY", help="Where it ends.")
@click.option(
    "--via",
    metavar="PX,PY",
    multiple=True,
    help="Points on the way, in order: two in each loop that crosses the line. Several are allowed.",
)
@click.option("--loops", is_flag=True, help="Go straight on at crossings instead of taking the shortest way.")
@click.option(
    "--line",
    type=click.Choice(["auto", "single", "double"]),
    default="auto",
    show_default=True,
    help="One stroke, or the track's two edges, between which the middle is wanted.",
)
@click.option("--page", type=int, default=1, show_default=True, help="Page of a PDF or a TIFF.")
@click.option("--dpi", type=float, default=200.0, show_default=True, help="Resolution at which PDF and SVG are drawn.")
@report_option
def command(
    picture: Path,
    output: Path,
    scale: float | None,
    points: Path | None,
    unknown_scale: bool,
    start: str | None,
    end: str | None,
    via: tuple[str, ...],
    loops: bool,
    line: str,
    page: int,
    dpi: float,
    report: Path | None,
) -> None:
    """Follow the drawn line in PICTURE from --start to --end to a fraction of a pixel.

    Pixels count from the top left pixel's centre, 0,0; those of PDF and SVG are the ones at --dpi.
    Writes x_m, y_m, px, py, confidence: y points
    up, the origin is the first point, the axes are the picture's.
    """
    if start is None or end is None:
        raise click.UsageError("say where the line starts and ends: --start PX,PY --end PX,PY")
    clicks = np.array([_pixel(text) for text in (start, *via, end)])
    check_outputs([output, report], inputs=[picture, points])
    image = read_picture(picture, page=page, dpi=dpi)
    notes = list(image.notes)
    if image.world is not None and (scale is not None or points is not None or unknown_scale):
        notes.append("the picture's own scale, from a world file or its tags, was not used: another one was given")
    for note in notes:
        click.echo(f"note: {picture}: {note}", err=True)
    calibration = _calibration(picture, image, scale, points, unknown=unknown_scale)

    started = time.perf_counter()
    trace = _traced(picture, image, clicks, loops=loops, settings=_settings(line))
    seconds = time.perf_counter() - started
    _refuse_nothing(picture, trace)
    metres = calibration.to_metres(trace.points)
    metres = metres - metres[0]
    length = float(np.hypot(*np.diff(metres, axis=0).T).sum())
    sigma = _length_sigma(calibration, length)

    if report is not None:
        write_atomic(
            report,
            to_json(
                {
                    "clicks": len(clicks),
                    "seconds": seconds,
                    "confidence_mean": float(trace.confidence.mean()),
                    "confidence_min": float(trace.confidence.min()),
                    "plan_length_m": length,
                    "plan_length_sigma_m": sigma,
                    "metres_per_pixel": calibration.metres_per_pixel,
                    "length_px": trace.length_px,
                    "line_width_px": trace.line_width_px,
                    "kind": trace.kind,
                    "warnings": list(trace.warnings),
                    "notes": notes,
                }
            ),
        )
    write_atomic(output, trace_table(metres, trace))
    for warning in trace.warnings:
        click.echo(f"note: {warning}", err=True)
    unit = "m" if calibration.scale_known else "px"
    click.echo(
        f"{len(trace.points)} points, plan length {length:.2f} ± {sigma:.2f} {unit}, mean confidence"
        f" {trace.confidence.mean():.2f}, a {trace.kind} line {trace.line_width_px:.1f} px wide; written to {output}"
    )


def _settings(line: str) -> TraceSettings:
    if line == "single":
        return TraceSettings(line="single")
    return TraceSettings(line="double") if line == "double" else TraceSettings()


def _traced(picture: Path, image: PlanImage, clicks: FloatArray, *, loops: bool, settings: TraceSettings) -> Trace:
    try:
        if loops:
            proposal = with_progress(propose_loops(image.pixels, clicks, settings=settings), "tracing")
            if proposal is not None:
                return proposal
            click.echo("note: no way around a loop was found; this is the shortest way", err=True)
        return with_progress(trace_line(image.pixels, clicks, settings=settings), "tracing")
    except InputError as error:
        raise InputError(f"{picture}: {error}") from error


def _refuse_nothing(picture: Path, trace: Trace) -> None:
    """Refuse a trace that is no line, so that no plan of blank paper is written."""
    if trace.length_px < _SHORTEST_PX:
        raise InputError(f"{picture}: start and end are the same place, {trace.length_px:.0f} px apart along the line")
    if float(trace.confidence.mean()) < _NO_LINE:
        raise InputError(f"{picture}: there is no line between the points; start and end must lie on it")


def _calibration(
    picture: Path, image: PlanImage, scale: float | None, points: Path | None, *, unknown: bool
) -> Calibration:
    """Return the one calibration that was given, by option or by the file itself."""
    given = [
        name
        for name, wanted in (
            ("--scale", scale is not None),
            ("--points", points is not None),
            ("--unknown-scale", unknown),
        )
        if wanted
    ]
    if len(given) > 1:
        raise click.UsageError(f"{given[0]} and {given[1]} contradict each other; give one of them")
    if unknown:
        return calibrations.unknown_scale()
    if scale is not None:
        if not _SCALES[0] <= scale <= _SCALES[1]:
            raise click.UsageError(
                f"--scale must be between {_SCALES[0]:g} and {_SCALES[1]:g} metres per pixel, not {scale:g}"
            )
        return calibrations.calibration_from_scale(scale)
    if points is not None:
        known = parse_qgis_points(decode_text(read_bytes(points), name=str(points)), name=str(points))
        fit = fit_calibration(known.points)
        for sentence in calibration_sentences(fit, plan_length_m=None):
            click.echo(f"note: {sentence}", err=True)
        misfit = misfit_sentence(fit, known.points)
        if misfit is not None:
            click.echo(f"warning: {misfit}", err=True)
        return fit.calibration
    if image.world is not None:
        return calibrations.calibration_from_world(image.world, name=str(picture))
    raise click.UsageError(
        "the picture has no scale of its own: give --scale M_PER_PX, --points FILE.points or --unknown-scale"
    )


def _length_sigma(calibration: Calibration, length: float) -> float:
    """Return 1 sigma of the plan length, m: of the scale, and of the two clicked ends."""
    of_scale = calibrations.plan_length_sigma(calibration, length) or 0.0
    of_ends = math.sqrt(2) * _END_SIGMA_PX * calibration.metres_per_pixel
    return math.hypot(of_scale, of_ends)
