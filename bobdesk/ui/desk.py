"""What the parts of one window share; they never talk to each other but through it."""

from __future__ import annotations

from dataclasses import dataclass

from bobdesk.ui.notices import Notices
from bobdesk.ui.plan_picture import PlanPicture
from bobdesk.ui.quantities import Quantities
from bobdesk.ui.runner import Runner
from bobdesk.ui.selection import Selection
from bobdesk.ui.session import Session
from bobdesk.ui.settings import Settings


@dataclass(frozen=True, eq=False)
class Desk:
    """The window's common things.

    Attributes
    ----------
    session
        The document; the only way to change it.
    selection
        What is selected, and the cursor along the line.
    picture
        The decoded picture of the document, as it becomes ready.
    runner
        Long jobs.
    notices
        Sentences to the user, and what can be done about them.
    settings
        What the program remembers.
    quantities
        Numbers with units, as the user wants them.
    """

    session: Session
    selection: Selection
    picture: PlanPicture
    runner: Runner
    notices: Notices
    settings: Settings
    quantities: Quantities
