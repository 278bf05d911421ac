"""What a file holds, before it is read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..core.errors import FileFormatError


@dataclass(frozen=True)
class ChannelInfo:
    """One data channel of a file.

    ``shape`` is (nx, ny); ``size`` is (Lx, Ly) in m, or None if the file does not state it; ``unit`` is the unit of the
    data as written in the file, empty if unknown; ``default`` marks the channel that is read when none is named.
    """

    index: int
    name: str
    shape: tuple[int, ...]
    size: tuple[float, float] | None
    unit: str
    default: bool


def chosen(channels: Sequence[ChannelInfo], channel: str | int | None, path: object) -> ChannelInfo:
    """The ``channel`` named by text (the first of equal names) or index, the default one for None.

    Raises
    ------
    FileFormatError
        If there is no such channel; the message lists those that exist.
    """
    if channel is None:
        return next(info for info in channels if info.default)
    for info in channels:
        if info.name == channel:
            return info
    index = int(channel) if str(channel).isdigit() else -1
    for info in channels:
        if info.index == index:
            return info
    listed = ", ".join(f"{info.index} = {info.name!r}" for info in channels)
    raise FileFormatError(f"channel of file {path} must be one of {listed}, but is {channel!r}.")
