"""Serves a page to this machine only, on the loopback address below a random path."""

import json
import secrets
import sys
import threading
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from errors import BadInput
from machine import forwarded_host
from playing.hub import Hub

_LONGEST = 64 * 1024  # bytes of a command
_BEAT = 1.0  # seconds without a line after which the connection is tested
_HEADERS = {"Cache-Control": "no-store", "Referrer-Policy": "no-referrer", "X-Content-Type-Options": "nosniff"}


class Server:
    """Serves the page, sends `frames` to it, and receives `command` from it."""

    def __init__(self, port: int | None, page: Callable[[], str], hub: Hub, command: Callable[[dict], None]):
        self.token = secrets.token_urlsafe(24)
        handler = type("Handler", (_Handler,), {"token": self.token, "page": staticmethod(page), "hub": hub,
                                                "obey": staticmethod(command)})
        try:
            self._server = _LocalServer(("127.0.0.1", port or 0), handler)
        except OSError as error:
            raise BadInput(f"play: port {port} cannot be used: {error.strerror}") from None
        threading.Thread(target=self._server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True).start()

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self._server.server_port}/{self.token}/"

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()


class _LocalServer(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, request, client_address) -> None:
        if not isinstance(sys.exc_info()[1], OSError):  # a page may close at any time
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    token: str
    page: Callable[[], str]
    hub: Hub
    obey: Callable[[dict], None]

    def do_GET(self) -> None:
        what = self._asked()
        if what == "":
            self._answer(200, self.page(), "text/html; charset=utf-8")
        elif what == "frames":
            self._stream()
        elif what is not None:
            self._answer(404, "There is nothing here.\n")

    def do_POST(self) -> None:
        what = self._asked()
        if what is None:
            return
        length = self.headers.get("Content-Length", "")
        if what != "command" or not length.isdecimal() or int(length) > _LONGEST:
            self.close_connection = True  # the body of the request is not read
            if what != "command":
                self._answer(404, "There is nothing here.\n")
            else:
                self._answer(413, f"A command has a Content-Length of at most {_LONGEST} bytes.\n")
            return
        try:
            command = json.loads(self.rfile.read(int(length)))
        except ValueError:
            command = None
        if not isinstance(command, dict):
            self._answer(400, "A command is a JSON object.\n")
            return
        self.obey(command)
        self._answer(204, "")

    def _asked(self) -> str | None:
        """Returns the path below the token; None after a refusal.

        A page of another site may reach this machine under another name, which the Host header reveals.
        """
        port = self.server.server_port
        hosts = {f"{name}:{port}" for name in ("127.0.0.1", "localhost")}
        origins = {f"http://{host}" for host in hosts}
        if forwarded := forwarded_host(port):  # requests arrive by https, under either name
            hosts.add(forwarded)
            origins |= {f"https://{host}" for host in hosts}
        origin = self.headers.get("Origin")
        if self.headers.get("Host") not in hosts or (origin and origin not in origins):
            self.close_connection = True
            self._answer(403, "This page is for this machine only.\n")
            return None
        first, slash, what = self.path.lstrip("/").partition("/")
        if not slash or not secrets.compare_digest(first.encode(), self.token.encode()):
            self.close_connection = True
            self._answer(404, "There is nothing here.\n")
            return None
        return what

    def _answer(self, code: int, text: str, kind: str = "text/plain; charset=utf-8") -> None:
        content = text.encode()
        self.send_response(code)
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        if code != 204:
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(content)))
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(content)

    def _stream(self) -> None:
        """Sends the engine's lines as server-sent events, until the page closes."""
        self.close_connection = True
        self.send_response(200)
        for name, value in {**_HEADERS, "Content-Type": "text/event-stream", "Connection": "close"}.items():
            self.send_header(name, value)
        self.end_headers()
        listener = self.hub.join()
        try:
            while True:
                line = listener.get(_BEAT)
                self.wfile.write(f"data: {line}\n\n".encode() if line else b": still here\n\n")
        except OSError:
            pass  # the page has closed
        finally:
            self.hub.leave(listener)

    def log_message(self, *_) -> None:
        pass
