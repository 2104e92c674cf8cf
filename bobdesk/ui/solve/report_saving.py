"""Make a report and put it where the user wants it."""

from __future__ import annotations

from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from PySide6.QtCore import QObject

from bobdesk.errors import InputError, TargetError
from bobdesk.files.atomic import write_atomic
from bobdesk.progress import Progress
from bobdesk.project.project import Project
from bobdesk.project.runs import Run
from bobdesk.track.design_rules import Finding
from bobdesk.ui.desk import Desk
from bobdesk.ui.questions import Questions
from bobdesk.ui.solve.report import Report
from bobdesk.ui.solve.report_open_data import ReportOnOpenData
from bobdesk.ui.solve.usual_rules import rules_of
from bobdesk.ui.theme import on_paper

if TYPE_CHECKING:
    from bobdesk.solve.envelope import Envelope
    from bobdesk.track.centreline3d import Centreline3D
    from bobdesk.track.comparison import Comparison
    from bobdesk.track.error_budget import ErrorBudget

Kind = Literal["pdf", "html"]


class _Found(NamedTuple):
    line: Centreline3D
    band: Envelope | None
    comparison: Comparison | None
    budget: ErrorBudget | None
    why_no_budget: str
    findings: tuple[Finding, ...]


def _worked_out(project: Project, run: Run) -> Generator[Progress, None, _Found]:
    from bobdesk.project.derive_open import budget as budget_of
    from bobdesk.project.derive_runs import run_comparison, run_envelope, run_line, why_out_of_date
    from bobdesk.track.design_rules import judged

    yield Progress(0.0, "report")
    line = run_line(run)
    try:
        band = run_envelope(run)
    except TargetError:
        band = None
    budget, why = None, ""
    if why_out_of_date(project, run) is not None:
        why = "the result is out of date"
    else:
        try:
            budget = yield from budget_of(project)
        except (InputError, TargetError) as error:
            why = str(error)
    findings = judged(line, rules_of(project), project.sled)
    return _Found(line, band, run_comparison(project, run), budget, why, findings)


class ReportSaving(QObject):
    """Asks where, works figures out in the background, draws in the window's thread, and writes."""

    def __init__(self, desk: Desk, questions: Questions, parent: QObject) -> None:
        super().__init__(parent)
        self._desk = desk
        self._questions = questions

    def save(self, kind: Kind) -> None:
        """Ask where and write a report of the shown run."""
        project = self._desk.session.project
        if project.run is None:
            return
        name = (project.name or self.tr("track")) + f"-{project.run.name}.{kind}"
        path = self._questions.file_to_save("export", self.tr("Report"), name, f"{kind.upper()} (*.{kind})", f".{kind}")
        if path is not None:
            self.write(kind, path)

    def write(self, kind: Kind, path: Path) -> None:
        """Write a report of the shown run."""
        project = self._desk.session.project
        run = project.run
        if run is None:
            return

        def done(found: Any) -> None:
            self._write(kind, path, project, run, found)

        self._desk.runner.start(
            self.tr("Preparing the report"), lambda: _worked_out(project, run), done=done,
            failed=self._desk.notices.error,
        )  # fmt: skip

    def _write(self, kind: Kind, path: Path, project: Project, run: Run, found: _Found) -> None:
        from bobdesk.project.derive_runs import why_out_of_date
        from bobdesk.ui.plots.picture import draw_line
        from bobdesk.ui.view3d.picture import fitted_picture
        from bobdesk.ui.view3d.scene_making import SceneMaking

        line, band = found.line, found.band
        with on_paper():
            in_space = fitted_picture(SceneMaking(self._desk.quantities, self).scene(line, "gradient"))
        picture = draw_line(line, band, run.inputs.targets, title=project.name, kind=".png")
        pictures = [
            (self.tr("Plan, gradient and elevation"), picture),
            (self.tr("In space"), in_space),
        ]
        report = Report(
            project, run, found.comparison, pictures, self._desk.quantities, why_out_of_date(project, run),
            ReportOnOpenData(self._desk.quantities, found.budget, found.why_no_budget, found.findings),
        )  # fmt: skip
        try:
            write_atomic(path, report.pdf() if kind == "pdf" else report.html())
        except InputError as error:
            self._desk.notices.error(str(error))
            return
        self._desk.notices.note(self.tr("Written to {name}.").format(name=path.name))
