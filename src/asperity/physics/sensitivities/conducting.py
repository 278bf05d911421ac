"""Constants of conductors as parameters of a conductance: resistivities, conductivities and
thicknesses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from ...contact.problem import ContactProblem
from ...solids.compliance.halfspace import Compliance
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Layered
from ..conductance.operator import Flow
from ..conductance.rates import UNITS, ConductorConstant, conductor_constants
from .parameters import kept_layers, place_in


class ConductorParameter(NamedTuple):
    """A constant of a conductor: its ``name``, such as ``body.base.electrical_resistivity``, whose
    ``body`` it is, and which ``constant``."""

    name: str
    body: str
    constant: ConductorConstant

    @property
    def rate(self) -> Compliance:
        """Derivative of flux density to potential, but for the ``factor``."""
        return self.constant.rate

    @property
    def factor(self) -> float:
        """Of the rate."""
        return self.constant.factor

    @property
    def value(self) -> float:
        """Value in SI units."""
        return self.constant.value

    @property
    def unit(self) -> str:
        """SI unit."""
        return UNITS[self.constant.kind]

    @property
    def of_material(self) -> bool:
        """Whether it is one of a material, which the contact itself does not depend on."""
        return self.constant.kind != "thickness"


def conductor_parameters(problem: ContactProblem, flow: Flow) -> tuple[ConductorParameter, ...]:
    """All constants on which the ``flow`` through the bodies of ``problem`` depends at a given
    contact.

    Raises
    ------
    InputError
        If the conductivity of a material is not known.
    """
    found = []
    for key, body in (("body", problem.body), ("counter_body", problem.counter_body)):
        if isinstance(body, Rigid):
            continue
        for constant in conductor_constants(body, flow, key.replace("_", " ")):
            name = f"{key}.{place_in(body, constant.layer)}{constant.kind}"
            found.append(ConductorParameter(name, key, constant))
    return tuple(found)


def with_conductor(problem: ContactProblem, parameter: ConductorParameter, value: float) -> ContactProblem:
    """``problem`` with another ``value`` of a resistivity or conductivity."""
    body, kind = getattr(problem, parameter.body), parameter.constant.kind
    if isinstance(body, Layered):
        layers, base = list(body.layers), body.base
        number = kept_layers(body)[parameter.constant.layer]
        if number == len(layers):
            assert isinstance(base, Elastic)
            base = _with(base, kind, value)
        else:
            layers[number] = replace(layers[number], material=_with(layers[number].material, kind, value))
        other: Elastic | Layered = Layered(layers, base, body.name)
    else:
        other = _with(body, kind, value)
    return replace(problem, body=other) if parameter.body == "body" else replace(problem, counter_body=other)


def _with(material: Elastic, kind: str, value: float) -> Elastic:
    return replace(material, conduction=replace(material.conduction, **{kind: value}))


def of_half_spaces(several: Mapping[str, ConductorParameter], flow: Flow) -> Mapping[str, float]:
    """Derivatives of ln k_s to the constants of homogeneous conductors, by name: 1/k_s is half the
    sum of their resistivities."""
    resistivity = {name: each.value if flow.resistivity else 1.0 / each.value for name, each in several.items()}
    whole = sum(resistivity.values())
    sign = -1.0 if flow.resistivity else 1.0
    return {name: sign * resistivity[name] / whole / each.value for name, each in several.items()}


def is_layered(body: object) -> bool:
    """Whether a ``body`` has a layer that counts."""
    return isinstance(body, Layered) and bool(body.reduced.layers)
