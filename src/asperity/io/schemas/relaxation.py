"""How the modulus of a viscoelastic material relaxes, in a problem document; as tables or in the
text of a material.

E=3MPa+10MPa@10ms+3MPa@0.1s,nu=0.5       3 MPa and two terms that relax, each with its time
E=1MPa@10s,nu=0.5                        Maxwell: all of it relaxes
E=3MPa,retardation=1s,nu=0.5             Kelvin-Voigt
E=2GPa,power=0.1,shortest=1ms,longest=1e4s,nu=0.4     E = 2 GPa (t/s)^-0.1
moduli=rubber.csv,nu=0.5                 moduli measured against frequency or time
…,bulk=elastic                           shear alone relaxes
…,WLF=298K;8.86;101.6K                   reference, c1 and c2 of the shift with temperature
…,Arrhenius=298K;80000J/mol              reference and activation energy of the shift
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import Count, Fraction, NonEmpty, Number, Positive, Pressure, Temperature
from ...solids.relaxation_text import AT, SHIFT_KEYS, series_parts

Time: TypeAlias = Annotated[float, Number("time", above=0.0)]
RelaxedModulus: TypeAlias = Annotated[float, Number("pressure", least=0.0)]

USUAL_RATIO = 1e4
"""First over relaxed modulus of a Kelvin-Voigt solid, if not said otherwise."""


class WlfTable(Settings):
    """Williams, Landel and Ferry's shift of the times with temperature: log10 a = -c1 (T -
    reference)/(c2 + T - reference)."""

    kind: Literal["wlf"]
    reference: Temperature
    c1: Positive
    c2: Temperature


class ArrheniusTable(Settings):
    """Arrhenius' shift of the times with temperature: ln a = activation_energy/R (1/T -
    1/reference)."""

    kind: Literal["arrhenius"]
    reference: Temperature
    activation_energy: Annotated[float, Number("J/mol", above=0.0)]


ShiftTable: TypeAlias = Annotated[WlfTable | ArrheniusTable, Field(discriminator="kind")]
"""How times change with temperature, identified by the key ``kind``."""


class Relaxing(Settings):
    """What all ways to relax have."""

    elastic_bulk: bool = setting(
        False, help="the bulk modulus does not relax, so that Poisson's ratio rises; else it is constant"
    )
    shift: ShiftTable | None = setting(None, help="how the times change with temperature")


class PronyTable(Relaxing):
    """Young's modulus E(t) = relaxed + sum of ``moduli`` exp(-t/``times``), generalised Maxwell
    model; without ``relaxed`` a fluid."""

    kind: Literal["prony"]
    relaxed: RelaxedModulus = setting("0 Pa", help="Young's modulus after all relaxation")
    moduli: tuple[Pressure, ...] = setting(help="parts of Young's modulus that relax")
    times: tuple[Time, ...] = setting(help="relaxation time of each")

    @model_validator(mode="after")
    def _pairs(self) -> PronyTable:
        if len(self.moduli) != len(self.times) or not self.moduli:
            raise InputError(
                f".times must hold one time for each of moduli, at least one, but there are {len(self.times)} "
                f"times and {len(self.moduli)} moduli."
            )
        return self


class StandardLinearTable(Relaxing):
    """Young's modulus from ``instantaneous`` to ``relaxed`` with one relaxation ``time``
    (Zener)."""

    kind: Literal["standard_linear"]
    relaxed: Pressure
    instantaneous: Pressure
    time: Time


class MaxwellTable(Relaxing):
    """A fluid of Young's modulus ``modulus`` exp(-t/``time``)."""

    kind: Literal["maxwell"]
    modulus: Pressure
    time: Time


class KelvinVoigtTable(Relaxing):
    """A spring (``relaxed``) and a dashpot side by side, of retardation ``time``; ``instantaneous``
    is the first over the relaxed modulus."""

    kind: Literal["kelvin_voigt"]
    relaxed: Pressure
    time: Time
    instantaneous: Annotated[float, Number(above=1.0)] = USUAL_RATIO


class PowerLawTable(Relaxing):
    """Young's modulus ``coefficient`` (t/s)^-``exponent`` from the ``shortest`` to the ``longest``
    time, as a Prony series."""

    kind: Literal["power_law"]
    coefficient: Pressure
    exponent: Fraction
    shortest: Time
    longest: Time


