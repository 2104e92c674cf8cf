"""Files made to harm: each must give one sentence within 10 seconds and 1 GB.

Run as a program with "make" and a folder it writes them there. With "read" it reads them and prints name,
seconds and sentence as JSON, and at last the most memory, MB, that it and its helpers held. These are two
processes, since a process's most memory begins with that of the one that started it.
"""

from __future__ import annotations

import io
import json
import random
import resource
import struct
import sys
import time
import zipfile
from functools import partial
from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.importers.formats import read_line
from bobdesk.files.project_archive import archive_bytes
from bobdesk.files.project_encoding import encode_project
from bobdesk.project.project import Project
from tests.files.importers import made_files as made

_ROOTS = {"kml": "kml", "gpx": "gpx", "osm": "osm", "svg": "svg"}


def _laughs(root):
    entities = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 12))
    return f'<?xml version="1.0"?><!DOCTYPE {root} [<!ENTITY l0 "ha">{entities}]><{root}>&l11;</{root}>'.encode()


def _quadratic(root):
    return f'<!DOCTYPE {root} [<!ENTITY a "{"x" * 100_000}">]><{root}>{"&a;" * 100_000}</{root}>'.encode()


def _outside(root):
    return f'<!DOCTYPE {root} [<!ENTITY x SYSTEM "file:///etc/passwd">]><{root} d="1">&x;</{root}>'.encode()


def _lying_kmz():
    """Return an archive that says its entry is small when it unpacks to 150 MB."""
    data = bytearray(made.kmz(b"<kml>" + b" " * 150_000_000))
    for mark, place in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        at = data.index(mark) + place
        data[at : at + 4] = struct.pack("<I", 1000)
    return bytes(data)


def _archive(entries):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, content in entries:
            archive.writestr(name, content)
    return buffer.getvalue()


def _packed(entries):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            archive.writestr(name, content)
    return buffer.getvalue()


def _encrypted():
    data = bytearray(made.kmz())
    for mark, place in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        data[data.index(mark) + place] |= 1
    return bytes(data)


def _first_kilobyte(name):
    return made.ALL[name]()[:1000]


def _looping_dxf():
    block = "0\nBLOCK\n8\n0\n2\nA\n70\n0\n10\n0\n20\n0\n30\n0\n" + "0\nINSERT\n8\n0\n2\nA\n10\n0\n20\n0\n" * 8
    blocks = f"0\nSECTION\n2\nBLOCKS\n{block}0\nENDBLK\n0\nENDSEC\n".encode()
    return blocks + _entities("0\nINSERT\n8\n0\n2\nA\n10\n0\n20\n0\n")


def _entities(body):
    return f"0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n".encode()


def _kml_line(coordinates):
    return b"<kml><LineString><coordinates>" + coordinates + b"</coordinates></LineString></kml>"


def _geojson(coordinates):
    return b'{"type":"LineString","coordinates":' + coordinates + b"}"


