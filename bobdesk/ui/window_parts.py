"""The parts of the window that one key leads to, one after the other."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget

from bobdesk.ui.steps_bar import StepsBar

# Widgets that are one part together: the keyboard goes to the first of them that takes it.
Part = Sequence[QWidget]


def go_to_part(parts: Sequence[Part], by: int) -> None:
    """Move the keyboard to the next part that takes it, or with -1 to the one before, and round again."""
    focus = QApplication.focusWidget()
    at = next((index for index, part in enumerate(parts) if focus is not None and _holds(part, focus)), None)
    first = at if at is not None else (-1 if by > 0 else 0)
    for offset in range(1, len(parts) + 1):
        if _focus_into(parts[(first + by * offset) % len(parts)]):
            return


def _holds(part: Part, focus: QWidget) -> bool:
    return any(widget is focus or widget.isAncestorOf(focus) for widget in part)


def _focus_into(part: Part) -> bool:
    for top in part:
        if not top.isVisible():
            continue
        if isinstance(top, StepsBar):
            top.take_focus()
            return True
        for widget in (top, *top.findChildren(QWidget)):
            if widget.focusPolicy() & Qt.FocusPolicy.TabFocus and widget.isVisible() and widget.isEnabled():
                widget.setFocus(Qt.FocusReason.ShortcutFocusReason)
                return True
    return False
