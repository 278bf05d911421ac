"""Bodies of a problem document: rigid, one material, or layers on a base; as tables or in one line
of text.

DLC                               a material of the library
E=140GPa,nu=0.25,H=15GPa          elastic constants: E, nu, and if known hardness H (also 700HV,
                                  200HB, 60HRC), yield stress Y, hardening, name
steel{H=60HRC}                    a material of the library with another strength
steel{Y=400MPa,hardening=linear(2GPa)}   and with what plastic flow needs; also swift(0.2) and
                                  voce(100MPa,20)
copper{k=390W/(m*K),rho=58MS/m}   and with another conductivity of heat or current
DLC{kw=1e-7mm^3/Nm}:2um/steel     and with a wear coefficient
DLC:5nm/Cr:2nm/steel              5 nm of DLC on 2 nm of Cr on steel
DLC:5nm~/rigid                    ~ : the layer slips without friction on what lies below it
E=3MPa+10MPa@10ms,nu=0.5          10 MPa of Young's modulus relax in 10 ms; further ways in
                                  ``relaxation``
"""

from __future__ import annotations

import re
from types import MappingProxyType
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, ConfigDict, Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import (
    Count,
    ElectricalResistivity,
    HardnessValue,
    Length,
    NonEmpty,
    NonNegative,
    NonNegativeLength,
    Number,
    PoissonRatio,
    Positive,
    Pressure,
    ThermalConductivity,
    ThermalExpansion,
    VolumetricHeatCapacity,
    WearCoefficient,
)
from ...solids.relaxation_text import AT
from .relaxation import SYMBOLS as RELAXING
from .relaxation import RelaxationTable, number_or_text, relaxation_from_symbols

NonNegativePressure = Annotated[float, Number("pressure", least=0.0)]
Share = Annotated[float, Number(least=0.0, most=1.0)]

CONSTANTS = ("youngs_modulus", "poisson_ratio")
"""Keys of the elastic constants, which go together."""

FLOW = ("yield_stress", "hardening", "kinematic", "recall")
"""Keys of plastic flow."""

CONDUCTS = ("thermal_conductivity", "electrical_resistivity", "volumetric_heat_capacity", "thermal_expansion")
"""Keys of what conducts, stores heat and expands."""

BESIDE = ("hardness", *FLOW, "wear_coefficient", *CONDUCTS)
"""Keys of the strength, of wear and of what conducts, which elastic constants may bring along, and
a named material, too: they replace those of the library."""


def _text_too(schema: dict[str, Any]) -> None:
    """Let the JSON ``schema`` of a table accept text, which stands for the table."""
    table = dict(schema)
    schema.clear()
    schema.update({"title": table["title"], "anyOf": [{"type": "string"}, table]})


class LinearHardeningTable(Settings):
    """The yield stress grows by ``modulus`` with the accumulated plastic strain."""

    kind: Literal["linear"]
    modulus: NonNegativePressure = setting(help="Slope H: 2GPa; E E_t/(E - E_t) for a tangent modulus E_t")


class SwiftTable(Settings):
    """Yield stress that grows as (1 + q/reference_strain)^exponent; the strain is that at yield,
    Y/E, by default."""

    kind: Literal["swift"]
    exponent: Share = setting(help="Exponent, 0 to 1")
    reference_strain: Positive | None = setting(None, help="Strain ε_0")


class VoceTable(Settings):
    """Yield stress that grows by at most ``gain``, the sooner the larger the ``rate``."""

    kind: Literal["voce"]
    gain: NonNegativePressure = setting(help="Largest growth Q: 100MPa")
    rate: Positive = setting(help="Rate b of its growth with the plastic strain")


HARDENING = MappingProxyType(
    {"linear": ("modulus",), "swift": ("exponent", "reference_strain"), "voce": ("gain", "rate")}
)
"""Values of each kind of hardening in the order in which its text has them."""

_CALL = re.compile(r"\s*(\w+)\s*\(([^()]*)\)\s*")


