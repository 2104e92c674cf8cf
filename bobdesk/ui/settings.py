"""What the program remembers of its user: preferences, window, recent files. Not part of any project."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal, cast

import platformdirs
from PySide6.QtCore import QByteArray, QObject, QSettings, Signal

Theme = Literal["system", "light", "dark"]
LengthUnit = Literal["m", "ft"]
GradientUnit = Literal["percent", "degrees"]
_MOST_RECENT = 12


def user_settings_file() -> Path:
    """Return where the settings of this user lie."""
    return Path(platformdirs.user_config_dir("bobdesk", appauthor=False)) / "settings.ini"


class Settings(QObject):
    """Typed access to an INI file.

    Signals
    -------
    changed
        Name of the preference that was changed.
    """

    changed = Signal(str)

    def __init__(self, path: Path | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store = QSettings(str(path or user_settings_file()), QSettings.Format.IniFormat)

    @property
    def theme(self) -> Theme:
        """Light, dark, or as the system has it."""
        return cast("Theme", self._one_of("theme", ("system", "light", "dark")))

    @theme.setter
    def theme(self, value: Theme) -> None:
        self._set("theme", value)

    @property
    def language(self) -> str:
        """Code of the language of texts, such as "de"; "" is the system's."""
        return self._text("language")

    @language.setter
    def language(self, value: str) -> None:
        self._set("language", value)

    @property
    def length_unit(self) -> LengthUnit:
        """Unit in which lengths are shown."""
        return cast("LengthUnit", self._one_of("length_unit", ("m", "ft")))

    @length_unit.setter
    def length_unit(self, value: LengthUnit) -> None:
        self._set("length_unit", value)

    @property
    def gradient_unit(self) -> GradientUnit:
        """Unit in which gradients are shown."""
        return cast("GradientUnit", self._one_of("gradient_unit", ("percent", "degrees")))

    @gradient_unit.setter
    def gradient_unit(self, value: GradientUnit) -> None:
        self._set("gradient_unit", value)

    @property
    def autosave_minutes(self) -> int:
        """Minutes after which a project that has a file is saved by itself; 0 never does."""
        return max(0, min(120, self._whole("autosave_minutes", 0)))

    @autosave_minutes.setter
    def autosave_minutes(self, value: int) -> None:
        self._set("autosave_minutes", value)

    @property
    def asks_for_updates(self) -> bool:
        """Whether a newer version is looked for by itself."""
        return bool(self._store.value("updates/ask", False, type=bool))

    @asks_for_updates.setter
    def asks_for_updates(self, value: bool) -> None:
        self._set("updates/ask", value)

    @property
    def updates_asked(self) -> float:
        """When a newer version was looked for last, seconds since 1970; 0 for never."""
        try:
            return float(self._text("updates/asked"))
        except ValueError:
            return 0.0

    @updates_asked.setter
    def updates_asked(self, value: float) -> None:
        self._store.setValue("updates/asked", str(math.floor(value)))

    @property
    def updates_told(self) -> str:
        """The newer version that the user was told of last, "" for none."""
        return self._text("updates/told")

    @updates_told.setter
    def updates_told(self, value: str) -> None:
        self._store.setValue("updates/told", value)

    @property
    def recent(self) -> tuple[Path, ...]:
        """Projects opened or saved lately, newest first."""
        found = self._store.value("recent", [])
        texts = [found] if isinstance(found, str) else found if isinstance(found, list) else []
        return tuple(Path(text) for text in texts if isinstance(text, str) and text)[:_MOST_RECENT]

    def remember_recent(self, path: Path) -> None:
        """Put a project first among the recent ones."""
        path = path.absolute()
        self._set("recent", [str(path), *(str(one) for one in self.recent if one != path)][:_MOST_RECENT])

    def forget_recent(self, path: Path) -> None:
        """Take a project off the recent ones."""
        self._set("recent", [str(one) for one in self.recent if one != path])

    def key_of(self, action: str) -> str | None:
        """Return the key that the user has given an action, "" for none, or None for the usual one."""
        return self._text(f"keys/{action}") if self._store.contains(f"keys/{action}") else None

    def set_key(self, action: str, key: str | None) -> None:
        """Give an action another key; None gives it the usual one again."""
        if key is None:
            self._store.remove(f"keys/{action}")
            self.changed.emit(f"keys/{action}")
        else:
            self._set(f"keys/{action}", key)

    def flag(self, name: str, usual: bool) -> bool:
        """Return a remembered yes or no of the window (a layer that is shown, a sentence not to be said again)."""
        value = self._store.value(f"window/{name}", usual, type=bool)
        return bool(value)

    def set_flag(self, name: str, value: bool) -> None:
        """Remember a yes or no of the window."""
        self._set(f"window/{name}", value)

    def text_of(self, name: str) -> str:
        """Return a remembered text of the window; "" if there is none."""
        return self._text(f"window/{name}")

    def set_text(self, name: str, value: str) -> None:
        """Remember a text of the window."""
        self._store.setValue(f"window/{name}", value)

    def bytes_of(self, name: str) -> QByteArray:
        """Return remembered bytes of the window (geometry, docks); empty if there are none."""
        value = self._store.value(f"window/{name}")
        return value if isinstance(value, QByteArray) else QByteArray()

    def set_bytes(self, name: str, value: QByteArray) -> None:
        """Remember bytes of the window."""
        self._store.setValue(f"window/{name}", value)

    def folder(self, purpose: str) -> str:
        """Return the folder used last for a purpose such as "open"."""
        return self._text(f"folders/{purpose}")

    def set_folder(self, purpose: str, path: Path) -> None:
        """Remember the folder used last."""
        self._store.setValue(f"folders/{purpose}", str(path))

    def write(self) -> None:
        """Bring everything to the disk now."""
        self._store.sync()

    def _set(self, name: str, value: object) -> None:
        self._store.setValue(name, value)
        self.changed.emit(name)

    def _text(self, name: str) -> str:
        value = self._store.value(name, "")
        return value if isinstance(value, str) else ""

    def _whole(self, name: str, usual: int) -> int:
        try:
            return int(self._text(name))
        except ValueError:
            value = self._store.value(name)
            return value if isinstance(value, int) else usual

    def _one_of(self, name: str, choices: tuple[str, ...]) -> str:
        value = self._text(name)
        return value if value in choices else choices[0]
