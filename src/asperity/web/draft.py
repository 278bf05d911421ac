"""The document that is being filled in: text by key as a person typed it, every change can be
undone; its forms as text."""

from __future__ import annotations

import copy
import json
import pprint
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from ..core.errors import AsperityError
from ..run.document import ProblemDocument, checked, dumps, tidy, with_files

Keys: TypeAlias = tuple[str | int, ...]
"""Where a value stands: keys of tables and places in lists."""

STEPS_BACK = 200
"""Changes that can be undone."""

EMPTY: Mapping[str, Any] = {"version": 2}
"""A document with nothing in it yet."""


def found(table: Any, keys: Keys) -> Any:
    """What stands at ``keys`` of the nested ``table``; None if there is nothing."""
    for key in keys:
        try:
            table = table[key]
        except (KeyError, IndexError, TypeError):
            return None
    return table


def changed(table: Any, keys: Keys, value: Any) -> Any:
    """Copy of the nested ``table`` with ``value`` at ``keys``, or without the key if it is None."""
    if not keys:
        return value
    key, rest = keys[0], keys[1:]
    if isinstance(key, int):
        made_list = list(table) if isinstance(table, list) else []
        if value is None and not rest:
            del made_list[key]
            return made_list
        made_list += [None] * (key + 1 - len(made_list))
        made_list[key] = changed(made_list[key], rest, value)
        return made_list
    made = dict(table) if isinstance(table, Mapping) else {}
    if value is None and not rest:
        made.pop(key, None)
    else:
        made[key] = changed(made.get(key), rest, value)
    return made


def place_in(table: Any, found: Sequence[str | int]) -> Keys:
    """Keys of the nested ``table`` at which a check has ``found`` something wrong, whose path has
    names of kinds of tables among the keys; the last key may be one that is missing."""
    keys: list[str | int] = []
    for number, part in enumerate(found):
        last = number == len(found) - 1
        if isinstance(table, Mapping) and (part in table or last):
            keys.append(part)
            table = table.get(part)
        elif isinstance(table, Sequence) and not isinstance(table, str) and isinstance(part, int):
            keys.append(part)
            table = table[part] if part < len(table) else None
    return tuple(keys)


def moduli_files(table: Any, keys: Keys = ()) -> Iterator[Keys]:
    """Where the nested ``table``, which stands at ``keys``, names a file of storage and loss
    moduli, or wants one."""
    if isinstance(table, Mapping) and table.get("kind") == "measured":
        yield (*keys, "moduli_file")
    elif isinstance(table, Mapping | list):
        for key, value in table.items() if isinstance(table, Mapping) else enumerate(table):
            yield from moduli_files(value, (*keys, key))


@dataclass
class Draft:
    """A problem document that may be incomplete, with what was before and after it."""

    table: dict[str, Any] = field(default_factory=lambda: dict(EMPTY))
    before: list[dict[str, Any]] = field(default_factory=list)
    after: list[dict[str, Any]] = field(default_factory=list)

    def get(self, *keys: str | int) -> Any:
        """What stands at ``keys``; None for nothing."""
        return found(self.table, keys)

    def set(self, keys: Keys, value: Any) -> None:
        """Put ``value`` at ``keys``; None removes the key."""
        self.replace(changed(self.table, keys, copy.deepcopy(value)))

    def replace(self, table: Mapping[str, Any]) -> None:
        """Take ``table`` for the whole document."""
        if table == self.table:
            return
        self.before = [*self.before[-STEPS_BACK:], self.table]
        self.table, self.after = dict(table), []

    def undo(self) -> None:
        """Take back the last change."""
        if self.before:
            self.after.append(self.table)
            self.table = self.before.pop()

    def redo(self) -> None:
        """Make the change again that was taken back."""
        if self.after:
            self.before.append(self.table)
            self.table = self.after.pop()

    def rename(self, names: Mapping[str, str]) -> None:
        """Call files by other ``names`` from now on; what was before and after is the same."""
        self.table = relabelled(self.table, names)
        self.before, self.after = relabelled(self.before, names), relabelled(self.after, names)

    def document(self) -> ProblemDocument:
        """The document, checked.

        Raises
        ------
        InputError
            If it is incomplete or wrong; the message has one line for each problem.
        """
        return checked(self.table)

    def problems(self) -> list[str]:
        """What is wrong or missing, one sentence each; nothing if the document is complete."""
        try:
            self.document()
        except AsperityError as error:
            lines = [line.strip() for line in str(error).splitlines()]
            return [line.removeprefix("problem document: ") for line in lines if not line.endswith("problems:")]
        return []


@dataclass(frozen=True)
class Forms:
    """A document as ``python``, as ``command`` and as ``document``, for copying."""

    python: str
    command: str
    document: str


def forms_of(table: Mapping[str, Any], labels: Mapping[str, str]) -> Forms:
    """Text of the document ``table`` for other doors; files are called by their ``labels``, which a
    person knows."""
    named = relabelled(table, labels)
    try:
        text = dumps(checked(named))
        plain: dict[str, Any] = tidy(checked(named).model_dump(mode="json", exclude_none=True))
    except AsperityError:
        import tomli_w

        text, plain = tomli_w.dumps(tidy(json.loads(json.dumps(named)))), dict(named)
    name = f"{plain_name(str(named.get('title', ''))) or 'problem'}.toml"
    python = (
        "import asperity as asp\n\n"
        f"document = {pprint.pformat(plain, width=100, sort_dicts=False)}\n\n"
        "outcome = asp.run(document)\n"
        'asp.write_report(outcome, "report.html")\n'
    )
    end = "END_OF_DOCUMENT"
    command = f"cat > {name} <<'{end}'\n{text.rstrip()}\n{end}\nasperity contact --from {name} --out run\n"
    return Forms(python, command, text)


def plain_name(title: str) -> str:
    """Name of a file after a ``title``: letters, digits and dashes, perhaps none."""
    return re.sub(r"[^A-Za-z0-9]+", "-", title).lower()[:40].strip("-")


def relabelled(table: Any, labels: Mapping[str, str]) -> Any:
    """Nested ``table`` in which names of files are replaced by their ``labels``."""
    return with_files(table, lambda name: labels.get(name, name))