class MeasuredTable(Relaxing):
    """Storage and loss modulus (Young's) against frequency, or relaxation modulus or creep
    compliance against time, in a text file, fitted by a Prony series."""

    kind: Literal["measured"]
    moduli_file: NonEmpty = setting(
        help="columns with units: frequency (Hz), storage modulus (MPa), loss modulus (MPa); or time (s) and "
        "relaxation modulus (MPa) or creep compliance (1/MPa)"
    )
    per_decade: Count = setting(4, help="relaxation times in a decade of frequency or time")
    fluid: bool = setting(False, help="all of it relaxes: the series has no constant, the compliance no limit")


RelaxationTable: TypeAlias = Annotated[
    PronyTable | StandardLinearTable | MaxwellTable | KelvinVoigtTable | PowerLawTable | MeasuredTable,
    Field(discriminator="kind"),
]
"""How Young's modulus relaxes, identified by the key ``kind``."""

SYMBOLS = ("retardation", "power", "shortest", "longest", "moduli", "bulk", "WLF", "Arrhenius")
"""Symbols of the text of a material that make it viscoelastic, beside @ in its modulus."""


def relaxation_from_symbols(symbols: dict[str, str]) -> dict[str, Any]:
    """Table of the relaxation for the ``symbols`` of the text of a material, taking away those it
    uses.

    Raises
    ------
    InputError
        If they do not go together; the message lacks the name of the option or key at its
        beginning.
    """
    modulus = symbols.pop("E", None)
    found = {key: symbols.pop(key) for key in SYMBOLS if key in symbols}
    ways = {"retardation", "power", "moduli"} & found.keys() | ({AT} if AT in (modulus or "") else set())
    if len(ways) != 1 or (modulus is None) != ("moduli" in ways):
        raise InputError(
            " must relax in one way, such as E=3MPa+10MPa@10ms, E=3MPa,retardation=1s, "
            "E=2GPa,power=0.1,shortest=1ms,longest=1e4s or moduli=rubber.csv, but gives "
            f"{' and '.join(sorted(ways)) or 'none'}{'' if modulus else ' without E'}."
        )
    made = _way(ways.pop(), modulus or "", found)
    bulk = found.pop("bulk", None)
    if bulk not in (None, "elastic"):
        raise InputError(f" must have bulk=elastic or no bulk, but has bulk={bulk}.")
    made |= {} if bulk is None else {"elastic_bulk": True}
    made |= _shift(found)
    if found:
        raise InputError(f" must have {', '.join(found)} only together with power, but has it without.")
    return made


def _way(way: str, modulus: str, found: dict[str, str]) -> dict[str, Any]:
    if way == "moduli":
        return {"kind": "measured", "moduli_file": found.pop("moduli")}
    if way == "retardation":
        return {"kind": "kelvin_voigt", "relaxed": modulus, "time": found.pop("retardation")}
    if way == "power":
        times: dict[str, Any] = {key: found.pop(key) for key in ("shortest", "longest") if key in found}
        return {"kind": "power_law", "coefficient": modulus, "exponent": number_or_text(found.pop("power")), **times}
    try:
        rest, terms = series_parts(modulus)
    except InputError as error:
        raise InputError(f" (E){error}") from None
    series = {"moduli": [term[0] for term in terms], "times": [term[1] for term in terms]}
    return {"kind": "prony", **({"relaxed": rest} if rest else {}), **series}


def _shift(found: dict[str, str]) -> dict[str, Any]:
    """The shift with temperature, if one is given."""
    given = [name for name in SHIFT_KEYS if name in found]
    if not given:
        return {}
    texts = {name: found.pop(name) for name in given}
    keys = SHIFT_KEYS[given[0]]
    pieces = [piece.strip() for piece in texts[given[0]].split(";")]
    if len(given) > 1 or len(pieces) != len(keys):
        raise InputError(
            " must give one shift with temperature, WLF=298K;8.86;101.6K or Arrhenius=298K;80000J/mol, but gives "
            f"{' and '.join(f'{name}={text}' for name, text in texts.items())}."
        )
    values = {key: number_or_text(piece) if key == "c1" else piece for key, piece in zip(keys, pieces, strict=True)}
    return {"shift": {"kind": given[0].lower(), **values}}


def number_or_text(text: str) -> float | str:
    """The number, or the ``text`` that is none and that the schema refuses under its key."""
    try:
        return float(text)
    except ValueError:
        return text
