import contextlib
import gzip
import io
import os
import struct
import sys
import time
import zlib

import numpy as np
import pytest
from PIL import Image

from bobdesk.errors import InputError
from bobdesk.files import picture_process
from bobdesk.files.picture_process import decode_in_process, worker_command
from bobdesk.files.pictures import read_picture, read_picture_steps
from bobdesk.progress import finish
from tests.plan.made_pdf import made_pdf

GREY = np.add.outer(np.arange(120), np.arange(90)).astype(np.uint8)
RGB = np.random.default_rng(0).integers(0, 255, (120, 90, 3), dtype=np.uint8)


def encoded(pixels: np.ndarray, kind: str, **options) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, kind, **options)
    return stream.getvalue()


def worker_peak_mb() -> float:
    """Largest resident size of any process that this one started and that has ended."""
    import resource

    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)


@pytest.mark.parametrize("pixels", [GREY > 100, GREY, RGB])
def test_a_picture_comes_back_from_its_process_as_it_was(tmp_path, pixels):
    path = tmp_path / "plan.png"
    path.write_bytes(encoded(pixels, "PNG", dpi=(300, 300)))
    image = read_picture(path)
    assert image.pixels.dtype == pixels.dtype
    assert np.array_equal(image.pixels, pixels)
    assert not image.pixels.flags.writeable
    assert (image.dpi, image.format, image.pages, image.notes) == ((300, 300), "PNG", 1, ())


def test_a_wrong_extension_does_not_matter(tmp_path):
    path = tmp_path / "plan.jpg"
    path.write_bytes(encoded(GREY, "PNG"))
    assert read_picture(path).format == "PNG"


def test_a_name_that_is_not_ascii(tmp_path):
    path = tmp_path / "Königssee 第一 plan.png"
    path.write_bytes(b"nothing")
    with pytest.raises(InputError, match="Königssee 第一"):
        read_picture(path)


def test_the_clipboard():
    image = finish(decode_in_process(encoded(RGB, "PNG"), name="The clipboard"))
    assert np.array_equal(image.pixels, RGB)
    with pytest.raises(InputError, match="The clipboard is not a picture"):
        finish(decode_in_process(b"some words", name="The clipboard"))


def test_page_dpi_and_limit_reach_the_process(tmp_path):
    path = tmp_path / "plan.pdf"
    path.write_bytes(made_pdf(["", "0 0 9 9 re f"], width=144, height=72))
    image = read_picture(path, page=2, dpi=100)
    assert (image.width, image.height, image.pages) == (200, 100, 2)
    assert image.pixels.min() == 0
    with pytest.raises(InputError, match="megapixels"):
        read_picture(path, limit_megapixels=0.01)


def test_a_world_file_beside_the_picture_places_it(tmp_path):
    path = tmp_path / "plan.png"
    path.write_bytes(encoded(GREY, "PNG"))
    (tmp_path / "plan.pgw").write_text("0.5\n0\n0\n-0.5\n1000\n2000\n")
    assert read_picture(path).world.at(2, 2) == (1001, 1999)
    (tmp_path / "plan.pgw").write_text("0.5\n0\n0\n-0.5\n1000\n")
    image = read_picture(path)
    assert image.world is None
    assert image.notes == ("plan.pgw is not a world file: it has 5 lines of text where six belong.",)


