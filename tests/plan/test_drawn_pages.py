import gzip

import numpy as np
import pytest

from bobdesk.errors import InputError
from bobdesk.plan.image import decode_picture
from tests.plan.made_pdf import made_pdf

SVG = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'


def svg(inside: str, *, size='width="100mm" height="50mm" viewBox="0 0 100 50"') -> bytes:
    return f"<svg {SVG} {size}>{inside}</svg>".encode()


BLACK_BOX = '<rect x="10" y="10" width="20" height="10"/>'


@pytest.mark.parametrize("compress", [bytes, gzip.compress])
def test_an_svg_is_drawn_at_the_dpi_asked_for(compress):
    image = decode_picture(compress(svg(BLACK_BOX)), name="plan.svg", dpi=254)
    assert image.pixels.shape == (500, 1000)  # no colours: grey
    assert image.dpi == pytest.approx((254, 254))
    assert (image.pixels[100:200, 100:300] == 0).all()
    image_without_box = image.pixels.copy()
    image_without_box[100:200, 100:300] = 255
    assert (image_without_box == 255).all()


def test_an_svg_in_colour_on_white():
    image = decode_picture(svg('<rect width="50" height="50" fill="red" opacity=".5"/>'), name="plan.svg")
    assert np.abs(image.pixels[10, 10].astype(int) - (255, 127, 127)).max() <= 1
    assert image.pixels[-1, -1].tolist() == [255, 255, 255]


@pytest.mark.parametrize(
    ("size", "shape", "real"),
    [
        ('width="100" height="50"', (104, 208), False),
        ('viewBox="0 0 100 50"', (104, 208), False),
        ('width="100%" height="100%" viewBox="0 0 100 50"', (104, 208), False),
        ('width="5cm" viewBox="0 0 100 50"', (197, 394), True),
        ('height="1in" viewBox="0 0 100 50"', (200, 400), True),
        ('width="2in" height="72pt"', (200, 400), True),
    ],
)
def test_sizes_of_an_svg(size, shape, real):
    image = decode_picture(svg(BLACK_BOX, size=size), name="plan.svg", dpi=200)
    assert image.pixels.shape == shape
    assert (image.dpi is not None) == real
    assert image.dpi is None or image.dpi == pytest.approx((200, 200), rel=1 / 197)


def test_an_svg_in_utf_16_and_with_its_own_entities():
    text = f'<?xml version="1.0" encoding="UTF-16"?><svg {SVG} width="10" height="10">{BLACK_BOX}</svg>'
    decode_picture(text.encode("utf-16"), name="plan.svg")
    own = svg('<rect width="99" height="99" fill="&red;"/>').decode()
    image = decode_picture(f'<!DOCTYPE svg [<!ENTITY red "#f00">]>{own}'.encode(), name="plan.svg")
    assert image.pixels[3, 3].tolist() == [255, 0, 0]


def test_a_picture_that_an_svg_links_to_is_not_opened(tmp_path):
    from PIL import Image

    secret = tmp_path / "secret.png"
    Image.new("RGB", (10, 10), (1, 2, 3)).save(secret)
    for link in str(secret), secret.as_uri(), "http://example.org/a.png":
        for key in "href", "xlink:href":
            drawing = svg(f'<image {key}="{link}" width="100" height="50"/>')
            image = decode_picture(drawing, name="plan.svg")
            assert (image.pixels == 255).all()
            assert "links to" in image.notes[0]


def test_a_picture_inside_an_svg_is_drawn():
    import base64
    import io

    from PIL import Image

    stream = io.BytesIO()
    Image.new("RGB", (10, 10), (200, 0, 0)).save(stream, "PNG")
    link = "data:image/png;base64," + base64.b64encode(stream.getvalue()).decode()
    image = decode_picture(svg(f'<image href="{link}" width="50" height="50"/>'), name="plan.svg")
    assert image.pixels[10, 10].tolist() == [200, 0, 0]
    assert image.notes == ()


