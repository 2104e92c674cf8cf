"""What cannot be used is refused by one sentence, the right status, and nothing written."""

import os

import pytest

from tests.cli.calls import TARGETS, contents, one_sentence

UNUSABLE = {
    "missing.csv": (None, "there is no such file"),
    "empty.csv": (b"", "empty"),
    "blank.csv": (b" \n\r\n\t\n", "empty"),
    "header.csv": (b"x_m,y_m\n", "no row below"),
    "comments.csv": (b"# a\n# b\n", "no rows"),
    "one.csv": (b"x_m,y_m\n1,2\n", "only one point"),
    "two.csv": (b"x_m,y_m\n1,2\n30,4\n", "only 2 different points"),
    "equal.csv": (b"x_m,y_m\n" + b"1,2\n" * 9, "only one point"),
    "text.csv": (b"Dear reader,\nthis is a letter,\nnot a plan.\n", "there is no column x_m and y_m"),
    "binary.csv": (bytes(range(256)) * 20, "not a text file"),
    "nan.csv": (b"x_m,y_m\n0,0\n5,nan\n9,9\n", "line 3, column y_m holds 'nan'"),
    "infinite.csv": (b"x_m,y_m\n0,0\n5,1\n-inf,9\n", "line 4, column x_m holds '-inf'"),
    "words.csv": (b"x_m,y_m\n0,0\nfive,1\n7,9\n", "line 3, column x_m holds 'five'"),
    "hole.csv": (b"# a note\nx_m,y_m\n0,0\n\n5,\n9,9\n", "line 5, column y_m is empty"),
    "short row.csv": (b"x_m,y_m\n0,0\n5\n9,9\n", "line 3: there is no column y_m"),
    "wrong.csv": (b"a,b\n0,0\n5,5\n9,9\n", "line 1: there is no column x_m and y_m; there are a, b"),
    "half.csv": (b"x_m,b\n0,0\n5,5\n9,9\n", "no column y_m"),
    "four.csv": (b"0,0,1,2\n5,5,1,2\n9,9,1,2\n", "line 1: there is no header"),
    "far.csv": (b"x_m,y_m\n0,0\n5,5\n1e9,9\n", "line 4, column x_m holds 1e+09"),
    "tiny.csv": (b"x_m,y_m\n0,0\n0.5,0.5\n0.9,0.9\n", "too short"),
    "long.csv": (b"x_m,y_m\n0,0\n5e6,0\n9e6,9\n", "are the coordinates metres"),
    "decimal commas.csv": (b"x_m,y_m\n0,5,0,5\n10,5,3,5\n20,5,9,5\n", "line 2: the row has 4 cells"),
    "one row.csv": (b"1," * 200_000, "line 1: the row has 400,000 characters"),
    "half utf-16.csv": ("\ufeffx_m,y_m\n0,0\n5,5\n9,9".encode("utf-16-le")[:-1], "broken at byte"),
}


@pytest.mark.parametrize("name", UNUSABLE)
@pytest.mark.parametrize("command", ["segment", "check", "reconstruct", "compare"])
def test_a_plan_that_cannot_be_used(call, name, command):
    content, expected = UNUSABLE[name]
    path = call.path(name)
    if content is not None:
        path.write_bytes(content)
    arguments = {
        "segment": (path, "-o", call.path("out.csv")),
        "check": (path, *TARGETS, "--report", call.path("out.json")),
        "reconstruct": (path, *TARGETS, "-o", call.path("out.csv"), "--picture", call.path("out.png")),
        "compare": (call.plan, path, "--report", call.path("out.json")),
    }[command]
    if command == "compare" and name in ("tiny.csv", "long.csv"):
        expected = "column z_m"
    sentence = call.refused(command, *arguments, status=3)
    assert expected in sentence
    assert name in sentence


def test_a_folder_is_no_plan(call):
    assert "folder" in call.refused("segment", call.folder, "-o", call.path("s.csv"), status=3)


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device here")  # noqa: PTH110
def test_a_device_without_end_is_refused(call, monkeypatch):
    monkeypatch.setattr("bobdesk.files.importers.table._LARGEST_FILE", 1_000_000)
    assert "too large" in call.refused("segment", "/dev/zero", "-o", call.path("s.csv"), status=3)


TWO_HALVES = b"segment,kind,from_m,to_m\n1,straight,0,300\n2,curve,300,702.1\n"


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (None, "no such file"),
        (b"kind,from_m\nstraight,0\n", "the column to_m is missing; a table of segments needs kind, from_m and to_m"),
        (TWO_HALVES.replace(b"curve", b"bend"), "line 3, column kind holds 'bend'"),
        (TWO_HALVES.replace(b",300,702.1", b",310,702.1"), "leaves a gap"),
        (TWO_HALVES.replace(b",300,702.1", b",290,702.1"), "overlaps"),
        (TWO_HALVES.replace(b"702.1", b"600"), "end at 600.000 m"),
        (TWO_HALVES.replace(b",300\n", b",\n"), "line 2, column to_m is empty"),
        (TWO_HALVES.replace(b"0,300", b"x,300"), "line 2, column from_m holds 'x'"),
    ],
)
def test_segments_that_cannot_be_used(call, content, expected):
    path = call.path("s.csv")
    if content is not None:
        path.write_bytes(content)
    for command in (("check",), ("reconstruct", "-o", call.path("l.csv"))):
        assert expected in call.refused(*command, call.plan, *TARGETS, "--segments", path, status=3)


