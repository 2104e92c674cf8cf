"""The figures of a dragged stretch, in a small card beside the strips."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from bobdesk.alignment.range_figures import RangeFigures
from bobdesk.ui.icons import icon
from bobdesk.ui.quantities import Quantities


class RangeCard(QFrame):
    """Shows figures.

    Signals
    -------
    closed
        The stretch is not wanted any more.
    """

    closed = Signal()

    def __init__(self, quantities: Quantities, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._quantities = quantities
        self._figures: RangeFigures | None = None
        self.setObjectName("range_card")
        self.setAccessibleName(self.tr("Figures of the selected stretch"))
        self.setMinimumWidth(190)
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 6, 8, 8)
        column.setSpacing(4)
        row = QHBoxLayout()
        self._title = QLabel(self)
        self._title.setProperty("kind", "heading")
        row.addWidget(self._title, 1)
        self._copy = self._button("copy", self.tr("Copy these figures"))
        self._copy.clicked.connect(self._on_copy)
        self._close = self._button("close", self.tr("Close"))
        self._close.clicked.connect(self.closed)
        row.addWidget(self._copy)
        row.addWidget(self._close)
        column.addLayout(row)
        grid = QGridLayout()
        grid.setVerticalSpacing(2)
        grid.setHorizontalSpacing(10)
        grid.setColumnStretch(1, 1)
        column.addLayout(grid)
        column.addStretch(1)
        self._values: list[tuple[QLabel, QLabel]] = []
        for number, text in enumerate(
            (
                self.tr("Length"),
                self.tr("Mean radius"),
                self.tr("Smallest radius"),
                self.tr("Turn angle"),
                self.tr("Mean gradient"),
                self.tr("Drop"),
            )
        ):
            name, value = QLabel(text, self), QLabel(self)
            name.setProperty("kind", "muted")
            value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            value.setAccessibleName(text)
            grid.addWidget(name, number, 0)
            grid.addWidget(value, number, 1, Qt.AlignmentFlag.AlignRight)
            self._values.append((name, value))
        quantities.changed.connect(self._fill)
        self.hide()

    def show_figures(self, figures: RangeFigures | None) -> None:
        """Show the figures of a stretch, or nothing."""
        self._figures = figures
        self._fill()
        self.setVisible(figures is not None)

    def refresh_icons(self) -> None:
        """Draw the icons in the colours in force."""
        self._copy.setIcon(icon("copy"))
        self._close.setIcon(icon("close"))

    def _fill(self) -> None:
        found, unit = self._figures, self._quantities
        if found is None:
            return
        start, end = unit.length(found.start, unit=False), unit.length(found.end)
        self._title.setText(f"{start} – {end}")
        side = self.tr("left") if found.turn >= 0 else self.tr("right")
        texts = (
            unit.length(found.length),
            self._radius(found.mean_radius),
            self._radius(found.least_radius),
            f"{unit.angle(abs(found.turn))} {side}",
            unit.gradient(found.mean_gradient),
            unit.length(found.drop, 2),
        )
        for (_, value), text in zip(self._values, texts, strict=True):
            value.setText(text)

    def _radius(self, radius: float) -> str:
        return self.tr("straight") if not math.isfinite(radius) or radius > 1e4 else self._quantities.length(radius)

    def _on_copy(self) -> None:
        rows = [self._title.text(), *(f"{name.text()}\t{value.text()}" for name, value in self._values)]
        QGuiApplication.clipboard().setText("\n".join(rows))

    def _button(self, name: str, tip: str) -> QToolButton:
        button = QToolButton(self)
        button.setIcon(icon(name))
        button.setAutoRaise(True)
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        return button
