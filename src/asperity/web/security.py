"""What reaches the application: own host and origin, whoever has the token, bodies up to a size;
and what pages may do."""

from __future__ import annotations

import hmac
import html
import json
import re
import secrets
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias
from urllib.parse import parse_qs

Message: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[Message]]
Send: TypeAlias = Callable[[Message], Awaitable[None]]
App: TypeAlias = Callable[[MutableMapping[str, Any], Receive, Send], Awaitable[None]]

LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
"""Names of this machine for itself."""

MIB = 2**20

NO_TOKEN = (
    "This page belongs to whoever started it. Open it by the whole address that `asperity app` has printed last, "
    "with ?token=… at its end: each of them opens one browser, once."
)

FORWARDED = b"x-forwarded-prefix"
"""Header by which the pages are told the path below which they stand."""

_SCRIPT = re.compile(rb"(?m)^([ ]{4})<script(?=[ >])")
"""Scripts of the page's own template, which begin a line; text from outside is escaped and never
begins one."""


def _random_path() -> str:
    return f"/{secrets.token_urlsafe(18)}"


def _random_name() -> str:
    return f"asperity_{secrets.token_hex(8)}"


@dataclass
class Guard:
    """ASGI application around ``app`` that lets only its own pages and their owner through.

    All pages stand below the random path ``root``. A browser sends a cookie to every port of a
    host, so that other servers of this machine would get it; but only below its path, which they do
    not know.

    Attributes
    ----------
    app
        What is guarded; it is asked for paths without ``root``, which it finds in the header
        X-Forwarded-Prefix.
    hosts
        Values of the header Host that are served, each with its port; any other is a name that
        somebody else has given to this machine (DNS rebinding).
    largest
        Bytes that the body of a request may have.
    renewed
        Called with the next ``token`` when one has been used.
    token
        What the first address must hold. It is taken once, for the ``cookie`` with the ``secret``
        that then stands for it, so that the history of a browser or a list of processes is of no
        use to others.
    """

    app: App
    hosts: frozenset[str]
    largest: int
    renewed: Callable[[str], None] = lambda token: None
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    secret: str = field(default_factory=lambda: secrets.token_urlsafe(32))
    root: str = field(default_factory=_random_path)
    cookie: str = field(default_factory=_random_name)

    async def __call__(self, scope: MutableMapping[str, Any], receive: Receive, send: Send) -> None:
        """Serve, redirect or refuse one request or one websocket."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = {key.decode("latin-1").lower(): value.decode("latin-1") for key, value in scope["headers"]}
        if (reason := self._stranger(scope, headers)) is not None:
            await _refuse(scope, send, 403, reason)
            return
        early = "prefetch" in headers.get("sec-purpose", "")  # a browser that asks before its owner does
        if scope["type"] == "http" and scope["method"] == "GET" and not early and self._admitted(scope):
            # the token in the address is exchanged for the cookie; the address no longer shows it
            cookie = f"{self.cookie}={self.secret}; Path={self.root}/; HttpOnly; SameSite=Strict"
            page = leading_to(f"{self.root}/")
            more = [("set-cookie", cookie), ("content-type", "text/html; charset=utf-8"), ("cache-control", "no-store")]
            await _answer(send, 200, page.encode(), [*more, *_strict("", "'none'")])
            return
        pairs = (part.strip().partition("=") for part in headers.get("cookie", "").split(";"))
        cookies = {name: value for name, _, value in pairs}
        known = hmac.compare_digest(cookies.get(self.cookie, "").encode(), self.secret.encode())
        if not known or not scope["path"].startswith(f"{self.root}/"):
            await _refuse(scope, send, 403, NO_TOKEN)
            return
        inner = self._below_root(scope)
        if scope["type"] == "websocket":
            await self.app(inner, receive, send)
            return
        await self._serve(inner, headers, receive, send)

    def _admitted(self, scope: MutableMapping[str, Any]) -> bool:
        """Whether the address holds the token, which is then another one."""
        query = parse_qs(scope.get("query_string", b"").decode("latin-1"))
        given = query.get("token", [""])[0]
        if scope["path"] != "/" or not hmac.compare_digest(given.encode(), self.token.encode()):
            return False
        self.token = secrets.token_urlsafe(24)
        self.renewed(self.token)
        return True

    def _below_root(self, scope: MutableMapping[str, Any]) -> MutableMapping[str, Any]:
        """``scope`` as the application sees it."""
        kept = [item for item in scope["headers"] if item[0].lower() != FORWARDED]
        root = self.root.encode("ascii")
        raw = scope.get("raw_path") or scope["path"].encode()
        return {
            **scope,
            "path": scope["path"][len(self.root) :],
            "raw_path": raw[len(root) :] if raw.startswith(root) else scope["path"][len(self.root) :].encode(),
            "headers": [*kept, (FORWARDED, root)],
        }

    def _stranger(self, scope: MutableMapping[str, Any], headers: dict[str, str]) -> str | None:
        """Why the request is none of the application's own pages; None if it is one."""
        host, origin = headers.get("host", ""), headers.get("origin")
        if host.lower() not in self.hosts:
            return "The name of this address is not one under which the application was started."
        changes = scope["type"] == "websocket" or scope["method"] not in ("GET", "HEAD")
        if (origin is not None or changes) and (origin or "").lower() not in {f"http://{name}" for name in self.hosts}:
            return "Requests of other pages are not served."
        if headers.get("sec-fetch-site") == "cross-site" and headers.get("sec-fetch-mode") != "navigate":
            return "Requests of other pages are not served."
        return None

    async def _serve(
        self, scope: MutableMapping[str, Any], headers: dict[str, str], receive: Receive, send: Send
    ) -> None:
        length = headers.get("content-length", "0")
        if not length.isdecimal() or int(length) > self.largest:
            await _too_large(send, self.largest)
            return
        counted = _Counted(receive, self.largest)
        nonce = secrets.token_urlsafe(18)
        page = _Page(send, nonce, headers.get("host", ""), self.root)
        page.counted = counted
        try:
            await self.app(scope, counted, page)
        except Exception:
            if not counted.over:
                raise
        if counted.over and not page.started:
            await _too_large(send, self.largest)


