"""Where the newest version is told of, and what is told.

The address stands in the one file resources/release-feed, which whoever publishes installers has put there
(RELEASE_FEED in packaging/identity.py). Without it there is nobody to ask, and the program offers nothing: so it
is in a checkout, and so it is where a package manager brings new versions.

What is read is one JSON object with `tag_name` ("v1.2.0") and `html_url` (the page for people), as GitHub tells of
the latest release.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import urlsplit

import msgspec

from bobdesk.errors import InputError
from bobdesk.ui.resources import resource

_VERSION = re.compile(r"v?(\d{1,9}(?:\.\d{1,9}){0,4})")
_LOOPBACK = ("127.0.0.1", "::1", "localhost")


@dataclass(frozen=True)
class Release:
    """A version and the page that tells of it."""

    version: str
    page: str


class _Told(msgspec.Struct):
    tag_name: str
    html_url: str


def feed_address() -> str:
    """Return the address to ask, "" if there is none."""
    try:
        address = resource("release-feed").read_text(encoding="utf-8").strip()
    except (OSError, UnicodeDecodeError):
        return ""
    return address if is_safe(address) else ""


def is_safe(address: str) -> bool:
    """Return whether nobody on the way can change what is read: https, or this computer itself."""
    try:
        parts = urlsplit(address)
        host = parts.hostname
    except ValueError:
        return False
    return bool(host) and (parts.scheme == "https" or (parts.scheme == "http" and host in _LOOPBACK))


def release_in(data: bytes) -> Release:
    """Return what a feed tells.

    Raises
    ------
    InputError
        If it tells of no version, or of a page that is not safe to open.
    """
    try:
        told = msgspec.json.decode(data, type=_Told)
    except (msgspec.MsgspecError, RecursionError, ValueError):
        raise InputError("what it answers tells of no version") from None
    version = _VERSION.fullmatch(told.tag_name.strip())
    if version is None:
        raise InputError("what it answers tells of no version that can be compared")
    if not is_safe(told.html_url):
        raise InputError("what it answers leads to a page that is not safe")
    return Release(version[1], told.html_url)


def is_newer(version: str, than: str) -> bool:
    """Return whether a version comes after another one; of one that is no plain version nothing is known."""
    one, other = _numbers(version), _numbers(than)
    return one is not None and other is not None and one > other


def _numbers(version: str) -> tuple[int, ...] | None:
    found = _VERSION.fullmatch(version.strip())
    if found is None:
        return None
    numbers = [int(part) for part in found[1].split(".")]
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return tuple(numbers)
