"""What follows from the project but takes longer than a frame: worked out in the background, newest first."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QCoreApplication, QObject, Signal

from bobdesk.project import derive
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.newest import Newest

if TYPE_CHECKING:
    from bobdesk.alignment.centreline import Centreline

Inputs = Callable[[Project], tuple[object, ...] | None]


class DerivedLater(QObject):
    """Follows the document: asks anew when what `function` needs is other objects than before.

    Parameters
    ----------
    title
        What is worked out, for the user.
    function
        Called on a thread with a project (a value that never changes); may raise InputError. A generator
        function may be stopped between two steps.
    inputs
        Returns what the function needs of a project, compared by identity; None if there is nothing to
        work out yet.

    Signals
    -------
    changed
        There is another value, or another sentence why there is none, or the value became out of date.
    """

    changed = Signal()

    def __init__(
        self, desk: Desk, title: str, function: Callable[[Project], Any], inputs: Inputs, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._desk = desk
        self._function = function
        self._inputs = inputs
        self._asked: tuple[object, ...] | None = None
        self._value: Any = None
        self._problem: str | None = None
        self._is_current = True
        self._newest = Newest(desk.runner, title, self)
        self._newest.answered.connect(self._on_answered)
        self._newest.failed.connect(self._on_failed)
        desk.session.changed.connect(self._on_changed)
        desk.session.document_changed.connect(self._forget)
        self._look(desk.session.project)

    @property
    def value(self) -> Any:
        """The newest value, perhaps of a project that is a few edits old; None if there is none."""
        return self._value

    @property
    def problem(self) -> str | None:
        """Why there is no value."""
        return self._problem

    @property
    def is_current(self) -> bool:
        """Whether the value is that of the project as it is now."""
        return self._is_current

    def look_again(self) -> None:
        """Ask anew if what is needed is other than before, though the document is the same."""
        self._look(self._desk.session.project)

    def _on_changed(self, _before: Project, after: Project) -> None:
        self._look(after)

    def _look(self, project: Project) -> None:
        wanted = self._inputs(project)
        if same_inputs(wanted, self._asked):
            return
        self._asked = wanted
        if wanted is None:
            self._forget()
            return
        self._is_current = False
        function = self._function
        self._newest.ask(lambda: function(project))
        self.changed.emit()

    def _forget(self) -> None:
        self._newest.drop()
        self._asked = None
        self._tell(None, None)

    def _on_answered(self, value: object) -> None:
        if self._asked is not None:
            self._tell(value, None)

    def _on_failed(self, sentence: str) -> None:
        if self._asked is not None:
            self._tell(None, sentence)

    def _tell(self, value: Any, problem: str | None) -> None:
        self._value, self._problem, self._is_current = value, problem, True
        self.changed.emit()


def line_inputs(project: Project) -> tuple[object, ...] | None:
    """Return all that the line in plan and its centreline follow from; None while there is no line."""
    if project.source is None and project.trace is None:
        return None
    return (
        project.source,
        project.trace,
        project.extent,
        project.fit,
        project.calibration,
        project.control_points,
        project.known_distances,
        project.picture,
        project.target_sets,
        project.chosen_targets,
    )


def centreline_later(desk: Desk) -> DerivedLater:
    """Return the one follower of the centreline that all parts of a window share.

    Its value is a `bobdesk.project.derive.Derived` of a `Centreline`.
    """
    name = "centreline later"
    found = desk.session.findChild(DerivedLater, name)
    if found is not None:
        return found
    title = QCoreApplication.translate("DerivedLater", "Fitting the centreline")
    made = DerivedLater(desk, title, _centreline, line_inputs, desk.session)
    made.setObjectName(name)
    return made


def _centreline(project: Project) -> derive.Derived[Centreline]:
    return derive.centreline(project)


def same_inputs(one: tuple[object, ...] | None, other: tuple[object, ...] | None) -> bool:
    """Return whether two tuples hold the same objects (or equal whole numbers)."""
    if one is None or other is None:
        return one is other
    return len(one) == len(other) and all(a is b or _equal_number(a, b) for a, b in zip(one, other, strict=True))


def _equal_number(one: object, other: object) -> bool:
    return isinstance(one, int) and isinstance(other, int) and one == other
