"""Where things lie: plan units (picture pixels, or metres of a plan from coordinates), scene and screen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import QPointF, QRectF

from bobdesk.arrays import FloatArray
from bobdesk.project.project import Project

Place = tuple[float, float]
_SHOWN_BEFORE_A_SIZE_IS_KNOWN = QRectF(-0.5, -0.5, 1600, 1000)


@dataclass(frozen=True)
class Space:
    """What the scene's coordinates mean.

    Attributes
    ----------
    kind
        "picture": the scene is in picture pixels, y down, pixel centres at whole numbers. "coordinates": it
        is in metres with y turned over. "nothing": there is no plan.
    bounds
        What there is to see, scene coordinates.
    """

    kind: Literal["nothing", "picture", "coordinates"]
    bounds: QRectF

    @property
    def y_sign(self) -> float:
        """Scene y per plan y."""
        return -1.0 if self.kind == "coordinates" else 1.0

    def to_scene(self, place: Place) -> QPointF:
        """Return where a place of the plan lies in the scene."""
        return QPointF(place[0], self.y_sign * place[1])

    def to_plan(self, point: QPointF) -> Place:
        """Return the place of the plan at a point of the scene."""
        return point.x(), self.y_sign * point.y()


def space_of(project: Project, size_px: tuple[int, int] | None) -> Space:
    """Return the space of a project; `size_px` is the decoded picture's width and height, if it is ready."""
    if project.source is not None:
        return Space("coordinates", _around(project.source.polyline.vertices * [1.0, -1.0]))
    if project.picture is not None:
        size = size_px or project.picture.size_px
        if size is not None:
            return Space("picture", QRectF(-0.5, -0.5, *size))
        return Space("picture", _SHOWN_BEFORE_A_SIZE_IS_KNOWN)
    if project.trace is not None:
        return Space("picture", _around(project.trace.points))
    return Space("nothing", _SHOWN_BEFORE_A_SIZE_IS_KNOWN)


def digitised_points(project: Project) -> FloatArray | None:
    """Return the vertices (n, 2) of the line in plan units, or None before there is one."""
    if project.source is not None:
        return project.source.polyline.vertices
    return None if project.trace is None else project.trace.points


def rectangle_around(points: npt.ArrayLike) -> QRectF:
    """Return the smallest rectangle around points (n, 2)."""
    array = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    (left, top), (right, bottom) = array.min(axis=0), array.max(axis=0)
    return QRectF(float(left), float(top), float(right - left), float(bottom - top))


def _around(points: FloatArray) -> QRectF:
    tight = rectangle_around(points)
    margin = 0.05 * max(tight.width(), tight.height(), 1.0)
    return tight.adjusted(-margin, -margin, margin, margin)


@dataclass(frozen=True)
class Frame:
    """What one frame shows, for those who paint in pixels of the screen.

    Attributes
    ----------
    scale
        Screen pixels per plan unit.
    left, top
        Where the plan's origin lies on the screen.
    y_sign
        -1 where the plan's y goes up.
    width, height
        Of the view, screen pixels.
    """

    scale: float
    left: float
    top: float
    y_sign: float
    width: int
    height: int

    @property
    def per_screen(self) -> float:
        """Plan units per screen pixel."""
        return 1.0 / self.scale

    def to_screen(self, points: FloatArray) -> FloatArray:
        """Return screen places (n, 2) of plan places (n, 2)."""
        screen: FloatArray = points * [self.scale, self.scale * self.y_sign] + [self.left, self.top]
        return screen

    def point(self, place: Place) -> QPointF:
        """Return where a place of the plan lies on the screen."""
        return QPointF(place[0] * self.scale + self.left, place[1] * self.scale * self.y_sign + self.top)

    def sees(self, point: QPointF, margin: float = 40.0) -> bool:
        """Return whether a point of the screen lies in the view, or near it."""
        return -margin <= point.x() <= self.width + margin and -margin <= point.y() <= self.height + margin