def test_use_draws_what_it_should():
    image = decode_picture(
        svg(f'<defs><g id="a">{BLACK_BOX}</g></defs><use href="#a"/><use xlink:href="#a" x="40"/>'),
        name="plan.svg",
        dpi=254,
    )
    assert image.pixels[150, 150] == 0
    assert image.pixels[150, 550] == 0


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (svg(BLACK_BOX)[:-20], "damaged or ends too early"),
        (svg(BLACK_BOX, size=""), "no size"),
        (svg(BLACK_BOX, size='width="0" height="0"'), "no size"),
        (svg(BLACK_BOX, size='viewBox="0 0 nan 5"'), "no size"),
        (svg(BLACK_BOX, size='width="9000mm" height="9000mm"'), "draw it at 17 dpi"),
        (svg(BLACK_BOX, size='width="1e9mm" height="1e9mm"'), "too large to be drawn"),
        (b'<?xml version="1.0"?><kml/>', "not an SVG"),
        (b'<?xml version="1.0" encoding="nonsense"?><svg/>', "plan.svg"),
        (gzip.compress(svg(BLACK_BOX))[:-20], "ends too early"),
        (gzip.compress(bytes(70_000_000)), "too large"),
        (svg("<g>" * 300 + "</g>" * 300), "deep"),
    ],
)
def test_bad_drawings_say_what(data, words):
    with pytest.raises(InputError, match=words) as caught:
        decode_picture(data, name="plan.svg")
    assert "plan.svg" in str(caught.value)


def test_a_circle_of_uses_ends():
    drawing = svg('<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>' + BLACK_BOX)
    with pytest.raises(InputError, match="without end"):
        decode_picture(drawing, name="plan.svg")


def test_a_small_drawing_is_not_scaled_by_rounded_pixels():
    # 4 mm are 15.12 pixels at 96 dpi; the box ends 3 mm from the left whatever is rounded
    drawing = svg('<path d="M0 0H3V4H0z"/>', size='width="4mm" height="4mm" viewBox="0 0 4 4"')
    image = decode_picture(drawing, name="plan.svg", dpi=2400)
    black = (255 - image.pixels[150].astype(float)).sum() / 255
    assert black == pytest.approx(3 / 25.4 * image.dpi[0], abs=0.02)


def test_the_dpi_of_a_pdf_page_is_that_of_its_pixels():
    data = made_pdf(["0 0 0 rg 0 0 m 75 0 l 0 75 l f"], width=100.3, height=100.3)
    image = decode_picture(data, name="plan.pdf", dpi=100)
    black = (255 - image.pixels.astype(float)).sum() / 255
    assert image.dpi[0] > 100.3
    assert black == pytest.approx((75 / 72 * image.dpi[0]) ** 2 / 2, rel=0.002)


def test_a_drawing_keeps_its_shape_in_a_frame_of_another():
    drawing = svg('<rect width="10" height="10"/>', size='width="30mm" height="10mm" viewBox="0 0 10 10"')
    pixels = decode_picture(drawing, name="plan.svg", dpi=254).pixels
    assert pixels.shape == (100, 300)
    assert (pixels[:, 100:200] == 0).all()
    assert (pixels[:, :100] == 255).all()


def test_a_pdf_page_is_drawn_at_the_dpi_asked_for():
    data = made_pdf(["0 0 0 rg 72 72 72 36 re f", "1 0 0 rg 0 0 144 144 re f"], width=288, height=144)
    image = decode_picture(data, name="plan.pdf", dpi=100)
    assert image.pixels.shape == (200, 400)
    assert image.dpi == pytest.approx((100, 100))
    assert (image.pages, image.format) == (2, "PDF")
    assert (image.pixels[52:98, 102:198] == 0).all()
    assert image.pixels[110, 150] == 255
    second = decode_picture(data, name="plan.pdf", dpi=72, page=2)
    assert second.pixels[70, 70].tolist() == [255, 0, 0]
    with pytest.raises(InputError, match="2 pages; there is no page 3"):
        decode_picture(data, name="plan.pdf", page=3)


def test_a_pdf_with_a_unit_of_its_own_is_said():
    data = made_pdf([""], width=99, height=99).replace(b"/Type/Page/", b"/Type/Page/UserUnit 2.0/")
    assert "UserUnit" in decode_picture(data, name="plan.pdf").notes[0]


def test_a_pdf_too_large_names_the_dpi_that_fits():
    data = made_pdf(["0 0 10 10 re f"], width=5000, height=5000)
    with pytest.raises(InputError, match="draw it at 91 dpi or less") as caught:
        decode_picture(data, name="plan.pdf", dpi=200)
    assert "plan.pdf" in str(caught.value)
    assert decode_picture(data, name="plan.pdf", dpi=91).pixels.size <= 40e6
