import io
import struct

import numpy as np
import pytest
from PIL import Image

from bobdesk.errors import InputError
from bobdesk.plan.image import PictureHeader, PlanImage, decode_picture

RNG = np.random.default_rng(1)
SMOOTH = np.add.outer(np.arange(120), np.arange(90)).astype(np.uint8)  # (120, 90), compresses well
COLOUR = np.stack([SMOOTH, SMOOTH[::-1], 255 - SMOOTH], axis=-1)


def encoded(picture: Image.Image, kind: str, **options) -> bytes:
    stream = io.BytesIO()
    picture.save(stream, kind, **options)
    return stream.getvalue()


def decoded(picture: Image.Image, kind: str = "PNG", **options) -> PlanImage:
    return decode_picture(encoded(picture, kind, **options), name="plan")


LOSSLESS = [
    ("PNG", {}),
    ("TIFF", {}),
    ("TIFF", {"compression": "tiff_lzw"}),
    ("TIFF", {"compression": "tiff_deflate"}),
    ("TIFF", {"compression": "packbits"}),
    ("BMP", {}),
]


@pytest.mark.parametrize(("kind", "options"), [*LOSSLESS, ("WEBP", {"lossless": True})])
def test_colour_comes_back_as_it_was(kind, options):
    image = decoded(Image.fromarray(COLOUR), kind, **options)
    assert np.array_equal(image.pixels, COLOUR)
    assert (image.format, image.pages, image.notes, image.world) == (kind, 1, (), None)


@pytest.mark.parametrize(("kind", "options"), [*LOSSLESS, ("GIF", {})])
def test_grey_stays_grey(kind, options):
    image = decoded(Image.fromarray(SMOOTH), kind, **options)
    assert image.pixels.dtype == np.uint8
    assert np.array_equal(image.pixels, SMOOTH)


BITS = RNG.random((50, 67)) > 0.3


@pytest.mark.parametrize(
    ("kind", "options"),
    [*LOSSLESS, ("TIFF", {"compression": "group4"}), ("TIFF", {"compression": "group3"})],
)
def test_one_bit_stays_one_bit_with_true_for_white(kind, options):
    image = decoded(Image.fromarray(BITS), kind, **options)
    assert image.pixels.dtype == np.bool_
    assert np.array_equal(image.pixels, BITS)


@pytest.mark.parametrize("kind", ["JPEG", "TIFF"])
def test_jpeg_and_jpeg_in_tiff_are_near(kind):
    options = {"compression": "jpeg"} if kind == "TIFF" else {}
    for pixels in SMOOTH, COLOUR:
        image = decoded(Image.fromarray(pixels), kind, quality=95, **options)
        assert image.pixels.shape == pixels.shape
        difference = np.abs(image.pixels.astype(int) - pixels)
        assert np.median(difference) <= 3


def test_tiled_tiff():
    tile = 32
    tiles = [SMOOTH[y : y + tile, x : x + tile].copy() for y in (0, 32, 64) for x in (0, 32)]
    data = tiff(
        [
            (256, 3, [64]),
            (257, 3, [96]),
            (258, 3, [8]),
            (259, 3, [1]),
            (262, 3, [1]),
            (277, 3, [1]),
            (322, 3, [tile]),
            (323, 3, [tile]),
            (324, 4, [8 + tile * tile * number for number in range(6)]),
            (325, 4, [tile * tile] * 6),
        ],
        body=b"".join(part.tobytes() for part in tiles),
    )
    assert np.array_equal(decode_picture(data, name="plan").pixels, SMOOTH[:96, :64])


