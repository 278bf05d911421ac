"""The command ``app``: the web application on this machine."""

from __future__ import annotations

import importlib.util
import math
import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from ..core import require
from ..core.errors import InputError
from ..web.security import is_loopback
from ..web.server import Options, serve
from .show import say


def app(
    file: Annotated[
        list[Path] | None,
        typer.Argument(help="Files with heights, or a problem document, to begin with.", metavar="FILE"),
    ] = None,
    demo: Annotated[bool, typer.Option("--demo", help="Begin with the problem of `asperity demo`.")] = False,
    folder: Annotated[
        Path | None,
        typer.Option("--folder", help="Keep the session in this folder, or open the one that it holds.", metavar="DIR"),
    ] = None,
    port: Annotated[int, typer.Option("--port", help="Port; 0 for any free one.")] = 0,
    host: Annotated[
        str,
        typer.Option(
            "--host", help="Address of this machine at which others reach it; whoever has the token may then use it."
        ),
    ] = "127.0.0.1",
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Print the address and open no browser.")] = False,
    most_upload: Annotated[
        float, typer.Option("--most-upload", help="Largest file through the browser, in MiB.")
    ] = 512.0,
    all_uploads: Annotated[
        float, typer.Option("--all-uploads", help="All files through the browser together, in MiB.")
    ] = 4096.0,
    time_limit: Annotated[float, typer.Option("--time-limit", help="Longest time of one run in seconds.")] = 43200.0,
    total_time: Annotated[
        float, typer.Option("--total-time", help="Time of all runs together in seconds; unlimited by default.")
    ] = math.inf,
    at_once: Annotated[int, typer.Option("--at-once", help="Runs that work at the same time; others wait.")] = 4,
    memory: Annotated[
        float | None,
        typer.Option("--memory", help="Memory of all runs together in GiB; most of what is free by default."),
    ] = None,
    threads: Annotated[int | None, typer.Option("--threads", help="Threads of one run; all cores by default.")] = None,
) -> None:
    """Explore a contact in the browser, on this machine only: no account, nothing leaves it, works
    offline.

    Examples: asperity app; asperity app scan.x3p; asperity app --demo; asperity app --folder disk

    It ends with Ctrl-C. Needs NiceGUI, which the extra `web` of the package brings.
    """
    require.integer(port, 0, "--port", "Give 0 for any free one.")
    if port > 65535:
        raise InputError(f"--port must be at most 65535, but is {port}.")
    require.integer(at_once, 1, "--at-once", "Give 1 or more.")
    given = {"--most-upload": most_upload, "--all-uploads": all_uploads, "--time-limit": time_limit}
    for name, value in (given | {"--total-time": total_time, "--memory": memory}).items():
        if value is not None and not value > 0.0:
            raise InputError(f"{name} must be greater than zero, but is {value:g}.")
    if threads is not None:
        require.integer(threads, 1, "--threads", "Give 1 or more.")
    if importlib.util.find_spec("nicegui") is None:
        raise InputError('NiceGUI must be installed for the application, but is missing: pip install "asperity[web]".')
    options = Options(
        files=file or (),
        demo=demo,
        host=host,
        port=port,
        folder=folder,
        most_upload=most_upload,
        time_limit=time_limit,
        memory=memory,
        threads=threads,
        at_once=at_once,
        total_time=total_time,
        all_uploads=all_uploads,
    )
    serve(
        options,
        lambda address, file: _opened(address, file, host, browser=not no_browser),
        lambda address: say(f"The next window opens by {address}", "dim"),
    )


def _opened(address: str, file: Path, host: str, *, browser: bool) -> None:
    """Print the address, and open it by the private ``file`` that leads there: the list of
    processes shows what is opened."""
    say(f"asperity is at {address}")
    if not is_loopback(host):
        text = (
            f"Others reach it at {host}, without encryption: whoever opens an address with its token first may "
            "use it as you do."
        )
        say(text, "yellow", warning=True)
    say("It ends with Ctrl-C.", "dim")
    if browser:
        webbrowser.open(file.as_uri())