def test_a_world_file_of_a_turned_photo(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6
    path = tmp_path / "plan.jpg"
    path.write_bytes(encoded(GREY, "JPEG", exif=exif))
    (tmp_path / "plan.jgw").write_text("0.5\n0\n0\n-0.5\n1000\n2000\n")
    image = read_picture(path)
    assert (image.width, image.height) == (120, 90)
    # stored pixel (0, 0) is the turned picture's top right
    assert image.world.at(119, 0) == pytest.approx((1000, 2000))


# Hostile input: each gives one sentence that names the file, within 10 s and 1 GB.


def huge_png() -> bytes:
    header = struct.pack(">IIBBBBB", 60_000, 60_000, 8, 2, 0, 0, 0)
    return png_of((b"IHDR", header), (b"IDAT", zlib.compress(bytes(1000))), (b"IEND", b""))


def zero_png() -> bytes:
    return png_of((b"IHDR", struct.pack(">IIBBBBB", 0, 10, 8, 0, 0, 0, 0)), (b"IEND", b""))


def png_of(*chunks: tuple[bytes, bytes]) -> bytes:
    parts = [b"\x89PNG\r\n\x1a\n"]
    for kind, body in chunks:
        parts.append(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
    return b"".join(parts)


def patched(data: bytes, at: int, new: bytes) -> bytes:
    return data[:at] + new + data[at + len(new) :]


SVG = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="99" height="99"'


def use_bomb(*, levels: int, kind: str = "g") -> bytes:
    parts = ['<g id="a0"><rect width="9" height="9"/></g>']
    for level in range(1, levels):
        uses = f'<use xlink:href="#a{level - 1}"/>' * 10
        parts.append(f'<{kind} id="a{level}">{uses}</{kind}>')
    return f'<svg {SVG}><defs>{"".join(parts)}</defs><use xlink:href="#a{levels - 1}"/></svg>'.encode()


def pattern_bomb() -> bytes:
    """Patterns filled with patterns: no <use> to count, so only the limits of the process hold it."""
    parts = []
    for level in range(1, 12):
        boxes = f'<rect width="2" height="2" fill="url(#p{level - 1})"/>' * 10
        parts.append(f'<pattern id="p{level}" width="3" height="3" patternUnits="userSpaceOnUse">{boxes}</pattern>')
    box = '<rect width="99" height="99" fill="url(#p11)"/>'
    return f"<svg {SVG}><defs>{''.join(parts)}</defs>{box}</svg>".encode()


def laughs() -> bytes:
    entities = '<!ENTITY a0 "ha">' + "".join(f'<!ENTITY a{level} "{f"&a{level - 1};" * 10}">' for level in range(1, 10))
    return f"<!DOCTYPE svg [{entities}]><svg {SVG}><text>&a9;</text></svg>".encode()


def outside() -> bytes:
    entity = '<!ENTITY e SYSTEM "file:///etc/hostname">'
    return f"<!DOCTYPE svg [{entity}]><svg {SVG}><text>&e;</text></svg>".encode()


def slow_pdf() -> bytes:
    """A page of 400,000 boxes, each over most of it."""
    return made_pdf(["0 0 0 rg " + "0 0 9000 9000 re 10 10 8000 8000 re f* " * 200_000], width=900, height=900)


HOSTILE = {
    "empty.png": (b"", "is empty"),
    "text.png": (b"x_m,y_m\n1,2\n", "not a picture"),
    "zero.png": (zero_png(), "damaged"),
    "huge.png": (huge_png(), "3,600 megapixels"),
    "huge.bmp": (patched(encoded(GREY, "BMP"), 18, struct.pack("<ii", 60_000, 60_000)), "3,600 megapixels"),
    "huge.gif": (patched(encoded(GREY, "GIF"), 6, struct.pack("<HH", 60_000, 60_000)), "3,600 megapixels"),
    "huge.webp": (
        b"RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0" + (59_999).to_bytes(3, "little") * 2,
        "3,600 megapixels",
    ),
    "long.png": (
        png_of(
            (b"IHDR", struct.pack(">IIBBBBB", 200_000, 10, 1, 0, 0, 0, 0)),
            (b"IDAT", zlib.compress(bytes(250_010))),
            (b"IEND", b""),
        ),
        "too long",
    ),
    "cut.png": (encoded(RGB, "PNG")[:900], "damaged or ends too early"),
    "cut.jpg": (encoded(RGB, "JPEG")[:900], "damaged or ends too early"),
    "cut.tif": (encoded(RGB, "TIFF", compression="tiff_lzw")[:-3000], "damaged"),
    "cut_g4.tif": (encoded(GREY > 100, "TIFF", compression="group4")[:60], "damaged"),
    "cut.webp": (encoded(RGB, "WEBP")[:200], "damaged"),
    "cut.bmp": (encoded(RGB, "BMP")[:3000], "damaged or ends too early"),
    "cut.gif": (encoded(GREY, "GIF")[:900], "damaged or ends too early"),
    "cut.pdf": (made_pdf(["0 0 9 9 re f"], width=99, height=99)[:60], "damaged or ends too early"),
    "header.png": (encoded(RGB, "PNG")[:20], "damaged"),
    "header.jpg": (b"\xff\xd8\xff", "damaged"),
    "header.tif": (b"II*\0\x08\0\0\0", "damaged"),
    "header.webp": (b"RIFF\0\0\0\0WEBPVP8 ", "damaged"),
    "header.pdf": (b"%PDF-1.7", "damaged or ends too early"),
    "secret.pdf": (made_pdf([""], width=99, height=99, password="secret"), "password"),
    "large.pdf": (made_pdf([""], width=1e6, height=1e6), "too large to be drawn"),
    "flat.pdf": (made_pdf([""], width=1e6, height=1), "measures"),
    "nothing.pdf": (made_pdf([], width=99, height=99), "PDF"),
    "cut.svg": (f"<svg {SVG}><g>".encode(), "damaged or ends too early"),
    "use.svg": (use_bomb(levels=12), "<use>"),
    "use_symbol.svg": (use_bomb(levels=12, kind="symbol"), "<use>"),
    "laughs.svg": (laughs(), "entity"),
    "outside.svg": (outside(), "entity"),
    "deep.svg": (f"<svg {SVG}>".encode() + b"<g>" * 200_000, "deep"),
    "zip_bomb.svgz": (gzip.compress(bytes(200_000_000)), "too large"),
    "link_device.svg": (f'<svg {SVG}><image href="/dev/zero" width="9" height="9"/></svg>'.encode(), None),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_input_gives_one_sentence(tmp_path, name):
    data, words = HOSTILE[name]
    path = tmp_path / name
    path.write_bytes(data)
    started = time.monotonic()
    if words is None:
        read_picture(path)
    else:
        with pytest.raises(InputError, match=words) as caught:
            read_picture(path)
        sentence = str(caught.value)
        assert name in sentence
        assert sentence.endswith(".")
        assert "\n" not in sentence
    assert time.monotonic() - started < 10
    assert worker_peak_mb() < 1000


@pytest.mark.parametrize("make", [pattern_bomb, slow_pdf, lambda: use_bomb(levels=6)])
def test_what_only_the_limits_can_stop_is_stopped(make):
    started = time.monotonic()
    with contextlib.suppress(InputError):  # a fast computer may draw it
        finish(decode_in_process(make(), name="bomb", time_limit_s=2.0))
    assert time.monotonic() - started < 20
    assert worker_peak_mb() < 1000


def test_missing_folder_device_and_unreadable(tmp_path):
    with pytest.raises(InputError, match=r"There is no file .*nowhere\.png"):
        read_picture(tmp_path / "nowhere.png")
    with pytest.raises(InputError, match="is a folder"):
        read_picture(tmp_path)
    with pytest.raises(InputError, match="name is not allowed"):
        read_picture("a\0b.png")
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe.png")
        with pytest.raises(InputError, match=r"pipe\.png is a device"):
            read_picture(tmp_path / "pipe.png")


def test_a_file_without_permission(tmp_path, monkeypatch):
    path = tmp_path / "plan.png"
    path.write_bytes(encoded(GREY, "PNG"))

    def refuse(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(type(path), "read_bytes", refuse)  # root may read everything
    with pytest.raises(InputError, match=r"plan\.png cannot be read: you have no permission"):
        read_picture(path)


def test_a_disk_that_fails(tmp_path, monkeypatch):
    path = tmp_path / "plan.png"
    path.write_bytes(encoded(GREY, "PNG"))

    def fail(*_):
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(type(path), "read_bytes", fail)
    with pytest.raises(InputError, match=r"plan\.png cannot be read: input/output error\."):
        read_picture(path)


SLEEP = [sys.executable, "-c", "import time; time.sleep(60)"]


def test_a_process_that_hangs_is_given_up(monkeypatch):
    monkeypatch.setattr(picture_process, "worker_command", lambda: SLEEP)
    started = time.monotonic()
    with pytest.raises(InputError, match=r"plan\.png took longer than 1 second to open"):
        finish(decode_in_process(b"x" * 5_000_000, name="plan.png", time_limit_s=0.5))
    assert time.monotonic() - started < 20


def test_a_program_that_starts_itself_gets_the_picture(monkeypatch):
    # what a frozen program's __main__ does for WORKER_ARGUMENT
    run = "from bobdesk.files.picture_worker import main; raise SystemExit(main())"
    monkeypatch.setattr(picture_process, "worker_command", lambda: [sys.executable, "-c", run])
    image = finish(decode_in_process(encoded(RGB, "PNG"), name="plan.png"))
    assert np.array_equal(image.pixels, RGB)


def test_a_process_that_dies_is_a_sentence(monkeypatch):
    for command in ("import sys; sys.exit(3)", "import os; os.abort()", "print('{\"picture\": 1')"):
        monkeypatch.setattr(picture_process, "worker_command", lambda run=command: [sys.executable, "-c", run])
        with pytest.raises(InputError, match=r"plan\.png could not be opened"):
            finish(decode_in_process(b"x" * 5_000_000, name="plan.png"))


def test_closing_the_generator_ends_the_process(tmp_path, monkeypatch):
    mark = tmp_path / "pid"
    run = f"import os, time; open({str(mark)!r}, 'w').write(str(os.getpid())); time.sleep(60)"
    monkeypatch.setattr(picture_process, "worker_command", lambda: [sys.executable, "-c", run])
    path = tmp_path / "plan.png"
    path.write_bytes(encoded(GREY, "PNG"))
    steps = read_picture_steps(path)
    for progress in steps:
        assert 0 <= progress.fraction <= 1
        if mark.exists() and mark.read_text():
            break
    steps.close()
    with pytest.raises(ProcessLookupError):
        os.kill(int(mark.read_text()), 0)


def test_it_reports_at_least_every_tenth_of_a_second():
    steps = decode_in_process(encoded(np.zeros((6000, 6000), np.uint8), "PNG"), name="plan.png")
    longest, before, image = 0.0, time.thread_time(), None
    while image is None:
        try:
            next(steps)
        except StopIteration as end:
            image = end.value
        longest, before = max(longest, time.thread_time() - before), time.thread_time()
    assert image.pixels.shape == (6000, 6000)
    assert longest < 0.1


def test_a_frozen_program_starts_itself(monkeypatch):
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    assert worker_command() == [sys.executable, picture_process.WORKER_ARGUMENT]


def test_the_worker_imports_no_qt_and_no_scipy():
    import subprocess

    run = (
        "import sys, bobdesk.files.picture_worker, bobdesk.plan.raster, bobdesk.plan.svg_page, "
        "bobdesk.plan.pdf_page; print([m for m in ('PySide6', 'scipy', 'shapely') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "[]"
