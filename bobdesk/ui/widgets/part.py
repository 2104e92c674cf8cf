"""A part of a panel under a heading of its own."""

from __future__ import annotations

from PySide6.QtWidgets import QVBoxLayout, QWidget

from bobdesk.ui.widgets.panel import Panel


class Part(QWidget):
    """Shown and hidden as one; reaches the document through its panel's desk."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.panel = panel
        self.desk = panel.desk
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 8, 0, 0)
        self.column.setSpacing(6)
        self.heading = panel.add_label("", "heading", self.column)
        panel.column.addWidget(self)

    def name_it(self, heading: str) -> None:
        """Give the part its heading."""
        self.heading.setText(heading)
        self.setAccessibleName(heading)
