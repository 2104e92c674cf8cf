"""The small copy of a picture on which a line is sought: Lab colours and the background behind them."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PIL import Image
from scipy import ndimage

from bobdesk.arrays import FloatArray
from bobdesk.plan.raster import Float32Array, Pixels, area_average, copy_size, lab

# The background is the median over 9 x 9 blocks of 8 pixels: wider than any line, narrower than a lake.
_BLOCK = 8
_BLOCKS = 9


@dataclass(frozen=True, eq=False)
class WorkCopy:
    """A copy of at most some megapixels.

    Attributes
    ----------
    colours
        (h, w, c) CIE Lab, c = 3, or L* alone, c = 1.
    background
        The same shape: the colour of the paper, field or wood around each pixel.
    scale_x, scale_y
        Copy pixels per picture pixel, at most 1.
    """

    colours: Float32Array
    background: Float32Array
    scale_x: float
    scale_y: float

    @property
    def scale(self) -> float:
        """Copy pixels per picture pixel, the mean of both directions."""
        return 0.5 * (self.scale_x + self.scale_y)

    def to_copy(self, points: npt.ArrayLike) -> FloatArray:
        """Picture pixels (n, 2) to copy pixels; both count from the top left pixel's centre."""
        return (np.asarray(points, dtype=np.float64) + 0.5) * [self.scale_x, self.scale_y] - 0.5

    def to_picture(self, points: npt.ArrayLike) -> FloatArray:
        """Copy pixels (n, 2) to picture pixels."""
        return (np.asarray(points, dtype=np.float64) + 0.5) / [self.scale_x, self.scale_y] - 0.5


def work_copy(pixels: Pixels, *, megapixels: float = 1.5) -> Generator[float, None, WorkCopy]:
    """Make the copy of `pixels` with at most `megapixels`; yields the fraction done."""
    full_height, full_width = pixels.shape[:2]
    height, width = copy_size(full_height, full_width, megapixels=megapixels)
    average = yield from area_average(pixels, height=height, width=width)
    rows = max(1, 200_000 // width)
    for first in range(0, height, rows):
        average[first : first + rows] = lab(average[first : first + rows])
        yield min(1.0, (first + rows) / height)
    background = np.empty_like(average)
    for channel in range(average.shape[2]):
        background[..., channel] = _background(average[..., channel])
        yield (channel + 1) / average.shape[2]
    return WorkCopy(average, background, width / full_width, height / full_height)


def _background(channel: Float32Array) -> Float32Array:
    """Median of the surroundings: of every second pixel in blocks, then of the blocks, then bilinear."""
    height, width = channel.shape
    padded = np.pad(channel, ((0, -height % _BLOCK), (0, -width % _BLOCK)), mode="edge")
    rows, columns = padded.shape[0] // _BLOCK, padded.shape[1] // _BLOCK
    blocks = padded.reshape(rows, _BLOCK, columns, _BLOCK)[:, ::2, :, ::2]
    medians = np.median(blocks.transpose(0, 2, 1, 3).reshape(rows, columns, -1), axis=-1)
    smooth = ndimage.median_filter(medians.astype(np.float32), size=_BLOCKS, mode="nearest")
    picture = Image.fromarray(smooth).resize((columns * _BLOCK, rows * _BLOCK), Image.Resampling.BILINEAR)
    return np.asarray(picture, dtype=np.float32)[:height, :width]
