"""Options of commands, made from the declarations of parameters when a command is asked for them.

A command takes ``given: Given`` and says with ``@offers`` which options fill it; ``Lazy`` makes them late, so that the list
of all commands is shown without importing what declares them.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from ..core import units
from ..core.parameters import REQUIRED, Parameter, parameters
from ..core.values import Choice, Flag, Several, Values

__all__ = ["Given", "Lazy", "Option", "built", "explained", "offers", "options_of"]


@dataclass(frozen=True)
class Option:
    """One option: its ``name``, the key it fills by its ``path``, the declaration behind it, and the ``panel`` it is shown in."""

    name: str
    path: tuple[str, ...]
    parameter: Parameter
    panel: str | None = None
    required: bool = False
    others: tuple[str, ...] = ()

    @property
    def word(self) -> str:
        """Name of the argument that typer passes."""
        return self.name.lstrip("-").replace("-", "_").replace(".", "_").lower()

    @property
    def repeated(self) -> bool:
        """Whether it may be given several times: a list of what has commas in itself."""
        return isinstance(self.parameter.values, Several) and type(self.parameter.values.item) is Values

    def shown(self) -> inspect.Parameter:
        """Parameter of a typer command."""
        names = list(dict.fromkeys((self.name, *self.others, *([self.name.lower()] if not self.others else []))))
        kind: Any = list[str] if self.repeated else str
        default: Any = REQUIRED if self.required else None
        if isinstance(self.parameter.values, Flag):
            kind = bool
            if self.parameter.default is True:
                names = [f"{self.name}/--no-{self.name[2:]}"]
        made = typer.Option(
            *names, help=explained(self.parameter), metavar=_metavar(self.parameter), rich_help_panel=self.panel
        )
        wanted: Any = kind if self.required else kind | None
        annotation: Any = Annotated[wanted, made]
        return inspect.Parameter(self.word, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


@dataclass(frozen=True)
class Given:
    """What the user gave: text, flags and lists of text by the path of the key that they fill."""

    values: Mapping[tuple[str, ...], Any]
    options: Sequence[Option]

    def table(self) -> dict[str, Any]:
        """Nested table of everything given."""
        made: dict[str, Any] = {}
        for path, value in self.values.items():
            inner = made
            for part in path[:-1]:
                inner = inner.setdefault(part, {})
            inner[path[-1]] = value
        return made

    @property
    def names(self) -> dict[str, str]:
        """What the user calls each key, by its dotted path."""
        return {".".join(option.path): option.name for option in self.options}

    def under(self, *path: str) -> Given:
        """What was given below ``path``, by the rest of the path."""
        n = len(path)
        return Given({p[n:]: value for p, value in self.values.items() if p[:n] == path and len(p) > n}, self.options)


def options_of(
    declared: Any, path: tuple[str, ...] = (), panel: str | None = None, *, leave: Iterable[str] = (), prefix: str = ""
) -> tuple[Option, ...]:
    """One option for every parameter of ``declared``, a function, a dataclass or a table, that fills the key below ``path``.

    It is called as its declaration says, or else after the parameter with ``prefix``; those to ``leave`` have none.
    """
    left = set(leave)
    found = [item for item in declarations(declared) if item.name not in left]
    return tuple(
        Option(
            item.option or f"--{prefix}{item.name.replace('_', '-')}", (*path, item.name), item, panel, item.required
        )
        for item in found
    )


def declarations(declared: Any) -> tuple[Parameter, ...]:
    """The parameters that a function, a dataclass or a table of a document declares."""
    fields = getattr(declared, "model_fields", None)
    if fields is None:
        return parameters(declared)
    from ..core.settings import declared as parameter_of

    return tuple(parameter_of(name, field) for name, field in fields.items())


def offers(make: Callable[[], Sequence[Option]]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a command the options that ``make`` returns, in the place of its parameter ``given``."""

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        command.__dict__["offered"] = make
        return command

    return decorated


class Lazy(TyperCommand):
    """A command of which the options are made when somebody asks for them."""

    def get_params(self, ctx: Any) -> Any:
        """Parameters of the command; the first call makes them."""
        command = getattr(self.callback, "lazy", None)
        if command is not None:
            made = built(command, command.__dict__["offered"](), str(self.name))
            self.params, self.callback = made.params, made.callback
        return super().get_params(ctx)


def late(command: Callable[..., None]) -> Callable[..., None]:
    """What typer is shown of a command before its options are made: its name and its words."""

    @functools.wraps(command)
    def nothing() -> None:  # replaced by the command itself before it runs
        raise NotImplementedError

    nothing.__dict__.update(lazy=command, __signature__=inspect.Signature(), __annotations__={})
    return nothing


def built(command: Callable[..., None], options: Sequence[Option], name: str) -> Any:
    """Command of typer that calls ``command`` with what is given by the ``options``.

    Raises
    ------
    ValueError
        If two options have the same name.
    """
    own = inspect.signature(command, eval_str=True).parameters
    by_word: dict[str, Option] = {}
    for option in options:
        other = by_word.setdefault(option.word, option)
        if other is not option or option.word in own:
            where = ".".join(other.path) if other is not option else "the command itself"
            raise ValueError(
                f"{option.name} of `{name}` is the option of {'.'.join(option.path)} and of {where}: rename one"
            )

    def run(**values: Any) -> None:
        found = {option.path: values.pop(word) for word, option in by_word.items()}
        told = {path: value for path, value in found.items() if value is not None and value != []}
        command(**values, given=Given(told, options))

    shown: list[inspect.Parameter] = []
    for key, item in own.items():
        if key == "given":
            shown += [option.shown() for option in options]
        else:
            shown.append(item.replace(kind=inspect.Parameter.KEYWORD_ONLY))
    run.__dict__["__signature__"] = inspect.Signature(shown)
    run.__annotations__ = {item.name: item.annotation for item in shown}
    run.__doc__ = inspect.cleandoc(command.__doc__ or "")
    app = typer.Typer(add_completion=False)
    app.command(name)(run)
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
    told = units.show(default, item.unit) if isinstance(default, float) else default
    return f"{text}. Default: {told}."


def _metavar(item: Parameter) -> str | None:
    return None if isinstance(item.values, Flag) else item.values.metavar
