"""The plan length and what it is uncertain by, worked out beside the window."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bobdesk.plan.calibration import plan_length_sigma
from bobdesk.project import derive
from bobdesk.project.project import Project


@dataclass(frozen=True)
class PlanLength:
    """A length in metres with 1 sigma from the scale and from the vertices; None where nothing is known.

    `is_scaled` is false if the length counts in units that nobody knows.
    """

    length: float
    by_scale: float | None
    by_vertices: float | None
    is_scaled: bool

    @property
    def sigma(self) -> float | None:
        """Both together; None if neither is known."""
        known = [part for part in (self.by_scale, self.by_vertices) if part is not None]
        return math.hypot(*known) if known else None


def plan_length(project: Project) -> PlanLength:
    """Return the plan length of a project; called on a thread.

    Raises
    ------
    InputError
        If there is no centreline yet.
    """
    from bobdesk.alignment.length_error import length_sigma_of_vertices

    line = derive.centreline(project).needed()
    vertices = derive.working_polyline(project).needed().vertices
    by_scale = None
    if project.source is None:
        by_scale = plan_length_sigma(derive.calibration(project).needed(), line.length)
    return PlanLength(
        line.length,
        by_scale,
        length_sigma_of_vertices(
            line, vertex_distance=line.length / (len(vertices) - 1), wavelength=project.fit.wavelength
        ),
        derive.scale_is_known(project),
    )
