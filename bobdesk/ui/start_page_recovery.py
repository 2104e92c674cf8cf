"""What an earlier, ended session left behind, on the start page."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMessageBox, QPushButton, QVBoxLayout, QWidget

from bobdesk.files.recovery_store import Recoverable
from bobdesk.ui.banner import Banner
from bobdesk.ui.when import Moments


class RecoveryBanner(Banner):
    """One sentence for each project that can be recovered, with what can be done.

    Signals
    -------
    recover, discard
        A `Recoverable`; before it is discarded the user was asked.
    """

    recover = Signal(object)
    discard = Signal(object)

    def __init__(self, items: Sequence[Recoverable], parent: QWidget | None = None) -> None:
        super().__init__("warning", parent)
        self._moments = Moments(self)
        lines = QVBoxLayout()
        lines.setSpacing(2)
        if len(items) > 1:
            lines.addWidget(QLabel(self.tr("BobDesk ended unexpectedly. These can be recovered:")))
        for item in items:
            lines.addLayout(self._line(item, alone=len(items) == 1))
        self.row.addLayout(lines, 1)
        self.row.setContentsMargins(12, 8, 12, 8)

    def _line(self, item: Recoverable, *, alone: bool) -> QHBoxLayout:
        name = item.name or self.tr("A project without a name")
        words = {"name": f"<b>{escape(name)}</b>", "when": escape(self._when(item)), "edit": escape(item.last_edit)}
        if alone:
            template = self.tr("BobDesk ended unexpectedly. {name} can be recovered, last edit {when}")
        else:
            template = self.tr("{name}, last edit {when}")
        sentence = template.format(**words) + (self.tr(" “{edit}”").format(**words) if item.last_edit else "") + "."
        label = QLabel(sentence)
        label.setTextFormat(Qt.TextFormat.RichText)
        label.setWordWrap(True)
        line = QHBoxLayout()
        line.setSpacing(12)
        line.addWidget(label, 1)
        recover = self._link(self.tr("Recover"), self.tr("Open {name} as it was at its last edit"), name)
        recover.clicked.connect(lambda: self.recover.emit(item))
        font = recover.font()
        font.setBold(True)
        recover.setFont(font)
        discard = self._link(self.tr("Discard"), self.tr("Delete the copy of {name}"), name)
        discard.clicked.connect(lambda: self._ask(item, name))
        line.addWidget(recover)
        line.addWidget(discard)
        return line

    def _link(self, text: str, tip: str, name: str) -> QPushButton:
        link = QPushButton(text)
        link.setProperty("kind", "link")
        link.setCursor(Qt.CursorShape.PointingHandCursor)
        link.setToolTip(tip.format(name=name))
        link.setAccessibleName(f"{text}: {name}")
        return link

    def _when(self, item: Recoverable) -> str:
        day = self._moments.text(item.time)
        time = self._moments.time(item.time)
        return day if time in day else f"{day} {time}"

    def _ask(self, item: Recoverable, name: str) -> None:
        box = QMessageBox(self.window())
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.setIcon(QMessageBox.Icon.Question)
        box.setWindowTitle(self.tr("Discard the copy"))
        box.setText(self.tr("Delete the recovery copy of {name}?").format(name=name))
        box.setInformativeText(self.tr("It cannot be brought back. A saved project file stays as it is."))
        box.setTextFormat(Qt.TextFormat.PlainText)
        yes = box.addButton(self.tr("Discard"), QMessageBox.ButtonRole.DestructiveRole)
        box.setDefaultButton(box.addButton(self.tr("Keep it"), QMessageBox.ButtonRole.RejectRole))
        yes.clicked.connect(lambda: self.discard.emit(item))
        box.open()
