"""The table [stress] of a document: which stresses inside a body are wanted, and under what friction."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import Angle, Length, NonNegativeLength, Number, Pressure
from .values import PlaceOfMaximum


def positions_from_text(text: str) -> dict[str, str]:
    """Positions in text such as ``"y=max"`` or ``"x=30nm, y=max"``, by axis.

    Raises
    ------
    InputError
        If a part is no position; the message lacks the name of the option or key at its beginning.
    """
    found: dict[str, str] = {}
    for part in text.split(","):
        axis, equals, position = (piece.strip() for piece in part.partition("="))
        if axis not in ("x", "y") or not equals or not position or axis in found:
            raise InputError(f' must be a position such as "y=max", "y=pressure" or "x=30nm", but is {text!r}.')
        found[axis] = position
    return found


class _Placed(Settings):
    """Positions ``x`` and ``y``, each a length or a word; both together may be text such as ``"y=max"``.

    ``"max"`` is the position of the largest stress, ``"pressure"`` that of the highest pressure.
    """

    x: PlaceOfMaximum | None = None
    y: PlaceOfMaximum | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return positions_from_text(value) if isinstance(value, str) else value


class SectionTable(_Placed):
    """Vertical plane through the body: exactly one of ``x`` and ``y``.

    With ``"max"`` each kind of stress is shown on the plane through its own maximum (as by Peng 2001, figs. 3.15 - 3.22).
    """

    @model_validator(mode="after")
    def _one(self) -> SectionTable:
        if (self.x is None) == (self.y is None):
            given = "none" if self.x is None else "both"
            raise InputError(f' must give exactly one of x and y, such as "y=max", but gives {given}.')
        return self


class ProfileTable(_Placed):
    """Line into the body; a position that is left out is that of the largest equivalent stress, ``"max"``."""


Friction: TypeAlias = Annotated[float, Number(least=0.0, fix="Turn the direction by 180 deg instead.")]
"""Coefficient of friction."""


class StressTable(Settings):
    """Stresses that are computed after the contact; those on the section y = max if nothing else is asked for.

    ``friction`` is the ratio of shear traction and pressure in a sliding contact, ``direction`` that of the traction on
    the body, from +x towards +y; ``coupled`` lets the shear traction change the pressure. ``depths`` are planes,
    ``sections`` vertical planes and ``profiles`` lines down to the depth ``deepest``. The strengths are compared with the
    largest tension, and with shear and peel of the interfaces.
    """

    friction: Friction = 0.0
    direction: Angle = setting("0 deg")
    coupled: bool = False
    inside: Literal["body", "counter_body"] = "body"
    depths: tuple[NonNegativeLength, ...] = ()
    sections: tuple[SectionTable, ...] = ()
    profiles: tuple[ProfileTable, ...] = ()
    deepest: Length | None = None
    criterion: Literal["von_mises", "tresca"] = "von_mises"
    tensile_strength: Pressure | None = None
    interface_shear_strength: Pressure | None = None
    interface_peel_strength: Pressure | None = None
    precision: Literal["double", "single"] = "double"


class StressDocument(Settings):
    """Nothing but the stresses that are wanted of a contact that has been solved."""

    stress: StressTable
