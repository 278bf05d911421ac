"""Wear: what the bodies lose as they slide, how the surfaces run in, and when a coating is worn
through."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Count, Length, Number, Pressure, StepOfPath, WearCoefficient, Whole
from ...parts.part import Part
from ..friction.part import friction_law
from ..rolling.part import Rolling, Rolls
from ..stress.part import stress_request

if TYPE_CHECKING:
    from ..friction.law import FrictionLaw
    from ..stress.survey import StressRequest

WORDS = {"known": "known", "body": "body", "counter_body": "counter body", "both": "both"}

Which = Annotated[str, Choice({name: name for name in WORDS})]
Law = Annotated[str, Choice({name: name for name in ("archard", "energy")})]
ThresholdPressure = Annotated[float, Number("pressure", least=0.0)]
ThresholdEnergy = Annotated[float, Number("J/m^2", least=0.0)]
DebrisShare = Annotated[float, Number("number", least=0.0, below=1.0, percent=True)]
Tolerance = Annotated[float, Number("number", above=0.0, below=1.0, percent=True)]

SLIDING_ALONE = ("track_body", "track_counter_body", "until_bare")
"""Keys of sliding over a distance, which fretting does not have."""


class WearSettings(Settings):
    """Wear as one body slides over the other, moves to and fro on it (fretting), or rolls with the
    creepages of the table [rolling]: surfaces, areas and pressures follow what is worn away.

    Each body wears by the coefficients of the materials of its layers and base; one whose
    coefficients are not known does not, unless it is named. A coefficient given here is that of
    all materials of its body.
    """

    distance: Length | None = setting(
        None, option="--wear-distance", help="Slid, with all points sliding, or rolled: 10m"
    )
    cycles: Count | None = setting(None, option="--wear-cycles", help="Of fretting, instead of a distance: 10000")
    shift: Length | None = setting(
        None, option="--wear-shift", help="Of fretting, to either side along the friction: 5um"
    )
    wears: Which = setting("known", option="--wears", help="known (whose coefficients are), body, counter_body, both")
    coefficient_body: WearCoefficient | None = setting(
        None, option="--wear-body", help="Coefficient of the body, if not that of its materials: 1e-6mm^3/Nm"
    )
    coefficient_counter_body: WearCoefficient | None = setting(
        None, option="--wear-counter-body", help="The same of the counter body"
    )
    law: Law = setting(
        "archard",
        option="--wear-law",
        help="archard, or energy: coefficients given here are then volume over energy of friction",
    )
    threshold_pressure: ThresholdPressure = setting(
        "0 Pa", option="--wear-threshold-pressure", help="Only the pressure above it wears, by archard: 100MPa"
    )
    threshold_energy: ThresholdEnergy = setting(
        "0 J/m^2", option="--wear-threshold-energy", help="Of friction, before a point wears by energy: 100kJ/m^2"
    )
    track_body: Length | None = setting(
        None,
        option="--track-body",
        help="Length along x of the track that the body is, such as a disk; of one that rolls all around: 60mm",
    )
    track_counter_body: Length | None = setting(
        None, option="--track-counter-body", help="The same of the counter body"
    )
    debris: DebrisShare | None = setting(
        None, option="--debris", help="Share of the worn volume that stays in the gap where it is worn off: 20%"
    )
    debris_modulus: Pressure | None = setting(
        None, option="--debris-modulus", help="Of the debris in compression across its layer: 1GPa"
    )
    until_bare: bool = setting(
        False, option="--until-bare", help="Stop where a coating is first worn through, at the latest after the way"
    )
    allowed_depth: Length | None = setting(
        None, option="--allowed-wear-depth", help="Of a body, to ask when it is reached: 100nm"
    )
    steps: Count | None = setting(
        None, option="--wear-steps", help="Number of equal steps of the way, instead of by the tolerance"
    )
    quarter: Count | None = setting(None, option="--wear-quarter", help="Steps of a quarter of a cycle of fretting")
    tolerance: Tolerance | None = setting(
        None, option="--wear-tolerance", help="Share of the worn volume that a step may put at the wrong place: 2%"
    )
    order: Annotated[int, Whole(1, 2)] = setting(1, option="--wear-order", help="Of the steps of sliding: 1 or 2")
    step: StepOfPath = setting(
        "peak",
        option="--wear-step",
        help="Of a load path, whose load acts as they slide: peak, last, or its number from 1",
    )

    @model_validator(mode="after")
    def _whole(self) -> WearSettings:
        fretting = self.cycles is not None or self.shift is not None
        if (self.distance is None) != fretting:
            given = "both are" if fretting else "neither is"
            raise InputError(
                f".distance must be given, or cycles with a shift, but {given}. Give {{wear.distance=10m}}, or "
                "{wear.cycles=10000} and {wear.shift=5um}."
            )
        if fretting and (self.cycles is None or self.shift is None):
            missing, other = ("cycles", "shift") if self.cycles is None else ("shift", "cycles")
            raise InputError(
                f".{missing} must be given together with {other}, but is not. Give both {{wear.cycles=10000}} and "
                "{wear.shift=5um}."
            )
        sliding = next((key for key in SLIDING_ALONE if getattr(self, key)), "order" if self.order == 2 else None)
        if self.quarter is not None and not fretting:
            raise InputError(
                ".quarter must be left out for sliding over a distance, but is given: it is that of cycles of fretting "
                "({wear.cycles=10000})."
            )
        if fretting and sliding:
            raise InputError(
                f".{sliding} must be left out for fretting, but is given; it is for sliding over a distance "
                "({wear.distance=10m})."
            )
        if bool(self.debris) != (self.debris_modulus is not None):
            missing, other = ("debris", "debris_modulus") if not self.debris else ("debris_modulus", "debris")
            raise InputError(
                f".{missing} must be given together with {other}, but is not. Give both {{wear.debris=20%}} and "
                "{wear.debris_modulus=1GPa}, or neither: debris then leaves the contact."
            )
        if self.debris and (self.track_body is not None or self.track_counter_body is not None):
            raise InputError(f".debris must be left out along a track, which carries it away, but is {self.debris:g}.")
        for key, law, unit in (("threshold_pressure", "archard", "Pa"), ("threshold_energy", "energy", "J/m²")):
            if getattr(self, key) and self.law != law:
                raise InputError(
                    f".{key} must be left out for the law {self.law}, but is {getattr(self, key):g} {unit}; it is "
                    f"that of {{wear.law={law}}}."
                )
        return self


@dataclass(frozen=True)
class Wears:
    """What is asked of wear, the law of friction, its coefficient (0 for none) and its direction in
    rad, the stresses that are asked for as it wears, and how it rolls, if it does."""

    settings: WearSettings
    friction: FrictionLaw | None
    coefficient: float
    direction: float
    stresses: StressRequest | None = None
    rolls: Rolls | None = None

    @property
    def fretting(self) -> bool:
        """Whether one body moves to and fro."""
        return self.settings.cycles is not None


_GRID = ("x", "y")
STEP, STATE, POINT, LAYER = "wear_step", "wear_state", "section_point", "wear_layer"
"""Axes of the steps of wear, of the states whose sections are kept, along these, and of layers."""

STRESS_SCALARS = (
    *(
        Quantity(f"wear_{name}_{when}", unit, f"{label} {'before' if when == 'first' else 'after'} wear")
        for name, unit, label in (
            ("max_von_mises", "Pa", "largest von Mises stress"),
            ("max_tension", "Pa", "largest tension (σ₁)"),
            ("utilisation", "1", "largest stress / yield stress"),
            ("yield_load_factor", "1", "factor on the stresses at yield"),
        )
        for when in ("first", "last")
    ),
    Quantity("wear_utilisation_largest", "1", "largest stress / yield stress along the way"),
    Quantity("wear_yield_load_factor_least", "1", "least factor on the stresses at yield along the way"),
    Quantity("wear_yield_begins", "m", "distance after which a layer first yields"),
    Quantity("wear_yield_begins_cycles", "1", "cycles after which a layer first yields"),
    Quantity("wear_yield_ends", "m", "distance after which nothing yields any more"),
    Quantity("wear_yield_ends_cycles", "1", "cycles after which nothing yields any more"),
)
"""Numbers of the stresses as it wears, where these are asked for."""

STRESS_COLUMNS = (
    Quantity(LAYER, "", "layer, from the surface down", (LAYER,)),
    Quantity("course_coating", "m", "thickness of the layers with which stresses are computed", (STEP,)),
    Quantity("course_yield_load_factor", "1", "factor on the stresses at yield", (STEP,)),
    *(
        Quantity(f"course_{name}", unit, label, (STEP, LAYER))
        for name, unit, label in (
            ("von_mises", "Pa", "largest von Mises stress"),
            ("tension", "Pa", "largest tension (σ₁)"),
            ("utilisation", "1", "largest stress / yield stress"),
            ("stress_x", "m", "x of the largest stress"),
            ("stress_y", "m", "y of the largest stress"),
            ("stress_depth", "m", "depth of the largest stress below the worn surface"),
        )
    ),
)
"""The same after steps, NaN after those at which stresses are not computed."""

SCALARS = (
    Quantity("wear_distance", "m", "distance slid or rolled"),
    Quantity("wear_cycles", "1", "cycles of fretting"),
    Quantity("wear_volume", "m**3", "worn volume of both bodies"),
    Quantity("wear_body_volume", "m**3", "worn volume of the body"),
    Quantity("wear_counter_body_volume", "m**3", "worn volume of the counter body"),
    Quantity("wear_depth", "m", "largest worn depth"),
    Quantity("wear_body_depth", "m", "largest worn depth of the body"),
    Quantity("wear_counter_body_depth", "m", "largest worn depth of the counter body"),
    Quantity("wear_mean_depth", "m", "worn volume / nominal area"),
    Quantity("wear_rate", "m**2/N", "worn volume / (force x distance)"),
    Quantity("wear_breakthrough", "m", "distance after which a coating is first worn through"),
    Quantity("wear_breakthrough_cycles", "1", "cycles after which a coating is first worn through"),
    Quantity("wear_bare_fraction", "1", "area without coating / real contact area after wear"),
    Quantity("wear_life", "m", "distance after which the allowed depth is reached"),
    Quantity("wear_life_cycles", "1", "cycles after which the allowed depth is reached"),
    *(
        Quantity(f"wear_{name}_{when}", unit, f"{label} {'before' if when == 'first' else 'after'} wear")
        for name, unit, label in (
            ("area_fraction", "1", "real contact area / nominal area (pixels)"),
            ("max_pressure", "Pa", "maximum pressure"),
            ("rms_height", "m", "rms height"),
            ("core_height", "m", "core height Sk"),
            ("peak_height", "m", "reduced peak height Spk"),
            ("valley_depth", "m", "reduced valley depth Svk"),
        )
        for when in ("first", "last")
    ),
    Quantity("wear_error", "1", "share of the worn volume that steps may have misplaced"),
    Quantity("wear_balance", "1", "doses / (force x distance), difference from one"),
    Quantity("wear_unevenness", "1", "variation of the thickness that is left of the coating"),
    Quantity("wear_compliance_error", "1", "error of the compliance by this variation"),
    Quantity("wear_steps", "1", "steps of wear"),
    *STRESS_SCALARS,
)
"""Numbers of a contact that wears; NaN where there is no such thing."""

FIELDS = (
    Quantity("worn_body", "m", "worn depth of the body", _GRID),
    Quantity("worn_counter_body", "m", "worn depth of the counter body", _GRID),
    Quantity("worn_heights", "m", "heights of the composite surface after wear", _GRID),
    Quantity("worn_pressure", "Pa", "contact pressure after wear", _GRID),
    Quantity("worn_bare", "1", "whether a coating is worn through there", _GRID),
)
"""Fields of a contact that wears."""

SECTION = (
    Quantity("section_way", "m", "distance slid at a section; of fretting the cycles", (STATE,)),
    Quantity(
        "section_heights",
        "m",
        "heights on the section through the largest pressure at the start",
        (STATE, POINT),
    ),
    Quantity("section_pressure", "Pa", "contact pressure on that section", (STATE, POINT)),
)


class Wear(Part):
    """What the bodies lose as they slide."""

    name = "wear"
    title = "Wear"
    purpose = "What is worn away as the bodies slide, how they run in, and when a coating is worn through."
    table = "wear"
    settings = WearSettings
    basic = ("distance", "coefficient_body", "coefficient_counter_body")
    work = "physics.wear.work:WearWork"
    headline = "wear_volume"
    sheet = ("wear.csv", STEP)
    whole_path = True

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, fields, columns of all steps, and sections."""
        from .history import QUANTITIES, ROLLING

        course = (replace(item, name=f"course_{item.name}", dims=(STEP,)) for item in (*QUANTITIES, *ROLLING))
        return (*SCALARS, *FIELDS, *course, *STRESS_COLUMNS, *SECTION)

    def asked(self, document: Any, folder: Path) -> Wears:
        """The settings with the friction of the table [friction], and the motion of [rolling]."""
        ask: WearSettings = document.wear
        friction: Any = getattr(document, "friction", None)
        plain = friction is not None and friction.law == "coulomb"
        coefficient = float(friction.coefficient) if plain else 0.0
        fretting = ask.cycles is not None
        if getattr(document, "shear", None) is not None:
            raise InputError(
                "wear must be asked for without a table shear, but is asked for beside it: what wears is moved by its "
                "own table, over a distance ({wear.distance}) or to and fro ({wear.shift}).",
                subject="wear",
            )
        rolls = Rolling().asked(document, folder) if getattr(document, "rolling", None) is not None else None
        _require_motion(ask, rolls)
        if (fretting or ask.law == "energy") and not coefficient:
            why = "for fretting" if fretting else "for wear by energy"
            raise InputError(
                f"friction.coefficient must be given {why}, but is not. Give {{friction.coefficient=0.3}}.",
                subject="friction.coefficient",
            )
        law = friction_law(friction, sheared=fretting) if plain and coefficient else None
        stress = None if rolls is not None else getattr(document, "stress", None)
        request = None if stress is None else stress_request(stress, friction)
        return Wears(ask, law, coefficient, 0.0 if friction is None else float(friction.direction), request, rolls)


NOT_ROLLING = ("cycles", "debris", "threshold_pressure")
"""Keys that have no meaning where the contact rolls."""


def _require_motion(ask: WearSettings, rolls: Rolls | None) -> None:
    """Refuse keys that have no meaning in sliding, or in rolling where the contact ``rolls``."""
    if rolls is None:
        if ask.track_body is not None and ask.track_counter_body is not None:
            raise InputError(
                "wear.track_counter_body must be left out where the body is a track, but both are given: the other "
                "of both is in contact all the time, unless they roll ({rolling.longitudinal})."
            )
        return
    meaningless = next((key for key in NOT_ROLLING if getattr(ask, key)), "order" if ask.order == 2 else None)
    if ask.step not in ("peak", "last"):
        meaningless = "step"
    if meaningless is not None:
        raise InputError(
            f"wear.{meaningless} must be left out where the contact rolls, but is given: it wears over a distance "
            "({wear.distance}), under the last load."
        )
    if rolls.roughness is not None:
        raise InputError(
            "rolling.roughness_file must be left out where the contact wears as it rolls, but is given: a rough wheel "
            "rolls unsteadily."
        )
