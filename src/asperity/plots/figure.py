"""A drawn figure with what a report says of it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """A drawn figure: ``name`` of its file, ``title``, ``caption``, and the PNG."""

    name: str
    title: str
    caption: str
    picture: bytes
