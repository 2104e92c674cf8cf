"""Faults that nothing else has caught: the work is kept first, then one dialog says so.

Hooks may be called on any thread and in the middle of painting; so they only put down what
happened, and an event brings it to the window's thread.
"""

from __future__ import annotations

import sys
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QCoreApplication, QEvent, QObject
from PySide6.QtWidgets import QWidget

from bobdesk.ui.fault_report import fault_sentence, fault_text

if TYPE_CHECKING:
    from bobdesk.ui.dialogs.crash_dialog import CrashDialog

_MOST_WAITING = 50
# A fault in every paint would otherwise bring the dialog back for ever.
_MOST_DIALOGS_OF_ONE_FAULT = 2
_EVENT = QEvent.Type(QEvent.registerEventType())


@dataclass(frozen=True)
class Fault:
    """A fault in words: one line, and its traceback."""

    sentence: str
    trace: str


class CrashGuard(QObject):
    """Takes every fault that nobody else takes.

    Parameters
    ----------
    keep
        Writes the recovery copy; returns False, or fails, where that could not be done.
    leave
        Saves a copy and ends the program, for those who do not trust it any more.
    window
        Over which the dialog stands.
    """

    def __init__(self, keep: Callable[[], object], leave: Callable[[], object], window: QWidget | None = None) -> None:
        super().__init__(window)
        self._keep, self._leave, self._window = keep, leave, window
        self._waiting: deque[Fault] = deque(maxlen=_MOST_WAITING)
        self._dialogs_of: dict[str, int] = {}
        self._is_busy = False
        self._before: tuple[Any, Any, Any] | None = None
        self.dialog: CrashDialog | None = None

    def install(self) -> None:
        """Put the hooks in place."""
        if self._before is None:
            self._before = (sys.excepthook, threading.excepthook, sys.unraisablehook)
            sys.excepthook = self.on_exception
            threading.excepthook = self._on_thread
            sys.unraisablehook = self._on_unraisable

    def uninstall(self) -> None:
        """Bring the hooks back that were there before."""
        if self._before is not None:
            sys.excepthook, threading.excepthook, sys.unraisablehook = self._before
            self._before = None

    def on_exception(self, kind: type[BaseException], value: BaseException | None, trace: TracebackType | None) -> None:
        """Take a fault; Ctrl+C in a terminal is none."""
        if not issubclass(kind, Exception):
            sys.__excepthook__(kind, value if value is not None else kind(), trace)
            return
        if value is not None:
            sys.__excepthook__(kind, value, trace)
        self._waiting.append(Fault(fault_sentence(kind, value), fault_text(kind, value, trace)))
        if QCoreApplication.instance() is not None:
            QCoreApplication.postEvent(self, QEvent(_EVENT))

    def event(self, event: QEvent) -> bool:
        """On the window's thread: keep the work, then say what happened."""
        if event.type() == _EVENT:
            self._tell()
            return True
        return super().event(event)

    def _on_thread(self, args: threading.ExceptHookArgs) -> None:
        if args.exc_type is not SystemExit:
            self.on_exception(args.exc_type, args.exc_value, args.exc_traceback)

    def _on_unraisable(self, unraisable: sys.UnraisableHookArgs) -> None:
        self.on_exception(unraisable.exc_type, unraisable.exc_value, unraisable.exc_traceback)

    def _tell(self) -> None:
        if self._is_busy or not self._waiting:
            return
        self._is_busy = True
        try:
            faults = list(self._waiting)
            self._waiting.clear()
            kept = self._kept()
            if self.dialog is not None:
                for fault in faults:
                    self.dialog.add(fault.trace)
                return
            wanted = [fault for fault in faults if self._dialogs_of.get(fault.sentence, 0) < _MOST_DIALOGS_OF_ONE_FAULT]
            if wanted:
                self._dialogs_of[wanted[0].sentence] = self._dialogs_of.get(wanted[0].sentence, 0) + 1
                self._show(wanted, kept=kept)
        finally:
            self._is_busy = False

    def _kept(self) -> bool:
        try:
            return self._keep() is not False
        except Exception:  # noqa: BLE001 - keeping the work must not bring the next fault; the dialog says that it failed
            return False

    def _show(self, faults: list[Fault], *, kept: bool) -> None:
        from bobdesk.ui.dialogs.crash_dialog import CrashDialog

        dialog = CrashDialog(faults[0].trace, faults[0].sentence, kept=kept, parent=self._window)
        for fault in faults[1:]:
            dialog.add(fault.trace)
        dialog.finished.connect(self._on_finished)
        self.dialog = dialog
        dialog.open()

    def _on_finished(self) -> None:
        dialog, self.dialog = self.dialog, None
        if dialog is not None:
            dialog.deleteLater()
            if dialog.wants_to_leave:
                self._leave()
