"""Light and dark from one palette, for widgets, drawings and icons alike."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication

from bobdesk.ui.settings import Settings, Theme


@dataclass(frozen=True)
class Colours:
    """Every colour of the window, by what it is for.

    Straight and curve differ in lightness too, and are drawn in two widths: colour never stands alone.
    """

    is_dark: bool
    window: str
    panel: str
    base: str
    alternate: str
    text: str
    muted: str
    border: str
    outline: str
    accent: str
    on_accent: str
    accent_soft: str
    good: str
    warning: str
    warning_soft: str
    warning_border: str
    error: str
    error_soft: str
    selected_row: str
    canvas: str
    paper: str
    trace: str
    trace_doubtful: str
    vertex: str
    control_point: str
    straight: str
    curve: str
    start: str
    finish: str
    measure: str
    preview: str
    grid: str
    good_soft: str
    runs: tuple[str, ...]


LIGHT = Colours(
    is_dark=False,
    window="#f5f7fa",
    panel="#fafbfd",
    base="#ffffff",
    alternate="#f5f7fa",
    text="#22252b",
    muted="#5f6672",
    border="#d5dae1",
    outline="#8a929e",
    accent="#1b6ec2",
    on_accent="#ffffff",
    accent_soft="#dcebfa",
    good="#1f7a45",
    warning="#7a5200",
    warning_soft="#fff6e2",
    warning_border="#ecca83",
    error="#b3261e",
    error_soft="#fdecea",
    selected_row="#fff1c2",
    canvas="#dde2df",
    paper="#ffffff",
    trace="#1b6ec2",
    trace_doubtful="#e07b00",
    vertex="#ffffff",
    control_point="#c4148c",
    straight="#1b6ec2",
    curve="#d9622b",
    start="#1f7a45",
    finish="#22252b",
    measure="#7a3fb8",
    preview="#0a8f8f",
    grid="#d5dae1",
    good_soft="#e8f5ec",
    runs=("#1b6ec2", "#c2410c", "#1f7a45", "#4a2511", "#b3127a", "#6b5a00", "#0a7a8f", "#5f6672"),
)
DARK = Colours(
    is_dark=True,
    window="#1e2126",
    panel="#23272d",
    base="#191c20",
    alternate="#20242a",
    text="#e6e9ee",
    muted="#a3abb8",
    border="#3a414b",
    outline="#6b7480",
    accent="#5aa5ef",
    on_accent="#0e1116",
    accent_soft="#24405c",
    good="#62c38b",
    warning="#f2cd84",
    warning_soft="#3a3017",
    warning_border="#6d5a2a",
    error="#ff8a80",
    error_soft="#43211f",
    selected_row="#4a4218",
    canvas="#121417",
    paper="#ffffff",
    trace="#3f8fe0",
    trace_doubtful="#ff9f2e",
    vertex="#ffffff",
    control_point="#ff5cc4",
    straight="#5aa5ef",
    curve="#f08a55",
    start="#62c38b",
    finish="#e6e9ee",
    measure="#b98af0",
    preview="#2cc4c4",
    grid="#3a414b",
    good_soft="#1d3527",
    runs=("#5aa5ef", "#f08a55", "#62c38b", "#ffe9b0", "#ff7ac6", "#d8c34a", "#3fc1d6", "#a3abb8"),
)


_FIELDS = ("QLineEdit", "QAbstractSpinBox", "QComboBox")
# By how much the style darkens the window's colour for an outline.
_DARKER = 1.4


class _InForce:
    colours = LIGHT


def colours() -> Colours:
    """Return the colours in force."""
    return _InForce.colours


@contextmanager
def on_paper() -> Iterator[None]:
    """Have the light colours in force for a while: paper is white, whatever the screen is."""
    before = _InForce.colours
    _InForce.colours = LIGHT
    try:
        yield
    finally:
        _InForce.colours = before


def apply_theme(application: QApplication, theme: Theme) -> None:
    """Bring the whole application to light or dark.

    Qt's own colour scheme does nothing without a platform theme, so an own palette is set.
    """
    _InForce.colours = DARK if _is_dark(application, theme) else LIGHT
    application.setStyle("Fusion")
    application.setPalette(_palette(_InForce.colours))
    for name in _FIELDS:
        application.setPalette(_field_palette(_InForce.colours), name)  # type: ignore[arg-type]
    application.setStyleSheet(_style_sheet(_InForce.colours))


class ThemeFollower(QObject):
    """Keeps the application in the theme that the user, or the system, has chosen."""

    def __init__(self, application: QApplication, settings: Settings) -> None:
        super().__init__(application)
        self._application = application
        self._settings = settings
        settings.changed.connect(self._on_setting)
        application.styleHints().colorSchemeChanged.connect(self._on_scheme)
        apply_theme(application, settings.theme)

    def _on_setting(self, name: str) -> None:
        if name == "theme":
            apply_theme(self._application, self._settings.theme)

    def _on_scheme(self) -> None:
        if self._settings.theme == "system":
            apply_theme(self._application, "system")


def _is_dark(application: QApplication, theme: Theme) -> bool:
    if theme == "system":
        return application.styleHints().colorScheme() == Qt.ColorScheme.Dark
    return theme == "dark"


def _palette(of: Colours) -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette()
    for one, colour in (
        (role.Window, of.window),
        (role.WindowText, of.text),
        (role.Base, of.base),
        (role.AlternateBase, of.alternate),
        (role.Text, of.text),
        (role.Button, of.panel),
        (role.ButtonText, of.text),
        (role.BrightText, of.error),
        (role.Highlight, of.accent),
        (role.HighlightedText, of.on_accent),
        (role.Link, of.accent),
        (role.LinkVisited, of.accent),
        (role.ToolTipBase, of.base),
        (role.ToolTipText, of.text),
        (role.PlaceholderText, of.muted),
        (role.Accent, of.accent),
        (role.Light, of.base),
        (role.Midlight, of.panel),
        (role.Mid, of.border),
        (role.Dark, of.border),
        (role.Shadow, of.border),
    ):
        palette.setColor(one, QColor(colour))
    faint = QColor(of.muted)
    faint.setAlpha(150)
    for one in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, one, faint)
    return palette


def _field_palette(of: Colours) -> QPalette:
    """Return a palette with which the style draws fields in an outline that can be seen.

    It makes the outline from the window's colour, darker, which nothing else of a field is drawn with; on a dark
    window that is no outline at all.
    """
    palette = _palette(of)
    outline = QColor(of.outline)
    parts = (outline.red(), outline.green(), outline.blue())
    drawn_from = QColor(*(min(255, round(part * _DARKER)) for part in parts))
    palette.setColor(QPalette.ColorRole.Window, drawn_from)
    return palette


Kind = Literal["title", "muted", "warning", "error", "good"]


def _style_sheet(of: Colours) -> str:
    return f"""
