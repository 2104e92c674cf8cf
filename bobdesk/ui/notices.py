"""Sentences to the user: what cannot be done and why, with what can be done about it."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from PySide6.QtCore import QObject, Signal

from bobdesk.sentences import ended

_NUMBERS_AND_QUOTES = re.compile(r"'[^']*'|[-−]?\d[\d.,’\u00a0\u202f]*(?<![.,])")
Weight = Literal["note", "warning", "error"]


@dataclass(frozen=True)
class Remedy:
    """Something that the user can do about a notice: a button's text and what it does."""

    text: str
    do: Callable[[], object]


@dataclass(frozen=True)
class Notice:
    """One sentence; a note goes away by itself unless it stays, the others stay until they are closed.

    A refusal is about what the user has just tried to do, and nothing was changed.
    """

    sentence: str
    weight: Weight
    remedies: tuple[Remedy, ...] = ()
    stays: bool = False
    is_refusal: bool = False

    @property
    def kind(self) -> tuple[str, str]:
        """Equal for notices of which the newest is enough.

        They say the same of other numbers or other typed text; or they are refusals, for what was tried before the
        last attempt is of no interest any more.
        """
        return ("refusal", "") if self.is_refusal else (self.weight, _NUMBERS_AND_QUOTES.sub("#", self.sentence))


class Notices(QObject):
    """Takes sentences from anywhere in the window; the notice bar shows them.

    Signals
    -------
    told
        A `Notice`.
    """

    told = Signal(object)

    def note(self, sentence: str, *remedies: Remedy) -> None:
        """Say something that is good to know."""
        self._tell(sentence, "note", remedies)

    def offer(self, sentence: str, *remedies: Remedy) -> None:
        """Say something good to know that the user may act on, until it is closed."""
        self._tell(sentence, "note", remedies, stays=True)

    def refuse(self, sentence: str, *remedies: Remedy, weight: Weight = "note") -> None:
        """Say why what the user has just tried is not done; it takes the place of the refusal before."""
        self._tell(sentence, weight, remedies, is_refusal=True)

    def warn(self, sentence: str, *remedies: Remedy) -> None:
        """Say that something may not be as the user thinks."""
        self._tell(sentence, "warning", remedies)

    def error(self, sentence: str, *remedies: Remedy) -> None:
        """Say that something could not be done; nothing is lost."""
        self._tell(sentence, "error", remedies)

    def _tell(
        self,
        sentence: str,
        weight: Weight,
        remedies: tuple[Remedy, ...],
        *,
        stays: bool = False,
        is_refusal: bool = False,
    ) -> None:
        sentence = sentence.strip()
        if sentence:
            # the name of a file begins as it does
            is_name = any(sign in sentence.split(maxsplit=1)[0].rstrip(".:,!?…") for sign in "./\\:")
            first = sentence[0] if is_name else sentence[0].upper()
            whole = first + ended(sentence[1:])
            self.told.emit(Notice(whole, weight, remedies, stays, is_refusal))
