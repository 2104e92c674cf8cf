"""The main job, by the window's own tools: from the picture of a plan to a 3D line in a file, against the truth."""

from __future__ import annotations

import importlib.util
import json
import shutil
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from PySide6.QtCore import QPointF, Qt

from bobdesk.alignment.boundary_comparison import boundaries_of, compare_boundaries
from bobdesk.arrays import FloatArray
from bobdesk.files.atomic import write_atomic
from bobdesk.files.processes import process_executor
from bobdesk.files.project_file import load_project, save_project
from bobdesk.plan.control_points import ControlPoint
from bobdesk.project import derive, edits
from bobdesk.solve.targets import KnownElevation
from bobdesk.ui.plan_view.tools.tool import Pointer
from bobdesk.ui.resources import resource
from bobdesk.ui.selftest.record import Record, SelfTestError
from bobdesk.ui.selftest.unseen_window import UnseenWindow

if TYPE_CHECKING:
    from bobdesk.track.centreline3d import Centreline3D

_SAMPLE = "made_thin"
# How far the result may be off the truth: what is asked of an analyst's work with two known elevations.
_LARGEST_PERCENT = 0.1
_LARGEST_Z_RMS_PERCENT = 4.0
_LARGEST_MEDIAN_M = 0.5
_BOUNDARY_WITHIN_M = 5.0
_LOWEST_F1 = 0.9
# A table is rounded; its line is that of the window but for this, m.
_ROUNDING_M = 2e-3
# A pixel of a printed page is dark under this.
_DARK = 128
_PAGE_DPI = 150.0
_LEAST_INK = 0.005


