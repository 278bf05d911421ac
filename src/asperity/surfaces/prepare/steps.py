"""What preparation steps share: complete maps in, the change of the rms height in the record."""

from __future__ import annotations

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.units import show
from ..characterise.heights import rms_height
from ..surface import Surface


def require_complete(surface: Surface, word: str) -> None:
    """Refuse a surface with missing points; ``word`` says what it was to be, such as ``"tapered"``.

    Raises
    ------
    InputError
        If points are missing.
    """
    if surface.n_missing:
        raise InputError(
            f"surface must have no missing points to be {word}, but {surface.n_missing} are missing. "
            "Fill them first with filled()."
        )


def recorded(
    surface: Surface, heights: RealArray, step: str, *, periodic: bool, citation_keys: tuple[str, ...] = ()
) -> Surface:
    """``surface`` with other ``heights`` (nx, ny) in m; the history tells ``step`` and both rms heights."""
    after = Surface(heights, surface.dx, surface.dy, periodic=periodic)
    change = f"{step} (rms {show(rms_height(surface), 'm', 3)} -> {show(rms_height(after), 'm', 3)})"
    origin = surface.origin.continued(change, citation_keys)
    return Surface(after.heights, surface.dx, surface.dy, periodic=periodic, origin=origin)
