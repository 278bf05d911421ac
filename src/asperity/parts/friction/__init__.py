"""Friction between the bodies: shear traction on them, the force that a film holds, and what shear does to the pressure."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ...core.settings import Settings, setting
from ...core.values import Angle, Number, Speed
from ..part import Part

if TYPE_CHECKING:
    from ...contact.laws import Coulomb

Coefficient = Annotated[float, Number(least=0.0, fix="Turn the direction by 180 deg instead.")]


class FrictionSettings(Settings):
    """Friction of a sliding contact; stresses, menisci and, if it is ``coupled``, the pressure take it from here."""

    coefficient: Coefficient = setting(0.0, option="--friction", help="Shear traction over pressure: 0.3")
    direction: Angle = setting(
        "0 deg", option="--direction", help="Of the shear traction on the body, from x towards y: 90deg"
    )
    coupled: bool = setting(False, option="--coupled", help="Let the shear traction change the pressure")
    speed: Speed | None = setting(
        None, option="--speed", help="Sliding speed, for the viscous part of the friction of a film: 1mm/s"
    )


def coulomb(settings: FrictionSettings) -> Coulomb:
    """Friction of the problem with these ``settings``."""
    from ...contact.laws import Coulomb

    return Coulomb(settings.coefficient, settings.direction, settings.speed or 0.0, settings.coupled)


class Friction(Part):
    """Shear traction that changes the pressure."""

    name = "friction"
    title = "Friction"
    table = "friction"
    settings = FrictionSettings
    in_every_document = True

    def asked(self, document: Any, folder: Path) -> FrictionSettings | None:
        """The settings, where the friction takes part in the solve."""
        table: FrictionSettings = document.friction
        return table if table.coupled and table.coefficient else None

    def coupling(self, ask: FrictionSettings) -> Mapping[str, Any]:
        """Sliding joins the solve."""
        return {"friction": coulomb(ask)}
