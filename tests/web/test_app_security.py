"""Nobody but the owner reaches the application, and nothing that is sent to it gets further than it
may."""

from __future__ import annotations

import http.client
import os
import re
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.web.kept import label_of
from asperity.web.security import host_names, is_loopback

from .app_server import AppServer

CAP = 1


@pytest.fixture(scope="module")
def app() -> Iterator[AppServer]:
    with AppServer(("--demo", "--most-upload", str(CAP))) as running:
        yield running


@pytest.fixture(scope="module")
def cookie(app: AppServer) -> str:
    return app.cookie()


def test_only_this_machine_listens(app: AppServer) -> None:
    assert app.host.startswith("127.0.0.1:")


def test_without_the_token_nothing_is_served(app: AppServer) -> None:
    for path in ("/", "/start", "/static/app.js", "/_nicegui/client", "/?token=wrong", "/files/a/b/c"):
        status, headers, body = app.ask("GET", path)
        assert status == 403, path
        assert b"asperity app" in body
        assert "default-src 'none'" in headers["content-security-policy"]


def test_the_token_is_exchanged_for_a_cookie_that_scripts_and_other_sites_do_not_get(app: AppServer) -> None:
    token = app.token
    status, headers, body = app.ask("GET", f"/?token={token}")
    assert status == 200
    assert "HttpOnly" in headers["set-cookie"]
    assert "SameSite=Strict" in headers["set-cookie"]
    assert token not in headers["set-cookie"]
    assert token.encode() not in body
    assert headers["cache-control"] == "no-store"


def test_the_token_opens_once_and_the_next_one_is_printed(app: AppServer) -> None:
    first = app.token
    assert app.ask("HEAD", f"/?token={first}")[0] == 403
    assert app.ask("GET", f"/?token={first}", Sec_Purpose="prefetch;prerender")[0] == 403, "nobody has asked for it yet"
    assert app.ask("GET", f"/?token={first}")[0] == 200
    assert app.ask("GET", f"/?token={first}")[0] == 403
    assert app.token != first
    assert app.ask("GET", f"/?token={app.token}")[0] == 200


def test_a_cookie_is_worth_nothing_outside_the_path_of_its_instance(app: AppServer, cookie: str) -> None:
    root = app.roots[cookie]
    assert len(root) > 20, "nobody guesses it"
    for path in ("/", "/start", root, f"{root}x/start", f"/x{root}/start", "/static/app.js"):
        assert app.ask("GET", path, Cookie=cookie)[0] == 403, path
    assert app.ask("GET", "/start", cookie=cookie)[0] == 200
    assert app.ask("GET", f"{root}/start", Cookie=cookie.partition("=")[0] + "=x")[0] == 403


@dataclass
class Neighbour:
    """Another server of this machine, which notes the cookies that it is sent."""

    cookies: list[str] = field(default_factory=list)

    def __enter__(self) -> Neighbour:
        cookies = self.cookies

        class Noted(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                cookies.append(self.headers.get("Cookie", ""))
                self.send_response(200)
                self.send_header("Content-Length", "0")
                self.end_headers()

            def log_message(self, *said: object) -> None:
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Noted)
        Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *error: object) -> None:
        self.server.shutdown()
        self.server.server_close()


@pytest.mark.slow
def test_two_instances_in_one_browser_do_not_see_each_others_cookies(
    app: AppServer, open_page: Callable[..., Any]
) -> None:
    with AppServer(("--demo",)) as other, Neighbour() as neighbour:
        watched = open_page(app.address)
        page, context = watched.page, watched.page.context
        page.wait_for_url("**/s/**")
        second = context.new_page()
        second.goto(other.address)
        second.wait_for_url("**/s/**")
        for shown in (page, second):
            shown.reload()
            shown.wait_for_selector("h1")
        sent: list[str] = []
        context.on("request", lambda request: sent.append(request.all_headers().get("cookie", "")))
        for path in ("/", "/start", "/favicon.ico"):
            second.goto(f"http://127.0.0.1:{neighbour.server.server_port}{path}")
        assert neighbour.cookies
        assert set(neighbour.cookies) == {""}
        names = {cookie["name"]: cookie["path"] for cookie in context.cookies()}
        assert len(names) == len(set(names.values())) == 2
        assert "/" not in names.values()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="modes of POSIX systems")
