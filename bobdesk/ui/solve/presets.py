"""Public figures of known tracks, to begin with."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache

from bobdesk.ui.resources import resource


@dataclass(frozen=True)
class Preset:
    """Figures of one track as they are published; None where none are.

    Attributes
    ----------
    name
        Of the track.
    length, drop
        m.
    mean_gradient, max_gradient
        Downhill positive.
    curves
        How many there are.
    """

    name: str
    length: float
    drop: float
    mean_gradient: float | None
    max_gradient: float | None
    curves: int


@cache
def presets() -> tuple[Preset, ...]:
    """Return the tracks by name."""
    found = json.loads(resource("presets", "official_tracks.json").read_text(encoding="utf-8"))
    return tuple(
        sorted(
            (
                Preset(
                    track["name"],
                    track["race_length_m"],
                    track["height_difference_m"],
                    track["mean_gradient"],
                    track["max_gradient"],
                    track["curves"],
                )
                for track in found["tracks"]
            ),
            key=lambda preset: preset.name,
        )
    )
