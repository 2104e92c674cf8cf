"""What a report of a fault says: versions and traceback, and nothing of the user's folders."""

from __future__ import annotations

import re
import traceback
from pathlib import Path
from types import TracebackType

from bobdesk.ui.licences import versions


def fault_text(kind: type[BaseException], value: BaseException | None, trace: TracebackType | None) -> str:
    """Return a traceback without the user's folders."""
    return without_home("".join(traceback.format_exception(kind, value, trace)))


def fault_sentence(kind: type[BaseException], value: BaseException | None) -> str:
    """Return the fault in one line."""
    return without_home(traceback.format_exception_only(kind, value)[-1].strip())


def report(trace: str) -> str:
    """Return what "Copy report" copies."""
    return f"{trace.strip()}\n\n{versions()}\n"


def without_home(text: str) -> str:
    """Put ~ in the place of the home folder, however its path is written."""
    try:
        home = str(Path.home())
    except RuntimeError:
        return text
    if len(home) < 2:
        return text
    for written in (home, home.replace("\\", "/"), home.replace("\\", "\\\\")):
        text = re.sub(re.escape(written) + r"(?![\w.-])", "~", text)
    return text
