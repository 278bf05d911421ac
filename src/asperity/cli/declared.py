"""Options of commands, made from the declarations of parameters when a command is asked for them.

A command takes ``given: Given`` and ``@offers`` the options that fill it; ``built`` makes both a
command of typer.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from ..core import units
from ..core.errors import InputError
from ..core.parameters import REQUIRED, Parameter, parameters
from ..core.settings import declared as parameter_of
from ..core.values import Choice, Flag, Several, Values
from ..parts.registry import parts
from .show import silence


@dataclass(frozen=True)
class Option:
    """One option: its ``name``, the key it fills by its ``path``, the declaration behind it, and
    the ``panel`` it is shown in."""

    name: str
    path: tuple[str, ...]
    parameter: Parameter
    panel: str | None = None
    required: bool = False
    others: tuple[str, ...] = ()
    metavar: str | None = None

    @property
    def word(self) -> str:
        """Name of the argument that typer passes."""
        return self.name.lstrip("-").replace("-", "_").replace(".", "_").lower()

    def shown(self) -> inspect.Parameter:
        """Parameter of a typer command."""
        names = list(dict.fromkeys((self.name, *self.others, *([self.name.lower()] if not self.others else []))))
        values = self.parameter.values
        # what has commas in itself is given several times; shells complete names of files
        listed = isinstance(values, Several) and type(values.item) is Values
        named = self.metavar == FILE or self.name.endswith("-file")
        kind: Any = list[str] if listed else Path if named else str
        default: Any = REQUIRED if self.required else None
        if isinstance(values, Flag):
            kind = bool
            if self.parameter.default is True:
                names = [f"{self.name}/--no-{self.name[2:]}"]
        metavar = None if kind is bool else FILE if kind is Path else self.metavar or values.metavar or "TEXT"
        if listed and not self.metavar:
            metavar = "TEXT"  # one of them: the option is given several times
        made = typer.Option(*names, help=explained(self.parameter), metavar=metavar, rich_help_panel=self.panel)
        wanted: Any = kind if self.required else kind | None
        annotation: Any = Annotated[wanted, made]
        return inspect.Parameter(self.word, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


FILE = "FILE"
"""Stands for a value that is the name of a file."""


@dataclass(frozen=True)
class Given:
    """What the user gave: text, flags and lists of text by the path of the key that they fill."""

    values: Mapping[tuple[str, ...], Any]
    options: Sequence[Option] = ()

    def table(self) -> dict[str, Any]:
        """Nested table of everything given."""
        made: dict[str, Any] = {}
        for path, value in self.values.items():
            inner = made
            for part in path[:-1]:
                inner = inner.setdefault(part, {})
            inner[path[-1]] = value
        return made

    def get(self, *path: str) -> Any:
        """What was given for the key at ``path``, or None."""
        return self.values.get(path)

    @property
    def names(self) -> dict[str, str]:
        """What the user calls each key, by its dotted path."""
        return {".".join(option.path): option.name for option in self.options}

    def under(self, *path: str) -> Given:
        """What was given below ``path``, by the rest of the path."""
        n = len(path)
        return Given({p[n:]: value for p, value in self.values.items() if p[:n] == path and len(p) > n}, self.options)


def options_of(
    declared: Any,
    path: tuple[str, ...] = (),
    panel: str | None = None,
    *,
    leave: Iterable[str] = (),
    only: Iterable[str] = (),
    prefix: str = "",
) -> tuple[Option, ...]:
    """One option for every parameter of ``declared``, a function, a dataclass or a table, that
    fills the key below ``path``.

    It is called as its declaration says, or else after the parameter with ``prefix``; those to
    ``leave`` have none, or all but ``only`` some.
    """
    left, kept = set(leave), set(only)
    found = [item for item in declarations(declared) if item.name not in left and (not kept or item.name in kept)]
    return tuple(
        Option(
            item.option or f"--{prefix}{item.name.replace('_', '-')}",
            (*path, item.name),
            item,
            panel,
            item.required,
        )
        for item in found
    )


def declarations(declared: Any) -> tuple[Parameter, ...]:
    """The parameters that a function, a dataclass or a table of a document declares."""
    fields = getattr(declared, "model_fields", None)
    if fields is None:
        return parameters(declared)
    return tuple(parameter_of(name, field) for name, field in fields.items())


def part_options(*names: str, basic: Iterable[str] = ()) -> tuple[Option, ...]:
    """Options for the settings of the parts with these ``names``; of all parts if none is named.

    Those of the parts of this package that are neither ``basic`` nor said to be so by the part are
    advanced; none is if none is ``basic``.
    """
    found: list[Option] = []
    for part in parts():
        if part.settings is not None and (not names or part.name in names):
            own = type(part).__module__.partition(".")[0] == "asperity"
            prefix = "" if own else f"{part.name.replace('_', '-')}-"
            # what a table must have, it must have where it is asked for
            every = options_of(part.settings, (part.table,), panel=part.title, prefix=prefix)
            made = [replace(option, required=False) for option in every]
            first = {*basic, *(option.name for option in made if option.path[-1] in part.basic)}
            found += sorted_out(made, first) if own and basic else made
    return tuple(found)


def sorted_out(options: Iterable[Option], basic: Iterable[str]) -> list[Option]:
    """``options``, those that are not ``basic`` in a panel of advanced options."""
    wanted = set(basic)
    return [
        option if option.name in wanted else replace(option, panel=f"{ADVANCED}{option.panel}") for option in options
    ]


def with_parts(table: Mapping[str, Any], given: Given, asked: tuple[str, ...] = ()) -> dict[str, Any]:
    """``table`` of a document with what is ``given`` over it; the tables that are ``asked`` for are
    there in any case.

    Friction for no part that takes it, such as a shift or a motion, requests the stresses that it
    causes.

    Raises
    ------
    InputError
        If a table is asked for that no part has.
    """
    known = [part.table for part in parts() if part.settings is not None]
    chosen = {name: values for name, values in given.table().items() if name in known}
    made = dict(table)
    for name, values in chosen.items():
        before = made.get(name)
        made[name] = {**(before if isinstance(before, dict) else {}), **values}
    for name in asked:
        if name not in known:
            raise InputError(f"--with must be one of {', '.join(known)}, but is {name!r}.")
        made.setdefault(name, {})
    if "friction" in chosen and not any(part.takes_friction and part.table in made for part in parts()):
        made.setdefault("stress", {})
    return made


def part_names(given: Given, *, everything: bool) -> dict[str, str]:
    """What the user calls the keys of the parts: those that are ``given``, or with ``everything``
    all of them."""
    known = {part.table for part in parts() if part.settings is not None}
    names = {
        ".".join(option.path): option.name
        for option in given.options
        if option.path[0] in known and (everything or option.path in given.values)
    }
    tables = {name.partition(".")[0] for name in names}
    return {**{name: f"the {name.replace('_', ' ')}" for name in tables}, **names}


def offers(make: Callable[[], Sequence[Option]]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a command the options that ``make`` returns, in the place of its parameter ``given``."""

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        command.__dict__["offered"] = make
        return command

    return decorated