QToolTip {{ color: {of.text}; background: {of.base}; border: 1px solid {of.border}; padding: 3px; }}
QStatusBar {{ background: {of.window}; border-top: 1px solid {of.border}; }}
QStatusBar::item {{ border: none; }}
QCheckBox::indicator:unchecked, QRadioButton::indicator:unchecked, QTableView::indicator:unchecked {{
    width: 13px; height: 13px; border: 1px solid {of.muted}; background: {of.base}; }}
QCheckBox::indicator:unchecked, QTableView::indicator:unchecked {{ border-radius: 3px; }}
QRadioButton::indicator:unchecked {{ border-radius: 7px; }}
QCheckBox::indicator:unchecked:disabled, QRadioButton::indicator:unchecked:disabled {{ border-color: {of.border}; }}
QMenuBar {{ background: {of.window}; }}
QMenuBar::item:selected {{ background: {of.accent_soft}; }}
QToolBar {{ background: {of.window}; border: none; spacing: 3px; padding: 3px; }}
QToolBar::separator {{ background: {of.border}; width: 1px; height: 1px; margin: 4px; }}
QDockWidget {{ font-weight: 600; }}
QDockWidget#panel_dock {{ font-size: 12pt; }}
QDockWidget > QWidget {{ font-weight: 400; }}
QDockWidget#panel_dock > QWidget {{ font-size: {QApplication.font().pointSizeF()}pt; }}
QMainWindow::separator {{ background: {of.border}; width: 1px; height: 1px; }}
QLabel[kind="title"] {{ font-size: 13pt; font-weight: 600; }}
QLabel[kind="heading"] {{ font-weight: 600; color: {of.muted}; }}
QLabel[kind="muted"] {{ color: {of.muted}; }}
QLabel[kind="error"] {{ color: {of.error}; }}
QLabel[kind="good"] {{ color: {of.good}; }}
QLabel[kind="warning"] {{ color: {of.warning}; background: {of.warning_soft};
    border: 1px solid {of.warning_border}; border-radius: 4px; padding: 6px 8px; }}
QFrame[kind="notice"] {{ background: {of.warning_soft}; border: 1px solid {of.warning_border}; border-radius: 4px; }}
QFrame[kind="notice"] QLabel {{ color: {of.warning}; border: none; }}
QFrame[kind="notice"] QPushButton[kind="link"] {{ color: {of.warning}; font-weight: 600; }}
QFrame[kind="line"] {{ background: {of.border}; max-height: 1px; border: none; }}
QPushButton[kind="primary"] {{ background: {of.accent}; color: {of.on_accent}; font-weight: 600;
    border: 1px solid {of.accent}; border-radius: 4px; padding: 5px 12px; }}
QPushButton[kind="primary"]:disabled {{ background: {of.border}; border-color: {of.border}; color: {of.muted}; }}
QPushButton[kind="primary"]:focus {{ border: 2px solid {of.text}; }}
QPushButton[kind="link"] {{ border: none; background: transparent; color: {of.accent}; text-decoration: underline;
    padding: 2px; }}
QToolButton[kind="chip"] {{ border: 1px solid {of.border}; border-radius: 4px; padding: 2px 6px; color: {of.muted}; }}
QToolButton[kind="chip"]:checked {{ border-color: {of.accent}; background: {of.accent_soft}; color: {of.text}; }}
QToolButton[kind="chip"]:focus {{ border: 2px solid {of.accent}; }}
QTableView#runs_table::indicator {{ width: 11px; height: 11px; border: 1px solid {of.muted}; background: {of.base}; }}
QTableView#runs_table::indicator:checked {{ border-color: {of.accent}; background: {of.accent}; }}
QTableView {{ gridline-color: {of.border}; selection-background-color: {of.selected_row};
    selection-color: {of.text}; }}
QHeaderView::section {{ background: {of.window}; color: {of.muted}; font-weight: 600; border: none;
    border-bottom: 1px solid {of.border}; padding: 3px 6px; }}
"""