@pytest.mark.parametrize(
    "options",
    [
        ("--known", "200"),
        ("--known", "200:a"),
        ("--known", "200:20,5"),
        ("--known", "1_0:20"),
        ("--known", "nan:20"),
        ("--known", ":"),
        ("--known", "1:2:3:4"),
        ("--known", "200:20:-1"),
        ("--known",),
        ("--count", "0"),
        ("--count", "-3"),
        ("--count", "2.5"),
        ("--spacing", "0"),
        ("--spacing", "nan"),
        ("--spacing", "11"),
        ("--wavelength", "-1"),
        ("--wavelength", "inf"),
        ("--threshold", "0"),
        ("--threshold", "nan"),
        ("--length", "1,300"),
        ("--length", "nan"),
        ("--length", "0"),
        ("--drop", "-30"),
        ("--drop", "0"),
        ("--drop", "800"),
        ("--drop", "inf"),
        ("--min-gradient", "0.3", "--max-gradient", "0.1"),
        ("--min-gradient", "0.1", "--max-gradient", "0.1"),
        ("--max-gradient", "10"),
        ("--max-gradient", "nan"),
        ("--mean-gradient", "4.3"),
        ("--mean-gradient", "nan"),
        ("--mean-gradient", "0"),
        ("--mean-gradient", "-0.05"),
        ("--mean-gradient", "-0.05", "--mean-gradient-is", "drop-per-plan"),
        ("--mean-gradient-is", "whatever"),
        ("--segments", "s.csv", "--count", "4"),
        ("--segments", "s.csv", "--threshold", "0.004"),
        ("--no-such-option",),
        ("one argument too many",),
    ],
)
def test_a_wrong_call_has_status_2(call, options):
    for command in (("check",), ("reconstruct", "-o", call.path("l.csv"))):
        call.refused(*command, call.plan, *TARGETS, *options, status=2)


@pytest.mark.parametrize(
    "options",
    [
        ("--transition", "-1"),
        ("--transition", "nan"),
        ("--transition", "201"),
        ("--weight-length", "-1"),
        ("--weight-gradient", "nan"),
        ("--weight-height", "inf"),
        ("--method", "magic"),
        ("--flavour", "vanilla"),
        ("--picture", "p.bmp"),
        ("--picture", "p"),
    ],
)
def test_a_wrong_call_of_reconstruct(call, options):
    call.refused("reconstruct", call.plan, *TARGETS, "-o", call.path("l.csv"), *options, status=2)


@pytest.mark.parametrize("arguments", [("segment",), ("segment", "p.csv"), ("check", "p.csv"), ("fly",), ("--fly",)])
def test_a_call_with_too_little(call, arguments):
    call.refused(*arguments, status=2)


CONTRADICTIONS = [
    (("--known", "900:2"), "900 m lies outside the line"),
    (("--known", "-5:29"), "-5 m lies outside the line"),
    (("--known", "200:-2"), "below the lowest point"),
    (("--known", "200:20", "--known", "200:21"), "21 m at 200 m contradicts 20 m"),
    (("--known", "0:12"), "contradicts 30 m"),
    (("--known", "200:20", "201:5"), "between 200 m and 201 m"),
    (("--max-gradient", "0.01"), "must fall by 30.00 m"),
    (("--min-gradient", "0.1"), "must fall by 30.00 m"),
]


@pytest.mark.parametrize(("options", "expected"), CONTRADICTIONS)
def test_targets_that_contradict_each_other(call, options, expected):
    output = call.path("l.csv")
    assert expected in call.refused("reconstruct", call.plan, *TARGETS, "-o", output, *options, status=3)
    strict = call.refused("reconstruct", call.plan, *TARGETS, "-o", output, *options, "--strict", status=4)
    assert expected.lower() in strict.lower()
    said = call("check", call.plan, *TARGETS, *options)
    assert (said.status, said.err) == (0, "")
    assert expected.lower() in said.out.lower()
    call.refused("check", call.plan, *TARGETS, *options, "--strict", status=4)


@pytest.mark.parametrize("length", ["700", "704"])
def test_a_length_out_of_reach_is_noted_and_strict_refuses_it(call, length):
    targets = ("--length", length, "--drop", "30")
    output = call.path("l.csv")
    call.refused("reconstruct", call.plan, *targets, "-o", output, "--strict", status=4)
    said = call("reconstruct", call.plan, *targets, "-o", output)
    assert said.status == 0
    assert said.err.startswith("note: No ")
    assert output.exists()


def test_a_method_that_finds_no_scale_says_so(call):
    said = call(
        "reconstruct", call.plan, "--length", 1403, "--drop", 60, "--unknown-scale", "--method", "published",
        "--rate", 1e-5, "-o", call.path("l.csv"),
    )  # fmt: skip
    assert said.status == 0
    assert "scale" in said.out
    assert "nan" not in call.path("l.csv").read_text()
    strict = call.refused(
        "reconstruct", call.plan, "--length", 1403, "--drop", 60, "--unknown-scale", "--method", "published",
        "--rate", 1e-5, "-o", call.path("m.csv"), "--strict", status=4,
    )  # fmt: skip
    assert "scale" in strict


def test_known_elevations_take_no_plan_for_a_value(call):
    before = contents(call.folder)
    said = call("check", *TARGETS, "--known", "100:26", "200:20", call.plan)
    assert said.status == 0
    assert contents(call.folder) == before
    assert said.out == call("check", call.plan, *TARGETS, "--known", "100:26", "--known", "200:20").out
    assert said.out == call("check", call.plan, "--known=100:26", *TARGETS, "--known", "200:20").out


def test_one_sentence_is_checked_by_a_helper_that_can_fail():
    for text in ("Error: no.\n", "bobdesk: no\n", "bobdesk: no.\nbobdesk: nothing.\n", ""):
        with pytest.raises(AssertionError):
            one_sentence(text)
