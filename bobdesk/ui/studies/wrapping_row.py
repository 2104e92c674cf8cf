"""A row of buttons or fields that goes on below where the width ends."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QSizePolicy, QWidget

from bobdesk.ui.widgets.flow_layout import FlowLayout


def wrapping_row(parent: QWidget, widgets: Sequence[QWidget]) -> QWidget:
    """Return a widget with the others in it, beside each other as far as they fit."""
    holder = QWidget(parent)
    policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
    policy.setHeightForWidth(True)
    holder.setSizePolicy(policy)
    flow = FlowLayout(holder)
    for widget in widgets:
        flow.addWidget(widget)
    return holder
