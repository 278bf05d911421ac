"""Elastic-plastic bodies of finite elements: forces and consistent stiffness at a displacement,
from the state of the last step."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy import sparse

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..solids.elastic import Elastic
from ..solids.plasticity import J2, UNIT, WEIGHTS, PlasticState, von_mises
from .elements import Elements

AT_YIELD = 1e-9
"""Excess over the yield stress up to which a point counts as elastic: at rounding, points that have
flowed would change sides at random where a step begins."""


@dataclass(frozen=True, eq=False)
class Response:
    """A body at a displacement.

    Attributes
    ----------
    forces
        (unknowns,) in N that hold it there.
    stress
        (elements, points, 6) in Pa.
    state
        Plastic state that the next step starts from.
    stiffness
        Derivative of the forces, sparse by columns; None if it was not asked for.
    """

    forces: RealArray
    stress: RealArray
    state: PlasticState
    stiffness: sparse.csc_array | None = None


@dataclass(frozen=True, eq=False)
class Solid:
    """Elements with the law of each region: ``J2`` where it may flow, ``Elastic`` elsewhere; and a
    ``support``, the stiffness in N/m of what lies beyond them.

    Raises
    ------
    InputError
        If a law is missing, or a region is incompressible.
    """

    elements: Elements
    laws: tuple[Elastic | J2, ...]
    support: sparse.csc_array | None = None
    moduli: RealArray = field(init=False)
    matrices: RealArray = field(init=False)
    entries: RealArray = field(init=False)

    def __post_init__(self) -> None:
        regions = int(self.elements.region.max()) + 1
        if len(self.laws) < regions:
            raise InputError(f"laws must be one for each of {regions} regions, but is {len(self.laws)} laws.")
        tensors = np.stack([elastic_tensor(law.elastic if isinstance(law, J2) else law) for law in self.laws])
        matrices = self.elements.stiffnesses(tensors[self.elements.region][:, None])
        object.__setattr__(self, "moduli", tensors)
        object.__setattr__(self, "matrices", matrices)
        object.__setattr__(self, "entries", self.elements.pattern.sum(matrices))

    @property
    def symmetric(self) -> bool:
        """Whether the stiffness is symmetric: without recall of a back stress."""
        return not any(isinstance(law, J2) and law.recall > 0.0 for law in self.laws)

    def virgin(self) -> PlasticState:
        """State that has not flowed."""
        return PlasticState.virgin(self.elements.shape)

    def respond(self, displacement: RealArray, state: PlasticState, *, stiffness: bool = False) -> Response:
        """Response at the ``displacement`` (unknowns,) in m, in one implicit step from ``state``.

        Raises
        ------
        ConvergenceError
            If the plastic strain is not found at a point.
        """
        strain = self.elements.strains(displacement)
        elastic, stress = strain - state.plastic_strain, np.empty_like(strain)
        for number, tensor in enumerate(self.moduli):
            inside = self.elements.region == number
            stress[inside] = elastic[inside] @ (tensor * WEIGHTS).T
        entries = self.entries
        for number, law in enumerate(self.laws):
            if not isinstance(law, J2):
                continue
            # points whose elastic trial stress is beyond yield
            inside = np.flatnonzero(self.elements.region == number)
            trial = von_mises(stress[inside] - state.back_stress[inside])
            beyond = trial > law.hardening.yield_stress(state.accumulated[inside]) * (1.0 + AT_YIELD)
            row, point = np.nonzero(beyond)
            element = inside[row]
            if not len(element):
                continue
            before = PlasticState(
                state.plastic_strain[element, point],
                state.back_stress[element, point],
                state.accumulated[element, point],
            )
            step = law.step(strain[element, point], before, tangent=stiffness)
            state = PlasticState(state.plastic_strain.copy(), state.back_stress.copy(), state.accumulated.copy())
            state.plastic_strain[element, point] = step.state.plastic_strain
            state.back_stress[element, point] = step.state.back_stress
            state.accumulated[element, point] = step.state.accumulated
            stress[element, point] = step.stress
            if step.tangent is not None:
                chosen, place = np.unique(element, return_inverse=True)
                tangent = np.repeat(self.moduli[number][None, None], len(chosen), axis=0)
                tangent = np.repeat(tangent, self.elements.shape[1], axis=1)
                tangent[place, point] = step.tangent
                softer = self.elements.stiffnesses(tangent, chosen) - self.matrices[chosen]
                entries = entries + self.elements.pattern.sum(softer, chosen)
        forces = self.elements.forces(stress)
        if self.support is not None:
            forces = forces + self.support @ displacement
        if not stiffness:
            return Response(forces, stress, state)
        whole = self.elements.pattern.matrix(entries)
        return Response(
            forces, stress, state, whole if self.support is None else sparse.csc_array(whole + self.support)
        )

    def elastic_energy(self, stress: RealArray) -> RealArray:
        """Elastic energy (elements,) in J of a ``stress``."""
        density = np.empty(self.elements.shape)
        for number, law in enumerate(self.laws):
            own, inside = law.elastic if isinstance(law, J2) else law, self.elements.region == number
            trace = stress[inside] @ UNIT
            squares = stress[inside] ** 2 @ WEIGHTS
            nu, E = own.poisson_ratio, own.youngs_modulus
            density[inside] = 0.5 * ((1.0 + nu) * squares - nu * trace**2) / E
        found: RealArray = (density * self.elements.weights).sum(axis=1)
        return found


def elastic_tensor(solid: Elastic) -> RealArray:
    """Tensor (6, 6) of stress over tensor strain, to be used like ``PlasticStep.tangent``.

    Raises
    ------
    InputError
        If the solid is incompressible.
    """
    nu = solid.poisson_ratio
    if nu >= 0.5:
        raise InputError(f"Poisson's ratio of a meshed solid must be less than 0.5, but is {nu:g}. Use 0.499.")
    G = solid.shear_modulus
    return 2.0 * G * (np.diag(1.0 / WEIGHTS) + nu / (1.0 - 2.0 * nu) * np.outer(UNIT, UNIT))