def tiff(entries, *, body=b"") -> bytes:
    """A TIFF of one page: header, `body` (at offset 8), the values, the directory."""
    sizes = {3: ("H", 2), 4: ("I", 4), 5: ("II", 8), 12: ("d", 8)}
    values, directory = b"", b""
    start = 8 + len(body)
    for tag, kind, numbers in entries:
        code, size = sizes[kind]
        flat = [part for number in numbers for part in (number if kind == 5 else [number])]
        packed = struct.pack("<" + code * len(numbers), *flat)
        if len(packed) <= 4:
            field = packed.ljust(4, b"\0")
        else:
            field = struct.pack("<I", start + len(values))
            values += packed
        directory += struct.pack("<HHI", tag, kind, len(packed) // size) + field
    values += b"\0" * (len(values) % 2)
    head = b"II*\0" + struct.pack("<I", start + len(values))
    return head + body + values + struct.pack("<H", len(entries)) + directory + b"\0\0\0\0"


def grey_tiff(*extra) -> bytes:
    basic = [(256, 3, [4]), (257, 3, [3]), (258, 3, [8]), (259, 3, [1]), (262, 3, [1]), (273, 4, [8])]
    return tiff(sorted([*basic, (277, 3, [1]), (278, 3, [3]), (279, 4, [12]), *extra]), body=bytes(range(12)))


@pytest.mark.parametrize("kind", ["PNG", "TIFF"])
def test_sixteen_bit_grey_keeps_its_brightness(kind):
    full = np.linspace(0, 65535, 90 * 4).astype(np.uint16).reshape(4, 90)
    image = decoded(Image.fromarray(full), kind)
    assert image.pixels.dtype == np.uint8
    assert np.abs(image.pixels - full / 257).max() <= 0.5
    # 12 bits in 16: bright stays bright
    image = decoded(Image.fromarray(full // 16), kind)
    assert image.pixels.max() == 255
    assert len(image.notes) == 1
    assert "4095" in image.notes[0]


def test_sixteen_bit_colour_is_reduced_with_a_note():
    deep = np.arange(24, dtype="<u2").reshape(2, 4, 3) * 2700
    data = tiff(
        [
            (256, 3, [4]),
            (257, 3, [2]),
            (258, 3, [16, 16, 16]),
            (259, 3, [1]),
            (262, 3, [2]),
            (273, 4, [8]),
            (277, 3, [3]),
            (278, 3, [2]),
            (279, 4, [48]),
        ],
        body=deep.tobytes(),
    )
    image = decode_picture(data, name="plan")
    assert np.abs(image.pixels - deep / 257).max() <= 1
    assert image.notes == ("Its 16 bits per colour were reduced to 8.",)


def test_floating_point_grey_is_spread_and_ignores_nan():
    values = np.array([[1.0, 2.0], [np.nan, 3.0]], dtype=np.float32)
    image = decoded(Image.fromarray(values), "TIFF")
    assert image.pixels.tolist() == [[0, 128], [0, 255]]


def test_cmyk_is_converted_with_a_note():
    picture = Image.fromarray(COLOUR).convert("CMYK")
    for kind in "JPEG", "TIFF":
        image = decoded(picture, kind)
        assert image.pixels.shape == COLOUR.shape
        assert np.median(np.abs(image.pixels.astype(int) - COLOUR)) <= 4
        assert "CMYK" in image.notes[0]


@pytest.mark.parametrize("kind", ["PNG", "TIFF", "WEBP"])
def test_transparent_is_laid_on_white(kind):
    alpha = np.zeros((120, 90), dtype=np.uint8)
    alpha[:40], alpha[40:80] = 255, 128
    picture = Image.fromarray(np.dstack([COLOUR, alpha]))
    image = decoded(picture, kind, **({"lossless": True, "exact": True} if kind == "WEBP" else {}))
    assert np.array_equal(image.pixels[:40], COLOUR[:40])
    assert (image.pixels[80:] == 255).all()
    half = COLOUR[40:80] * (128 / 255) + 255 * (127 / 255)
    assert np.abs(image.pixels[40:80] - half).max() <= 0.51
    assert image.notes == ("Transparent parts were laid on white.",)


def test_an_alpha_that_hides_nothing_is_not_worth_a_note():
    opaque = np.full((120, 90), 255, dtype=np.uint8)
    image = decoded(Image.fromarray(np.dstack([COLOUR, opaque])))
    assert np.array_equal(image.pixels, COLOUR)
    assert image.notes == ()


def test_grey_with_alpha_stays_grey():
    picture = Image.merge("LA", (Image.fromarray(SMOOTH), Image.new("L", (90, 120), 0)))
    image = decoded(picture)
    assert image.pixels.shape == (120, 90)
    assert (image.pixels == 255).all()


def test_palettes_of_colours_and_of_greys():
    colours = Image.fromarray(COLOUR).quantize(16)
    assert np.array_equal(decoded(colours).pixels, np.asarray(colours.convert("RGB")))
    greys = Image.fromarray(SMOOTH // 64)
    greys.putpalette([0, 0, 0, 80, 80, 80, 160, 160, 160, 255, 255, 255])
    image = decoded(greys)
    assert image.pixels.shape == (120, 90)
    assert np.array_equal(image.pixels, np.asarray(greys.convert("L")))


def test_a_transparent_palette_colour_becomes_white():
    picture = Image.new("P", (4, 4), 1)
    picture.putpalette([255, 0, 0, 0, 0, 255])
    picture.putpixel((0, 0), 0)
    for kind in "PNG", "GIF":
        image = decoded(picture, kind, transparency=0)
        assert image.pixels[0, 0].tolist() == [255, 255, 255]
        assert image.pixels[1, 1].tolist() == [0, 0, 255]


def test_of_a_moving_gif_the_first_frame_is_shown():
    frames = [Image.fromarray(np.full((5, 5), value, dtype=np.uint8)) for value in (10, 200)]
    image = decoded(frames[0], "GIF", save_all=True, append_images=frames[1:])
    assert (image.pixels == 10).all()
    assert image.pages == 1
    assert "first frame" in image.notes[0]


def test_pages_of_a_tiff():
    pages = [Image.fromarray(np.full((5, 5 + value), value, dtype=np.uint8)) for value in (10, 20)]
    data = encoded(pages[0], "TIFF", save_all=True, append_images=pages[1:])
    image = decode_picture(data, name="plan", page=2)
    assert (image.width, image.height, image.pages) == (25, 5, 2)
    with pytest.raises(InputError, match="2 pages; there is no page 3"):
        decode_picture(data, name="plan", page=3)


ASYMMETRIC = np.arange(12, dtype=np.uint8).reshape(3, 4) * 20


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize("kind", ["PNG", "TIFF", "WEBP", "JPEG"])
def test_the_exif_turn_is_honoured(kind, orientation):
    from PIL import ImageOps

    # enlarged, so that JPEG and its colours keep the pattern
    stored = Image.fromarray(np.kron(ASYMMETRIC, np.ones((16, 16), dtype=np.uint8)))
    stored = stored.convert("RGB") if kind == "WEBP" else stored
    exif = Image.Exif()
    exif[0x0112] = orientation
    data = encoded(stored, kind, exif=exif, **({"lossless": True} if kind == "WEBP" else {}))
    image = decode_picture(data, name="plan")
    stored.getexif()[0x0112] = orientation
    expected = np.asarray(ImageOps.exif_transpose(stored))
    assert image.pixels.shape == expected.shape
    assert np.abs(image.pixels.astype(int) - expected).max() <= (3 if kind == "JPEG" else 0)
    assert len(image.notes) == (orientation != 1)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "TIFF", "BMP"])
def test_dpi_of_the_files_own_tags(kind):
    assert decoded(Image.fromarray(SMOOTH), kind, dpi=(300, 300)).dpi == (300, 300)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP", "GIF"])
def test_no_dpi_is_made_up(kind):
    assert decoded(Image.fromarray(SMOOTH), kind).dpi is None


def test_no_dpi_is_made_up_from_broken_exif_or_missing_tags():
    exif = Image.Exif()
    exif[0x010E] = "a plan"  # EXIF without a resolution: Pillow would say 72
    assert decoded(Image.fromarray(SMOOTH), "JPEG", exif=exif).dpi is None
    assert decode_picture(grey_tiff(), name="plan").dpi is None


def test_dpi_in_centimetres_and_from_exif():
    data = grey_tiff((282, 5, [(100, 1)]), (283, 5, [(100, 1)]), (296, 3, [3]))
    assert decode_picture(data, name="plan").dpi == (254, 254)
    exif = Image.Exif()
    exif[282], exif[283], exif[296] = 240.0, 240.0, 2
    assert decoded(Image.fromarray(SMOOTH), "WEBP", exif=exif).dpi == (240, 240)


def test_pixels_that_are_not_square_are_said():
    image = decoded(Image.fromarray(BITS), "TIFF", compression="group4", dpi=(204, 98))
    assert image.dpi == (204, 98)
    assert "not square" in image.notes[0]


def test_a_quarter_turn_swaps_the_dpi():
    exif = Image.Exif()
    exif[0x0112] = 6
    image = decoded(Image.fromarray(SMOOTH), "JPEG", dpi=(200, 100), exif=exif)
    assert image.dpi == (100, 200)


def test_a_geotiff_knows_its_place_and_bad_tags_are_a_note():
    place = [(33550, 12, [0.5, 0.5, 0]), (33922, 12, [0, 0, 0, 1000, 2000, 0])]
    world = decode_picture(grey_tiff(*place), name="plan").world
    assert world.at(0, 0) == (1000.25, 1999.75)
    degrees = (34735, 3, [1, 1, 0, 1, 1024, 0, 1, 2])
    image = decode_picture(grey_tiff(*place, degrees), name="plan")
    assert image.world is None
    assert "degrees" in image.notes[0]


def test_the_pixels_cannot_be_written():
    image = decoded(Image.fromarray(SMOOTH))
    with pytest.raises(ValueError, match="read-only"):
        image.pixels[0, 0] = 1


def test_a_picture_of_another_shape_is_a_programming_error():
    with pytest.raises(ValueError, match="no picture"):
        PlanImage(np.zeros((2, 2, 4), np.uint8), None, 1, "PNG")
    with pytest.raises(ValueError, match="no picture"):
        PlanImage(np.zeros((0, 2), np.uint8), None, 1, "PNG")


def test_the_limit_comes_before_decoding():
    data = encoded(Image.fromarray(SMOOTH), "PNG")
    seen: list[PictureHeader] = []
    decode_picture(data, name="plan", limit_megapixels=0.0109, before_decoding=seen.append)
    assert [(header.width, header.height) for header in seen] == [(90, 120)]
    with pytest.raises(InputError, match="plan is too large: 90 × 120 pixels"):
        decode_picture(data, name="plan", limit_megapixels=0.0107, before_decoding=seen.append)
    assert len(seen) == 1


def test_over_pillows_own_limit_no_warning_leaks():
    # 120 megapixels, of which Pillow would warn; warnings are errors here
    image = decoded(Image.new("1", (12_000, 10_000), 1), "TIFF", compression="group4")
    assert image.pixels.all()


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b"station,x,y\n1,2,3\n", "not a picture"),
        (b"AC1032 and so on", "DWG"),
        (b"PK\x03\x04....", "ZIP"),
        (b"\0\0\0\x18ftypheic", "HEIC"),
        (b"8BPS", "Photoshop"),
        (b"<html><body>not found</body></html>", "not a picture"),
    ],
)
def test_what_is_no_picture_is_said(data, words):
    with pytest.raises(InputError, match=words) as caught:
        decode_picture(data, name="plan.png")
    assert str(caught.value).startswith("plan.png")


