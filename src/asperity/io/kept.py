"""Results beside contacts and load paths in files: the group that holds each, written by the codec
or by its physics."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..contact.result import ContactResult
from ..core.registry import RESULTS, home
from .codec import KIND, group_of, made_of, values_in
from .contacts import grid_lines
from .description import kind_name
from .tree import Node


def group_name(result: object) -> str:
    """Name of the group that holds a ``result``; empty if none does."""
    kind = kind_name(type(result))
    return next((name for name, kept in RESULTS.items() if kind == f"asperity.{kept.home}"), "")


def contact_beside(result: object) -> ContactResult | None:
    """The contact that files hold beside a ``result``."""
    name = group_name(result)
    return getattr(result, RESULTS[name].contact) if name and RESULTS[name].contact else None


def kept_node(result: Any, name: str) -> Node:
    """The group of that ``name`` for a ``result``, or for the parts of one, one after the other,
    where it can be divided."""
    kept = RESULTS[name]
    if kept.writes:
        found: Node = home(kept.writes)(result)
        return found
    node, contact = group_of(result), contact_beside(result)
    return node if contact is None else replace(node, values=(*grid_lines(contact), *node.values))


def kept_from(node: Node, name: str, contact: ContactResult | None = None) -> Any:
    """The result of a group of that ``name``, equal to the one it was made of; ``contact`` stands
    beside it.

    Raises
    ------
    KeyError, ValueError
        If something is missing, or contradicts itself.
    """
    kept = RESULTS[name]
    if kept.reads:
        return home(kept.reads)(node)
    if KIND not in node.attributes:
        from .format2 import kept_from as older

        return older(node, name, contact)
    kind = home(kept.home)
    values = values_in(node)
    made = made_of(kind, values, {kept.contact: contact} if kept.contact else {})
    if hasattr(made, "require_sound"):
        made.require_sound()
    return made
