"""The web application as a process of its own, and requests to it without a browser."""

from __future__ import annotations

import http.client
import json
import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlsplit

ENDED: set[str] = set()
"""Hosts, with their ports, of the applications that have ended."""


def install_part(folder: Path, module: str, code: str, name: str, made: str) -> None:
    """Put a package into ``folder`` whose ``module`` has the ``code`` of a part, found by the entry
    point ``name`` as ``made``."""
    (folder / f"{module}.py").write_text(code, encoding="utf-8")
    project = module.replace("_", "-")
    information = folder / f"{module}-1.0.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project}\nVersion: 1.0\n", encoding="utf-8")
    (information / "entry_points.txt").write_text(f"[asperity.parts]\n{name} = {module}:{made}\n", encoding="utf-8")


@dataclass
class AppServer:
    """``asperity app`` with these ``arguments``; ``packages`` is a folder of further ones,
    ``environment`` further variables, and ``said`` what it printed."""

    arguments: tuple[str, ...] = ()
    folder: Path | None = None
    packages: Path | None = None
    environment: dict[str, str] = field(default_factory=dict)
    said: list[str] = field(default_factory=list)
    roots: dict[str, str] = field(default_factory=dict)
    quiet: bool = True

    def __enter__(self) -> AppServer:
        environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST")}
        environment |= self.environment
        if self.packages is not None:
            environment["PYTHONPATH"] = os.pathsep.join([str(self.packages), environment.get("PYTHONPATH", "")])
        self.process = subprocess.Popen(
            [sys.executable, "-m", "asperity", "app", *(["--no-browser"] if self.quiet else []), *self.arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            cwd=self.folder,
            env=environment,
        )
        while not self.addresses():
            if self.process.poll() is not None:
                raise AssertionError("".join(self.said))
            time.sleep(0.05)
        return self

    def addresses(self) -> list[str]:
        """All addresses that were printed; the last one has not been used. An address is printed
        before the one before it is answered."""
        assert self.process.stdout is not None
        os.set_blocking(self.process.stdout.fileno(), False)
        self.said.append((self.process.stdout.read() or b"").decode())
        return re.findall(r"http://\S+(?=\s)", "".join(self.said))

    @property
    def address(self) -> str:
        """An address that opens one window."""
        return self.addresses()[-1]

    def __exit__(self, *error: object) -> None:
        ENDED.add(self.host)
        self.process.terminate()
        self.process.wait(timeout=20)
        self.addresses()
        assert self.process.stdout is not None
        self.process.stdout.close()
        assert "Traceback" not in "".join(self.said), "".join(self.said)

    @property
    def host(self) -> str:
        return urlsplit(self.address).netloc

    @property
    def token(self) -> str:
        return self.address.partition("token=")[2]

    def ask(
        self, method: str, path: str, *, body: Any = None, cookie: str = "", **headers: str
    ) -> tuple[int, dict[str, str], bytes]:
        """Status, headers and body of the answer to one request; ``headers`` with underscores for
        dashes, ``path`` below that of the ``cookie``."""
        connection = http.client.HTTPConnection(self.host, timeout=30)
        named = {key.replace("_", "-"): value for key, value in headers.items()}
        if cookie:
            named["Cookie"] = cookie
            path = f"{self.roots[cookie]}{path}"
        try:
            connection.request(method, path, body=body, headers=named)
            answer = connection.getresponse()
            return answer.status, {key.lower(): value for key, value in answer.getheaders()}, answer.read()
        finally:
            connection.close()

    def cookie(self) -> str:
        """The cookie for which the token is exchanged."""
        _, headers, _ = self.ask("GET", f"/?token={self.token}")
        cookie, path = re.match(r"(\S+); Path=(/[\w-]+)/;", headers["set-cookie"]).groups()  # type: ignore[union-attr]
        self.roots[cookie] = path
        return cookie

    def session(self, cookie: str) -> str:
        """Key of the first session."""
        _, headers, _ = self.ask("GET", "/", cookie=cookie)
        return headers["location"].split("/")[3]

    def upload(self, cookie: str, session: str, name: str, content: bytes) -> tuple[int, dict[str, Any]]:
        """Status and answer to an upload as a page makes it."""
        status, _, body = self.ask(
            "POST",
            f"/upload/{session}?name={quote(name, safe='')}",
            body=content,
            cookie=cookie,
            Origin=f"http://{self.host}",
        )
        return status, json.loads(body)
