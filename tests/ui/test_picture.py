"""The picture of a result is a real file of its type, with something on it."""

import io
import xml.etree.ElementTree as ElementTree

import numpy as np
import pypdfium2
import pytest
from PIL import Image

from bobdesk.alignment.centreline import fit_centreline
from bobdesk.alignment.segments import Segment
from bobdesk.plan.polyline import Polyline
from bobdesk.progress import finish
from bobdesk.solve.anchors import anchors_of
from bobdesk.solve.envelope import envelope
from bobdesk.solve.pgd import pgd
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.centreline3d import make_centreline3d
from bobdesk.ui.plots.picture import draw_line

ORANGE, BLUE = (232, 116, 59), (31, 119, 208)


@pytest.fixture(scope="module")
def drawn():
    angles = np.linspace(0, np.pi, 60)
    bend = np.column_stack([100 + 40 * np.sin(angles), 40 - 40 * np.cos(angles)])
    vertices = np.concatenate([np.linspace([0, 0], [98, 0], 50), bend, np.linspace([98, 80], [0, 80], 50)])
    centreline = fit_centreline(Polyline(vertices))
    bounds = (0.0, 100.0, 100 + 40 * np.pi, centreline.length)
    segments = tuple(
        Segment("curve" if index == 1 else "straight", *bounds[index : index + 2]) for index in range(3)
    )  # fmt: skip
    targets = Targets(length=327, drop=25, known=(KnownElevation(150, 14),))
    solution = finish(pgd(centreline, segments, targets))
    line = make_centreline3d(centreline, segments, solution)
    band = envelope(solution.profile.stations, anchors_of(targets, centreline.length), targets)

    def draw(kind, with_band=True):
        return draw_line(line, band if with_band else None, targets, title="plan <1> & Größe.csv", kind=kind)

    return draw


def near(pixels, colour):
    return int((np.abs(pixels.astype(int) - colour).max(axis=-1) < 12).sum())


def assert_drawn(pixels):
    """Expect curve and straight in the plan at the top, and the profile in both plots below."""
    height = len(pixels)
    top, middle, bottom = np.split(pixels, [int(0.55 * height), int(0.75 * height)])
    assert near(top, ORANGE) > 300
    assert near(top, BLUE) > 200
    assert near(middle, BLUE) > 300
    assert near(bottom, BLUE) > 300
    assert (pixels == 255).all(axis=-1).mean() > 0.5


def test_png(drawn):
    content = drawn(".png")
    image = Image.open(io.BytesIO(content))
    assert (image.format, image.size) == ("PNG", (1500, 1250))
    assert_drawn(np.asarray(image.convert("RGB")))


def test_svg_is_well_formed_and_shows_its_words(drawn):
    content = drawn(".svg")
    root = ElementTree.fromstring(content)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.get("viewBox").split() == ["0", "0", "1500", "1250"]
    words = " ".join(root.itertext())
    for word in ("elevation (m)", "gradient (%)", "station (m)", "Start", "Finish", "straight", "curve", "Größe"):
        assert word in words, word
    assert_drawn(rendered_by_qt(content))


def rendered_by_qt(svg):
    from PySide6.QtGui import QImage, QPainter
    from PySide6.QtSvg import QSvgRenderer

    image = QImage(1500, 1250, QImage.Format.Format_RGB888)
    image.fill(0xFFFFFFFF)
    painter = QPainter(image)
    QSvgRenderer(svg).render(painter)
    painter.end()
    # Copied, since the bytes belong to the image, and that ends here.
    return np.frombuffer(image.constBits(), np.uint8).reshape(1250, 1500, 3).copy()


def test_svg_and_png_look_alike(drawn):
    png = np.asarray(Image.open(io.BytesIO(drawn(".png"))).convert("RGB"))
    svg = rendered_by_qt(drawn(".svg"))
    for colour in (ORANGE, BLUE):
        assert near(svg, colour) == pytest.approx(near(png, colour), rel=0.25)
    # The axis below the plan reaches as far to the right.
    dark = [np.flatnonzero((pixels[640:670] < 200).any(axis=(0, 2))).max() for pixels in (png, svg)]
    assert dark[1] == pytest.approx(dark[0], abs=5)


def test_pdf_is_one_page_of_the_right_shape(drawn):
    content = drawn(".pdf")
    assert content.startswith(b"%PDF-")
    document = pypdfium2.PdfDocument(content)
    try:
        assert len(document) == 1
        page = document[0]
        width, height = page.get_size()
        assert width / height == pytest.approx(1.2, abs=0.01)
        assert_drawn(np.asarray(page.render(scale=1500 / width).to_pil().convert("RGB")))
    finally:
        document.close()


def test_the_band_is_drawn_only_if_there_is_one(drawn):
    one, other = (np.asarray(Image.open(io.BytesIO(drawn(".png", with_band))).convert("RGB")) for with_band in (1, 0))
    changed = (one != other).any(axis=-1)
    assert changed.sum() > 20_000
    assert not changed[: int(0.7 * len(one))].any()


def test_the_same_result_gives_the_same_picture(drawn):
    assert drawn(".png") == drawn(".png")