class MainJob:
    """The steps in their order.

    Parameters
    ----------
    folder
        To work in.
    """

    def __init__(self, unseen: UnseenWindow, record: Record, folder: Path) -> None:
        self._unseen, self._record, self._folder = unseen, record, folder
        self._window = unseen.window
        self._desk = unseen.window.desk
        sample = resource("samples", _SAMPLE)
        self._about: dict[str, Any] = json.loads((sample / "truth.json").read_text(encoding="utf-8"))
        self._truth = np.genfromtxt(sample / "truth.csv", delimiter=",", names=True)
        self._line = folder / "line.csv"
        self._project = folder / "project.bobdesk"

    def do(self) -> None:
        """Do all steps.

        Raises
        ------
        SelfTestError
            If one fails, or the result is not as near to the truth as it has to be.
        """
        with self._record.step("open the sample picture"):
            self._open_picture()
        with self._record.step("scale it by two points"):
            self._scale()
        with self._record.step("trace the line"):
            self._trace()
        with self._record.step("find straights and curves"):
            self._window.go_to("Segments")
            self._until(lambda project: derive.segments(project).value is not None, "segments are found")
        with self._record.step("solve"):
            self._solve()
        with self._record.step("show the result in space"):
            self._window.views.show_in_space(True)
            self._unseen.until_quiet()
            self._window.views.show_in_space(False)
        with self._record.step("export as CSV"):
            self._export()
        with self._record.step("read the export and compare it with the truth"):
            line = self._compare()
        with self._record.step("calculate in a second process"):
            self._in_a_process(line)
        with self._record.step("write a drawing and read it in its process"):
            self._drawing(line)
        with self._record.step("write a report and look at its page"):
            self._report()
        with self._record.step("save the project, open it, change it, save it again"):
            self._save()

    def _open_picture(self) -> None:
        picture = self._folder / "plan.jpg"
        shutil.copyfile(resource("samples", _SAMPLE, "plan.jpg"), picture)
        self._window.open_file(picture)
        self._unseen.until(lambda: self._desk.picture.image is not None, "the picture is shown")

    def _scale(self) -> None:
        self._window.go_to("Scale")
        for row in (self._truth[0], self._truth[-1]):
            point = ControlPoint(float(row["px"]), float(row["py"]), float(row["x_m"]), float(row["y_m"]))
            self._edit("Place a control point", lambda project, point=point: edits.add_control_point(project, point))
        self._until(lambda project: derive.calibration(project).value is not None, "the scale is known")

    def _trace(self) -> None:
        self._window.go_to("Centreline")
        self._window.view.set_tool("auto_trace")
        tool = self._window.view.tool("auto_trace")
        for place in (self._about["start_px"], self._about["end_px"]):
            x, y = float(place[0]), float(place[1])
            tool.press(Pointer((x, y), QPointF(x, y), 1.0, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier))
        self._until(lambda project: project.trace is not None, "the line is traced")
        self._unseen.until_quiet()

    def _solve(self) -> None:
        self._window.go_to("Solve")
        length, drop = round(self._about["length_m"], 2), round(self._about["drop_m"], 2)
        self._edit("Set length", lambda project: edits.set_length(project, length))
        self._edit("Set height difference", lambda project: edits.set_drop(project, drop))
        low = float(self._truth["z_m"].min())
        for share in (1 / 3, 2 / 3):
            row = self._truth[round(share * (len(self._truth) - 1))]
            known = KnownElevation(float(row["station_m"]), round(float(row["z_m"]) - low, 2))
            self._edit("Add a known elevation", lambda project, known=known: edits.add_known_elevation(project, known))
        action = self._window.actions_by_name["run"]
        self._unseen.until(action.isEnabled, "the targets can be solved for")
        action.trigger()
        self._until(lambda project: project.run is not None, "there is a result")
        self._unseen.until_quiet()

    def _export(self) -> None:
        self._window.export()
        panel: Any = self._window.panels.stack.currentWidget()
        self._unseen.until(
            lambda: panel.later.is_current and panel.later.value is not None, "the bytes of the file are prepared"
        )
        write_atomic(self._line, panel.later.value.content)

    def _compare(self) -> Centreline3D:
        from bobdesk.files.importers.line3d import read_line3d
        from bobdesk.project.derive_runs import run_line
        from bobdesk.track.comparison import compare
        from bobdesk.track.figures import figures

        project = self._desk.session.project
        run, pixels = project.run, derive.calibration(project).value
        if run is None or pixels is None:
            raise SelfTestError("the result has gone")
        line = read_line3d(self._line).line
        shown = run_line(run)
        apart = float(np.abs(line.points - shown.points).max())
        true = np.column_stack([self._truth["x_m"], self._truth["y_m"], self._truth["z_m"]])
        found = compare(line.points, true)
        stated = [segment["to_m"] for segment in self._about["segments"][:-1]]
        boundaries = compare_boundaries(boundaries_of(run.inputs.segments), np.array(stated), within=_BOUNDARY_WITHIN_M)
        median = _median_distance(line.points, true)
        self._record.put("figures", {**asdict(figures(shown)), "metres_per_pixel": pixels.metres_per_pixel})
        self._record.put(
            "against_the_truth", {**asdict(found), "boundaries_f1": boundaries.f1, "plan_median_m": median}
        )
        self._record.put(
            "counts",
            {
                "traced_points": 0 if project.trace is None else len(project.trace.points),
                "rows": len(line.points),
                "segments": len(run.inputs.segments),
                "iterations": run.nit,
            },
        )
        for what, value, limit in (
            ("a line that is read is off the one that was written by {:.4f} m", apart, _ROUNDING_M),
            ("the length is off the truth by {:.3f} %", abs(found.length_percent), _LARGEST_PERCENT),
            ("the height difference is off the truth by {:.3f} %", abs(found.drop_percent), _LARGEST_PERCENT),
            ("elevations are off the truth by {:.2f} % of the drop", found.z_rms_percent, _LARGEST_Z_RMS_PERCENT),
            ("the plan is off the truth by {:.2f} m", median, _LARGEST_MEDIAN_M),
            ("boundaries of segments agree with the truth by 1 - {:.3f}", 1 - boundaries.f1, 1 - _LOWEST_F1),
        ):
            if not value <= limit:
                raise SelfTestError(what.format(value))
        return line

    def _in_a_process(self, line: Centreline3D) -> None:
        """Hand the line to a process as studies do, and have its figures back."""
        from bobdesk.track.figures import figures

        with process_executor(1) as executor:
            if executor.submit(figures, line).result(timeout=60) != figures(line):
                raise SelfTestError("a second process has other figures of the same line")

    def _drawing(self, line: Centreline3D) -> None:
        """Write DXF, and read it where hostile drawings can do no harm; that needs an extra."""
        from bobdesk.files.exporters.formats import export_line
        from bobdesk.files.importers.formats import read_line

        if importlib.util.find_spec("ezdxf") is None:
            self._record.note("DXF drawings are not read here, since the extra [cad] is not installed")
            return
        drawing = self._folder / "line.dxf"
        write_atomic(drawing, export_line(line, format="dxf"))
        vertices = read_line(drawing).polyline.vertices
        apart = float(np.hypot(*(vertices[-1] - vertices[0] - (line.points[-1] - line.points[0])[:2])))
        if not apart <= _ROUNDING_M:
            raise SelfTestError(f"the line of a drawing that is read ends {apart:.3f} m off the one that was written")

    def _report(self) -> None:
        """Write the report as PDF; without letters its page would be nearly empty."""
        from bobdesk.files.pictures import read_picture
        from bobdesk.ui.solve.report_saving import ReportSaving

        page = self._folder / "report.pdf"
        ReportSaving(self._desk, self._window.questions, self._window).write("pdf", page)
        self._unseen.until(page.exists, "the report is written")
        ink = float((read_picture(page, dpi=_PAGE_DPI).pixels.mean(axis=2) < _DARK).mean())
        self._record.put("report_ink", ink)
        if ink < _LEAST_INK:
            raise SelfTestError(f"the report is empty: {100 * ink:.2f} % of its page is dark")

    def _save(self) -> None:
        session = self._desk.session
        before = session.project
        save_project(before, self._project)
        session.saved(before, self._project)
        self._window.open_file(self._project)
        self._until(lambda project: project is not before and project.run is not None, "the project is opened")
        if session.path != self._project:
            raise SelfTestError("the project is opened as another file")
        if derive.centreline(session.project).needed().length != derive.centreline(before).needed().length:
            raise SelfTestError("the centreline of the project that was read is another one")
        self._edit("Write notes", lambda project: edits.write_notes(project, "ä ö ü ß"))
        self._window.documents.save()
        self._unseen.until(lambda: session.is_saved, "the project is saved again")
        self._unseen.until_quiet()
        if load_project(self._project).notes != "ä ö ü ß":
            raise SelfTestError("what was saved last is not in the project's file")

    def _edit(self, label: str, edit: Any) -> None:
        self._desk.session.apply(label, edit)
        self._unseen.check()

    def _until(self, true: Any, what: str) -> None:
        self._unseen.until(lambda: bool(true(self._desk.session.project)), what)


def _median_distance(line: FloatArray, true: FloatArray) -> float:
    """Return the median distance in plan between points at equal shares of two lines, m."""
    share = np.linspace(0.0, 1.0, len(true))
    at = []
    for points in (line, true):
        along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points[:, :2], axis=0).T))])
        at.append([np.interp(share, along / along[-1], points[:, axis]) for axis in (0, 1)])
    return float(np.median(np.hypot(at[0][0] - at[1][0], at[0][1] - at[1][1])))