ADVANCED = "Advanced: "
"""Beginning of the title of a panel that only ``--help-all`` shows."""


def _says_nothing(param: Any) -> bool:
    """Whether an option is None where it is not given, whatever else."""
    plain = param.param_type_name == "option" and param.nargs == 1 and not param.multiple
    return plain and param.default is None and not (param.required or param.callback or param.envvar or param.is_flag)


class Command(TyperCommand):
    """A command whose page leaves the advanced options to ``--help-all``, and which names all
    missing options at once."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Take ``args`` apart."""
        found, every = self.make_parser(ctx).parse_args(list(args))[0], self.params
        # of some hundred options few are given; for each of the others a check would be built
        page = found.get("help") or found.get("help_all")  # which shows all of them
        left = [] if page else [param.name for param in every if _says_nothing(param) and param.name not in found]
        self.params = [param for param in every if param.name not in left]
        try:
            rest: list[str] = super().parse_args(ctx, args)
        except typer.BadParameter:
            missing: list[Any] = [param for param in self.params if param.required and param.name not in found]
            if len(missing) < 2:
                raise
            names = [
                f"'{param.opts[0]}'" if param.param_type_name == "option" else str(param.metavar or param.name)
                for param in missing
            ]
            ctx.fail(f"Missing {', '.join(names[:-1])} and {names[-1]}")
        finally:
            self.params = every
        ctx.params.update(dict.fromkeys(left))
        return rest

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options by panel, names in full; the advanced ones only if they are
        asked for."""
        panels: dict[str, list[tuple[str, str]]] = {"Arguments": [], "Options": []}
        left = 0
        for param in self.get_params(ctx):
            title = "Arguments" if param.param_type_name == "argument" else "Options"
            panel = getattr(param, "rich_help_panel", None) or title
            if panel.startswith(ADVANCED) and not ctx.meta.get(WHOLE, False):
                left += 1
            elif record := param.get_help_record(ctx):
                name = record[0].partition(" <")[0] if title == "Arguments" else record[0]  # it says itself what it is
                panels.setdefault(panel, []).append((name, record[1]))
        for panel, records in panels.items():
            if records:
                with formatter.section(panel):
                    formatter.write_dl(records)
        if left:
            formatter.write_paragraph()
            formatter.write_text(f"{left} further options: {ctx.command_path} --help-all")


WHOLE = "asperity.whole page"


def _whole_page(ctx: typer.Context, wanted: bool) -> None:
    if wanted:
        ctx.meta[WHOLE] = True
        typer.echo(ctx.get_help())
        raise typer.Exit


def built(command: Callable[..., None], name: str, options: Sequence[Option] | None = None) -> Any:
    """Command of typer that calls ``command`` with what is given by the ``options``, by default
    those it offers.

    Raises
    ------
    ValueError
        If two options have the same name.
    """
    if options is None:
        options = command.__dict__.get("offered", tuple)()
    own = inspect.signature(command, eval_str=True).parameters
    by_word: dict[str, Option] = {}
    for option in options:
        other = by_word.setdefault(option.word, option)
        if other is not option or option.word in own:
            where = ".".join(other.path) if other is not option else "the command itself"
            raise ValueError(
                f"{option.name} of `{name}` is the option of {'.'.join(option.path)} and of {where}: rename one"
            )

    def run(*, quiet: bool, **values: Any) -> None:
        values.pop("help_all", None)
        found = {option.path: values.pop(word) for word, option in by_word.items()}
        chosen = {path: str(v) if isinstance(v, Path) else v for path, v in found.items() if v is not None and v != []}
        with silence() if quiet else nullcontext():
            command(**values, **({"given": Given(chosen, options)} if "given" in own else {}))

    shown: list[inspect.Parameter] = []
    for key, item in own.items():
        if key == "given":
            shown += [option.shown() for option in options]
        else:
            shown.append(item.replace(kind=inspect.Parameter.KEYWORD_ONLY))
    quiet_help = "Print errors and warnings only, no answers and no progress."
    flags: dict[str, Any] = {"quiet": typer.Option("--quiet", "-q", help=quiet_help)}
    if any((option.panel or "").startswith(ADVANCED) for option in options):
        flags["help_all"] = typer.Option("--help-all", help="Show all options.", is_eager=True, callback=_whole_page)
    for key, flag in flags.items():
        annotation: Any = Annotated[bool, flag]
        shown.append(inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=False, annotation=annotation))
    run.__dict__["__signature__"] = inspect.Signature(shown)
    run.__annotations__ = {item.name: item.annotation for item in shown}
    run.__doc__ = inspect.cleandoc(command.__doc__ or "")
    app = typer.Typer(add_completion=False, rich_markup_mode=None)
    app.command(name, cls=Command)(run)
    app.callback()(lambda: None)
    return typer.main.get_group(app).commands[name]


def explained(item: Parameter) -> str:
    """Text of an option in the help: what it is, its unit or words, and its default."""
    text = item.help.rstrip(".").replace("``", "")
    text = text[:1].upper() + text[1:]
    values, default = item.values, item.default
    if isinstance(values, Choice):
        text += f": {', '.join(values.words)}"
        default = next((word for word, value in values.words.items() if value is default or value == default), None)
    shown = default is not REQUIRED and default not in (None, (), "") and not isinstance(default, bool)
    if not shown:
        return f"{text}."
    chosen = units.show(default, item.unit) if isinstance(default, float) else default
    return f"{text}. Default: {chosen}."
