"""Formats and solvers from other packages, through entry points; one that fails is told of, and does no harm."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import Generic, Protocol, TypeVar


class _Keyed(Protocol):
    @property
    def key(self) -> str:
        """Short name."""


Format = TypeVar("Format", bound=_Keyed)
_KEY = re.compile(r"[a-z0-9][a-z0-9_.-]{0,39}")


@dataclass(frozen=True)
class PluginFinding:
    """A plug-in that cannot be used.

    Attributes
    ----------
    group, plugin
        Entry-point group, and name of the plug-in in it.
    sentence
        Why it cannot be used, for a person.
    """

    group: str
    plugin: str
    sentence: str


@dataclass(frozen=True)
class Plugins(Generic[Format]):
    """Formats or methods that can be used, the built-in ones first, and findings on those that cannot."""

    formats: tuple[Format, ...]
    findings: tuple[PluginFinding, ...]


def find_plugins(group: str, kind: type[Format], *, built_in: tuple[Format, ...]) -> Plugins[Format]:
    """Return the built-in formats and those of the entry points in `group`.

    Parameters
    ----------
    group
        Such as "bobdesk.importers".
    kind
        What an entry point must be an instance of.
    built_in
        Their keys cannot be taken by a plug-in.
    """
    formats = list(built_in)
    findings: list[PluginFinding] = []
    for point, loaded, problem in _loaded(group):
        if problem is None and not isinstance(loaded, kind):
            problem = f"it is a {type(loaded).__name__}, not a {kind.__name__}"
        elif problem is None and isinstance(loaded, kind):
            problem = _wrong_key(loaded.key, [known.key for known in formats])
        if problem is not None:
            sentence = f"the plug-in {point.name} ({point.value}) cannot be used: {problem}"
            findings.append(PluginFinding(group, point.name, sentence))
        elif isinstance(loaded, kind):
            formats.append(loaded)
    return Plugins(tuple(formats), tuple(findings))


def _wrong_key(key: object, taken: list[str]) -> str | None:
    if not (isinstance(key, str) and _KEY.fullmatch(key)):
        return "its key is no short name in lower case"
    return f"there is a '{key}' already" if key in taken else None


@lru_cache(maxsize=8)
def _loaded(group: str) -> tuple[tuple[EntryPoint, object, str | None], ...]:
    """Load the entry points of a group once, each with why it failed, if it did."""
    result: list[tuple[EntryPoint, object, str | None]] = []
    for point in sorted(entry_points(group=group), key=lambda point: (point.name, point.value)):
        try:
            result.append((point, point.load(), None))
        # What another's code raises on import is not ours to foresee; it is told of, not hidden.
        except (Exception, SystemExit) as error:  # noqa: BLE001
            result.append((point, None, f"{type(error).__name__}: {' '.join(str(error).split())[:200]}"))
    return tuple(result)
