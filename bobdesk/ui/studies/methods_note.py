"""What the objective J conceals of some methods, in sentences below their table."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QCoreApplication

from bobdesk.files.method_run import MethodResult
from bobdesk.ui.quantities import Quantities


def methods_note(results: Sequence[MethodResult], unit: Quantities, title_of: Callable[[MethodResult], str]) -> str:
    """Return why J can be small where targets are missed, and large where they are met; "" if it conceals nothing."""
    rising = [
        QCoreApplication.translate("MethodsNote", "{counted} where {method} has {drop}").format(
            counted=unit.length(result.row.counted_drop, 2),
            method=title_of(result),
            drop=unit.length(result.row.found.drop, 2),
        )
        for result in results
        if result.row.found is not None and result.row.has_rises_in_objective
    ]
    unaware = [
        title_of(result) for result in results if any(miss.target == "known elevations" for miss in result.row.missed)
    ]
    sentences = []
    if rising:
        sentences.append(
            QCoreApplication.translate(
                "MethodsNote", "The objective J counts rises like falls: it sees a height difference of {seen}."
            ).format(seen=", ".join(rising))
        )
    if unaware:
        sentences.append(
            QCoreApplication.translate(
                "MethodsNote",
                "J has no term for known elevations; it does not show what is missed of them by {methods}.",
            ).format(methods=", ".join(unaware))
        )
    return " ".join(sentences)
