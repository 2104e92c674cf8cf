"""What a user does to the plan itself: picture, coordinates, names."""

from __future__ import annotations

from dataclasses import replace

from bobdesk.alignment.segments import Segments
from bobdesk.errors import InputError
from bobdesk.plan.projection import is_place
from bobdesk.plan.trace_vertices import enlarged
from bobdesk.project.project import ActualTrack, CalibrationChoice, Extent, Picture, Project, SourceLine


def name_project(project: Project, name: str) -> Project:
    """Give the project a name."""
    return replace(project, name=name.strip())


def write_notes(project: Project, notes: str) -> Project:
    """Write down what is worth knowing."""
    return replace(project, notes=notes)


def open_picture(project: Project, picture: Picture) -> Project:
    """Begin with a picture; line, control points and hand-made segments of another plan are put away."""
    way = "world" if picture.world is not None else "points"
    return replace(
        _without_plan(project),
        picture=picture,
        calibration=CalibrationChoice(way="world" if way == "world" else "points"),
    )


def open_coordinates(project: Project, source: SourceLine, segments: Segments | None = None) -> Project:
    """Begin with a line from a file; line, picture and hand-made segments of another plan are put away.

    Parameters
    ----------
    source
        The line.
    segments
        Those that the file says it has, or None to find them.

    Raises
    ------
    InputError
        If its longitude and latitude are no place on the Earth.
    """
    place = (source.longitude, source.latitude)
    if place != (None, None) and not is_place(*place):
        raise InputError("the longitude and latitude of the plan are no place on the Earth")
    return replace(_without_plan(project), source=source, segments=segments)


def redraw_page(project: Project, picture: Picture) -> Project:
    """Show the same page at another resolution: everything that was placed on it stays on its place.

    Parameters
    ----------
    picture
        With the same bytes and page as now, and the new dpi and size.

    Raises
    ------
    InputError
        If it is another picture or page.
    """
    old = project.picture
    if old is None or picture.page != old.page or picture.data != old.data:
        raise InputError("that is another picture; open it as a new plan")
    if old.size_px is None or picture.size_px is None:
        raise InputError("the size of the picture is not known yet")
    factor = picture.size_px[0] / old.size_px[0]

    def placed(x: float, y: float) -> tuple[float, float]:
        return (x + 0.5) * factor - 0.5, (y + 0.5) * factor - 0.5

    def moved_points() -> Project:
        points = []
        for point in project.control_points:
            x, y = placed(point.x_px, point.y_px)
            points.append(replace(point, x_px=x, y_px=y))
        return replace(project, control_points=tuple(points))

    known, checks = (
        tuple(replace(item, start_px=placed(*item.start_px), end_px=placed(*item.end_px)) for item in distances)
        for distances in (project.known_distances, project.check_distances)
    )
    extent, choice = project.extent, project.calibration
    if project.source is None:
        finish = None if extent.finish is None else factor * extent.finish
        cut_off = None if extent.cut_off is None else factor * extent.cut_off
        extent = replace(extent, start=factor * extent.start, finish=finish, cut_off=cut_off)
    if choice.metres_per_pixel is not None:
        choice = replace(choice, metres_per_pixel=choice.metres_per_pixel / factor)
    return replace(
        moved_points(),
        picture=picture,
        known_distances=known,
        check_distances=checks,
        calibration=choice,
        trace=None if project.trace is None else enlarged(project.trace, factor),
        extent=extent,
    )


def compare_with(project: Project, actual: ActualTrack) -> Project:
    """Lay the actual track beside the results."""
    return replace(project, actual=actual)


def compare_with_nothing(project: Project) -> Project:
    """Take the actual track away."""
    return replace(project, actual=None)


def _without_plan(project: Project) -> Project:
    return replace(
        project,
        picture=None,
        control_points=(),
        known_distances=(),
        check_distances=(),
        calibration=CalibrationChoice(),
        trace=None,
        source=None,
        extent=Extent(),
        segments=None,
    )
