"""The web application as a process of its own, and requests to it without a browser."""

from __future__ import annotations

import http.client
import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlsplit


@dataclass
class AppServer:
    """``asperity app`` with these ``arguments``; ``packages`` is a folder of further ones,
    ``address`` is what it printed."""

    arguments: tuple[str, ...] = ()
    folder: Path | None = None
    packages: Path | None = None
    address: str = ""
    said: list[str] = field(default_factory=list)

    def __enter__(self) -> AppServer:
        environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST")}
        if self.packages is not None:
            environment["PYTHONPATH"] = os.pathsep.join([str(self.packages), environment.get("PYTHONPATH", "")])
        self.process = subprocess.Popen(
            [sys.executable, "-m", "asperity", "app", "--no-browser", *self.arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd=self.folder,
            env=environment,
        )
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.said.append(line)
            if found := re.search(r"http://\S+", line):
                self.address = found[0]
                return self
        raise AssertionError("".join(self.said))

    def __exit__(self, *error: object) -> None:
        self.process.terminate()
        output, _ = self.process.communicate(timeout=20)
        self.said.append(output)
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
        dashes."""
        connection = http.client.HTTPConnection(self.host, timeout=30)
        named = {key.replace("_", "-"): value for key, value in headers.items()}
        if cookie:
            named["Cookie"] = cookie
        try:
            connection.request(method, path, body=body, headers=named)
            answer = connection.getresponse()
            return answer.status, {key.lower(): value for key, value in answer.getheaders()}, answer.read()
        finally:
            connection.close()

    def cookie(self) -> str:
        """The cookie for which the token is exchanged."""
        _, headers, _ = self.ask("GET", f"/?token={self.token}")
        return headers["set-cookie"].partition(";")[0]

    def session(self, cookie: str) -> str:
        """Key of the first session."""
        _, headers, _ = self.ask("GET", "/", cookie=cookie)
        return headers["location"].split("/")[2]

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
