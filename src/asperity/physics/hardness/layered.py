"""Pressure limited by the hardness of a coated body, which changes with the depth of the
indentation."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ...contact.law import Hardness
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.units import show
from ...solids.elastic import Elastic, yield_pressure
from ...solids.layers import Layered
from ...theories.hardness.effective_hardness import EffectiveHardness, StackHardness

_SHOWN = 1e-4
"""Relative difference of hardnesses that their text shows."""


@dataclass(frozen=True)
class LayeredHardness:
    """0 <= p <= H_e(w): every point bears the effective hardness at its own permanent indentation
    w.

    Parameters
    ----------
    body
        ``Layered`` body, every material of which has a known hardness, or a yield stress Y: then
        2.8 Y serves. Where both sides of a face state their yield stresses, these enter the law;
        else Y = H/2.8 on both.

    Notes
    -----
    The depth in the law of Bhattacharya & Nix is that of an indenter; here it is the local
    permanent indentation, which is what a pixel has been pressed in beyond its elastic recovery.

    Raises
    ------
    InputError
        If the body is not ``Layered``, lies on a rigid base, or neither hardness nor yield stress
        of one of its materials is known.
    """

    body: Layered
    _stack: StackHardness | None = field(init=False, repr=False, compare=False)
    _ends: tuple[float, float] = field(init=False, repr=False, compare=False)
    name: ClassVar[str] = "effective hardness"
    citation_keys: ClassVar[tuple[str, ...]] = (
        *Hardness.citation_keys,
        *StackHardness.citation_keys,
        "Anderson1965",
    )

    def __post_init__(self) -> None:
        require.instance(self.body, Layered, "body of an effective hardness", "Use Hardness(H) for a single material.")
        reduced = self.body.reduced
        materials = [*((layer.material, f"layer {n}") for n, layer in enumerate(reduced.layers, 1))]
        if not isinstance(reduced.base, Elastic):
            raise InputError(
                "base of a body with an effective hardness must be a material of known hardness, but is rigid."
            )
        materials.append((reduced.base, "the base"))
        hardnesses = []
        for solid, place in materials:
            known = yield_pressure(solid.strength).value
            if known is None:
                raise InputError(
                    f"hardness of {solid.name or 'the material'} in {place} must be known for an effective "
                    "hardness, but is not, nor is a yield stress. Give it as Strength(hardness=...) "
                    "(hardness, H=...), or limit the pressure by a number."
                )
            hardnesses.append(known)
        depths = np.cumsum([layer.thickness for layer in reduced.layers])
        faces, places = [], []
        for number, depth in enumerate(depths):
            (upper, _), (lower, _) = materials[number : number + 2]
            if hardnesses[number] != hardnesses[number + 1]:  # a face between equal hardnesses changes nothing
                moduli = upper.youngs_modulus / lower.youngs_modulus
                yields = upper.strength.yield_stress / lower.strength.yield_stress
                face = hardnesses[number], hardnesses[number + 1], moduli, None if math.isnan(yields) else yields
                faces.append(EffectiveHardness(*face))
                places.append(float(depth))
        object.__setattr__(self, "_stack", StackHardness(tuple(faces), tuple(places)) if faces else None)
        object.__setattr__(self, "_ends", (hardnesses[0], hardnesses[-1]))

    def pressure_cap(self) -> float:
        """Hardness in Pa of the virgin surface, that of the top layer."""
        return self._ends[0]

    @property
    def base_hardness(self) -> float:
        """Hardness in Pa of the base, met far below the coatings."""
        return self._ends[1]

    @property
    def limit_text(self) -> str:
        """The limit in words, with its extremes between surface and base where there are any beyond
        both."""
        top, base = self._ends
        low, high = (top, base) if self._stack is None else self._stack.extremes
        extremes = [
            (f"up to {show(high, 'Pa')}", high > max(top, base) * (1.0 + _SHOWN)),
            (f"down to {show(low, 'Pa')}", low < min(top, base) * (1.0 - _SHOWN)),
        ]
        between = " and ".join(text for text, beyond in extremes if beyond)
        between = f", {between} in between" if between else ""
        return f"{show(top, 'Pa')} at the surface to {show(base, 'Pa')} deep in the base{between}, by local indentation"

    def cap_at(self, indentation: RealArray) -> float | RealArray:
        """Largest pressure (nx, ny) in Pa where the surface is indented by ``indentation`` (nx, ny)
        in m."""
        return self.pressure_cap() if self._stack is None else self._stack.at(indentation)

    def work_at(self, indentation: RealArray) -> RealArray:
        """Work (nx, ny) in J/m² to indent the virgin surface by ``indentation`` (nx, ny) in m."""
        return self.pressure_cap() * indentation if self._stack is None else self._stack.work(indentation)