def _hardening_from_text(value: Any) -> Any:
    """Table for text such as ``"swift(0.2)"``, anything else as it is."""
    if not isinstance(value, str):
        return value
    match = _CALL.fullmatch(value)
    given = [part.strip() for part in match[2].split(",") if part.strip()] if match else []
    if match is None or match[1] not in HARDENING or len(given) > len(HARDENING[match[1]]):
        raise InputError(
            f" must be such as linear(2GPa), swift(0.2), swift(0.2,0.002) or voce(100MPa,20), but is {value!r}."
        )
    return {"kind": match[1], **dict(zip(HARDENING[match[1]], given, strict=False))}


AnyHardening: TypeAlias = Annotated[LinearHardeningTable | SwiftTable | VoceTable, Field(discriminator="kind")]
"""A law of hardening, identified by the key ``kind``; or its text."""


class MaterialTable(Settings):
    """One material: a name of the library, or elastic constants with what is known of the strength;
    ``relaxation`` instead of Young's modulus.

    It may be text, such as ``"steel"``, ``"E=140GPa,nu=0.25"``, ``"E=3MPa+10MPa@10ms,nu=0.5"`` or
    ``"steel{Y=400MPa}"``. The ``electrical_resistivity`` may be written as its inverse, in S/m.
    Yield stress, ``hardening`` and the back stress of a ``kinematic``
    modulus with its ``recall`` are those of plastic flow.
    """

    model_config = ConfigDict(json_schema_extra=_text_too)

    material: NonEmpty | None = None
    youngs_modulus: Pressure | None = None
    poisson_ratio: PoissonRatio | None = None
    relaxation: RelaxationTable | None = setting(None, help="how a viscoelastic material relaxes")
    hardness: HardnessValue | None = None
    yield_stress: Pressure | None = None
    hardening: Annotated[AnyHardening | None, BeforeValidator(_hardening_from_text)] = None
    kinematic: NonNegativePressure | None = None
    recall: NonNegative | None = None
    wear_coefficient: WearCoefficient | None = setting(None, help="k_w: 1e-6 mm^3/Nm")
    thermal_conductivity: ThermalConductivity | None = setting(None, help="k: 50 W/(m*K)")
    electrical_resistivity: ElectricalResistivity | None = setting(None, help="ρ: 17 nohm*m, or its inverse in S/m")
    volumetric_heat_capacity: VolumetricHeatCapacity | None = setting(None, help="ρc: 3.7 MJ/(m^3*K)")
    thermal_expansion: ThermalExpansion | None = setting(None, help="α, linear: 12e-6/K")
    name: NonEmpty | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return material_from_text(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check(self) -> MaterialTable:
        self._one_of({})
        return self

    def _one_of(self, others: dict[str, bool]) -> None:
        """Refuse all but one way to describe it: a material, constants, or one of the ``others``
        that are given."""
        pair = CONSTANTS if self.relaxation is None else ("relaxation", "poisson_ratio")
        constants = [key for key in pair if getattr(self, key) is not None]
        ways = [*(way for way, given in others.items() if given), *(["material"] if self.material else [])]
        ways += constants[:1]
        ways += ["youngs_modulus"] if self.relaxation is not None and self.youngs_modulus is not None else []
        if len(ways) != 1:
            choices = ", or ".join(["a material", "youngs_modulus (or relaxation) and poisson_ratio", *others])
            raise InputError(f" must give {choices}, but gives {' and '.join(ways) or 'none of these'}.")
        if len(constants) == 1:
            raise InputError(f" must give {pair[0]} and poisson_ratio together, but gives only {constants[0]}.")
        allowed = (*BESIDE, "name") if constants else ("name",) if "layers" in ways else BESIDE if self.material else ()
        beside = [key for key in (*BESIDE, "name") if getattr(self, key) is not None and key not in allowed]
        if beside:
            raise InputError(f" may give {beside[0]} only together with youngs_modulus, but gives it with {ways[0]}.")
        if self.recall and not self.kinematic:
            raise InputError(
                ' must give a kinematic modulus together with its recall, such as kinematic = "2 GPa", but does not.'
            )


class LayerTable(MaterialTable):
    """Homogeneous layer; ``interface`` is how it is joined to what lies below it."""

    model_config = ConfigDict(json_schema_extra=None)

    kind: Literal["layer"] = "layer"
    thickness: NonNegativeLength
    interface: Literal["bonded", "frictionless"] = "bonded"


class GradedTable(Settings):
    """Coating whose Young's modulus changes from that of ``top`` to that of ``bottom``, as thin
    homogeneous layers.

    ``kind`` is the law of its change with depth: ``"linear"``, ``"exponential"``, or ``"power"``
    with its ``exponent``.
    """

    kind: Literal["linear", "exponential", "power"]
    top: MaterialTable
    bottom: MaterialTable
    thickness: Length
    exponent: Positive | None = None
    sublayers: Count = 32
    interface: Literal["bonded", "frictionless"] = "bonded"

    @model_validator(mode="after")
    def _exponent(self) -> GradedTable:
        if self.kind == "power" and self.exponent is None:
            raise InputError(".exponent must be given for a graded layer of kind power, but is missing.")
        if self.kind != "power" and self.exponent is not None:
            raise InputError(f".exponent must be left out for a graded layer of kind {self.kind}, but is given.")
        return self


def _layers(value: object) -> object:
    """Layers as a tuple, each with its kind: a table without one is a homogeneous layer."""
    if not isinstance(value, list | tuple):
        return value
    return tuple({"kind": "layer"} | layer if isinstance(layer, dict) else layer for layer in value)


AnyLayer: TypeAlias = Annotated[LayerTable | GradedTable, Field(discriminator="kind")]
"""One layer or graded coating, identified by the key ``kind``."""


class BaseTable(MaterialTable):
    """What lies under all layers: a material, or ``rigid = true``."""

    rigid: bool = False

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return base_from_text(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check(self) -> BaseTable:
        self._one_of({"rigid = true": self.rigid})
        return self


class BodyTable(BaseTable):
    """One body: a named ``material``, elastic constants, ``rigid = true``, or ``layers`` from the
    surface down on a ``base``.

    In a document it may be text as on the command line, such as ``"DLC:5nm/Cr:2nm/steel"``.
    ``materials_file`` holds the named materials of all its parts; a relative path starts at the
    folder of the document.
    """

    materials_file: NonEmpty | None = setting(None, help="your own materials, a TOML file")
    layers: Annotated[tuple[AnyLayer, ...], BeforeValidator(_layers)] = ()
    base: BaseTable | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return body_from_text(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check(self) -> BodyTable:
        self._one_of({"rigid = true": self.rigid, "layers": "layers" in self.model_fields_set})
        if "layers" in self.model_fields_set and not self.layers:
            raise InputError(".layers must hold at least one layer, but is empty; give the material alone.")
        if self.layers and self.base is None:
            raise InputError('.base must be given together with layers, such as base = { material = "steel" }.')
        if self.base is not None and not self.layers:
            raise InputError(" may give a base only together with layers, but gives it without.")
        if self.materials_file is not None and self.material is None and not self.layers:
            raise InputError(" may give a materials_file only together with a material, but gives it without.")
        return self


SYMBOLS = MappingProxyType(
    {
        "E": "youngs_modulus",
        "nu": "poisson_ratio",
        "H": "hardness",
        "Y": "yield_stress",
        "hardening": "hardening",
        "kinematic": "kinematic",
        "recall": "recall",
        "kw": "wear_coefficient",
        "k": "thermal_conductivity",
        "rho": "electrical_resistivity",
        "C": "volumetric_heat_capacity",
        "alpha": "thermal_expansion",
        "name": "name",
    }
)
"""Key of the document for each symbol in the text of a material."""

SLIP = "~"
"""Mark behind the thickness of a layer that slips on what lies below."""

EXAMPLE = '"DLC:5nm/Cr:2nm/steel"'


def body_from_text(text: str) -> dict[str, Any]:
    """Table of a body for the ``text``.

    Raises
    ------
    InputError
        If the text is no body; the message lacks the name of the option or key at its beginning.
    """
    bare_text = _BRACES.sub("", text)
    if ":" not in bare_text and ("=" in bare_text or "/" not in bare_text):  # a unit such as N/mm**2 may hold a slash
        return base_from_text(text)
    *layers, base = (part.strip() for part in re.split(r"/(?![^{}]*\})", text))  # not within braces
    bare = [part for part in layers if part and ":" not in part]
    if ":" in base and bare:
        raise InputError(
            f" must have the base as its last part, but {bare[0]!r}, without thickness, stands before {base!r}; "
            f"write layers from the surface down, such as {EXAMPLE}."
        )
    if ":" in base:
        raise InputError(
            f' must end in the base, without thickness, such as {EXAMPLE} or "DLC:5nm/rigid", but ends in {base!r}.'
        )
    found = [_layer(part, number) for number, part in enumerate(layers, start=1)]
    if not base:
        raise InputError(f" must end in the base, such as {EXAMPLE}, but nothing stands behind the last slash.")
    return {"layers": found, "base": base_from_text(base)}


_BRACES = re.compile(r"\{([^{}]*)\}")


def _layer(part: str, number: int) -> dict[str, Any]:
    braces = "".join(match[0] for match in _BRACES.finditer(part))
    name, _, thickness = (piece.strip() for piece in _BRACES.sub("", part).partition(":"))
    if not name:
        found = repr(part) if part else "empty"
        raise InputError(f" must name a material in each part, such as {EXAMPLE}, but layer {number} is {found}.")
    if not thickness.rstrip(SLIP).strip():
        raise InputError(
            f" must give the thickness of every layer, such as {name.rstrip(SLIP)}:5nm, but layer {number} is "
            f"{part!r}; only the last part, the base, has none."
        )
    if name.casefold() == "rigid":
        raise InputError(f" must have rigid as its last part only, but layer {number} is {part!r}.")
    slips = thickness.endswith(SLIP)
    if SLIP in name or SLIP in thickness[:-1]:
        raise InputError(
            f" must have {SLIP} behind the thickness of the layer that slips, such as DLC:5nm{SLIP}/steel, "
            f"but layer {number} is {part!r}."
        )
    joined = {"interface": "frictionless"} if slips else {}
    return {**material_from_text(name + braces), "thickness": thickness.rstrip(SLIP).strip(), **joined}


def base_from_text(text: str) -> dict[str, Any]:
    """Table of a body without layers, or of what lies under them; errors as above."""
    return {"rigid": True} if text.strip().casefold() == "rigid" else material_from_text(text)


def material_from_text(text: str) -> dict[str, Any]:
    """Table of a material by its name or its constants; errors as above."""
    found = _BRACES.search(text)
    bare = _BRACES.sub("", text)
    if bare.strip().casefold() == "rigid" and found:
        raise InputError(f" must give no values of a rigid body, but gives {found[0]}.")
    given = dict(map(_constant, _constants(bare))) if "=" in bare else {}
    for within in _BRACES.finditer(text):
        given |= dict(map(_constant, _constants(within[1])))
    relaxes = bool(given.keys() & set(RELAXING)) or AT in given.get("E", "")
    relaxing = {"relaxation": relaxation_from_symbols(given)} if relaxes else {}
    plain = {
        SYMBOLS[symbol]: number_or_text(value) if symbol in ("nu", "recall") else value
        for symbol, value in given.items()
    }
    return {**({} if "=" in bare else {"material": bare.strip()}), **plain, **relaxing}


def _constants(text: str) -> list[str]:
    """``text`` at its commas, but for those within parentheses."""
    if comma := re.search(r"=\s*\d+,\d[^,()=]*(?=,|$)", text):
        number = comma[0].lstrip("= ")
        raise InputError(
            f" must have a point before decimals, such as {number.replace(',', '.')!r}, but has a comma: {number!r}."
        )
    return [part for part in re.split(r",(?![^()]*\))", text) if part.strip()]


def _constant(part: str) -> tuple[str, str]:
    symbol, _, value = (piece.strip() for piece in part.partition("="))
    if symbol not in SYMBOLS and symbol not in RELAXING:
        raise InputError(
            f' must be a material, constants such as "E=140GPa,nu=0.25,H=15GPa" ({", ".join(SYMBOLS)}), '
            f'viscoelastic ones such as "E=3MPa+10MPa@10ms,nu=0.5" ({", ".join(RELAXING)}), or layers such as '
            f"{EXAMPLE}, but holds {part.strip()!r}."
        )
    return symbol, value
