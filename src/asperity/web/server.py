"""The application as a server: addresses, files that it gives out, uploads, and how it starts and
ends."""

from __future__ import annotations

import math
import os
import signal
import socket
import tempfile
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from ..core.errors import InputError
from ..core.settings import Settings, setting
from ..core.spectral import thread_count
from ..core.values import Number, Whole
from ..core.words import speaking
from .beginning import fill
from .security import MIB, Guard, host_names, is_loopback, leading_to
from .session import Place
from .workers import Limits, Together

Positive: TypeAlias = Annotated[float, Number(above=0.0)]


class Caps(Settings):
    """How much runs and uploads may take."""

    most_upload: Positive = setting(512.0, help="largest file through the browser, in MiB")
    all_uploads: Positive = setting(4096.0, help="all files through the browser together, in MiB")
    time_limit: Positive | None = setting(None, help="longest time of one run in seconds; twelve hours by default")
    total_time: Positive | None = setting(None, help="time of all runs together in seconds; no limit by default")
    memory: Positive | None = setting(None, help="memory of all runs together in GiB; most of what is free by default")
    at_once: Annotated[int, Whole(1)] = setting(4, help="runs that work at the same time; others wait")
    threads: Annotated[int, Whole(1)] | None = setting(None, help="threads of one run; all cores by default")


@dataclass(frozen=True)
class Options:
    """How the application is started; see ``asperity app --help``."""

    files: Sequence[Path] = ()
    demo: bool = False
    host: str = "127.0.0.1"
    port: int = 0
    folder: Path | None = None
    caps: Caps = field(default_factory=Caps)


def serve(options: Options, opened: Callable[[str, Path], None], renewed: Callable[[str], None]) -> None:
    """Serve until interrupted; ``opened`` is told the address with its token when it can be opened,
    and a private file that leads there, ``renewed`` the next address whenever one has been used.

    Raises
    ------
    InputError
        If the host is no address of this machine, the port is taken, or a file cannot be used.
    """
    import uvicorn

    from .application import application

    host = options.host
    if host in ("0.0.0.0", "::", ""):
        raise InputError(
            f"--host must be one address or name of this machine by which others reach it, such as 192.168.1.5, but is "
            f"{host!r}: the names under which the application answers must be known."
        )
    try:
        listener = socket.create_server((host, options.port), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    except OSError as error:
        raise InputError(
            f"--host and --port must be free addresses of this machine, but {host}:{options.port} is not: "
            f"{error.strerror}; leave --port out for any free one."
        ) from None
    with listener, _private_files():
        port = listener.getsockname()[1]
        place = _place(options)
        first = place.folder / "open.html"

        def address(token: str) -> str:
            return f"http://{f'[{host}]' if ':' in host else host}:{port}/?token={token}"

        def used(token: str) -> None:
            first.unlink(missing_ok=True)
            renewed(address(token))

        try:
            guard: Any = Guard(application(place), host_names(host, port), place.largest, used)
            config = uvicorn.Config(
                guard,
                log_level="error",
                lifespan="on",
                proxy_headers=False,
                server_header=False,
                timeout_graceful_shutdown=2,
            )
            server = uvicorn.Server(config)
            place.ends = lambda: server.should_exit
            first.write_text(leading_to(address(guard.token)), encoding="utf-8")
            opened(address(guard.token), first)
            with _ended_by_signals(server), speaking("form"):
                server.run(sockets=[listener])
        except KeyboardInterrupt:
            pass
        finally:
            place.close()


@contextmanager
def _private_files() -> Iterator[None]:
    """Make all files and folders, also those of workers, readable by their owner only."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


@contextmanager
def _ended_by_signals(server: Any) -> Iterator[None]:
    """Let the signals by which a system ends a process or closes its terminal end the ``server``
    like Ctrl-C, so that private folders are removed. Ignored ones remain so.

    The server itself ends by SIGTERM, and then raises it once more.
    """
    ends = {"SIGTERM": signal.default_int_handler, "SIGHUP": server.handle_exit}
    known = {number: end for name, end in ends.items() if (number := getattr(signal, name, None)) is not None}
    changed = [number for number in known if signal.getsignal(number) is signal.SIG_DFL]
    if threading.current_thread() is not threading.main_thread():
        changed = []
    for number in changed:
        signal.signal(number, known[number])
    try:
        yield
    finally:
        for number in changed:
            signal.signal(number, signal.SIG_DFL)


def _place(options: Options) -> Place:
    """Where sessions live, with the first one if there is anything to begin with."""
    caps = options.caps
    usual = Limits.usual() if caps.time_limit is None else Limits.usual(caps.time_limit)
    memory = usual.memory if caps.memory is None else caps.memory * 2**30
    limits = replace(usual, memory=memory, together=Together(caps.at_once, caps.total_time or math.inf))
    private = Path(tempfile.mkdtemp(prefix="asperity-app-"))
    roots = () if is_loopback(options.host) else (Path.cwd().resolve(),)
    threads = thread_count(caps.threads)
    place = Place(private, limits, threads, int(caps.most_upload * MIB), roots, caps.all_uploads * MIB)
    if options.files or options.demo or options.folder is not None:
        try:
            _, session = place.new(options.folder)
            fill(session, files=options.files, demo=options.demo)
            session.touched()
        except BaseException:
            place.close()
            raise
    return place