def test_the_browser_is_opened_by_a_private_file_that_leads_there(
    open_page: Callable[..., Any], tmp_path: Path
) -> None:
    """What the program of the browser is given, others see in the list of processes."""
    browser, given = tmp_path / "browser", tmp_path / "given.txt"
    browser.write_text(f'#!/bin/sh\necho "$@" > {given}.part; mv {given}.part {given}\n')
    browser.chmod(0o755)
    with AppServer(("--demo",), environment={"BROWSER": f"{browser} %s"}, quiet=False) as app:
        for _ in range(100):
            if given.exists():
                break
            time.sleep(0.1)
        told, token = given.read_text().strip(), app.token
        assert token not in told
        assert app.host not in told
        file = Path(unquote(urlsplit(told).path))
        assert token in file.read_text()
        assert file.stat().st_mode & 0o077 == file.parent.stat().st_mode & 0o077 == 0
        page = open_page(file).page
        page.wait_for_url("http://**/s/**")
        page.wait_for_selector("h1")
        assert not file.exists(), "it leads nowhere any more"
        assert app.ask("GET", f"/?token={token}")[0] == 403


@pytest.mark.skipif(os.name == "nt", reason="modes of POSIX systems")
def test_kept_sessions_are_private(tmp_path: Path) -> None:
    before = os.umask(0o022)
    try:
        with AppServer(("--demo", "--folder", str(tmp_path / "kept"))) as app:
            cookie = app.cookie()
            app.upload(cookie, app.session(cookie), "a.txt", b"1 2\n3 4\n")
    finally:
        os.umask(before)
    found = [tmp_path / "kept", *(tmp_path / "kept").rglob("*")]
    assert len(found) > 3
    assert [path for path in found if path.stat().st_mode & 0o077] == []


def test_another_name_of_this_machine_is_refused(app: AppServer, cookie: str) -> None:
    port = app.host.partition(":")[2]
    for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.1.evil.example:{port}", ""):
        assert app.ask("GET", "/start", cookie=cookie, Host=host)[0] == 403, host
    assert app.ask("GET", "/start", cookie=cookie, Host=f"localhost:{port}")[0] == 200


def test_other_pages_cannot_send_anything(app: AppServer, cookie: str) -> None:
    session = app.session(cookie)
    path = f"/upload/{session}?name=a.txt"
    for headers in (
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://127.0.0.1:1"},
        {"Origin": f"https://{app.host}"},
        {},
    ):
        assert app.ask("POST", path, body=b"1", cookie=cookie, **headers)[0] == 403, headers
    socket = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec_WebSocket_Version": "13"}
    key = {"Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ=="}
    for origin in ({"Origin": "http://evil.example"}, {}):
        status, _, _ = app.ask("GET", "/_nicegui_ws/socket.io/?EIO=4", cookie=cookie, **socket, **key, **origin)
        assert status == 403
    assert app.ask("GET", "/start", cookie=cookie, Sec_Fetch_Site="cross-site", Sec_Fetch_Mode="no-cors")[0] == 403


def test_pages_may_run_their_own_scripts_only(app: AppServer, cookie: str) -> None:
    _, headers, body = app.ask("GET", "/start", cookie=cookie)
    policy = headers["content-security-policy"]
    scripts = next(part for part in policy.split(";") if part.strip().startswith("script-src"))
    assert "'unsafe-inline'" not in scripts
    assert "http:" not in policy.replace(f"ws://{app.host}", "")
    nonce = re.search(r"'nonce-([^']+)'", scripts)
    assert nonce is not None
    assert f'<script nonce="{nonce[1]}"'.encode() in body
    again = app.ask("GET", "/start", cookie=cookie)[1]["content-security-policy"]
    assert nonce[1] not in again, "a nonce is for one answer"
    assert headers["x-content-type-options"] == "nosniff"


def test_uploads_over_the_cap_are_counted_and_refused_in_words(app: AppServer, cookie: str) -> None:
    session = app.session(cookie)
    status, answer = app.upload(cookie, session, "large.txt", b"0" * (CAP * 2**20 + 1))
    assert status == 413
    assert f"{CAP} MiB" in answer["error"]
    assert "asperity app FILE" in answer["error"]


