"""All layers of one view, from the picture up to what the tool in hand previews."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRectF
from PySide6.QtWidgets import QGraphicsScene

from bobdesk.project.steps import StepName
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.layers.actual_track import ActualTrackLayer
from bobdesk.ui.plan_view.layers.centreline import CentrelineLayer
from bobdesk.ui.plan_view.layers.control_points import ControlPointsLayer
from bobdesk.ui.plan_view.layers.elevations import ElevationsLayer
from bobdesk.ui.plan_view.layers.flags import FlagsLayer
from bobdesk.ui.plan_view.layers.furniture import FurnitureLayer
from bobdesk.ui.plan_view.layers.layer import Layer
from bobdesk.ui.plan_view.layers.picture import PictureLayer
from bobdesk.ui.plan_view.layers.preview import PreviewLayer
from bobdesk.ui.plan_view.layers.segments import SegmentsLayer
from bobdesk.ui.plan_view.layers.source_line import SourceLineLayer
from bobdesk.ui.plan_view.layers.stations import StationsLayer
from bobdesk.ui.plan_view.layers.trace import TraceLayer
from bobdesk.ui.plan_view.space import Frame
from bobdesk.ui.plan_view.tool_box import ToolBox

# Layers that belong to some steps only, unless the user switches them.
_IN_STEPS: dict[str, tuple[StepName, ...]] = {
    "control_points": ("Plan", "Scale"),
    "segments": ("Segments", "Solve", "Export"),
    "actual_track": ("Solve", "Export"),
    "elevations": ("Segments", "Solve", "Export"),
}


class LayerStack:
    """The layers by name, lowest first; which are shown is remembered in the settings."""

    def __init__(self, desk: Desk, scene: QGraphicsScene, frame: Callable[[], Frame], tools: ToolBox) -> None:
        self._settings = desk.settings
        self.picture = PictureLayer(desk, frame)
        self.preview = PreviewLayer(desk, frame, lambda: tools.current)
        made: tuple[Layer, ...] = (
            self.picture,
            SourceLineLayer(desk, frame),
            TraceLayer(desk, frame, lambda: tools.current.preview_points()),
            CentrelineLayer(desk, frame),
            SegmentsLayer(desk, frame),
            ActualTrackLayer(desk, frame),
            StationsLayer(desk, frame),
            ElevationsLayer(desk, frame),
            FlagsLayer(desk, frame),
            ControlPointsLayer(desk, frame),
            FurnitureLayer(desk, frame),
            self.preview,
        )
        self._layers = {layer.name: layer for layer in made}
        for height, layer in enumerate(made):
            layer.setZValue(height)
            layer.setVisible(self._settings.flag(f"layer_{layer.name}", layer.usually_shown))
            scene.addItem(layer)

    @property
    def names(self) -> tuple[str, ...]:
        """Of the layers that can be switched, lowest first."""
        return tuple(name for name in self._layers if name != self.preview.name)

    def __getitem__(self, name: str) -> Layer:
        """Return a layer by its name."""
        return self._layers[name]

    def in_loupe(self) -> list[Layer]:
        """Return the shown layers that a loupe magnifies."""
        hidden = ("furniture", "flags", "stations")
        return [layer for layer in self._layers.values() if layer.isVisible() and layer.name not in hidden]

    def show_in_step(self, step: StepName) -> None:
        """Show the layers that belong to a step; what the user has switched stays as it is."""
        for name, steps in _IN_STEPS.items():
            self._layers[name].setVisible(self._settings.flag(f"layer_{name}", step in steps))

    def set_bounds(self, bounds: QRectF) -> None:
        """Let all layers cover the scene."""
        for layer in self._layers.values():
            layer.set_bounds(bounds)

    def is_shown(self, name: str) -> bool:
        """Return whether a layer is switched on."""
        return self._layers[name].isVisible()

    def set_shown(self, name: str, shown: bool) -> None:
        """Switch a layer on or off."""
        self._layers[name].setVisible(shown)
        if name == "trace":
            self._layers["source_line"].setVisible(shown)
        self._settings.set_flag(f"layer_{name}", shown)