@pytest.mark.parametrize(("page", "dpi"), [(0, 200), (1, 5), (1, 5000), (1, float("nan"))])
def test_pages_and_dpi_out_of_range(page, dpi):
    with pytest.raises(InputError):
        decode_picture(encoded(Image.fromarray(SMOOTH), "PNG"), name="plan", page=page, dpi=dpi)


def test_damaged_bytes_give_a_sentence_or_a_picture_and_nothing_else():
    rng = np.random.default_rng(4)
    noise = Image.fromarray(rng.integers(0, 255, (20, 30, 3), dtype=np.uint8))
    grey = noise.convert("L")
    seeds = [encoded(noise, kind) for kind in ("PNG", "JPEG", "TIFF", "WEBP", "BMP")]
    seeds += [encoded(grey, "GIF"), encoded(grey, "TIFF", compression="tiff_lzw"), grey_tiff()]
    seeds.append(b'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><path d="M0 0L9 9"/></svg>')
    pictures, sentences = 0, []
    for number in range(900):
        data = bytearray(seeds[number % len(seeds)])
        for _ in range(int(rng.integers(1, 6))):
            data[int(rng.integers(0, min(len(data), 200)))] = int(rng.integers(0, 256))
        if number % 3 == 0:
            del data[int(rng.integers(1, len(data))) :]
        try:
            decode_picture(bytes(data), name="plan", limit_megapixels=1)
            pictures += 1
        except InputError as sentence:
            sentences.append(str(sentence))
    assert all("plan" in sentence and sentence.endswith(".") for sentence in sentences)
    assert min(pictures, len(sentences)) > 50