class TooLargeError(Exception):
    """A body has more bytes than are taken."""


@dataclass(eq=False)
class _Counted:
    """``receive`` that counts what comes, whatever the header says."""

    receive: Receive
    left: int

    @property
    def over(self) -> bool:
        """Whether there were too many bytes."""
        return self.left < 0

    async def __call__(self) -> Message:
        message = await self.receive()
        if message["type"] == "http.request":
            self.left -= len(message.get("body", b""))
            if self.over:
                raise TooLargeError
        return message


class _Page:
    """``send`` that adds the policy to every answer, its nonce to the scripts of a page's template,
    and the path ``root`` to the places to which it redirects."""

    def __init__(self, send: Send, nonce: str, host: str, root: str) -> None:
        self._send, self._nonce, self._host, self._root = send, nonce, host, root.encode()
        self._start: Message | None = None
        self._body = bytearray()
        self.started = False
        self.counted: _Counted | None = None

    def _inside(self, location: bytes) -> bool:
        """Whether ``location`` is a place of the application that does not yet begin with the
        root."""
        return location.startswith(b"/") and not location.startswith(self._root + b"/")

    async def __call__(self, message: Message) -> None:
        if self.counted is not None and self.counted.over and not self.started:
            return  # what the application says of a body that was cut off
        if message["type"] == "http.response.start":
            self.started = True
            given = {key.lower(): value for key, value in message.get("headers", ())}
            page = given.get(b"content-type", b"").startswith(b"text/html") and b"content-encoding" not in given
            scripts = f"'self' 'nonce-{self._nonce}' 'unsafe-eval'"  # Vue compiles the templates of its components
            more = [(k.encode(), v.encode()) for k, v in _strict(self._host, scripts) if k.encode() not in given]
            kept = [
                (key, self._root + value if key.lower() == b"location" and self._inside(value) else value)
                for key, value in message.get("headers", ())
            ]
            begun = {**message, "headers": [*kept, *more]}
            if page:
                self._start = begun
            else:
                await self._send(begun)
        elif self._start is None:
            await self._send(message)
        else:
            self._body += message.get("body", b"")
            if not message.get("more_body", False):
                body = _SCRIPT.sub(rb'\1<script nonce="' + self._nonce.encode() + b'"', bytes(self._body))
                kept = [item for item in self._start["headers"] if item[0].lower() != b"content-length"]
                kept.append((b"content-length", str(len(body)).encode()))
                await self._send({**self._start, "headers": kept})
                await self._send({"type": "http.response.body", "body": body})


