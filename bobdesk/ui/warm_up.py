"""Loads the large libraries after the first paint, so that neither start nor first trace waits for them."""

from __future__ import annotations

import gc
import importlib
from collections.abc import Generator

from bobdesk.progress import Progress

_MODULES = (
    "numpy",
    "scipy.ndimage",
    "scipy.sparse.csgraph",
    "scipy.optimize",
    "shapely",
    "bobdesk.project.derive",
    "bobdesk.plan.trace",
    "bobdesk.alignment.segmentation",
)


def warm_up_steps() -> Generator[Progress, None, None]:
    """Import one module at a step."""
    for index, module in enumerate(_MODULES):
        importlib.import_module(module)
        yield Progress((index + 1) / len(_MODULES), "Getting ready")


def warm_up_plots() -> None:
    """Import what plots need, on the window's own thread.

    Pyqtgraph asks for every class of Qt while it is loaded. On another thread that ended the program now and then,
    where the window made use of one of these classes at the same moment.
    """
    importlib.import_module("pyqtgraph")
    # What was loaded stays: looking through it again and again for garbage costs single frames 15 ms.
    gc.collect()
    gc.freeze()
