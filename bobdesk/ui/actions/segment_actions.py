"""The Segments menu, and the keys of the segments."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from bobdesk.ui.actions.action import Action
from bobdesk.ui.derived import line_inputs
from bobdesk.ui.desk import Desk
from bobdesk.ui.segments.automatic_operations import automatic_operations
from bobdesk.ui.segments.operations import operations
from bobdesk.ui.segments.segment_files import SegmentFiles

# What strips and table take too, with their keys.
OF_SEGMENTS = (
    "split_segment",
    "merge_segments",
    "flip_kind",
    "lock_segment",
    "delete_boundary",
    "number_curves",
    "previous_segment",
    "next_segment",
)


class SegmentActions(QObject):
    """Rows of what can be done by hand and automatically.

    Parameters
    ----------
    window
        Stands behind the dialogs for files.
    """

    def __init__(self, desk: Desk, window: QWidget) -> None:
        super().__init__(window)
        self._desk = desk
        self._operations = operations(desk)
        self._automatic_operations = automatic_operations(desk)
        self._files = SegmentFiles(desk, window)

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (*self._by_hand(), *self._walking(), *self._automatic(), *self._in_files())

    def _by_hand(self) -> tuple[Action, ...]:
        do = self._operations
        return (
            self._row("split_segment", self.tr("&Split"), do.split, ("X",), "split",
                      self.tr("Cut the segment at the cursor in two: a new boundary"), "hand"),
            self._row("merge_segments", self.tr("&Merge"), do.merge, ("C",), "merge",
                      self.tr("Make one of the selected segments, or of this one and its nearer neighbour"), "hand"),
            self._row("flip_kind", self.tr("&Flip kind"), do.flip, ("O",), "flip",
                      self.tr("Turn a straight into a curve, or a curve into a straight"), "hand"),
            self._row("lock_segment", self.tr("&Lock"), do.lock, ("L",), "lock",
                      self.tr("Keep a segment as it is, whatever is detected or edited, or let it go"), "hand"),
            self._row("delete_boundary", self.tr("&Delete boundary"), do.delete_boundary, ("Shift+Del",), "delete",
                      self.tr("Take the selected boundary away; both its segments become one"), "hand"),
            self._row("number_curves", self.tr("&Number curves"), do.number_curves, (), "curve",
                      self.tr("Number the curves from the start; names of your own stay"), "hand", is_key=False),
        )  # fmt: skip

    def _walking(self) -> tuple[Action, ...]:
        do = self._operations
        return (
            self._row("previous_segment", self.tr("&Previous segment"), lambda: do.select_next(-1), ("[", "PgUp"),
                      "previous", self.tr("Select the segment before"), "walk"),
            self._row("next_segment", self.tr("Ne&xt segment"), lambda: do.select_next(1), ("]", "PgDown"),
                      "next", self.tr("Select the segment behind"), "walk"),
        )  # fmt: skip

    def _automatic(self) -> tuple[Action, ...]:
        do = self._automatic_operations
        return (
            self._row("detect_again", self.tr("Detect &again"), do.detect_again, (), "detect",
                      self.tr("Find the segments anew; locked and hand-made ones stay"), "automatic", is_key=False),
            self._row("automatic_segments", self.tr("&Back to automatic"), do.back_to_automatic, (), "reset",
                      self.tr("Give up all corrections; Undo brings them back"), "automatic", is_key=False),
        )  # fmt: skip

    def _in_files(self) -> tuple[Action, ...]:
        files = self._files
        return (
            self._row("open_segments", self.tr("&Open segments…"), files.ask_open, (), "import",
                      self.tr("Take all segments from a table with the columns kind, from_m and to_m"), "files",
                      is_key=False),
            self._row("save_segments", self.tr("Sa&ve segments…"), files.ask_save, (), "export",
                      self.tr("Write the table that the command reconstruct reads"), "files", is_key=False),
            self._row("compare_with_design", self.tr("&Compare with a design…"), files.ask_design, (), "table",
                      self.tr("Look at a designer's list of curves beside these segments"), "files", is_key=False),
        )  # fmt: skip

    def _row(
        self,
        name: str,
        text: str,
        do: Callable[[], object],
        keys: tuple[str, ...],
        icon: str,
        tip: str,
        group: str,
        *,
        is_key: bool = True,
    ) -> Action:
        return Action(
            name,
            text,
            do,
            keys,
            icon,
            tip,
            "Segments",
            group,
            "canvas" if is_key else "window",
            enabled=self._has_line,
            context=name in OF_SEGMENTS[:5],
        )

    def _has_line(self) -> bool:
        return line_inputs(self._desk.session.project) is not None
