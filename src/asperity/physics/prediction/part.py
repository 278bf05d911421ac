"""Prediction: what the table of solved contacts expects, beside what is solved."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice
from ...parts.part import Part
from .prediction import QUANTITIES

WORDS = ("heights", "spectrum")

Of = Annotated[str, Choice({name: name for name in WORDS})]


class PredictionSettings(Settings):
    """What ``asperity predict`` reads from its table of solved contacts, beside what is solved: by
    the heights of this surface, or by the spectrum that it is generated with, which all its
    realisations share.

    Numbers of the first differ from the solved ones by the scatter of the summits alone.
    """

    of: Of = setting(
        "heights", option="--predict", help="heights of this surface, or the spectrum that it is generated with"
    )


@dataclass(frozen=True)
class PredictionAsked:
    """What is read: nothing but the heights, or the ``table`` of the spectrum of the surface."""

    table: Any = None


def predicted(quantity: Quantity) -> tuple[Quantity, Quantity, Quantity]:
    """A predicted number and the ends of its band."""
    name, unit, label = f"predicted_{quantity.name}", quantity.unit, f"predicted {quantity.label}"
    return (
        Quantity(name, unit, label),
        Quantity(f"{name}_low", unit, f"{label}: lower end for 19 of 20 surfaces"),
        Quantity(f"{name}_high", unit, f"{label}: upper end for 19 of 20 surfaces"),
    )


SHOWN = tuple(quantity for quantity in QUANTITIES if quantity.name != "pull_pressure")
"""Numbers that are predicted; of contacts that nothing pulls together."""

GROUPS = (
    Quantity("predicted_y", "1", "mean pressure / rms pressure of full contact"),
    Quantity("full_contact_pressure", "Pa", "rms pressure of full contact"),
)


class PredictionPart(Part):
    """What is expected without solving."""

    name = "prediction"
    title = "Prediction"
    purpose = "What the table of solved contacts expects, beside what is solved."
    table = "prediction"
    settings = PredictionSettings
    quantities = (*(item for quantity in SHOWN for item in predicted(quantity)), *GROUPS)
    work = "physics.prediction.work:PredictionWork"
    answers = False

    def asked(self, document: Any, folder: Path) -> PredictionAsked | None:
        """The table of the spectrum, where it is asked for and the surface used as it is made."""
        if document.prediction is None:
            return None
        if document.prediction.of == "heights":
            return PredictionAsked()
        surface = document.surface
        made = document.counter_surface is None and not surface.prepare and getattr(surface, "kind", "") == "rough"
        return PredictionAsked(surface.spectrum if made else False)
