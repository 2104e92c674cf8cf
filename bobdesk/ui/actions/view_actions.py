"""Zoom, layers and loupe of the plan view."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject

from bobdesk.ui.actions.action import Action
from bobdesk.ui.desk import Desk
from bobdesk.ui.plan_view.view import PlanView
from bobdesk.ui.solve.open_data import open_data_of

_STEP = 1.25


class ViewActions(QObject):
    """What changes the look on the plan and never the plan."""

    def __init__(self, desk: Desk, view: PlanView, parent: QObject) -> None:
        super().__init__(parent)
        self._desk = desk
        self._view = view

    def table(self) -> tuple[Action, ...]:
        """Return the rows."""
        return (*self._zooms(), *self._layers(), *self._open_data(), self._loupe())

    def _zooms(self) -> tuple[Action, ...]:
        view, there = self._view, self._is_open
        return (
            Action(
                "fit_all",
                self.tr("Show the &whole plan"),
                view.fit_all,
                ("Ctrl+0",),
                "fit-all",
                self.tr("Zoom so that the whole plan is seen"),
                "View",
                "zoom",
                enabled=there,
                context=True,
            ),
            Action(
                "fit_selection",
                self.tr("Show the &selection"),
                view.fit_selection,
                ("F",),
                "fit-selection",
                self.tr("Zoom to what is selected, or else to the line"),
                "View",
                "zoom",
                "canvas",
                enabled=there,
                context=True,
            ),
            Action(
                "zoom_in",
                self.tr("Zoom &in"),
                lambda: view.zoom_by(_STEP),
                ("Ctrl++", "Ctrl+="),
                "zoom-in",
                self.tr("Show the plan larger; the wheel does it at the cursor"),
                "View",
                "zoom",
                enabled=there,
            ),
            Action(
                "zoom_out",
                self.tr("Zoom &out"),
                lambda: view.zoom_by(1 / _STEP),
                ("Ctrl+-",),
                "zoom-out",
                self.tr("Show the plan smaller; the wheel does it at the cursor"),
                "View",
                "zoom",
                enabled=there,
            ),
            Action(
                "zoom_to_pixels",
                self.tr("Picture at its own si&ze (1:1)"),
                view.zoom_to_pixels,
                ("Ctrl+Shift+0",),
                "",
                self.tr("Show each pixel of the picture as one pixel of the screen"),
                "View",
                "zoom",
                enabled=self._has_picture,
            ),
        )

    def _layers(self) -> tuple[Action, ...]:
        names = {
            "picture": self.tr("&Picture"),
            "trace": self.tr("&Digitised line"),
            "centreline": self.tr("&Centreline beside a digitised edge"),
            "segments": self.tr("&Segments"),
            "actual_track": self.tr("&Actual track"),
            "stations": self.tr("S&tations"),
            "elevations": self.tr("&Known elevations and selected stretch"),
            "control_points": self.tr("Control &points and distances"),
            "flags": self.tr("Start and &finish"),
            "furniture": self.tr("Scale &bar and north"),
        }
        return tuple(
            Action(
                f"layer_{name}",
                text,
                lambda on, name=name: self._view.set_layer_shown(name, on),
                (),
                "",
                self.tr("Show or hide this layer of the plan"),
                "View",
                "layers",
                enabled=self._is_open,
                checked=partial(self._view.is_layer_shown, name),
            )
            for name, text in names.items()
        )

    def _open_data(self) -> tuple[Action, ...]:
        found = open_data_of(self._desk)
        names = {
            "band": (
                self.tr("&Band of possible elevations"),
                self.tr("Show in the strips every elevation that the data allow"),
            ),
            "profiles": (
                self.tr("P&rofiles at random"),
                self.tr("Show in the strips profiles drawn evenly among all that the data allow"),
            ),
            "error_band": (
                self.tr("&Error band of the result"),
                self.tr("Show in the strips where the real track lies with 95 %"),
            ),
        }
        return tuple(
            Action(
                f"open_{name}",
                text,
                partial(found.show, name),
                (),
                "",
                tip,
                "View",
                "open data",
                enabled=self._is_open,
                checked=partial(found.is_shown, name),
            )
            for name, (text, tip) in names.items()
        )

    def _loupe(self) -> Action:
        return Action(
            "loupe",
            self.tr("&Loupe"),
            self._view.show_loupe,
            ("\\",),
            "loupe",
            self.tr("Show a magnified piece of the plan with a crosshair while points are placed"),
            "View",
            "loupe",
            "canvas",
            enabled=self._is_open,
            checked=self._view.is_loupe_shown,
        )

    def _is_open(self) -> bool:
        return self._desk.session.is_open

    def _has_picture(self) -> bool:
        return self._desk.session.project.picture is not None
