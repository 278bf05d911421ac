"""The command ``generate``: one subcommand for every kind of surface, made from the schema of the documents."""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperGroup


class Kinds(TyperGroup):
    """Subcommands that are built when they are asked for: the schemas they follow are slow to import."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of all kinds."""
        from .generators import KINDS

        return list(KINDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Subcommand of one kind, with dashes or underscores; None if there is none of the name."""
        from .generators import KINDS, command

        kind = cmd_name.replace("-", "_")
        return command(kind) if kind in KINDS else None


app = typer.Typer(name="generate", cls=Kinds, no_args_is_help=True, add_completion=False)


@app.callback()
def generate() -> None:
    """Generate a rough surface, a texture or an indenter and write it to a file.

    Example: asperity generate rough --points 512 --size 10um --spectrum self_affine --rms-height 5nm --hurst 0.8
    --rolloff-wavelength 2um --shortest-wavelength 80nm --seed 1 --out rough.nc

    asperity generate KIND --help lists the options of a kind.
    """
