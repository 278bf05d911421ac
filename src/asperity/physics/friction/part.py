"""Friction between the bodies."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import Angle, Choice, Number, Pressure, Speed
from ...parts.part import Part

if TYPE_CHECKING:
    from .law import Coulomb, FrictionLaw, FullStick, TrescaFriction

Coefficient = Annotated[float, Number(least=0.0, fix="Turn the direction by 180 deg instead.")]


LAWS = ("coulomb", "tresca", "full stick")
"""Laws of friction in documents."""

Law = Annotated[str, Choice({name: name for name in LAWS})]


class FrictionSettings(Settings):
    """Friction of the contact; stresses, menisci, plastic flow in the volume and, if it is
    ``coupled``, the pressure take it from here.

    Beside a table [shear], and under any law but plain Coulomb's, the surfaces stick and slip; else
    all points slide.
    """

    law: Law = setting("coulomb", option="--friction-law", help="Largest shear traction of a point")
    coefficient: Coefficient = setting(0.0, option="--friction", help="Shear traction over pressure: 0.3")
    direction: Angle = setting(
        "0 deg", option="--direction", help="Of the shear traction on the body, from x towards y: 90deg"
    )
    coupled: bool | None = setting(
        None,
        option="--coupled",
        help="Let the shear traction change the pressure; so it does where surfaces stick and slip",
    )
    limit: Pressure | None = setting(
        None, option="--friction-limit", help="Largest shear traction whatever the pressure, for stick and slip: 200MPa"
    )
    strength: Pressure | None = setting(
        None, option="--friction-strength", help="Shear traction of the law tresca: 20MPa"
    )
    speed: Speed | None = setting(
        None, option="--speed", help="Sliding speed, for the viscous part of the friction of a film: 1mm/s"
    )

    @model_validator(mode="after")
    def _fitting(self) -> FrictionSettings:
        if (self.strength is None) != (self.law != "tresca"):
            raise InputError(
                f" must give the strength ({{friction.strength}}) for the law tresca and for no other, but the "
                f"law is {self.law} {'with' if self.strength else 'without'} one. Give both, such as "
                f"{{friction.law=tresca}} and {{friction.strength=20 MPa}}."
            )
        if self.law != "coulomb" and (self.coefficient or self.limit):
            raise InputError(
                f" must give no coefficient and limit for the law {self.law}, but does: they are those of "
                "Coulomb friction."
            )
        return self


def friction_law(settings: FrictionSettings, *, sheared: bool = False) -> Coulomb | TrescaFriction | FullStick:
    """Law of friction of a problem with these ``settings``; ``sheared`` where it has stick and
    slip."""
    from .law import Coulomb, FullStick, TrescaFriction

    if settings.law == "tresca":
        return TrescaFriction(settings.strength or 0.0, settings.speed or 0.0)
    if settings.law == "full stick":
        return FullStick()
    coupled = sheared if settings.coupled is None else settings.coupled
    limit = math.inf if settings.limit is None else settings.limit
    return Coulomb(settings.coefficient, settings.direction, settings.speed or 0.0, coupled, limit)


def sticks(document: Any) -> bool:
    """Whether the surfaces of a ``document`` stick and slip: with a table [shear], or a law that is
    not plain Coulomb's; not where they roll."""
    table: FrictionSettings = document.friction
    if rolls(document):
        return False
    return document.shear is not None or table.law != "coulomb" or table.limit is not None


def rolls(document: Any) -> bool:
    """Whether the friction of a ``document`` is that of its table [rolling]."""
    return getattr(document, "rolling", None) is not None


class Friction(Part):
    """Shear traction that changes the pressure or makes the body flow."""

    name = "friction"
    title = "Friction"
    purpose = "What shear the surfaces carry while one slides over the other."
    table = "friction"
    settings = FrictionSettings
    basic = ("coefficient",)
    in_every_document = True

    def asked(self, document: Any, folder: Path) -> FrictionLaw | None:
        """The law, where the friction takes part in the solve."""
        table: FrictionSettings = document.friction
        if rolls(document):
            return None
        sheared, flow = sticks(document), getattr(document, "plastic_flow", None)
        felt = table.coupled or (
            flow is not None and flow.active
        )  # shear makes the body flow, whether or not it changes the pressure
        return friction_law(table, sheared=sheared) if sheared or (felt and table.coefficient) else None

    def coupling(self, ask: FrictionLaw) -> Mapping[str, Any]:
        """Sliding, or stick and slip, joins the solve."""
        return {"friction": ask}
