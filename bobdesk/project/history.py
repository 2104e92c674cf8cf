"""Undo and redo over values that never change: a step is a label and the value it left."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

Value = TypeVar("Value")
STEPS = 200


@dataclass(frozen=True, eq=False)
class Step(Generic[Value]):
    """What was done, and the value after it; steps with the same key in a row become one."""

    label: str
    value: Value
    key: str | None = None


class History(Generic[Value]):
    """The values that came one after another, and which of them is shown now.

    Parameters
    ----------
    value
        The first one; it counts as saved.
    limit
        How many steps can be undone; older ones are forgotten.
    """

    def __init__(self, value: Value, *, limit: int = STEPS) -> None:
        if limit < 1:
            raise ValueError("a history needs room for one step at least")
        self._steps: list[Step[Value]] = [Step("", value)]
        self._at = 0
        self._limit = limit
        self._saved: Step[Value] | None = self._steps[0]
        self._may_merge = False

    @property
    def value(self) -> Value:
        """The value that is shown now."""
        return self._steps[self._at].value

    @property
    def undo_labels(self) -> tuple[str, ...]:
        """What can be undone, the next one first."""
        return tuple(step.label for step in self._steps[self._at : 0 : -1])

    @property
    def redo_labels(self) -> tuple[str, ...]:
        """What can be redone, the next one first."""
        return tuple(step.label for step in self._steps[self._at + 1 :])

    @property
    def is_saved(self) -> bool:
        """Whether the value shown is the one that was saved last."""
        return self._saved is not None and self.value is self._saved.value

    def mark_saved(self) -> None:
        """Remember the value shown as saved; later edits begin a step of their own."""
        self._saved = self._steps[self._at]
        self._may_merge = False

    def push(self, label: str, value: Value, *, key: str | None = None) -> None:
        """Add a step; what was undone before is forgotten.

        Parameters
        ----------
        label
            What was done, for the menu: "Move vertex".
        value
            The value after it; the very value shown now is no step.
        key
            Steps with an equal key that follow each other directly (a spin box that is held) become one.
            Saving, undo and redo end such a row.
        """
        if value is self.value:
            return
        del self._steps[self._at + 1 :]
        last = self._steps[self._at]
        if key is not None and key == last.key and self._may_merge:
            self._steps[self._at] = Step(last.label, value, key)
        else:
            self._steps.append(Step(label, value, key))
            del self._steps[: -(self._limit + 1)]
            self._at = len(self._steps) - 1
        self._may_merge = True

    def undo(self) -> Value:
        """Go one step back and return the value there; at the beginning nothing happens."""
        self._at = max(0, self._at - 1)
        self._may_merge = False
        return self.value

    def redo(self) -> Value:
        """Go one step forward again and return the value there; at the end nothing happens."""
        self._at = min(len(self._steps) - 1, self._at + 1)
        self._may_merge = False
        return self.value
