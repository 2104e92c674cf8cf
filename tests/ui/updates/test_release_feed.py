"""What a feed tells, and which of two versions is newer."""

import json

import pytest

from bobdesk.errors import InputError
from bobdesk.ui.updates import release_feed
from bobdesk.ui.updates.release_feed import Release, feed_address, is_newer, is_safe, release_in

PAGE = "https://example.org/bobdesk"


def told(**values):
    return json.dumps(
        {"tag_name": "v1.2.0", "html_url": PAGE, "draft": False, "assets": [{"size": 1}]} | values
    ).encode()


def test_version_and_page_are_taken_and_the_rest_is_left():
    assert release_in(told()) == Release("1.2.0", PAGE)
    assert release_in(told(tag_name="1.10")) == Release("1.10", PAGE)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"not json",
        b"[]",
        b"null",
        b"\xff\xfe",
        b"[" * 100_000,
        told(tag_name=None),
        told(tag_name="latest"),
        told(tag_name="v2.0.0-rc.1"),
        told(tag_name="v" + "9" * 400),
        told(tag_name="1.2.3 && calc.exe"),
        told(html_url="http://example.org"),
        told(html_url="file:///etc/passwd"),
        told(html_url="javascript:alert(1)"),
        told(html_url="https://"),
        told(html_url="https://[bad"),
        json.dumps({"html_url": PAGE}).encode(),
    ],
)
def test_what_tells_of_no_version_or_of_a_page_that_is_not_safe_is_refused(data):
    with pytest.raises(InputError, match="what it answers"):
        release_in(data)


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("1.2.0", "1.1.9", True),
        ("1.10.0", "1.9.0", True),
        ("v2.0", "1.9.9", True),
        ("1.2", "1.2.0", False),
        ("1.2.0.1", "1.2", True),
        ("1.2.0", "1.2.0", False),
        ("1.1.0", "1.2.0", False),
        ("0.0", "0", False),
        ("1.3.0", "1.2.0.dev0", False),
        ("nightly", "1.0", False),
    ],
)
def test_versions_compare_as_numbers(one, other, expected):
    assert is_newer(one, other) is expected


@pytest.mark.parametrize(
    ("address", "safe"),
    [
        ("https://example.org/feed", True),
        ("http://127.0.0.1:8000/feed", True),
        ("http://localhost/feed", True),
        ("http://localhost.example.org/feed", False),
        ("http://example.org/feed", False),
        ("ftp://example.org", False),
        ("example.org", False),
        ("", False),
    ],
)
def test_only_what_nobody_can_change_on_the_way_is_safe(address, safe):
    assert is_safe(address) is safe


def test_without_an_address_nobody_is_asked(tmp_path, monkeypatch):
    place = tmp_path / "release-feed"
    monkeypatch.setattr(release_feed, "resource", lambda *parts: tmp_path.joinpath(*parts))
    assert feed_address() == ""
    place.write_text("\n")
    assert feed_address() == ""
    place.write_text("http://example.org/feed\n")
    assert feed_address() == ""
    place.write_text("https://example.org/feed\n")
    assert feed_address() == "https://example.org/feed"


def test_a_checkout_has_no_address():
    assert feed_address() == ""
