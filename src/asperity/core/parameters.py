"""Parameters declared once, where they stand in a signature: unit, range, choices, default and one
line of help.

A function or a frozen dataclass declares with ``Annotated`` what its parameters may be:

    def sphere(
        grid: Grid,
        *,
        radius: Annotated[Length, "Radius."],
        exact: Annotated[bool, "A circle."] = False,
    )

From this alone follow the checks of values (``Declared``, ``checked``), the keys and messages of
documents (``core.settings``), options and help of the command line, and the pages of reference.
Inside the package values are SI numbers; text such as ``"5 nm"`` of documents and options becomes
one by ``read``.
"""

from __future__ import annotations

import functools
import inspect
import reprlib
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass
from types import UnionType
from typing import Annotated, Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

from .errors import InputError
from .values import Choice, Flag, Number, Several, Text, Values, Whole

P = ParamSpec("P")
R = TypeVar("R")

REQUIRED: Any = inspect.Parameter.empty
"""Default of a parameter that must be given."""


@dataclass(frozen=True)
class Help:
    """What a parameter is, in one line; ``option`` names it on the command line, ``of`` is what it
    belongs to."""

    text: str
    option: str | None = None
    of: str = ""


@dataclass(frozen=True)
class Parameter:
    """A declared parameter: its ``name``, type, what ``values`` it takes, its ``default`` and one
    line of ``help``."""

    name: str
    annotation: Any
    values: Values
    default: Any = REQUIRED
    help: str = ""
    option: str | None = None
    of: str = ""

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is REQUIRED

    @property
    def unit(self) -> str:
        """SI unit, empty for what has none."""
        return self.values.unit

    @property
    def words(self) -> Mapping[str, Any]:
        """Words that stand for values, each with its value."""
        return self.values.words if isinstance(self.values, Choice) else {}

    @property
    def many(self) -> bool:
        """Whether it is a list of any length, or an array."""
        return isinstance(self.values, Several) and self.values.count is None

    def check(self, value: Any, owner: str) -> Any:
        """``value`` as its values are checked, or what a word stands for; None where that is the
        default."""
        if value is None and self.default is None:
            return None
        unit = f" ({self.unit})" if self.unit else ""
        read = self.values.read if self.words and isinstance(value, str) else self.values.check
        return read(value, f"{self.name}{unit} of {owner}")


@functools.cache
def parameters(declared: Any) -> tuple[Parameter, ...]:
    """The declared parameters of a function or dataclass, in their order; those without any
    declaration are left out."""
    if isinstance(declared, type) and is_dataclass(declared):
        defaults = {
            f.name: f.default
            if f.default is not MISSING
            else f.default_factory()
            if f.default_factory is not MISSING
            else REQUIRED
            for f in fields(declared)
            if f.init
        }
    else:
        defaults = {name: item.default for name, item in inspect.signature(declared).parameters.items()}
    hints = get_type_hints(declared, include_extras=True)
    found = (parameter(name, hints[name], default) for name, default in defaults.items() if name in hints)
    return tuple(item for item in found if item is not None)


def parameter(name: str, annotation: Any, default: Any = REQUIRED) -> Parameter | None:
    """Parameter for an ``annotation``, None if that declares nothing."""
    base, marks = taken_apart(annotation)
    described = next(
        (mark if isinstance(mark, Help) else Help(mark) for mark in reversed(marks) if isinstance(mark, Help | str)),
        None,
    )
    values = values_of(base, marks)
    if described is None and not any(isinstance(mark, Values) for mark in marks):
        return None
    described = described or Help("")
    belongs = next((mark.of for mark in marks if isinstance(mark, Help) and mark.of), "")
    return Parameter(name, annotation, values, default, described.text, described.option, belongs)


def values_of(base: Any, marks: tuple[Any, ...] = ()) -> Values:
    """What values an annotation allows: those of the last mark with values, else those of its
    type."""
    for mark in reversed(marks):
        if isinstance(mark, Values):
            return mark
    if get_origin(base) is Annotated or get_origin(base) in (Union, UnionType):
        inner, more = taken_apart(base)
        return values_of(inner, more) if inner is not base else Values()
    if get_origin(base) is Literal:
        return Choice({str(word): word for word in get_args(base)})
    if get_origin(base) is tuple:
        first, *others = get_args(base)
        return Several(values_of(first), None if others == [...] else 1 + len(others))
    plain: Mapping[Any, Values] = {bool: Flag(), int: Whole(), float: Number(), str: Text()}
    return plain.get(base, Values())


def taken_apart(annotation: Any) -> tuple[Any, tuple[Any, ...]]:
    """Type of an annotation without None, and its marks."""
    marks: tuple[Any, ...] = ()
    while True:
        if get_origin(annotation) is Annotated:
            annotation, *more = get_args(annotation)
            marks = (*more, *marks)
        elif get_origin(annotation) in (Union, UnionType):
            others = [item for item in get_args(annotation) if item is not type(None)]
            if len(others) != 1:
                return annotation, marks
            annotation = others[0]
        else:
            return annotation, marks


@functools.cache
def _objects(function: Any) -> tuple[tuple[str, type], ...]:
    """Undeclared parameters that take one type of object, with the type."""
    hints = get_type_hints(function)
    plain = {"return", *(item.name for item in parameters(function))}
    return tuple(
        (n, kind) for n, kind in hints.items() if n not in plain and is_dataclass(kind) and isinstance(kind, type)
    )


class Declared:
    """Base of a frozen dataclass whose parameters are checked against their declarations when it is
    made."""

    def __post_init__(self) -> None:
        """Check all parameters; a word is replaced by what it stands for.

        Raises
        ------
        InputError
            If one is out of its range or of a wrong type.
        """
        kind: Any = type(self)
        owner = getattr(kind, "name", kind.__name__)
        for item in parameters(kind):
            given = getattr(self, item.name)
            found = item.check(given, owner)
            if isinstance(given, str) and found is not given:
                object.__setattr__(self, item.name, found)


def _called(signature: inspect.Signature) -> str:
    """Names of the arguments of a function, those that must be named behind a star."""
    names = [(item.name, item.kind is inspect.Parameter.KEYWORD_ONLY) for item in signature.parameters.values()]
    place = [named for _, named in names].index(True) if any(named for _, named in names) else len(names)
    star = ["*"] if place < len(names) else []
    return ", ".join([*(name for name, _ in names[:place]), *star, *(name for name, _ in names[place:])])


def checked(function: Callable[P, R]) -> Callable[P, R]:
    """``function`` whose arguments are checked against their declarations, and passed on in their
    canonical type."""
    signature, owner = inspect.signature(function), f"{function.__name__}()"

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            bound = signature.bind(*args, **kwargs)
        except TypeError as error:  # which says neither of what nor how it is called
            raise TypeError(f"{error} of {function.__name__}({_called(signature)})") from None
        for name, kind in _objects(function):
            if name in bound.arguments and not isinstance(bound.arguments[name], kind):
                shown = reprlib.repr(bound.arguments[name])
                raise InputError(
                    f"{name} of {owner} must be a {kind.__name__}, such as {kind.__name__}(…), but is {shown}."
                )
        for item in parameters(function):
            if item.name in bound.arguments:
                bound.arguments[item.name] = item.check(bound.arguments[item.name], owner)
        return function(*bound.args, **bound.kwargs)

    return call
