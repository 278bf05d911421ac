"""The command ``theory``: one subcommand for every theory of the catalogue, made from its inputs."""

from __future__ import annotations

from typing import Annotated, Any

import typer
from typer.core import TyperGroup


class Theories(TyperGroup):
    """Subcommands that are built when they are asked for."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of all theories."""
        from ..theories.catalogue import THEORIES

        return list(THEORIES)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Subcommand of one theory, with dashes or underscores.

        Raises
        ------
        InputError
            If there is no such theory.
        """
        from ..theories.catalogue import theory
        from .theory_command import command

        return command(theory(cmd_name.replace("_", "-")))


app = typer.Typer(name="theory", cls=Theories, invoke_without_command=True, add_completion=False)


@app.callback()
def theory(
    context: typer.Context,
    listed: Annotated[bool, typer.Option("--list", help="Show all theories with their inputs and sources.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="The list as JSON.")] = False,
) -> None:
    """Evaluate a theory, from numbers or for a measured surface.

    Examples: asperity theory --list; asperity theory hertz --E-star 115GPa --radius 5mm --load 1N..100N;
    asperity theory bush-gibson-thomas --surface scan.di --body DLC --pressure 1MPa..100MPa

    asperity theory NAME --help lists the options of a theory.
    """
    if context.invoked_subcommand is None:
        if not listed:
            from ..core.errors import InputError

            raise InputError("NAME of a theory or --list must be given, but neither is.")
        from .theory_show import print_list

        print_list(as_json=as_json)