def _strict(host: str, scripts: str) -> list[tuple[str, str]]:
    """Headers of every answer: nothing from elsewhere, no frames around, no sniffing of types, no
    referrer."""
    policy = (
        f"default-src 'none'; script-src {scripts}; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
        f"font-src 'self' data:; connect-src 'self'{f' ws://{host}' if host else ''}; worker-src 'self' blob:; "
        "frame-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'self'; object-src 'none'"
    )
    return [
        ("content-security-policy", policy),
        ("x-content-type-options", "nosniff"),
        ("x-frame-options", "SAMEORIGIN"),
        ("referrer-policy", "no-referrer"),
        ("cross-origin-opener-policy", "same-origin"),
        ("cross-origin-resource-policy", "same-origin"),
    ]


def leading_to(address: str) -> str:
    """Page that leads to ``address`` at once, and asks for no picture of its own."""
    icon = '<link rel="icon" href="data:,">'
    refresh = f'<meta http-equiv="refresh" content="0; url={html.escape(address)}">'
    return f'<!doctype html><meta charset="utf-8">{icon}{refresh}<title>asperity</title>\n'


def host_names(host: str, port: int) -> frozenset[str]:
    """Values of the header Host for an application at ``host`` and ``port``."""
    own = f"[{host}]" if ":" in host else host.lower()
    return frozenset(f"{name}:{port}" for name in {own, *LOOPBACK})


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches ``host``."""
    return host in ("localhost", "::1") or re.fullmatch(r"127(\.\d{1,3}){3}", host) is not None


def cap_text(largest: int) -> str:
    """What is said of a file that is larger than ``largest`` bytes."""
    return (
        f"The file has more than {largest / MIB:g} MiB, which is the most that is taken through the browser. Start the "
        "application with it instead, asperity app FILE, or raise the limit: --most-upload."
    )


def quota_text(quota: float) -> str:
    """What is said of a file for which there is no room among ``quota`` bytes."""
    return (
        f"All files of the application together may have {quota / MIB:g} MiB, and this one would be more. Remove files "
        "that are not needed, start the application with the file instead, asperity app FILE, or raise the limit: "
        "--all-uploads."
    )


async def _too_large(send: Send, largest: int) -> None:
    body = json.dumps({"error": cap_text(largest)}).encode()
    await _answer(send, 413, body, [("content-type", "application/json"), *_strict("", "'none'")])


async def _refuse(scope: MutableMapping[str, Any], send: Send, status: int, reason: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": "refused"})
        return
    await _answer(
        send, status, reason.encode(), [("content-type", "text/plain; charset=utf-8"), *_strict("", "'none'")]
    )


async def _answer(send: Send, status: int, body: bytes, headers: Iterable[tuple[str, str]]) -> None:
    pairs = [(key.encode("latin-1"), value.encode("latin-1")) for key, value in headers]
    pairs.append((b"content-length", str(len(body)).encode()))
    await send({"type": "http.response.start", "status": status, "headers": pairs})
    await send({"type": "http.response.body", "body": body})
