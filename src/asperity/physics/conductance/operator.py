"""Flux density to potential on the surface of conductors: what the contact solver calls a
compliance.

A harmonic potential in each body makes of the flux density j on its surface the potential V, with
V(q) = Z(q) j(q) and Z = 1/(k q) of a half-space of conductivity k. Two bodies in series have the
sum of both, 2/(k_s q): that of an elastic half-space with E* replaced by k_s = 2 k1 k2/(k1 + k2).
So these are ``solids.compliance.halfspace.Compliance``, with potentials for displacements and flux
densities for pressures, and the operators, solvers and preconditioners of the contact serve.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.late import Shown
from ...solids.compliance.halfspace import Compliance, HalfSpace, SumOfCompliances
from ...solids.compliance.influence import (
    Limits,
    line_kernel,
    patch_coefficients,
    point_kernel,
    strip_coefficients,
    wavenumber_grid,
    wavenumbers,
)
from ...solids.elastic import Elastic, Rigid, known_conduction
from ...solids.layers import Body, Layered, deformable, surface_material


def transfer(q: RealArray, thickness: Sequence[complex], conductivity: Sequence[complex]) -> Any:
    """q Z of layers on a base at wavenumbers ``q`` (rad/m), from the base up:
    q Z <- (k q Z + t) / (k (1 + k q Z t)), t = tanh q h; thicknesses and conductivities as of
    ``LayeredConductor``, real or complex."""
    *layers, base = conductivity
    found: Any = np.full(np.shape(q), 0.0 if math.isinf(base.real) else 1.0 / base)
    for h, k in zip(reversed(thickness), reversed(layers), strict=True):
        tanh = np.tanh(q * h)
        found = (k * found + tanh) / (k * (1.0 + k * found * tanh))
    return found


@dataclass(frozen=True)
class LayeredConductor:
    """Conductor of layers, at least one, on a half-space or on a base of one potential.

    Parameters
    ----------
    thickness
        Of the layers from the surface down, in m, each > 0.
    conductivity
        Of the layers, and last of the base, which may be infinite; W/(m K) or S/m, > 0.
    """

    thickness: tuple[float, ...]
    conductivity: tuple[float, ...]
    citation_keys: ClassVar[tuple[str, ...]] = ("Holm1967", "Hamilton2000")

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """Z(q) at ``wavenumber`` q > 0 (rad/m)."""
        q = wavenumbers(wavenumber)
        return self._times_wavenumber(q) / q

    def mean_mode(self) -> float:
        """Sum of h/k on a base of one potential; 0 on a half-space, where the uniform flow is left
        out."""
        *layers, base = self.conductivity
        if math.isfinite(base):
            return 0.0
        return sum(h / k for h, k in zip(self.thickness, layers, strict=True))

    def influence(self, grid: Grid) -> RealArray:
        """Potential at pixel offsets (nx, ny) from a pixel of unit flux density."""
        return patch_coefficients(point_kernel(*self._sampled), grid)

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Potential at offsets (nx, 1) from a strip of unit flux density."""
        return strip_coefficients(line_kernel(*self._sampled), grid, datum)

    def _times_wavenumber(self, q: RealArray) -> RealArray:
        return np.asarray(transfer(q, self.thickness, self.conductivity))

    @cached_property
    def _sampled(self) -> tuple[RealArray, Limits]:
        depth = sum(self.thickness)
        limits = Limits(1.0 / self.conductivity[0], 1.0 / self.conductivity[-1], depth)
        return self._times_wavenumber(wavenumber_grid(depth)), limits


@dataclass(frozen=True)
class Filmed:
    """Conductors with a film between them whose specific resistance is the same everywhere: it adds
    to the diagonal.

    Parameters
    ----------
    conductors
        Sum of both bodies.
    resistance
        Specific resistance of the film in m² K/W or Ω m², > 0.
    """

    conductors: Compliance
    resistance: float

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Those of the conductors."""
        return self.conductors.citation_keys

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """Z(q) and the film, at ``wavenumber`` q > 0 (rad/m)."""
        return self.conductors.spectral(wavenumber) + self.resistance

    def mean_mode(self) -> float:
        """That of the conductors and the film."""
        return self.conductors.mean_mode() + self.resistance

    def influence(self, grid: Grid) -> RealArray:
        """Potential at pixel offsets (nx, ny); the film adds at the pixel itself."""
        return self._at_itself(self.conductors.influence(grid))

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Potential at offsets (nx, 1) from a strip."""
        return self._at_itself(self.conductors.line_influence(grid, datum))

    def _at_itself(self, potential: RealArray) -> RealArray:
        found = potential.copy()
        found[0, 0] += self.resistance
        return found


