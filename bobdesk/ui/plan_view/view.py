"""The plan in the middle of the window: layers below, the tool in hand above."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QKeyEvent, QShowEvent
from PySide6.QtWidgets import QWidget

from bobdesk.project.project import Project
from bobdesk.project.steps import StepName
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.canvas import Canvas
from bobdesk.ui.plan_view.layer_stack import LayerStack
from bobdesk.ui.plan_view.loupe import Loupe
from bobdesk.ui.plan_view.nudge import is_arrow, nudge
from bobdesk.ui.plan_view.selected_part import selected_part
from bobdesk.ui.plan_view.space import space_of
from bobdesk.ui.plan_view.tool_box import ToolBox
from bobdesk.ui.plan_view.tools.tool import Tool


class PlanView(Canvas):
    """Shows the plan.

    Signals
    -------
    tool_changed
        Another tool is in hand: its name.
    said
        What the tool in hand does, one line.
    """

    tool_changed = Signal(str)
    said = Signal(str)

    def __init__(self, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.desk = desk
        self.setObjectName("plan_view")
        self.setAccessibleName(self.tr("Plan"))
        self.viewport().setAccessibleName(self.tr("Plan"))
        self.setAccessibleDescription(self.tr("The same vertices and points stand in the tables of the panels."))
        self.tools = ToolBox(desk, self)
        self.layers = LayerStack(desk, self.scene(), self.frame_now, self.tools)
        self._loupe = Loupe(desk, self.layers.in_loupe, self.viewport())
        self._loupe_is_wanted = desk.settings.flag("loupe", True)
        self._doubt = -1
        self._to_be_fitted = True
        self.pointer_moved.connect(self._place_loupe)
        self.tools.changed.connect(self._on_tool)
        self.tools.said.connect(self.said)
        self.tools.repaint.connect(self.viewport().update)
        for name in self.tools.names:
            self.tools[name].show_place.connect(self.show_place)
        desk.session.document_changed.connect(self._on_document)
        desk.session.changed.connect(self._on_changed)
        desk.picture.changed.connect(self._enter_space)
        self._enter_space()
        self.show_cursor()

    @property
    def tool_name(self) -> str:
        """Name of the tool in hand."""
        return self.tools.current.name

    @property
    def sentence(self) -> str:
        """What the tool in hand does."""
        return self.tools.current.sentence

    @property
    def picture_opacity(self) -> float:
        """How strongly the picture is shown, 0 to 1."""
        return self.layers.picture.strength

    @picture_opacity.setter
    def picture_opacity(self, value: float) -> None:
        self.layers.picture.strength = min(max(value, 0.0), 1.0)
        self.viewport().update()

    def tool(self, name: str) -> Tool:
        """Return a tool by its name."""
        return self.tools[name]

    def tool_in_hand(self) -> Tool:
        """Return the tool that gets mouse and keys."""
        return self.tools.current

    def set_tool(self, name: str) -> None:
        """Take a tool in hand."""
        self.tools.take(name)

    def fit_all(self) -> None:
        """Show the whole plan."""
        self.navigation.fit(self.navigation.space.bounds)
        self.view_changed.emit()

    def fit_selection(self) -> None:
        """Show what is selected, or else the whole line, or else the whole plan."""
        part = selected_part(self.desk, self.navigation.space)
        self.navigation.fit(self.navigation.space.bounds if part is None else part)
        self.view_changed.emit()

    def zoom_by(self, factor: float) -> None:
        """Zoom about the middle."""
        self.navigation.zoom(factor)
        self.view_changed.emit()

    def zoom_to_pixels(self) -> None:
        """Show a picture's pixel as one of the screen."""
        self.navigation.zoom_to(1.0 / self.devicePixelRatioF())
        self.view_changed.emit()

    def show_place(self, x: float, y: float) -> None:
        """Bring a place of the plan to the middle."""
        self.navigation.show(self.navigation.space.to_scene((x, y)))
        self.view_changed.emit()

    def show_step(self, step: StepName) -> None:
        """Show what a step is about, and take the tool that it begins with; a drag ends."""
        self.tools.current.let_go()
        self.layers.show_in_step(step)
        self.tools.at_rest = "boundaries" if step == "Segments" else "select"
        if step == "Segments" and self.tool_name == "select":
            self.set_tool("boundaries")
        elif step != "Segments" and self.tool_name == "boundaries":
            self.set_tool("select")
        self.view_changed.emit()

    def take_back(self) -> bool:
        """Take the last click of the tool in hand back; return whether there was one."""
        return self.tools.current.take_back()

    def cancel(self) -> bool:
        """Drop what is under way, or else put the tool down; return whether there was something."""
        if self.tools.current.cancel():
            return True
        if self.tool_name not in ("select", self.tools.at_rest):
            self.set_tool(self.tools.at_rest)
            return True
        return False

    def nudge(self, event: QKeyEvent) -> bool:
        """Move what is selected by an arrow key."""
        return is_arrow(event) and nudge(
            self.desk,
            event,
            px_per_screen=self.frame_now().per_screen,
            vertices_label=self.tr("Nudge vertices"),
            point_label=self.tr("Nudge control point"),
        )

    def set_layer_shown(self, layer: str, shown: bool) -> None:
        """Switch a layer on or off."""
        self.layers.set_shown(layer, shown)
        self.view_changed.emit()

    def is_layer_shown(self, layer: str) -> bool:
        """Return whether a layer is switched on."""
        return self.layers.is_shown(layer)

    def is_loupe_shown(self) -> bool:
        """Whether the loupe is shown while points are placed."""
        return self._loupe_is_wanted

    def show_loupe(self, shown: bool) -> None:
        """Show the loupe while points are placed, or never."""
        self._loupe_is_wanted = shown
        self.desk.settings.set_flag("loupe", shown)
        self._place_loupe()

    def show_next_doubt(self) -> None:
        """Bring the next doubtful stretch of the trace to the middle, and select its vertices."""
        trace = self.desk.session.project.trace
        if trace is None or len(trace.suspect) == 0:
            return
        self._doubt = (self._doubt + 1) % len(trace.suspect)
        first, last = (int(index) for index in trace.suspect[self._doubt])
        self.desk.selection.vertices = range(first, last + 1)
        self.fit_selection()

    def showEvent(self, event: QShowEvent) -> None:
        """Show the whole plan the first time."""
        super().showEvent(event)
        self._fit_once()

    def _place_loupe(self, _place: object = None) -> None:
        tool = self.tools.current
        helps = self._loupe_is_wanted and (tool.places_points or tool.is_dragging)
        helps = helps and not self.navigation.is_panning and self.navigation.space.kind != "nothing"
        self._loupe.look(self.pointer if helps else None, self.frame_now())

    def _on_tool(self, name: str) -> None:
        self._place_loupe()
        self.show_cursor()
        self.tool_changed.emit(name)
        self.said.emit(self.sentence)

    def _on_document(self) -> None:
        self._to_be_fitted = True
        self.desk.selection.clear()

    def _on_changed(self, before: Project, after: Project) -> None:
        if before.picture is not after.picture or before.source is not after.source:
            self._to_be_fitted = self._to_be_fitted or before.picture is None or after.picture is None
        self._drop_lost_selection(after)
        self._enter_space()
        self.tools.refresh()

    def _drop_lost_selection(self, project: Project) -> None:
        chosen = self.desk.selection
        count = 0 if project.trace is None else len(project.trace.points)
        chosen.vertices = tuple(index for index in chosen.vertices if index < count)
        if chosen.control_point is not None and chosen.control_point >= len(project.control_points):
            chosen.control_point = None

    def _enter_space(self) -> None:
        decoded = self.desk.picture.decoded
        size = None if decoded is None else (decoded.levels[0].width(), decoded.levels[0].height())
        space = space_of(self.desk.session.project, size)
        if space != self.navigation.space:
            self.navigation.enter(space)
            self.layers.set_bounds(self.sceneRect())
        self._fit_once()
        self.viewport().update()

    def _fit_once(self) -> None:
        """Show a new document whole, once its size is known and the view has one."""
        project = self.desk.session.project
        if not self._to_be_fitted or not self.isVisible() or self.navigation.space.kind == "nothing":
            return
        self.fit_all()
        size_is_known = project.picture is None or project.picture.size_px or self.desk.picture.decoded is not None
        self._to_be_fitted = not size_is_known
