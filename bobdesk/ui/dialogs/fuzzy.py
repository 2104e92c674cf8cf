"""Which of many names a few typed letters mean."""

from __future__ import annotations

_AT_WORD = 6.0
_IN_A_ROW = 9.0
_SKIPPED = 0.15


def fuzzy_score(typed: str, text: str) -> float | None:
    """Return how well `text` answers what was typed, or None if it does not.

    All letters must occur in order; letters that begin words or follow one another count most, so that
    "sa" finds "Save as" before "Close gaps". Case does not matter, blanks part words that may come in
    any order.
    """
    total = 0.0
    for word in typed.casefold().split():
        score = _word_score(word, text.casefold())
        if score is None:
            return None
        total += score
    return total


def _word_score(word: str, text: str) -> float | None:
    """Try every place where the word's first letter stands; the best one counts."""
    starts = [index for index, letter in enumerate(text) if letter == word[0]]
    scores = [score for start in starts if (score := _from(word, text, start)) is not None]
    return max(scores, default=None)


def _from(word: str, text: str, start: int) -> float | None:
    score, before = 0.0, start - 1
    for letter in word:
        at = text.find(letter, before + 1)
        if at < 0:
            return None
        score += 1.0 - _SKIPPED * (at - before - 1)
        if at == before + 1 and at > start:
            score += _IN_A_ROW
        if at == 0 or not text[at - 1].isalnum():
            score += _AT_WORD
        before = at
    return score - 0.01 * len(text)
