"""What a user does with a designer's list of curves."""

from __future__ import annotations

import math
from dataclasses import replace

from bobdesk.alignment.design import DesignList
from bobdesk.errors import InputError
from bobdesk.project.project import Project


def compare_with_design(project: Project, design: DesignList) -> Project:
    """Lay a designer's list of curves beside the segments."""
    return project if design == project.design else replace(project, design=design)


def move_design(project: Project, offset: float) -> Project:
    """Let the list's station 0 lie at another station of the line, m."""
    if project.design is None:
        raise InputError("there is no list of a designer to move")
    if not math.isfinite(offset):
        raise InputError("the place of the list is not a number")
    return compare_with_design(project, replace(project.design, offset=float(offset)))


def compare_with_no_design(project: Project) -> Project:
    """Take the designer's list away."""
    return project if project.design is None else replace(project, design=None)