@dataclass(frozen=True, repr=False)
class Flow(Shown):
    """What flows, and by which property of a material.

    Attributes
    ----------
    name
        ``"electrical"`` or ``"thermal"``.
    key
        Of the property, a field of ``Conduction``.
    resistivity
        Whether that is one over the conductivity.
    """

    name: str
    key: str
    resistivity: bool = False

    def conductivity(self, material: Elastic, which: str) -> float:
        """That of a ``material`` in S/m or W/(m K); InputError, which names ``which`` body or layer
        it is, if it is not known."""
        value = known_conduction(material, self.key, which)
        return 1.0 / value if self.resistivity else value


ELECTRICAL = Flow("electrical", "electrical_resistivity", resistivity=True)
THERMAL = Flow("thermal", "thermal_conductivity")


def conductor_of(body: Body, flow: Flow, which: str) -> Compliance | None:
    """Conductor that ``body`` is for the ``flow``; None for a rigid body, which has one potential.

    Layers that vanish, and what lies under a layer of infinite thickness, do not count; a rigid
    base has one potential. ``which`` body it is, for messages.

    Raises
    ------
    InputError
        If the conductivity of a material is not known.
    """
    if isinstance(body, Rigid):
        return None
    stack = body.reduced if isinstance(body, Layered) else Layered((), body)
    layers = [flow.conductivity(layer.material, f"layer {n} of the {which}") for n, layer in enumerate(stack.layers, 1)]
    base = flow.conductivity(stack.base, which) if isinstance(stack.base, Elastic) else math.inf
    if not layers:
        return None if math.isinf(base) else HalfSpace(2.0 * base)
    return LayeredConductor(tuple(layer.thickness for layer in stack.layers), (*layers, base))


def conductors(body: Body, counter_body: Body, flow: Flow, film_resistance: float = 0.0) -> Compliance:
    """Both bodies in series, and between them a film of the specific ``film_resistance``, >= 0.

    Rigid bodies have one potential and add nothing.

    Raises
    ------
    InputError
        If the conductivity of a material is not known, or neither body has a resistance.
    """
    named = ((body, "body"), (counter_body, "counter body"))
    deformable(body, counter_body)  # not both rigid
    found = [item for item in (conductor_of(solid, flow, which) for solid, which in named) if item is not None]
    spaces = [item for item in found if isinstance(item, HalfSpace)]
    if len(spaces) == 2:
        total: Compliance = HalfSpace(1.0 / sum(1.0 / item.modulus for item in spaces))
    else:
        total = found[0] if len(found) == 1 else SumOfCompliances(tuple(found))
    return Filmed(total, film_resistance) if film_resistance else total


def harmonic_mean(body: Body, counter_body: Body, flow: Flow) -> float:
    """k_s, 2/k_s = 1/k1 + 1/k2, of the materials at both surfaces, S/m or W/(m K); a rigid body
    counts as a perfect conductor.

    Raises
    ------
    InputError
        If the conductivity of a material is not known.
    """
    deformable(body, counter_body)  # not both rigid
    inverse = 0.0
    for solid, named in ((body, "body"), (counter_body, "counter body")):
        material = surface_material(solid)
        which = f"layer 1 of the {named}" if isinstance(solid, Layered) and solid.reduced.layers else named
        inverse += 0.0 if material is None else 1.0 / flow.conductivity(material, which)
    return 2.0 / inverse


def layers_in_series(body: Body, counter_body: Body, flow: Flow) -> float:
    """Sum of h/k over all layers of both bodies in m² K/W or Ω m²: what a uniform flow meets in
    them.

    Raises
    ------
    InputError
        If the conductivity of a material is not known.
    """
    total = 0.0
    for solid, which in ((body, "body"), (counter_body, "counter body")):
        for n, layer in enumerate(solid.reduced.layers if isinstance(solid, Layered) else (), 1):
            total += layer.thickness / flow.conductivity(layer.material, f"layer {n} of the {which}")
    return total
