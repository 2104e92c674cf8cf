"""What every panel is: a column of headings, forms and tables that scrolls and fits 300 pixels."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtWidgets import (
    QFormLayout,
    QFrame,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import icon
from bobdesk.ui.widgets.facts import Facts
from bobdesk.ui.widgets.flow_layout import FlowLayout

_MARGIN = 14


class Panel(QScrollArea):
    """A column of widgets.

    Signals
    -------
    place_wanted
        Show this place of the plan: x, y in picture pixels, or metres for a plan from coordinates.
    tool_wanted
        Name of a tool of the plan view.
    """

    place_wanted = Signal(float, float)
    tool_wanted = Signal(str)

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.desk = desk
        self._icons: list[tuple[QPushButton, str]] = []
        self.setWidgetResizable(True)
        # What has the focus inside is scrolled into sight; the panel itself is no stop of the Tab key.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        self.setMinimumWidth(300)
        self._body = QWidget(self)
        self.column = QVBoxLayout(self._body)
        self.column.setContentsMargins(_MARGIN, _MARGIN, _MARGIN, _MARGIN)
        self.column.setSpacing(8)
        self.setWidget(self._body)
        self.state = self.add_label("", "muted")
        self.state.hide()

    def name_it(self, title: str) -> None:
        """Give the panel its title, which stands on its dock."""
        self.setAccessibleName(title)
        self.setWindowTitle(title)

    def say(self, sentence: str) -> None:
        """Put one line under the title; "" takes it away."""
        self.state.setText(sentence)
        self.state.setVisible(bool(sentence))

    def refuse(self, sentence: str) -> None:
        """Tell that something cannot be used."""
        self.desk.notices.refuse(sentence, weight="warning")

    def add_label(self, text: str, kind: str = "", to: QVBoxLayout | None = None) -> QLabel:
        """Add text that wraps; kinds are those of the style sheet."""
        label = QLabel(text, self._body)
        label.setWordWrap(True)
        label.setTextFormat(Qt.TextFormat.PlainText)
        if kind:
            label.setProperty("kind", kind)
        if kind != "title" and kind != "heading":
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        (to or self.column).addWidget(label)
        return label

    def add_section(self, heading: str) -> tuple[QWidget, QVBoxLayout]:
        """Add a heading with a column below it, to be shown and hidden as one."""
        section = QWidget(self._body)
        section.setAccessibleName(heading)
        column = QVBoxLayout(section)
        column.setContentsMargins(0, 8, 0, 0)
        column.setSpacing(6)
        self.column.addWidget(section)
        self.add_label(heading, "heading", column)
        return section, column

    def add_form(self, to: QVBoxLayout | None = None) -> QFormLayout:
        """Add rows of label and field; a field goes below its label where both do not fit."""
        form = QFormLayout()
        form.setContentsMargins(0, 0, 0, 0)
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(5)
        form.setRowWrapPolicy(QFormLayout.RowWrapPolicy.WrapLongRows)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        (to or self.column).addLayout(form)
        return form

    def add_facts(self, to: QVBoxLayout) -> Facts:
        """Add rows that only show something."""
        facts = Facts(self._body)
        to.addWidget(facts)
        return facts

    def add_field(self, form: QFormLayout, text: str, field: QWidget, tip: str) -> QWidget:
        """Add a row with something to set."""
        label = QLabel(text, self._body)
        label.setBuddy(field)
        field.setToolTip(tip)
        if not field.accessibleName():
            field.setAccessibleName(text)
        field.setAccessibleDescription(tip)
        form.addRow(label, field)
        return field

    def add_buttons(self, to: QVBoxLayout | None = None) -> FlowLayout:
        """Add a row of buttons that wraps."""
        holder = QWidget(self._body)
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        policy.setHeightForWidth(True)
        holder.setSizePolicy(policy)
        flow = FlowLayout(holder)
        (to or self.column).addWidget(holder)
        return flow

    def button(self, flow: FlowLayout, text: str, tip: str, icon_name: str = "") -> QPushButton:
        """Add a button."""
        button = QPushButton(text, self._body)
        button.setToolTip(tip)
        button.setAccessibleName(text)
        button.setAccessibleDescription(tip)
        if icon_name:
            self._icons.append((button, icon_name))
            button.setIcon(icon(icon_name))
        flow.addWidget(button)
        return button

    def changeEvent(self, event: QEvent) -> None:
        """Draw the icons in the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            for button, name in self._icons:
                button.setIcon(icon(name))
