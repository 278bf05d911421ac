"""Plastic load: the first load at which more than a share of the real area is at the hardness."""

from __future__ import annotations

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Fraction
from ...parts.part import Part


class PlasticLoadSettings(Settings):
    """A search for the load at which the plastic ``share`` of the real area is passed, 0.02 by
    default (some 15 solves)."""

    share: Fraction = setting(
        0.02, option="--plastic-share", help="Search the load at which this share of the real area is plastic"
    )


class PlasticLoad(Part):
    """First load at which more than a share of the real area is at the hardness."""

    name = "plastic_load"
    title = "Plastic load"
    purpose = "At which load a given share of the contact has turned plastic."
    table = "plastic_load"
    settings = PlasticLoadSettings
    quantities = (Quantity("plastic_load_pressure", "Pa", "mean pressure at which the contact becomes plastic"),)
    work = "physics.hardness.work:PlasticLoadWork"
