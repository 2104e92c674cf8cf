"""Preferences: how the program shows things; what is chosen is seen at once, Cancel takes it back."""

from __future__ import annotations

from typing import cast

from PySide6.QtCore import QLocale, Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from bobdesk.ui.dialogs.guide_in_dialog import offer_guide
from bobdesk.ui.resources import resource
from bobdesk.ui.settings import GradientUnit, LengthUnit, Settings, Theme

_LONGEST_AUTOSAVE = 120
_NARROWEST = 430
_SOURCE_LANGUAGE = "en"


def translated_languages() -> tuple[str, ...]:
    """Return the codes of the languages that there are texts for, English among them."""
    try:
        found = {path.stem.split("_", 1)[-1] for path in resource("translations").glob("*.qm")}
    except OSError:
        found = set()
    return tuple(sorted(found | {_SOURCE_LANGUAGE}))


def language_name(code: str) -> str:
    """Return what a language calls itself."""
    name = "English" if code == _SOURCE_LANGUAGE else QLocale(code).nativeLanguageName()
    return name[:1].upper() + name[1:] if name else code


class PreferencesDialog(QDialog):
    """Writes the settings as they are chosen; the window follows `Settings.changed`."""

    def __init__(self, settings: Settings, parent: QWidget | None = None, *, offers_updates: bool = False) -> None:
        super().__init__(parent)
        self.setObjectName("preferences")
        self.setWindowTitle(self.tr("Preferences"))
        self._settings = settings
        self._before = (
            settings.language,
            settings.theme,
            settings.length_unit,
            settings.gradient_unit,
            settings.autosave_minutes,
            settings.asks_for_updates,
        )
        self.theme = self._choices(
            self.tr("Theme"),
            self.tr("Light or dark colours"),
            [(self.tr("As the system"), "system"), (self.tr("Light"), "light"), (self.tr("Dark"), "dark")],
            settings.theme,
        )
        self.language = self._choices(
            self.tr("Language"),
            self.tr("Language of all texts"),
            [(self.tr("As the system"), ""), *((language_name(code), code) for code in translated_languages())],
            settings.language,
        )
        self.length_unit = self._choices(
            self.tr("Lengths"),
            self.tr("Unit of lengths on the screen; files always have metres"),
            [(self.tr("Metres (m)"), "m"), (self.tr("Feet (ft)"), "ft")],
            settings.length_unit,
        )
        self.gradient_unit = self._choices(
            self.tr("Gradients"),
            self.tr("Unit of gradients on the screen"),
            [(self.tr("Percent (%)"), "percent"), (self.tr("Degrees (°)"), "degrees")],
            settings.gradient_unit,
        )
        self.autosave = QSpinBox()
        self.autosave.setRange(0, _LONGEST_AUTOSAVE)
        self.autosave.setSpecialValueText(self.tr("never"))
        self.autosave.setSuffix(self.tr(" min"))
        self.autosave.setKeyboardTracking(False)
        self.autosave.setMinimumHeight(self.theme.sizeHint().height())
        self.autosave.setValue(settings.autosave_minutes)
        self.autosave.setAccessibleName(self.tr("Save every"))
        self.autosave.setToolTip(self.tr("Save a project that has a file by itself; 0 never does"))
        self.updates = QCheckBox(self.tr("Loo&k for a newer version once a day"), self)
        self.updates.setChecked(settings.asks_for_updates)
        self.updates.setToolTip(self.tr("Ask after the start whether there is a newer version, and say so if there is"))
        self.updates.setVisible(offers_updates)
        self._offers_updates = offers_updates
        self._buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok
            | QDialogButtonBox.StandardButton.Cancel
            | QDialogButtonBox.StandardButton.RestoreDefaults
        )
        offer_guide(self, self._buttons)
        self._lay_out()
        self._connect()

    def showEvent(self, event: QShowEvent) -> None:
        """Be as wide as the widest row and as high as the wrapped sentences need: Qt's own guess is too low."""
        super().showEvent(event)
        layout = self.layout()
        if layout is not None:
            self.setMinimumWidth(max(_NARROWEST, layout.totalMinimumSize().width()))
        self.setMinimumHeight(self.heightForWidth(self.width()))

    def reject(self) -> None:
        """Take back all that was chosen."""
        self._show(*self._before)
        super().reject()

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setHorizontalSpacing(16)
        form.setVerticalSpacing(8)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(self._heading(self.tr("Look")))
        form.addRow(self.tr("&Theme"), self.theme)
        form.addRow(self.tr("Lang&uage"), self.language)
        form.addRow("", self._hint(self.tr("Another language is used from the next start on.")))
        form.addRow(self._heading(self.tr("Units on the screen")))
        form.addRow(self.tr("&Lengths"), self.length_unit)
        form.addRow(self.tr("&Gradients"), self.gradient_unit)
        form.addRow("", self._hint(self.tr("Files always have metres and plain numbers.")))
        form.addRow(self._heading(self.tr("Saving")))
        form.addRow(self.tr("&Save every"), self.autosave)
        form.addRow(
            "", self._hint(self.tr("Apart from this, every edit goes into a recovery copy, whatever is chosen here."))
        )
        if self._offers_updates:
            form.addRow(self._heading(self.tr("Newer versions")))
            form.addRow("", self.updates)
            form.addRow("", self._hint(self.tr("Nothing is sent but the question, and nothing is installed.")))
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(16)
        column.addLayout(form)
        column.addStretch(1)
        column.addWidget(self._buttons)

    def _connect(self) -> None:
        settings = self._settings
        self.theme.currentIndexChanged.connect(self._on_theme)
        self.language.currentIndexChanged.connect(self._on_language)
        self.length_unit.currentIndexChanged.connect(self._on_length_unit)
        self.gradient_unit.currentIndexChanged.connect(self._on_gradient_unit)
        self.autosave.valueChanged.connect(lambda minutes: setattr(settings, "autosave_minutes", minutes))
        self.updates.toggled.connect(lambda on: setattr(settings, "asks_for_updates", on))
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        usual = self._buttons.button(QDialogButtonBox.StandardButton.RestoreDefaults)
        usual.setToolTip(self.tr("Bring all of these to what a new installation has"))
        usual.clicked.connect(lambda: self._show("", "system", "m", "percent", 0, False))

    def _show(self, language: str, theme: str, length: str, gradient: str, autosave: int, updates: bool) -> None:
        for box, value in (
            (self.language, language),
            (self.theme, theme),
            (self.length_unit, length),
            (self.gradient_unit, gradient),
        ):
            box.setCurrentIndex(max(0, box.findData(value)))
        self.autosave.setValue(autosave)
        self.updates.setChecked(updates)

    def _on_theme(self) -> None:
        self._settings.theme = cast("Theme", self.theme.currentData())

    def _on_language(self) -> None:
        self._settings.language = self.language.currentData()

    def _on_length_unit(self) -> None:
        self._settings.length_unit = cast("LengthUnit", self.length_unit.currentData())

    def _on_gradient_unit(self) -> None:
        self._settings.gradient_unit = cast("GradientUnit", self.gradient_unit.currentData())

    def _choices(self, name: str, tip: str, choices: list[tuple[str, str]], value: str) -> QComboBox:
        box = QComboBox()
        for text, data in choices:
            box.addItem(text, data)
        box.setCurrentIndex(max(0, box.findData(value)))
        box.setAccessibleName(name)
        box.setToolTip(tip)
        return box

    def _heading(self, text: str) -> QLabel:
        label = QLabel(text)
        label.setProperty("kind", "heading")
        label.setContentsMargins(0, 8, 0, 0)
        return label

    def _hint(self, text: str) -> QLabel:
        label = QLabel(text)
        label.setProperty("kind", "muted")
        label.setWordWrap(True)
        label.setAlignment(Qt.AlignmentFlag.AlignTop)
        return label
