"""A server on this computer that answers as a test wants it."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

PAGE = "https://example.org/bobdesk"


class Server(ThreadingHTTPServer):
    """Attributes: `answer` (status, headers, bytes), `go_on` is waited for first, `asked` headers of each request."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.answer: tuple[int, dict[str, str], bytes] = (200, {}, b"")
        self.answers: dict[str, tuple[int, dict[str, str], bytes]] = {}
        self.go_on = threading.Event()
        self.go_on.set()
        self.asked: list[tuple[str, dict[str, str]]] = []

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.server_port}/feed"

    def tell(self, version: str) -> None:
        self.answer = (200, {}, json.dumps({"tag_name": f"v{version}", "html_url": PAGE}).encode())

    def handle_error(self, request, client_address) -> None:
        """A client that goes away is no fault here."""


class Handler(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        self.server.asked.append((self.path, dict(self.headers.items())))
        self.server.go_on.wait(30)
        status, headers, body = self.server.answers.get(self.path, self.server.answer)
        self.send_response(status)
        for name, value in ({"Content-Length": str(len(body))} | headers).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *arguments: object) -> None:
        pass


@pytest.fixture
def server() -> Iterator[Server]:
    made = Server()
    thread = threading.Thread(target=made.serve_forever, args=(0.02,), daemon=True)
    thread.start()
    yield made
    made.go_on.set()
    made.shutdown()
    thread.join()
    made.server_close()
