"""Options of a command as frozen groups: the command takes a few dataclasses, the shell sees their fields."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, get_type_hints

from .declared import Given


def grouped(command: Callable[..., None]) -> Callable[..., None]:
    """``command`` with every parameter that is a dataclass replaced by one keyword for each field.

    A field is annotated and given a default exactly like a parameter of a typer command.
    """
    declared = inspect.signature(command, eval_str=True).parameters
    groups: dict[str, Any] = {
        name: p.annotation for name, p in declared.items() if is_dataclass(p.annotation) and p.annotation is not Given
    }
    shown: list[inspect.Parameter] = []
    for name, parameter in declared.items():
        if name in groups:
            hints = get_type_hints(groups[name], include_extras=True)
            shown += [_keyword(item.name, hints[item.name], _default(item)) for item in fields(groups[name])]
        else:
            shown.append(parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY))

    @functools.wraps(command)
    def flat(**values: Any) -> None:
        built = {
            name: group(**{item.name: values.pop(item.name) for item in fields(group)})
            for name, group in groups.items()
        }
        command(**values, **built)

    flat.__dict__["__signature__"] = inspect.Signature(shown)
    flat.__annotations__ = {parameter.name: parameter.annotation for parameter in shown}
    return flat


def _keyword(name: str, annotation: object, default: object) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _default(item: Field[Any]) -> Any:
    return inspect.Parameter.empty if item.default is MISSING else item.default