def test_a_body_that_hides_its_length_is_counted(app: AppServer, cookie: str) -> None:
    connection = http.client.HTTPConnection(app.host, timeout=30)
    connection.putrequest("POST", f"{app.roots[cookie]}/upload/{app.session(cookie)}?name=a.txt")
    for key, value in (("Transfer-Encoding", "chunked"), ("Cookie", cookie), ("Origin", f"http://{app.host}")):
        connection.putheader(key, value)
    connection.endheaders()
    block = b"%x\r\n%s\r\n" % (2**16, b"0" * 2**16)
    try:
        for _ in range(CAP * 16 + 2):
            connection.send(block)
        connection.send(b"0\r\n\r\n")
    except (BrokenPipeError, ConnectionResetError):
        pass  # refused before the end
    assert connection.getresponse().status == 413
    connection.close()


NAMES = (
    "../../../../etc/passwd",
    "..\\..\\evil.txt",
    "/etc/cron.d/evil",
    "a\x00b.txt",
    "<img src=x onerror=alert(1)>.txt",
    "x" * 5000 + ".txt",
    "CON.txt",
    "\u202egnp.exe",
    ".htaccess",
    "",
    "a.t%2fxt",
    "; rm -rf ~ #.csv",
)


def test_names_of_uploads_lead_nowhere_else(app: AppServer, cookie: str) -> None:
    session = app.session(cookie)
    names = []
    for number, name in enumerate((*NAMES, *NAMES), start=1):
        content = f"1 2\n3 {number}\n".encode()
        status, answer = app.upload(cookie, session, name, content)
        assert status == 200, name
        path = Path(answer["path"])
        names.append(path.name)
        assert path.resolve() == path
        assert path.parent.name == "files"
        assert path.parents[2].name.startswith("asperity-app-")
        assert path.parents[2].stat().st_mode & 0o077 == 0, "the folder of uploads is private"
        assert path.read_bytes() == content
    assert len(set(names)) == len(names), "none replaces another one"
    assert names[len(NAMES)] == "passwd (2)"


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX systems")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_private_folders_are_gone_however_the_application_is_ended(name: str) -> None:
    if signal.getsignal(getattr(signal, name)) is signal.SIG_IGN:
        pytest.skip(f"this run ignores {name}, as under nohup, and so do the processes that it starts")
    with AppServer(("--demo",)) as app:
        cookie = app.cookie()
        _, answer = app.upload(cookie, app.session(cookie), "a.txt", b"1 2\n3 4\n")
        private = Path(answer["path"]).parents[2]
        assert private.is_dir()
        app.process.send_signal(getattr(signal, name))
        app.process.wait(20.0)
    assert not private.exists()


def test_labels_show_no_folders_and_no_hidden_letters() -> None:
    labels = [label_of(name) for name in NAMES]
    assert labels[0] == "passwd"
    assert labels[1] == "evil.txt"
    assert all(label.isprintable() and 0 < len(label) <= 80 for label in labels)
    for name in ("..", ".", "a/..", "..\\..", "…" * 500, "\U0001f4a5" * 90, "\\", "/", " ", "\n"):
        label = label_of(name)
        assert label == label_of(label), name
        assert not label.startswith(".")
        assert "/" not in label
        assert len(f"{label} (12345)".encode()) < 200


def test_no_path_leads_out_of_what_is_given_out(app: AppServer, cookie: str) -> None:
    session = app.session(cookie)
    for path in (
        f"/files/{session}/roughness/../../../etc/passwd",
        f"/files/{session}/roughness/%2e%2e/%2e%2e/session.json",
        f"/files/{session}/..%2f..%2fetc/passwd",
        f"/files/{session}//etc/passwd",
        "/static/..%2fserver.py",
        "/static/%2e%2e/server.py",
    ):
        status, _, body = app.ask("GET", path, cookie=cookie)
        assert status in (404, 307, 200), path
        assert b"root:" not in body
        assert b"uvicorn" not in body
        assert b"asperity_session" not in body


def test_hosts_and_addresses() -> None:
    assert "localhost:8000" in host_names("127.0.0.1", 8000)
    assert "[::1]:8000" in host_names("::1", 8000)
    assert all(map(is_loopback, ("127.0.0.1", "127.8.0.1", "localhost", "::1")))
    assert not any(map(is_loopback, ("0.0.0.0", "192.168.1.5", "localhost.evil.example", "")))
