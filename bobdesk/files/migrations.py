"""Old project files become new ones: n to n + 1, on plain JSON, before anything is checked.

A migration is never changed once a version has gone out, and `tests/data/projects` holds a file of
each version. Version 1 is the first, so there is none yet.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Plain = dict[str, Any]
MIGRATIONS: dict[int, Callable[[Plain], Plain]] = {}


def migrated(document: Plain, *, to: int, migrations: dict[int, Callable[[Plain], Plain]] = MIGRATIONS) -> Plain:
    """Return a document brought from its version to version `to`, step by step.

    Raises
    ------
    KeyError, TypeError
        If a migration does not find what it needs: the document is damaged.
    """
    while document["version"] < to:
        version = document["version"]
        document = migrations[version](document) | {"version": version + 1}
    return document
