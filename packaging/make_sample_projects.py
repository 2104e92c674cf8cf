"""Make the finished sample projects that the start page opens, from the bundled pictures and figures.

usage: python packaging/make_sample_projects.py
"""

import json
import time
from pathlib import Path

import numpy as np

from bobdesk.files.importers.formats import read_line
from bobdesk.files.pictures import read_picture
from bobdesk.files.project_file import save_project
from bobdesk.plan.control_points import ControlPoint, KnownDistance
from bobdesk.plan.trace import trace_line
from bobdesk.progress import finish
from bobdesk.project import edits
from bobdesk.project.new_run import new_run
from bobdesk.project.project import ActualTrack, Picture, Project, SourceLine
from bobdesk.solve.targets import KnownElevation

SAMPLES = Path(__file__).parent.parent / "resources" / "samples"


def main() -> None:
    save(made("made_double", "A made track, two edges"), "made_double")
    save(made("made_thin", "A made track, a thin line"), "made_thin")
    save(mugello(), "mugello")
    for sample, name, title in (
        ("cortina_2026_design", "plan.csv", "Cortina 2026, from design figures"),
        ("sa_calobra", "sa_calobra.csv", "Sa Calobra, descent"),
        ("franciacorta", "franciacorta.csv", "Franciacorta, descent"),
    ):
        save(surveyed(sample, name, title), sample)


def made(sample: str, title: str) -> Project:
    """A made track with four control points, as an analyst would have it."""
    folder = SAMPLES / sample
    truth = json.loads((folder / "truth.json").read_text())
    table = np.genfromtxt(folder / "truth.csv", delimiter=",", names=True)
    project = opened(sample, "plan.jpg", title)
    width, height = project.picture.size_px
    scale = truth["metres_per_pixel"]
    first = table[0]
    for name, x_px, y_px in (
        ("A", 120.0, 90.0),
        ("B", width - 118.0, 95.0),
        ("C", width - 123.0, height - 79.0),
        ("D", 125.0, height - 84.0),
    ):
        east = first["x_m"] + (x_px - first["px"]) * scale
        north = first["y_m"] - (y_px - first["py"]) * scale
        # Read off a grid to 0.1 m.
        project = edits.add_control_point(project, ControlPoint(x_px, y_px, round(east, 1), round(north, 1), name))
    middle = table[len(table) // 2]
    check = KnownDistance(
        tuple(truth["start_px"]),
        (float(middle["px"]), float(middle["py"])),
        round(float(np.hypot(middle["x_m"] - first["x_m"], middle["y_m"] - first["y_m"])), 1),
        "start – half way",
    )
    project = edits.add_check_distance(project, check)
    project = traced(project, folder / "plan.jpg", [truth["start_px"], truth["end_px"]])
    project = edits.set_length(project, round(truth["length_m"], 1))
    project = edits.set_drop(project, round(truth["drop_m"], 1))
    for share in (0.25, 0.5, 0.75):
        row = table[round(share * (len(table) - 1))]
        known = KnownElevation(round(float(row["station_m"])), round(float(row["z_m"] - table["z_m"].min()), 1))
        project = edits.add_known_elevation(project, known)
    actual = ActualTrack("truth.csv", np.column_stack([table["x_m"], table["y_m"], table["z_m"]]))
    return solved(edits.compare_with(project, actual))


def mugello() -> Project:
    """A real descent, scaled by a known distance, with three known elevations."""
    where = json.loads((SAMPLES / "mugello" / "plan.json").read_text())
    project = opened("mugello", "plan.png", "Mugello, descent")
    project = edits.scale_by_number(project, where["metres_per_pixel"])
    project = traced(project, SAMPLES / "mugello" / "plan.png", [where["start_px"], where["end_px"]])
    project = edits.set_length(project, 703.70)
    project = edits.set_drop(project, 35.73)
    table = np.genfromtxt(SAMPLES / "mugello" / "mugello.csv", delimiter=",", names=True)
    for station in (175.5, 351.0, 526.5):
        elevation = np.interp(station, table["s2d_m"], table["z_m"]) - table["z_m"].min()
        project = edits.add_known_elevation(project, KnownElevation(station, round(float(elevation), 2)))
    actual = ActualTrack("mugello.csv", np.column_stack([table["x_m"], table["y_m"], table["z_m"]]))
    return solved(edits.compare_with(project, actual))


def surveyed(sample: str, name: str, title: str) -> Project:
    """A line with elevations: it is solved from its plan, length, drop and three elevations.

    Where it rises to its end, the elevations of the lowest point and of the end are known as well.
    """
    path = SAMPLES / sample / name
    found = read_line(path)
    points = np.column_stack([found.polyline.vertices, found.elevations])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points[:, :2], axis=0).T))])
    low = points[:, 2].min()
    project = edits.name_project(edits.open_coordinates(Project(), SourceLine(path.name, found.polyline)), title)
    project = edits.set_length(project, round(float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()), 2))
    project = edits.set_drop(project, round(float(points[0, 2] - low), 2))
    for share in (0.25, 0.5, 0.75):
        at = int(np.searchsorted(along, share * along[-1]))
        project = edits.add_known_elevation(
            project, KnownElevation(round(float(along[at]), 2), round(float(points[at, 2] - low), 2))
        )
    if points[-1, 2] > low:  # The track rises to its end, to slow the sled: where it is lowest is known.
        for at in (int(np.argmin(points[:, 2])), len(points) - 1):
            project = edits.add_known_elevation(
                project, KnownElevation(round(float(along[at]), 2), round(float(points[at, 2] - low), 2))
            )
    return solved(edits.compare_with(project, ActualTrack(path.name, points)))


def opened(sample: str, name: str, title: str) -> Project:
    path = SAMPLES / sample / name
    image = read_picture(path)
    picture = Picture(
        path.read_bytes(), name, size_px=(image.width, image.height), file_dpi=image.dpi, world=image.world
    )
    return edits.name_project(edits.open_picture(Project(), picture), title)


def traced(project: Project, path: Path, clicks: list[list[float]]) -> Project:
    image = read_picture(path)
    return edits.take_trace(project, finish(trace_line(image.pixels, clicks)))


def solved(project: Project) -> Project:
    run = finish(new_run(project, name="Run 1", clock=time.perf_counter))
    return edits.keep_run(project, run)


def save(project: Project, sample: str) -> None:
    path = SAMPLES / sample / f"{sample}.bobdesk"
    save_project(project, path)
    print(f"{path}: {path.stat().st_size:,} bytes, {project.run.message}")


if __name__ == "__main__":
    main()
