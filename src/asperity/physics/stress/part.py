"""Stresses inside a body: the largest of each layer and interface, sections, profiles and planes;
onset of yield."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Length, NonNegativeLength, Number, Pressure, StepOfPath
from ...parts.part import Part

if TYPE_CHECKING:
    from ..friction.part import FrictionSettings
    from .field import StressField
    from .survey import Place, StressRequest, SurveyedSection


PLACES = ("max", "pressure")
"""Words for positions: of the largest stress, and of the highest pressure."""

PlaceOfMaximum: TypeAlias = Annotated[float | str, Number("length", least=0.0, words=PLACES)]


class Placed(Settings):
    """Positions ``x`` and ``y``, each a length or a word; both together may be text such as
    ``"y=max"``.

    ``"max"`` is the position of the largest stress, ``"pressure"`` that of the highest pressure.
    """

    x: PlaceOfMaximum | None = None
    y: PlaceOfMaximum | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        """Positions in text such as ``"y=max"`` or ``"x=30nm, y=max"``, by axis."""
        if not isinstance(value, str):
            return value
        found: dict[str, str] = {}
        for part in value.split(","):
            axis, equals, position = (piece.strip() for piece in part.partition("="))
            if axis not in ("x", "y") or not equals or not position or axis in found:
                raise InputError(f' must be a position such as "y=max", "y=pressure" or "x=30nm", but is {value!r}.')
            found[axis] = position
        return found


class SectionTable(Placed):
    """Vertical plane through the body: exactly one of ``x`` and ``y``.

    With ``"max"`` each kind of stress is shown on the plane through its own maximum (as by Peng
    2001, figs. 3.15 - 3.22).
    """

    @model_validator(mode="after")
    def _one(self) -> SectionTable:
        if (self.x is None) == (self.y is None):
            given = "none" if self.x is None else "both"
            raise InputError(f' must give exactly one of x and y, such as "y=max", but gives {given}.')
        return self


class ProfileTable(Placed):
    """Line into the body; a position that is left out is that of the largest equivalent stress,
    ``"max"``."""


Body = Annotated[str, Choice({"body": "body", "counter_body": "counter_body", "counter": "counter_body"})]


class StressSettings(Settings):
    """Stresses that are computed after the contact; those on the section y = max if nothing else is
    asked for.

    The shear traction is that of the table [friction], unless ``shear`` is false. ``depths`` are
    planes, ``sections`` vertical planes and ``profiles`` lines down to the depth ``deepest``. Of a
    load path they are those at one ``step``. The strengths are compared with the largest tension,
    and with shear and peel of the interfaces.
    """

    shear: bool = setting(True, option="--shear", help="Whether the friction loads the body, too")
    inside: Body = setting("body", option="--stress-in", help="The body whose stresses are computed")
    step: StepOfPath = setting(
        "peak",
        option="--stress-step",
        help="Of a load path: peak for that of the largest load, last, or its number from 1",
    )
    depths: tuple[NonNegativeLength, ...] = setting((), option="--depths", help="Whole planes: 1nm,5nm,20nm")
    sections: tuple[SectionTable, ...] = setting(
        (),
        option="--section",
        help="Vertical plane through each maximum: y=max; x=30nm, y=pressure. May be repeated",
    )
    profiles: tuple[ProfileTable, ...] = setting(
        (), option="--profile", help="Line into the body: x=max,y=max; x=30nm,y=pressure. May be repeated"
    )
    deepest: Length | None = setting(
        None, option="--deepest", help="End of sections and profiles; suits the contact by default"
    )
    criterion: Literal["von_mises", "tresca"] = setting("von_mises", option="--criterion", help="Of yield")
    tensile_strength: Pressure | None = setting(
        None, option="--tensile-strength", help="To compare the largest tension with"
    )
    interface_shear_strength: Pressure | None = setting(
        None, option="--interface-shear-strength", help="To compare the shear of interfaces with"
    )
    interface_peel_strength: Pressure | None = setting(
        None, option="--interface-peel-strength", help="To compare the peel of interfaces with"
    )
    precision: Literal["double", "single"] = setting(
        "double", option="--stress-precision", help="Arithmetic of the stresses"
    )


@dataclass(frozen=True, eq=False)
class StoredSurvey:
    """Stress fields of a file: what figures show of a ``StressSurvey``; ``step`` as there."""

    sections: tuple[SurveyedSection, ...]
    profiles: tuple[StressField, ...]
    planes: StressField | None
    step: int = 0

    def wanted_planes(self) -> Iterator[StressField]:
        """The whole planes one by one."""
        return iter(()) if self.planes is None else (self.planes.only(n) for n in range(len(self.planes.planes)))


_LARGEST = {
    "max_von_mises": "largest von Mises stress",
    "max_tension": "largest tension (σ₁)",
    "max_shear": "largest shear stress",
}
"""Largest stresses that each layer has, and what they are called."""


_OF_FRICTION = {"friction": "coefficient", "direction": "direction", "coupled": "coupled"}


class Stress(Part):
    """Largest stresses of layers and interfaces."""

    name = "stress"
    title = "Stresses inside the body"
    purpose = "What stresses act inside the body, and where it would yield or crack first."
    table = "stress"
    settings = StressSettings
    basic = ("sections", "depths")
    moved = MappingProxyType({key: f"friction.{to}" for key, to in _OF_FRICTION.items()})
    unmoved = MappingProxyType({"shear": False})
    quantities = (
        *(Quantity(name, "Pa", text) for name, text in _LARGEST.items()),
        *(Quantity(f"{name}_error", "Pa", f"error of the {text}") for name, text in _LARGEST.items()),
        *(
            Quantity(f"{name}_{at}", "m", f"{at} of the {text}")
            for name, text in _LARGEST.items()
            for at in ("x", "y", "depth")
        ),
        Quantity("max_interface_shear", "Pa", "largest shear on an interface"),
        Quantity("max_interface_peel", "Pa", "largest peel of an interface"),
        Quantity("layer", "", "layer, from the surface down", dims=("layer",)),
        Quantity("layer_top", "m", "depth of the top of the layer", dims=("layer",)),
        Quantity("layer_bottom", "m", "depth of the bottom of the layer", dims=("layer",)),
        *(Quantity(f"layer_{name}", "Pa", f"{text} in the layer", dims=("layer",)) for name, text in _LARGEST.items()),
        *(
            Quantity(f"layer_{name}_depth", "m", f"depth of the {text} in the layer", dims=("layer",))
            for name, text in _LARGEST.items()
        ),
        Quantity("interface", "", "materials above and below the interface", dims=("interface",)),
        Quantity("interface_depth", "m", "depth of the interface", dims=("interface",)),
        Quantity("interface_max_shear", "Pa", "largest shear on the interface", dims=("interface",)),
        Quantity("interface_max_peel", "Pa", "largest peel of the interface", dims=("interface",)),
    )
    work = "physics.stress.work:StressWork"
    headline = "max_von_mises"
    whole_path = True

    def asked(self, document: Any, folder: Path) -> StressRequest:
        """The request of the table [stress], with the friction of the table [friction]."""
        return stress_request(document.stress, getattr(document, "friction", None))


class Yielding(Part):
    """Onset of yield under the stresses."""

    name = "yielding"
    title = "Onset of yield"
    table = "stress"
    quantities = (Quantity("yield_load_factor", "1", "factor on the stresses at yield"),)
    work = "physics.stress.work:YieldingWork"


def stress_request(table: StressSettings, friction: FrictionSettings | None = None) -> StressRequest:
    """Stresses that ``table`` requests, under ``friction``; the section through the maximum where
    it requests none."""
    from .criteria import Tresca, VonMises
    from .survey import Strengths, StressRequest, WantedProfile, WantedSection

    given = table.given("sections", "profiles")
    sections = tuple(
        WantedSection("y", _place(wanted.y)) if wanted.x is None else WantedSection("x", _place(wanted.x))
        for wanted in table.sections
    )
    profiles = tuple(WantedProfile(_place(wanted.x), _place(wanted.y)) for wanted in table.profiles)
    strengths = {name: given[f"{name}_strength"] for name in vars(Strengths()) if f"{name}_strength" in given}
    return StressRequest(
        friction=friction.coefficient if friction is not None and table.shear else 0.0,
        direction=0.0 if friction is None else friction.direction,
        coupled=friction is not None and bool(friction.coupled),
        sheared=table.shear,
        of="counter_body" if table.inside == "counter_body" else "body",
        depths=table.depths,
        sections=sections if sections or profiles or table.depths else StressRequest().sections,
        profiles=profiles,
        deepest=table.deepest,
        criterion=Tresca() if table.criterion == "tresca" else VonMises(),
        strengths=Strengths(**strengths),
        dtype="float32" if table.precision == "single" else "float64",
        step=table.step if isinstance(table.step, str) else int(table.step),  # type: ignore[arg-type]
    )


def _place(value: float | str | None) -> Place:
    if value is None or value == PLACES[0]:
        return "max"
    return "pressure" if isinstance(value, str) else float(value)
