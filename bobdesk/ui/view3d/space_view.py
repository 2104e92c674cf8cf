"""The result in three dimensions, with what can be set of it."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QSignalBlocker, Qt
from PySide6.QtGui import QGuiApplication, QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QSlider,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.project.project import Project
from bobdesk.ui.desk import Desk
from bobdesk.ui.icons import icon
from bobdesk.ui.questions import Questions
from bobdesk.ui.shown_result import shown_result_of
from bobdesk.ui.theme import colours
from bobdesk.ui.view3d.colouring import Figure
from bobdesk.ui.view3d.picture import scene_file, scene_image
from bobdesk.ui.view3d.scene import Thread
from bobdesk.ui.view3d.scene_making import SceneMaking, actual_elevations
from bobdesk.ui.view3d.space_canvas import SpaceCanvas

_FIGURES: tuple[Figure, ...] = ("gradient", "curvature", "elevation", "deviation")


class SpaceView(QWidget):
    """Shows the line that the whole window shows; cursor and selection are those of plan and strips."""

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("space_view")
        self.setAccessibleName(self.tr("3D view"))
        self._desk = desk
        self._shown = shown_result_of(desk)
        self._making = SceneMaking(desk.quantities, self)
        self._is_old = True
        self.canvas = SpaceCanvas(self)
        self.canvas.empty_text = self.tr("The result is shown here after a run.")
        self.height_slider = QSlider(Qt.Orientation.Horizontal, self)
        self.height_label = QLabel(self)
        self.figure_box = QComboBox(self)
        self.drop_box = QCheckBox(self.tr("Drop lines"), self)
        self._buttons: list[tuple[QToolButton, str]] = []
        self._questions = Questions(desk.settings, self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.canvas, 1)
        column.addWidget(self._controls())
        self.setFocusProxy(self.canvas)
        self._connect()
        self._say_height()
        self._offer_deviation(desk.session.project)

    def save(self, kind: str) -> None:
        """Ask where and save the picture as it is seen; `kind` is .png, .svg or .pdf."""
        scene = self.canvas.scene
        if scene is None:
            return
        name = (self._desk.session.project.name or self.tr("track")) + f"-3d{kind}"
        filters = f"{kind.removeprefix('.').upper()} (*{kind})"
        path = self._questions.file_to_save("export", self.tr("Save picture"), name, filters, kind)
        if path is None:
            return
        try:
            write_atomic(path, scene_file(scene, self.canvas.camera, self.canvas.width(), self.canvas.height(), kind))
        except InputError as error:
            self._desk.notices.error(str(error))
            return
        self._desk.notices.note(self.tr("Written to {name}.").format(name=path.name))

    def copy(self) -> None:
        """Copy the picture as it is seen."""
        scene = self.canvas.scene
        if scene is not None:
            image = scene_image(scene, self.canvas.camera, self.canvas.width(), self.canvas.height(), ratio=2.0)
            QGuiApplication.clipboard().setImage(image)
            self._desk.notices.note(self.tr("The picture is on the clipboard."))

    def showEvent(self, event: QShowEvent) -> None:
        """Draw what has changed while the view was hidden."""
        super().showEvent(event)
        if self._is_old:
            self._follow()

    def changeEvent(self, event: QEvent) -> None:
        """Draw in the colours of another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            for button, name in self._buttons:
                button.setIcon(icon(name))
            self._follow()

    def _controls(self) -> QWidget:
        bar = QWidget(self)
        row = QHBoxLayout(bar)
        row.setContentsMargins(10, 4, 10, 4)
        row.setSpacing(8)
        self.height_label.setBuddy(self.height_slider)
        self.height_slider.setRange(10, 100)
        self.height_slider.setValue(25)
        self.height_slider.setPageStep(10)
        self.height_slider.setMaximumWidth(160)
        self.height_slider.setAccessibleName(self.tr("Exaggeration of heights"))
        self.height_slider.setToolTip(self.tr("By how much heights are drawn larger"))
        for text in (
            self.tr("Colour: gradient"),
            self.tr("Colour: curvature"),
            self.tr("Colour: elevation"),
            self.tr("Colour: deviation from the actual track"),
        ):
            self.figure_box.addItem(text)
        self.figure_box.setAccessibleName(self.tr("What the colours stand for"))
        self.figure_box.setToolTip(self.figure_box.accessibleName())
        self.figure_box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.figure_box.setMinimumContentsLength(16)
        self.drop_box.setChecked(True)
        self.drop_box.setAccessibleName(self.drop_box.text())
        self.drop_box.setToolTip(self.tr("Verticals down to the level of the lowest point, and the plan there"))
        row.addWidget(self.height_label)
        row.addWidget(self.height_slider)
        row.addWidget(self.figure_box)
        row.addWidget(self.drop_box)
        row.addStretch(1)
        for text, tip, turn, tilt in (
            (self.tr("Front"), self.tr("Look from the front (1)"), 0.0, 0.0),
            (self.tr("Side"), self.tr("Look from the side (3)"), 90.0, 0.0),
            (self.tr("Top"), self.tr("Look from above (7)"), 0.0, 90.0),
        ):
            button = self._button(row, text, tip)
            button.clicked.connect(lambda _checked=False, turn=turn, tilt=tilt: self.canvas.look(turn, tilt))
        fit = self._button(row, "", self.tr("Show everything (F)"), "fit-all")
        fit.clicked.connect(self.canvas.fit)
        picture = self._button(row, "", self.tr("Copy or save the picture"), "camera")
        menu = QMenu(picture)
        menu.addAction(self.tr("&Copy picture"), self.copy)
        menu.addAction(self.tr("Save as &PNG…"), lambda: self.save(".png"))
        menu.addAction(self.tr("Save as &SVG…"), lambda: self.save(".svg"))
        menu.addAction(self.tr("Save as P&DF…"), lambda: self.save(".pdf"))
        picture.setMenu(menu)
        picture.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        return bar

    def _button(self, row: QHBoxLayout, text: str, tip: str, icon_name: str = "") -> QToolButton:
        button = QToolButton(self)
        button.setText(text)
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setAutoRaise(True)
        if icon_name:
            button.setIcon(icon(icon_name))
            self._buttons.append((button, icon_name))
        row.addWidget(button)
        return button

    def _connect(self) -> None:
        self.height_slider.valueChanged.connect(self._on_height)
        self.figure_box.activated.connect(self._follow)
        self.drop_box.toggled.connect(self._follow)
        self.canvas.hovered.connect(self._on_hovered)
        self.canvas.picked.connect(self._on_picked)
        self._shown.changed.connect(self._follow)
        selection = self._desk.selection
        selection.station_changed.connect(self._follow)
        selection.segments_changed.connect(self._follow)
        self._desk.quantities.changed.connect(self._follow)
        self._desk.session.changed.connect(self._on_changed)

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.actual is not after.actual:
            self._offer_deviation(after)
            self._follow()

    def _offer_deviation(self, project: Project) -> None:
        item = self.figure_box.model().item(_FIGURES.index("deviation"))  # type: ignore[attr-defined]
        item.setEnabled(project.actual is not None)
        if project.actual is None and self.figure_box.currentIndex() == _FIGURES.index("deviation"):
            with QSignalBlocker(self.figure_box):
                self.figure_box.setCurrentIndex(0)

    def _follow(self, *_anything: object) -> None:
        if not self.isVisible():
            self._is_old = True
            return
        self._is_old = False
        line = self._shown.line
        if line is None:
            self.canvas.show_scene(None)
            return
        project, selection = self._desk.session.project, self._desk.selection
        threads = [Thread(other.points, self._shown.colour_of(run)) for run, other in self._shown.overlays]
        if project.actual is not None:
            points = np.column_stack([line.points[:, :2], actual_elevations(line, project.actual)])
            threads.append(Thread(points, colours().measure))
        self.canvas.show_scene(
            self._making.scene(
                line,
                _FIGURES[self.figure_box.currentIndex()],
                actual=project.actual,
                threads=tuple(threads),
                segments=tuple(index for index in selection.segments if index < len(line.segments)),
                station=self._in_true_size(selection.station),
                has_drop_lines=self.drop_box.isChecked(),
            )
        )

    def _scale(self) -> float:
        """Return the factor from the centreline's stations to the line's."""
        run = self._shown.run
        return 1.0 if run is None else run.scale

    def _in_true_size(self, station: float | None) -> float | None:
        return None if station is None else station * self._scale()

    def _on_hovered(self, row: int) -> None:
        line = self._shown.line
        if line is not None and 0 <= row < len(line.stations):
            self._desk.selection.station = float(line.stations[row]) / self._scale()

    def _on_picked(self, row: int, adds: bool) -> None:
        line = self._shown.line
        if line is None or not 0 <= row < len(line.stations):
            if not adds:
                self._desk.selection.segments = ()
            return
        index = int(line.segment_of[row])
        before = self._desk.selection.segments if adds else ()
        self._desk.selection.segments = (*before, index)
        self._desk.selection.station = float(line.stations[row]) / self._scale()

    def _on_height(self, value: int) -> None:
        self.canvas.exaggerate(value / 10)
        self._say_height()

    def _say_height(self) -> None:
        factor = self._desk.quantities.number(self.height_slider.value() / 10, 1)
        self.height_label.setText(self.tr("Height × {factor}").format(factor=factor))
