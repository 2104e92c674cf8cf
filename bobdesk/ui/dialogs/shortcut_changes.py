"""Giving actions other keys: what a key is taken by, and what follows from taking it over."""

from __future__ import annotations

from PySide6.QtGui import QKeySequence

from bobdesk.ui.actions.action import Action
from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.settings import Settings

_PORTABLE = QKeySequence.SequenceFormat.PortableText


def native(key: str) -> str:
    """Return a key as this system writes it."""
    return QKeySequence(key, _PORTABLE).toString(QKeySequence.SequenceFormat.NativeText)


def conflict(actions: ActionSet, row: Action, key: str) -> Action | None:
    """Return the other action that has `key` where both would act, or None."""
    wanted = QKeySequence(key, _PORTABLE)
    for other in actions.table:
        if other.name != row.name and any(QKeySequence(one, _PORTABLE) == wanted for one in actions.keys_of(other)):
            return other
    return None


def give(actions: ActionSet, settings: Settings, row: Action, key: str) -> None:
    """Give an action a key, "" for none, and take it from the one that had it."""
    other = conflict(actions, row, key) if key else None
    if other is not None:
        wanted = QKeySequence(key, _PORTABLE)
        left = [one for one in actions.keys_of(other) if QKeySequence(one, _PORTABLE) != wanted]
        settings.set_key(other.name, left[0] if left else "")
    # the usual key is not kept as the user's own, so that a later version may change it
    settings.set_key(row.name, None if (key,) == row.keys or (not key and not row.keys) else key)


def give_usual(actions: ActionSet, settings: Settings, row: Action) -> None:
    """Give an action its usual keys again; those of them that another one was given are taken from it."""
    settings.set_key(row.name, None)
    for key in row.keys:
        other = conflict(actions, row, key)
        if other is not None:
            left = [one for one in actions.keys_of(other) if one != key]
            settings.set_key(other.name, left[0] if left else "")


def give_all_usual(actions: ActionSet, settings: Settings) -> None:
    """Give every action its usual keys again."""
    for row in actions.table:
        if settings.key_of(row.name) is not None:
            settings.set_key(row.name, None)
