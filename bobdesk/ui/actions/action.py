"""One action: its words, key and picture, when it can be done, and what it does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

MenuName = Literal["File", "Edit", "View", "Plan", "Track", "Segments", "Solve", "Window", "Help"]
Scope = Literal["window", "canvas"]
Role = Literal["none", "about", "preferences", "quit", "of the program"]


def always() -> bool:
    """Every time."""
    return True


@dataclass(frozen=True)
class Action:
    """A row of the table that menus, tool bars, context menus, shortcut sheet and command palette are made from.

    Attributes
    ----------
    name
        Never shown; settings and tests know the action by it.
    text
        In menus, with the mnemonic's ampersand.
    do
        What it does; it is given whether it is checked if it is checkable.
    keys
        The usual keys, the first one is shown; in Qt's portable form.
    icon
        Name of a file in resources/icons, without ".svg".
    tip
        A sentence: tool tip and status bar.
    menu, group
        Where it stands; a separator comes between groups.
    scope
        "canvas": the key acts only while the plan view has the focus.
    enabled
        Asked again after every change.
    checked
        For what can be on or off: asked again after every change.
    context
        Also in the context menu of the plan view.
    tool_bar
        Also in the tool bar at the left.
    role
        What it is for macOS, which moves such actions to the menu that bears the program's name.
    """

    name: str
    text: str
    do: Callable[..., object]
    keys: tuple[str, ...] = ()
    icon: str = ""
    tip: str = ""
    menu: MenuName = "File"
    group: str = ""
    scope: Scope = "window"
    enabled: Callable[[], bool] = always
    checked: Callable[[], bool] | None = None
    context: bool = False
    tool_bar: bool = False
    role: Role = "none"

    @property
    def plain_text(self) -> str:
        """The text without mnemonic and dots."""
        return self.text.replace("&&", "\0").replace("&", "").replace("\0", "&").removesuffix("…")