def hostile():
    """Return names, and functions that make the contents: all at once would take over a gigabyte."""
    noise = random.Random(5).randbytes(200_000)
    files = {
        "deep.json": lambda: b"[" * 200_000,
        "deep_objects.json": lambda: b'{"a":' * 200_000,
        "deep_closed.geojson": lambda: _geojson(b"[" * 200_000 + b"]" * 200_000),
        "deep_500.geojson": lambda: _geojson(b"[" * 500 + b"1" + b"]" * 500),
        "nan.geojson": lambda: _geojson(b"[[1,2],[NaN,3],[4,5]]"),
        "infinity.geojson": lambda: _geojson(b"[[1,2],[-Infinity,3],[4,5]]"),
        "overflow.geojson": lambda: _geojson(b"[[1,2],[1e999,3],[4,5]]"),
        "long_number.geojson": lambda: _geojson(b"[[1,2],[" + b"9" * 5000 + b",3],[4,5]]"),
        "large_number.geojson": lambda: _geojson(b"[[1,2],[" + b"9" * 400 + b",3],[4,5]]"),
        "wide.geojson": lambda: _geojson(b'[[1,2],[1,"x"],[null,true]]'),
        "far.geojson": lambda: _geojson(b"[[1,2],[100,3],[-100,40]]"),
        "pole.geojson": lambda: _geojson(b"[[1,90],[2,90],[3,90]]"),
        "many_lists.json": lambda: b"[" + b"[]," * 20_000_000 + b"1]",
        "many_lists_below_limit.json": lambda: b"[" + b"[]," * 2_900_000 + b"1]",
        "many_members.json": lambda: b"{" + b",".join(b'"k%d":1.5' % i for i in range(2_900_000)) + b"}",
        "many_objects.json": lambda: b'{"elements":[' + b'{"type":"node","id":1},' * 590_000 + b"1]}",
        "same_point.geojson": lambda: _geojson(b"[" + b"[1.5,2.5]," * 1_000_000 + b"[1,2]]"),
        "half.geojson": lambda: made.geojson()[:1500],
        "deep.kml": lambda: b"<kml>" + b"<a>" * 200_000,
        "many.kml": lambda: b"<kml>" + b"<a/>" * 10_000_000 + b"</kml>",
        "comment.kml": lambda: b"<kml><!--" + b"x" * 60_000_000,
        "attribute.svg": lambda: b'<svg><path d="' + b"M0 0" * 15_000_000 + b'"/></svg>',
        "points.svg": lambda: b"<svg>" + b'<polyline points="' + b"1 " * 30_000_000 + b'"/></svg>',
        "transforms.svg": lambda: b"<svg>" + b'<g transform="' + b"scale(1)" * 7_000_000 + b'"/></svg>',
        "digits.svg": lambda: b'<svg><path d="M0 0 L' + b"1" * 60_000_000 + b' 5"/></svg>',
        "blanks.svg": lambda: b'<svg><path d="M0 0' + b" " * 60_000_000 + b'x"/></svg>',
        "inf.svg": lambda: (
            b'<svg transform="rotate(1e999) scale(1e300)"><path d="M0 0L1e308 1e308A1e300 1e-300 1e999 0 1 5 5"/></svg>'
        ),
        "scaled.svg": lambda: (
            b"<svg>"
            + b'<g transform="scale(1e12)">' * 100
            + b'<path d="M0 0L1 1L2 0L3 3"/>'
            + b"</g>" * 100
            + b"</svg>"
        ),
        "tuples.kml": lambda: (
            b"<kml><LineString><coordinates>" + b"11 " * 20_000_000 + b"</coordinates></LineString></kml>"
        ),
        "pairs.kml": lambda: (
            b"<kml><LineString><coordinates>" + b"1,1 " * 15_000_000 + b"</coordinates></LineString></kml>"
        ),
        "huge.kml": lambda: b"<kml>" + b" " * 70_000_000 + b"</kml>",
        "encoding.kml": lambda: b'<?xml version="1.0" encoding="EBCDIC-9"?><kml></kml>',
        "no_nodes.osm": lambda: made.osm_xml().replace(b"<node", b"<nod"),
        "bomb.kmz": lambda: made.kmz(b"<kml>" + b" " * 150_000_000),
        "lying.kmz": lambda: _lying_kmz(),
        "parent.kmz": lambda: _archive([("../../etc/cron.d/doc.kml", made.kml())]),
        "absolute.kmz": lambda: _archive([("/etc/doc.kml", made.kml())]),
        "windows.kmz": lambda: _archive([("C:\\\\doc.kml", made.kml())]),
        "backslash.kmz": lambda: _archive([("..\\\\doc.kml", made.kml())]),
        "no_kml.kmz": lambda: _archive([("a.png", b"1")]),
        "many.kmz": lambda: _archive([(f"{i}", b"") for i in range(20_000)]),
        "encrypted.kmz": lambda: _encrypted(),
        "half.kmz": lambda: made.kmz()[:900],
        "bomb.bobdesk": lambda: _packed([("project.json", b" " * 110_000_000)]),
        "parent.bobdesk": lambda: _archive([("project.json", b"{}"), ("../../etc/cron.d/evil", b"x")]),
        "deep.bobdesk": lambda: _archive([("project.json", b'{"a":' * 200_000)]),
        "half.bobdesk": lambda: made.bobdesk()[:900],
        "no_line.bobdesk": lambda: archive_bytes(encode_project(Project())),
        "kml.bobdesk": lambda: made.kmz(),
        "noise.kmz": lambda: b"PK\x03\x04" + noise,
        "noise.dxf": lambda: noise,
        "half.dxf": lambda: made.dxf()[:10_000],
        "looping.dxf": lambda: _looping_dxf(),
        "arc.dxf": lambda: _entities("0\nARC\n8\n0\n10\n0\n20\n0\n40\n1e15\n50\n0\n51\n359\n"),
        "spline.dxf": lambda: _entities(
            "0\nSPLINE\n8\n0\n70\n8\n71\n3\n72\n8\n73\n4\n" + "40\n0\n" * 8 + "10\nnan\n20\n0\n30\n0\n" * 4
        ),
        "nan.dxf": lambda: _entities("0\nLINE\n8\n0\n10\nnan\n20\n0\n11\ninf\n21\n1\n"),
        "binary.dxf": lambda: b"AutoCAD Binary DXF\r\n\x1a\x00" + noise,
        "one_line.csv": lambda: b"1," * 50_000_000,
        "cells.csv": lambda: b"x_m,y_m\n" + (b"1," * 5000 + b"\n") * 8000,
        "rows.csv": lambda: b"1,2\n" * 1_500_000,
        "zero.csv": lambda: b"\0" * 1_000_000,
        "noise.csv": lambda: noise,
        "nan.csv": lambda: b"x_m,y_m\n0,0\nnan,1\n2,2\n",
        "empty.csv": lambda: b"",
        "quotes.csv": lambda: b'"' * 90_000,
        "picture.csv": lambda: b"\x89PNG\r\n\x1a\n" + noise,
    }
    for ending, root in _ROOTS.items():
        files[f"laughs.{ending}"] = partial(_laughs, root)
        files[f"quadratic.{ending}"] = partial(_quadratic, root)
        files[f"outside.{ending}"] = partial(_outside, root)
        files[f"half.{ending}"] = partial(_first_kilobyte, ending)
    return files


def make(folder: Path) -> None:
    for name, content in hostile().items():
        (folder / name).write_bytes(content())


def read(folder: Path) -> None:
    for path in sorted(folder.iterdir()):
        started = time.process_time()
        sentence = None
        try:
            read_line(path)
        except InputError as error:
            sentence = str(error)
        print(json.dumps([path.name, round(time.process_time() - started, 2), sentence]), flush=True)
        path.unlink()
    held = max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    print(json.dumps(["memory", held / 1024, None]))


if __name__ == "__main__":
    {"make": make, "read": read}[sys.argv[1]](Path(sys.argv[2]))
