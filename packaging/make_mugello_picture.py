"""Draw the plan of the Mugello sample as an analyst would get it: a picture with a scale, without elevations.

usage: python packaging/make_mugello_picture.py
"""

import json
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.interpolate import CubicSpline

SAMPLE = Path(__file__).parent.parent / "resources" / "samples" / "mugello"
METRES_PER_PIXEL = 0.25
MARGIN_PX = 160
FINER = 4
LINE_PX = 5.0
PAPER, INK, FAINT = "#f6f4ee", "#2b3440", "#c9c4b6"


def main() -> None:
    table = np.genfromtxt(SAMPLE / "mugello.csv", delimiter=",", names=True)
    station = table["s2d_m"]
    line = CubicSpline(station, np.column_stack([table["x_m"], table["y_m"]]))(np.linspace(0, station[-1], 4000))
    low, high = line.min(axis=0), line.max(axis=0)
    size = np.ceil((high - low) / METRES_PER_PIXEL + 2 * MARGIN_PX).astype(int)
    pixels = (line - low) / METRES_PER_PIXEL + MARGIN_PX
    pixels[:, 1] = size[1] - 1 - pixels[:, 1]

    image = Image.new("RGB", tuple(size * FINER), PAPER)
    draw = ImageDraw.Draw(image)
    for at in range(0, int(size.max()), 200):
        for ends in (((at, 0), (at, size[1])), ((0, at), (size[0], at))):
            draw.line([tuple(FINER * np.array(end)) for end in ends], fill=FAINT, width=FINER)
    centred = FINER * (pixels + 0.5)
    radius = FINER * LINE_PX / 2
    draw.line([tuple(point) for point in centred], fill=INK, width=round(2 * radius), joint="curve")
    font = ImageFont.load_default(FINER * 22)
    for at, name in ((0, "START"), (-1, "FINISH")):
        draw.text(tuple(centred[at] + FINER * np.array([34, -12])), name, fill=INK, font=font)
    draw.text((FINER * 40, FINER * 30), "MUGELLO 700 m", fill=INK, font=ImageFont.load_default(FINER * 30))
    bar = 100 / METRES_PER_PIXEL
    y = FINER * (size[1] - 50)
    draw.line([(FINER * 40, y), (FINER * (40 + bar), y)], fill=INK, width=FINER * 3)
    draw.text((FINER * 40, y - FINER * 34), "100 m", fill=INK, font=font)
    image.resize(tuple(size), Image.Resampling.BOX).save(SAMPLE / "plan.png", optimize=True)
    ends = {"start_px": pixels[0].round(1).tolist(), "end_px": pixels[-1].round(1).tolist()}
    (SAMPLE / "plan.json").write_text(json.dumps({"metres_per_pixel": METRES_PER_PIXEL, **ends}, indent=1) + "\n")


if __name__ == "__main__":
    main()
