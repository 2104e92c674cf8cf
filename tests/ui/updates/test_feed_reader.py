"""The feed over the network: what is sent, what is taken, and what is said when it does not work."""

import json

import pytest

from bobdesk.ui.updates.feed_reader import FeedReader
from bobdesk.ui.updates.release_feed import Release
from tests.ui.updates.conftest import PAGE


class Heard:
    def __init__(self, reader, until):
        self.releases, self.sentences = [], []
        self._reader, self._until = reader, until
        reader.answered.connect(self.releases.append)
        reader.failed.connect(self.sentences.append)

    def ask(self, address):
        self._reader.ask(address)
        self._until(lambda: bool(self.releases or self.sentences))
        assert not self._reader.is_busy
        return self


@pytest.fixture
def reader(qapp):
    made = FeedReader()
    yield made
    made.drop()
    made.deleteLater()


@pytest.fixture
def heard(reader, until):
    return Heard(reader, until)


def test_the_release_is_told_and_nothing_is_sent_that_tells_of_the_user(heard, server):
    server.tell("9.1.2")
    assert heard.ask(server.address).releases == [Release("9.1.2", PAGE)]
    (path, headers), *others = server.asked
    assert not others
    assert path == "/feed"
    assert headers.pop("Host").startswith("127.0.0.1:")
    assert headers.pop("Connection").lower() == "keep-alive"
    assert headers == {
        "Cache-Control": "no-cache",
        "Pragma": "no-cache",
        "User-Agent": "BobDesk",
        "Accept": "application/json",
        "Accept-Language": "en",
        "Accept-Encoding": "identity",
    }


@pytest.mark.parametrize(
    ("answer", "sentence"),
    [
        ((404, {}, b""), "127.0.0.1 does not tell of versions now (HTTP 404); try again later."),
        ((503, {}, b"{}"), "127.0.0.1 does not tell of versions now (HTTP 503); try again later."),
        ((200, {}, b"<html>"), "127.0.0.1 cannot be understood: what it answers tells of no version."),
        ((200, {}, b" " * 2_000_000), "127.0.0.1 cannot be understood: what it answers is too long."),
    ],
)
def test_an_answer_that_is_none_is_said(heard, server, answer, sentence):
    server.answer = answer
    assert heard.ask(server.address).sentences == [sentence]


def test_without_a_connection_it_says_so(heard, server):
    server.server_close()
    assert heard.ask(server.address).sentences == ["127.0.0.1 cannot be reached; is this computer online?"]


def test_a_server_that_says_nothing_is_given_up(qapp, until, server):
    server.go_on.clear()
    reader = FeedReader(timeout_ms=200)
    heard = Heard(reader, until).ask(server.address)
    assert heard.sentences == ["127.0.0.1 has not answered in time; try again later."]
    reader.deleteLater()


def test_a_redirect_is_followed_where_it_is_safe(heard, server):
    server.answers["/feed"] = (302, {"Location": "/new"}, b"")
    server.tell("3.0")
    assert heard.ask(server.address).releases == [Release("3.0", PAGE)]
    assert [path for path, _ in server.asked] == ["/feed", "/new"]


def test_a_redirect_that_others_could_listen_to_is_not_followed(heard, server):
    server.answer = (302, {"Location": "http://example.org/feed"}, b"")
    heard.ask(server.address)
    assert not heard.releases
    assert len(heard.sentences) == 1


def test_a_circle_of_redirects_ends(heard, server):
    server.answer = (302, {"Location": "/feed"}, b"")
    heard.ask(server.address)
    assert not heard.releases
    assert len(server.asked) < 10


def test_cookies_are_not_kept(heard, server):
    server.tell("3.0")
    server.answer = (200, {"Set-Cookie": "who=you"}, server.answer[2])
    heard.ask(server.address)
    heard.releases.clear()
    heard.ask(server.address)
    assert all("Cookie" not in headers for _, headers in server.asked)
    assert len(server.asked) == 2


def test_one_that_is_dropped_says_nothing(qtbot, heard, reader, server):
    server.go_on.clear()
    reader.ask(server.address)
    qtbot.waitUntil(lambda: len(server.asked) == 1)
    reader.drop()
    assert not reader.is_busy
    server.go_on.set()
    server.answer = (200, {}, json.dumps({"tag_name": "v5", "html_url": PAGE}).encode())
    assert heard.ask(server.address).releases == [Release("5", PAGE)]
    assert not heard.sentences
