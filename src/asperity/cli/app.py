"""The command ``app``: the web application on this machine."""

from __future__ import annotations

import importlib.util
import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from ..core import require
from ..core.errors import InputError
from ..core.settings import COMMAND_LINE, validated
from ..web.security import is_loopback
from ..web.server import Caps, Options, serve
from .declared import Given, Option, offers, options_of
from .show import say


def _caps() -> tuple[Option, ...]:
    return options_of(Caps, ("caps",), "Limits")


@offers(_caps)
def app(
    given: Given,
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
) -> None:
    """Explore a contact in the browser, on this machine only: no account, nothing leaves it, works
    offline.

    Examples: asperity app; asperity app scan.x3p; asperity app --demo; asperity app --folder disk

    It ends with Ctrl-C. Needs NiceGUI, which the extra `web` of the package brings.
    """
    require.integer(port, 0, "--port", "Give 0 for any free one.")
    if port > 65535:
        raise InputError(f"--port must be at most 65535, but is {port}.")
    caps = given.under("caps")
    limits = validated(Caps, caps.table(), COMMAND_LINE, {option.path[-1]: option.name for option in caps.options})
    if importlib.util.find_spec("nicegui") is None:
        raise InputError('NiceGUI must be installed for the application, but is missing: pip install "asperity[web]".')
    options = Options(file or (), demo, host, port, folder, limits)
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
