"""From space to a picture: parallel rays from any side."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from bobdesk.arrays import FloatArray

_FLATTEST, _STEEPEST = math.radians(-89.0), math.radians(90.0)
_SMALLEST, _LARGEST = 1e-3, 1e4
_MARGIN = 0.88


@dataclass(frozen=True)
class Camera:
    """Where one looks from.

    Attributes
    ----------
    turn
        About the vertical, radians; at 0 one looks along +y.
    tilt
        Above the horizon, radians; pi / 2 looks down from above.
    zoom
        Pixels a metre.
    centre
        Place in space that is in the middle of the picture, x y z, m, z without exaggeration.
    exaggeration
        By which heights are multiplied.
    """

    turn: float = math.radians(-35.0)
    tilt: float = math.radians(28.0)
    zoom: float = 1.0
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    exaggeration: float = 2.5

    def seen(self, points: FloatArray, width: float, height: float) -> tuple[FloatArray, FloatArray]:
        """Return places in the picture and distances from the viewer.

        Parameters
        ----------
        points : (n, 3)
            m.
        width, height
            Of the picture, pixels.

        Returns
        -------
        (n, 2) pixels, y down, and (n,) depths, m, larger ones farther away.
        """
        x, y, z = (points - np.array(self.centre)).T
        z = z * self.exaggeration
        across = math.cos(self.turn) * x + math.sin(self.turn) * y
        away = -math.sin(self.turn) * x + math.cos(self.turn) * y
        up = math.sin(self.tilt) * away + math.cos(self.tilt) * z
        depths: FloatArray = math.cos(self.tilt) * away - math.sin(self.tilt) * z
        places = np.column_stack([width / 2 + self.zoom * across, height / 2 - self.zoom * up])
        return places, depths

    def orbited(self, by_turn: float, by_tilt: float) -> Camera:
        """Return the camera moved around the centre, radians."""
        tilt = min(max(self.tilt + by_tilt, _FLATTEST), _STEEPEST)
        return replace(self, turn=math.remainder(self.turn + by_turn, 2 * math.pi), tilt=tilt)

    def panned(self, right: float, down: float) -> Camera:
        """Return the camera that shows everything moved by so many pixels."""
        across, up = -right / self.zoom, down / self.zoom
        x, y, z = self.centre
        away = up * math.sin(self.tilt)
        return replace(
            self,
            centre=(
                x + math.cos(self.turn) * across - math.sin(self.turn) * away,
                y + math.sin(self.turn) * across + math.cos(self.turn) * away,
                z + up * math.cos(self.tilt) / self.exaggeration,
            ),
        )

    def zoomed(self, factor: float, right: float, down: float) -> Camera:
        """Return a nearer or farther camera; the place that lies so many pixels from the middle stays there."""
        zoom = min(max(self.zoom * factor, _SMALLEST), _LARGEST)
        kept = zoom / self.zoom - 1
        return replace(replace(self, zoom=zoom).panned(-right * kept, -down * kept))

    def looking(self, turn: float, tilt: float) -> Camera:
        """Return the camera looking another way, degrees."""
        return replace(self, turn=math.radians(turn), tilt=math.radians(tilt))

    def fitted(self, points: FloatArray, width: float, height: float) -> Camera:
        """Return the camera that shows all points, (n, 3)."""
        low, high = points.min(axis=0), points.max(axis=0)
        middle = 0.5 * (low + high)
        camera = replace(self, zoom=1.0, centre=(float(middle[0]), float(middle[1]), float(middle[2])))
        places, _ = camera.seen(points, 0.0, 0.0)
        size = np.maximum(np.ptp(places, axis=0), 1e-6)
        zoom = _MARGIN * min(width / size[0], height / size[1])
        camera = replace(camera, zoom=min(max(float(zoom), _SMALLEST), _LARGEST))
        places, _ = camera.seen(points, 0.0, 0.0)
        off = 0.5 * (places.min(axis=0) + places.max(axis=0))
        return camera.panned(-float(off[0]), -float(off[1]))
