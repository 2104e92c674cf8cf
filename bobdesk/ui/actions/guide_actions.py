"""The actions that open the guide, and the picture that its first pages are about."""

from __future__ import annotations

from PySide6.QtCore import QObject

from bobdesk.ui.actions.action import Action
from bobdesk.ui.guide.guide import Guide
from bobdesk.ui.guide.pages import FIRST_TRACK_PAGE
from bobdesk.ui.plans import Plans
from bobdesk.ui.samples import practice_picture


class GuideActions(QObject):
    """Guide, first track, practice picture."""

    def __init__(self, guide: Guide, plans: Plans, parent: QObject) -> None:
        super().__init__(parent)
        self._guide = guide
        self._plans = plans

    def table(self) -> tuple[Action, ...]:
        """Return the rows for the table of actions."""
        return (
            Action(
                "guide",
                self.tr("User's &guide"),
                self._guide.open_here,
                ("F1",),
                "help",
                self.tr("Read about what you are doing now"),
                menu="Help",
                group="guide",
            ),
            Action(
                "first_track",
                self.tr("&First track in ten minutes"),
                lambda: self._guide.open(FIRST_TRACK_PAGE),
                (),
                "next",
                self.tr("From a picture to a 3D line in a file, step by step"),
                menu="Help",
                group="guide",
            ),
            Action(
                "practice_picture",
                self.tr("Practice &picture"),
                self.open_practice_picture,
                (),
                "picture",
                self.tr("Begin with the picture that the first track is made from"),
                menu="Help",
                group="guide",
                enabled=lambda: practice_picture() is not None,
            ),
        )

    def open_practice_picture(self) -> None:
        """Begin a project with the practice picture."""
        path = practice_picture()
        if path is not None:
            self._plans.open_picture(path, name=self.tr("Practice") + path.suffix)
