"""A report of a run: pictures, figures, settings and sources, in the user's language."""

from __future__ import annotations

import base64
import html
from collections.abc import Callable

from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QObject, QSizeF, QUrl
from PySide6.QtGui import QImage, QPageLayout, QPageSize, QPdfWriter, QTextDocument

from bobdesk import __version__
from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.track.comparison import Comparison
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.solve.report_open_data import ReportOnOpenData
from bobdesk.ui.solve.run_figures import actual_figures, mean_of

Rows = list[tuple[str, ...]]
_STYLE = """
body { font-family: "DejaVu Sans", Arial, sans-serif; font-size: 10pt; color: #22252b; }
h1 { font-size: 18pt; margin-bottom: 2pt; } h2 { font-size: 12pt; margin-top: 14pt; }
table { border-collapse: collapse; width: 100%; } td, th { padding: 2pt 6pt; border-bottom: 1px solid #d5dae1; }
th { text-align: left; color: #5f6672; } td.n, th.n { text-align: right; } p.muted { color: #5f6672; }
"""
_PICTURE = "line.png"


class Report(QObject):
    """Text and pictures of one run.

    Parameters
    ----------
    pictures
        Names and PNG bytes, in order, with a caption each.
    open_data
        The error budget and the design rules.
    """

    def __init__(
        self,
        project: Project,
        run: Run,
        comparison: Comparison | None,
        pictures: list[tuple[str, bytes]],
        quantities: Quantities,
        why_out_of_date: str | None,
        open_data: ReportOnOpenData,
    ) -> None:
        super().__init__()
        self._project, self._run, self._comparison = project, run, comparison
        self._pictures, self._unit, self._why = pictures, quantities, why_out_of_date
        self._open_data = open_data

    def html(self) -> bytes:
        """Return one file that holds everything."""
        sources = [
            f"data:image/png;base64,{base64.b64encode(content).decode('ascii')}" for _, content in self._pictures
        ]
        return self._page(sources, width="100%").encode("utf-8")

    def pdf(self) -> bytes:
        """Return pages in A4."""
        buffer = QBuffer()
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        writer = QPdfWriter(buffer)
        writer.setPageSize(QPageSize(QPageSize.PageSizeId.A4))
        writer.setPageMargins(QMarginsF(18, 16, 18, 16), QPageLayout.Unit.Millimeter)
        writer.setResolution(96)
        writer.setTitle(self._title())
        writer.setCreator(f"BobDesk {__version__}")
        document = QTextDocument()
        size = QSizeF(writer.pageLayout().paintRectPixels(96).size())
        names = []
        for index, (_, content) in enumerate(self._pictures):
            name = f"{index}-{_PICTURE}"
            names.append(name)
            document.addResource(QTextDocument.ResourceType.ImageResource.value, QUrl(name), QImage.fromData(content))
        document.setPageSize(size)
        document.setHtml(self._page(names, width=str(int(size.width()))))
        document.setPageSize(size)
        document.print_(writer)
        buffer.close()
        return bytes(buffer.data().data())

    def _title(self) -> str:
        return (self._project.name or self.tr("Track")) + f" – {self._run.name}"

    def _page(self, sources: list[str], *, width: str) -> str:
        run = self._run
        parts = [f"<h1>{_safe(self._title())}</h1>", f'<p class="muted">{_safe(self._subtitle())}</p>']
        if self._why:
            out_of_date = self.tr("Out of date: {why}.").format(why=self._why)
            parts.append(f"<p><b>{_safe(out_of_date)}</b></p>")
        parts += self._table(self.tr("Figures"), self._figures(), heads=self._heads())
        if self._comparison is not None:
            parts += self._table(self.tr("Beside the actual track"), self._compared(self._comparison))
        for index, ((caption, _), source) in enumerate(zip(self._pictures, sources, strict=True)):
            # A caption stays with its picture.
            style = ' style="page-break-before: always"' if index else ""
            parts += [
                f"<h2{style}>{_safe(caption)}</h2>",
                f'<img src="{source}" width="{width}" alt="{_safe(caption)}">',
            ]
        budget, rules = self._open_data.budget(), self._open_data.rules()
        parts += self._table(self.tr("Error budget, 95 %"), budget, heads=self._open_data.budget_heads())
        sentence = self._open_data.budget_sentence()
        parts.append(f"<p>{_safe(sentence)}</p>")
        parts += self._table(self.tr("Design rules"), rules, heads=self._open_data.rule_heads(), numbers=False)
        parts += self._table(self.tr("Known elevations"), self._known())
        parts += self._table(self.tr("Settings"), self._settings())
        parts += self._table(self.tr("Segments"), self._segments(), heads=self._segment_heads())
        parts += self._table(self.tr("Sources"), self._sources())
        if self._project.notes.strip():
            lines = "<br>".join(_safe(line) for line in self._project.notes.splitlines())
            heading = self.tr("Notes")
            parts += [f"<h2>{_safe(heading)}</h2>", f"<p>{lines}</p>"]
        parts.append(f'<p class="muted">{_safe(self._unit.sentence(run.message))} BobDesk {__version__}.</p>')
        body = "\n".join(parts)
        return (
            '<!DOCTYPE html>\n<html><head><meta charset="utf-8">'
            f"<title>{_safe(self._title())}</title><style>{_STYLE}</style></head>\n<body>\n{body}\n</body></html>\n"
        )

    def _subtitle(self) -> str:
        run, number = self._run, self._unit.number
        return self.tr("{method}, targets {targets}, {count} iterations in {seconds} s").format(
            method=run.inputs.settings.method,
            targets=run.target_set,
            count=number(run.nit, 0),
            seconds=number(run.seconds, 2),
        )

    def _heads(self) -> tuple[str, ...]:
        heads = ("", self.tr("Result"), self.tr("Target"))
        return heads if self._project.actual is None else (*heads, self.tr("Actual"))

    def _figures(self) -> Rows:
        unit, found, wanted = self._unit, self._run.figures, self._run.inputs.targets
        actual = None if self._project.actual is None else actual_figures(self._project.actual)
        named = wanted.mean_gradient_is

        def real(name: str) -> float | None:
            found: float | None = getattr(actual, name, None)
            return found

        def metres(value: float | None) -> str:
            return unit.length(value, 3)

        def gradient(value: float | None) -> str:
            return unit.gradient(value, 2)

        def row(
            name: str, value: float, target: float | None, real: float | None, show: Callable[[float | None], str]
        ) -> tuple[str, ...]:
            cells = (name, show(value), show(target))
            return cells if actual is None else (*cells, show(real))

        return [
            row(self.tr("Length"), found.length, wanted.length, real("length"), metres),
            row(self.tr("Height difference"), found.drop, wanted.drop, real("drop"), metres),
            row(self.tr("Length in plan"), found.plan_length, None, real("plan_length"), metres),
            row(self.tr("Mean gradient"), mean_of(found, named), wanted.mean_gradient,
                None if actual is None else mean_of(actual, named), gradient),
            row(self.tr("Largest gradient"), found.max_gradient, wanted.max_gradient, real("max_gradient"),
                gradient),
            row(self.tr("Smallest gradient"), found.min_gradient, wanted.min_gradient, real("min_gradient"),
                gradient),
            row(self.tr("Scale factor f"), self._run.scale * self._run.inputs.factor, None, None,
                lambda value: unit.number(value, 5)),
        ]  # fmt: skip

    def _compared(self, found: Comparison) -> Rows:
        unit = self._unit
        return [
            (self.tr("Elevation, root mean square"), unit.length(found.z_rms, 3),
             self.tr("{value} % of the drop").format(value=unit.number(found.z_rms_percent, 2))),
            (self.tr("Elevation, largest"), unit.length(found.z_max, 3),
             self.tr("at {station}").format(station=unit.length(found.z_max_station, 0))),
            (self.tr("Gradient, root mean square"), unit.gradient(found.gradient_rms, 3), ""),
        ]  # fmt: skip

    def _known(self) -> Rows:
        unit = self._unit
        return [
            (unit.length(known.station, 2), unit.length(known.elevation, 2), f"± {unit.length(known.tolerance, 2)}")
            for known in self._run.inputs.targets.known
        ]

    def _settings(self) -> Rows:
        unit, settings = self._unit, self._run.inputs.settings
        rows: Rows = [
            (self.tr("Spacing of the stations"), unit.length(self._run.inputs.fit.spacing, 2)),
            (self.tr("Smoothing, wavelength"), unit.length(self._run.inputs.fit.wavelength, 1)),
        ]
        if settings.method == "pgd":
            pgd = settings.pgd
            return [
                *rows,
                (self.tr("Meet the length"), self.tr("yes") if pgd.meet_length else self.tr("no")),
                (self.tr("Largest swing"), unit.gradient(pgd.plausible, 1)),
                (self.tr("Vertical transitions"), unit.length(pgd.transition, 1)),
                (self.tr("Level out over"), unit.length(pgd.level_out, 1)),
            ]
        weights = settings.weights
        named = "a {}, b {}, c {}, d {}".format(
            *(unit.short(one, 6) for one in (weights.length, weights.height, weights.curvature, weights.gradient))
        )
        rate, threshold = unit.short(settings.rate, 6), unit.short(settings.threshold, 6)
        return [*rows, (self.tr("Weights"), named), ("η", rate), ("δ", threshold)]

    def _segment_heads(self) -> tuple[str, ...]:
        return (self.tr("Segment"), self.tr("Kind"), self.tr("From"), self.tr("To"))

    def _segments(self) -> Rows:
        unit, scale = self._unit, self._run.scale
        kinds = {"straight": self.tr("straight"), "curve": self.tr("curve")}
        return [
            (
                segment.name or str(index),
                kinds[segment.kind],
                unit.length(scale * segment.start, 1),
                unit.length(scale * segment.end, 1),
            )
            for index, segment in enumerate(self._run.inputs.segments, 1)
        ]

    def _sources(self) -> Rows:
        project = self._project
        rows: Rows = []
        if project.picture is not None:
            rows.append((self.tr("Picture of the plan"), project.picture.name))
        if project.source is not None:
            rows.append((self.tr("Coordinates of the plan"), project.source.name))
        if project.actual is not None:
            rows.append((self.tr("Actual track"), project.actual.name))
        return rows

    def _table(self, heading: str, rows: Rows, heads: tuple[str, ...] = (), *, numbers: bool = True) -> list[str]:
        if not rows:
            return []
        right = " class=n align=right" if numbers else ""
        lines = [f"<h2>{_safe(heading)}</h2>", '<table width="100%">']
        if heads:
            cells = "".join(f"<th{right if at else ''}>{_safe(cell)}</th>" for at, cell in enumerate(heads))
            lines.append(f"<tr>{cells}</tr>")
        for row in rows:
            cells = "".join(f"<td{right if at else ''}>{_safe(cell)}</td>" for at, cell in enumerate(row))
            lines.append(f"<tr>{cells}</tr>")
        return [*lines, "</table>"]


def _row(cells: tuple[str, ...], tag: str) -> str:
    first, *others = (_safe(cell) for cell in cells)
    right = "".join(f'<{tag} class="n" align="right">{cell}</{tag}>' for cell in others)
    return f"<tr><{tag}>{first}</{tag}>{right}</tr>"


def _safe(text: str) -> str:
    return html.escape(text)
