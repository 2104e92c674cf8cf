"""The two errors that a person may see, each with one sentence that says what and where."""

from __future__ import annotations


class InputError(Exception):
    """An input cannot be used; the message is one sentence for a person.

    The sentence names the file, line and column where there are such, and what to do.
    """


class TargetError(Exception):
    """The targets contradict each other or the plan; the message is one sentence with numbers."""


class SolverFaultError(InputError):
    """A solver of a plug-in has failed; what it had found until then may be kept."""
