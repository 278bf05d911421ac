"""Plastic flow of a material point: J2 plasticity with hardening, stepped by radial return, with
its consistent tangent."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.parameters import Declared
from ..core.quantity import measured
from ..core.values import NonNegative, Positive, Pressure
from .elastic import Elastic, Hardening

WEIGHTS = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
"""How often each of the components xx, yy, zz, xy, xz, yz of a symmetric tensor stands in it: a :
b = sum of WEIGHTS a b."""

UNIT = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
"""The unit tensor."""


# Hardening.


@dataclass(frozen=True)
class LinearHardening(Declared):
    """Y + H q; without H the perfectly plastic solid.

    Parameters
    ----------
    initial
        Y in Pa, > 0.
    modulus
        H in Pa, >= 0; E E_t/(E - E_t) for a tangent modulus E_t.
    """

    initial: Annotated[Pressure, "Yield stress in tension."]
    modulus: Annotated[NonNegative, "Slope, in Pa."] = 0.0
    name: ClassVar[str] = "linear hardening"

    def yield_stress(self, plastic_strain: RealArray) -> RealArray:
        """Y + H q in Pa."""
        found: RealArray = self.initial + self.modulus * plastic_strain
        return found

    def slope(self, plastic_strain: RealArray) -> RealArray:
        """H in Pa."""
        return np.full_like(plastic_strain, self.modulus)


@dataclass(frozen=True)
class Swift(Declared):
    """Y (1 + q/ε_0)^n (Swift 1952).

    Parameters
    ----------
    initial
        Y in Pa, > 0.
    reference_strain
        ε_0 > 0; Y/E joins the elastic line.
    exponent
        n, 0 to 1.
    """

    initial: Annotated[Pressure, "Yield stress in tension."]
    reference_strain: Annotated[Positive, "Strain ε_0."]
    exponent: Annotated[NonNegative, "Exponent n."]
    name: ClassVar[str] = "Swift hardening"

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.exponent > 1.0:
            raise InputError(f"exponent of Swift hardening must be at most 1, but is {self.exponent!r}.")

    def yield_stress(self, plastic_strain: RealArray) -> RealArray:
        """Y (1 + q/ε_0)^n in Pa."""
        found: RealArray = self.initial * (1.0 + plastic_strain / self.reference_strain) ** self.exponent
        return found

    def slope(self, plastic_strain: RealArray) -> RealArray:
        """n Y/ε_0 (1 + q/ε_0)^(n-1) in Pa."""
        base = 1.0 + plastic_strain / self.reference_strain
        found: RealArray = self.initial * self.exponent / self.reference_strain * base ** (self.exponent - 1.0)
        return found


@dataclass(frozen=True)
class Voce(Declared):
    """Y + Q (1 - e^{-bq}) (Voce 1948).

    Parameters
    ----------
    initial
        Y in Pa, > 0.
    gain
        Q in Pa, >= 0.
    rate
        b, > 0.
    """

    initial: Annotated[Pressure, "Yield stress in tension."]
    gain: Annotated[NonNegative, "Largest growth Q, in Pa."]
    rate: Annotated[Positive, "Rate b."]
    name: ClassVar[str] = "Voce hardening"

    def yield_stress(self, plastic_strain: RealArray) -> RealArray:
        """Y + Q (1 - e^{-bq}) in Pa."""
        found: RealArray = self.initial - self.gain * np.expm1(-self.rate * plastic_strain)
        return found

    def slope(self, plastic_strain: RealArray) -> RealArray:
        """Q b e^{-bq} in Pa."""
        found: RealArray = self.gain * self.rate * np.exp(-self.rate * plastic_strain)
        return found


# The material and its steps.


@dataclass(frozen=True, eq=False)
class PlasticState:
    """What plastic flow leaves at points of any shape (…): a step takes it and gives a new one.

    Attributes
    ----------
    plastic_strain
        (…, 6) components xx, yy, zz, xy, xz, yz of the tensor.
    back_stress
        (…, 6) in Pa.
    accumulated
        (…) q, the accumulated plastic strain.
    """

    plastic_strain: RealArray = measured("1", "plastic strain xx, yy, zz, xy, xz, yz", "point", "tensor")
    back_stress: RealArray = measured("Pa", "back stress xx, yy, zz, xy, xz, yz", "point", "tensor")
    accumulated: RealArray = measured("1", "accumulated plastic strain", "point")

    def require_sound(self) -> None:
        """Refuse arrays of a file that do not fit each other, with a ValueError."""
        if (
            self.plastic_strain.shape != (*self.accumulated.shape, 6)
            or self.back_stress.shape != self.plastic_strain.shape
        ):
            raise ValueError("plastic strain, back stress and accumulated strain do not fit each other")

    @classmethod
    def virgin(cls, shape: tuple[int, ...] = ()) -> PlasticState:
        """Points of ``shape`` that have not flowed."""
        return cls(np.zeros((*shape, 6)), np.zeros((*shape, 6)), np.zeros(shape))


@dataclass(frozen=True, eq=False)
class PlasticStep:
    """Points after a step.

    Attributes
    ----------
    stress
        (…, 6) in Pa, tension positive.
    state
        What to start the next step from.
    tangent
        (…, 6, 6) derivative of the stress with respect to the strain of the step: d stress =
        tangent · (WEIGHTS d strain), so that entries of shear are those of the tensor D_ijkl; None
        if it was not asked for.
    """

    stress: RealArray
    state: PlasticState
    tangent: RealArray | None = None


TOLERANCE = 1e-14
"""Residual of the yield condition over the stress at which the equation for Δq is solved: Newton
ends at rounding."""

MOST_STEPS = 60
"""Newton steps for Δq; concave laws take at most 8 from zero, kinematic recall some more."""


@dataclass(frozen=True)
class J2:
    """Elastic-plastic solid: von Mises' yield condition with associated flow, isotropic and
    kinematic hardening, small strains.

        sqrt(3/2) |dev σ - α| <= Y(q),   dε^p = sqrt(3/2) dq n,   dα = (2/3) H_k dε^p - γ α dq.

    Parameters
    ----------
    elastic
        Young's modulus and Poisson's ratio.
    hardening
        ``LinearHardening``, ``Swift``, ``Voce``, or one's own.
    kinematic
        H_k in Pa, >= 0 (Prager 1956).
    recall
        γ >= 0 (Armstrong and Frederick 1966); 0 is Prager's law.

    Raises
    ------
    InputError
        If a parameter is out of its range or of a wrong type.

    Examples
    --------
    >>> steel = J2(Elastic(200e9, 0.3), LinearHardening(400e6))
    >>> pulled = steel.step([0.01, -0.005, -0.005, 0.0, 0.0, 0.0])
    >>> f"{float(von_mises(pulled.stress)) / 1e6:.1f} MPa"
    '400.0 MPa'
    """

    elastic: Elastic
    hardening: Hardening
    kinematic: float = 0.0
    recall: float = 0.0
    citation_keys: ClassVar[tuple[str, ...]] = ("SimoTaylor1985",)
    shear: float = field(init=False)
    bulk: float = field(init=False)

    def __post_init__(self) -> None:
        solid = require.instance(self.elastic, Elastic, "elastic", "Give Elastic(E, nu).")
        require.instance(self.hardening, Hardening, "hardening", "Give LinearHardening(Y), Swift(…) or Voce(…).")
        require.not_negative(self.kinematic, "kinematic hardening (Pa)")
        require.not_negative(self.recall, "recall of the back stress")
        require.between(solid.poisson_ratio, -1.0, 0.5, "Poisson's ratio of a J2 solid")
        object.__setattr__(self, "shear", 0.5 * solid.youngs_modulus / (1.0 + solid.poisson_ratio))
        object.__setattr__(self, "bulk", solid.youngs_modulus / (3.0 * (1.0 - 2.0 * solid.poisson_ratio)))

    def step(self, strain: ArrayLike, state: PlasticState | None = None, *, tangent: bool = False) -> PlasticStep:
        """Stress at the total ``strain`` (…, 6), tensor components, that is reached in one implicit
        step from ``state``, by default the virgin one.

        Raises
        ------
        InputError
            If strain and state do not fit together or are not finite.
        ConvergenceError
            If the equation for the plastic strain is not solved at a point.
        """
        eps = np.asarray(strain, dtype=float)
        before = PlasticState.virgin(eps.shape[:-1]) if state is None else state
        if eps.shape[-1:] != (6,) or eps.shape != before.plastic_strain.shape or not np.isfinite(eps).all():
            raise InputError(
                f"strain must be finite with the shape {before.plastic_strain.shape} of the state, but has "
                f"{eps.shape}. Components are xx, yy, zz, xy, xz, yz."
            )
        volume = eps @ UNIT
        trial = 2.0 * self.shear * (eps - before.plastic_strain - np.multiply.outer(volume / 3.0, UNIT))
        # Δq of each point: zero where it stays elastic, else by Newton's method from zero, which is
        # monotonic for concave hardening
        dq = np.zeros(trial.shape[:-1])
        left, slope = self._excess(trial, before, dq)
        scale = np.maximum(math.sqrt(1.5) * norm(trial), self.hardening.yield_stress(before.accumulated))
        flows = left > 0.0
        for _ in range(MOST_STEPS):
            open_ = flows & (np.abs(left) > TOLERANCE * scale)
            if not open_.any():
                break
            moved = np.where(open_, np.maximum(dq - left / slope, 0.5 * dq), dq)
            if np.array_equal(moved, dq):  # at rounding
                break
            dq = moved
            left, slope = self._excess(trial, before, dq)
        else:
            if not (np.abs(left[flows]) < 1e-10 * scale[flows]).all():
                raise ConvergenceError(
                    f"The plastic strain of a step is not found in {MOST_STEPS} steps at every point. Take a "
                    "smaller step."
                )
        eta = trial - before.back_stress / (1.0 + self.recall * dq)[..., None]  # less what Δq leaves of the back stress
        size = norm(eta)
        direction = eta / np.where(size > 0.0, size, 1.0)[..., None]
        flow = math.sqrt(1.5) * dq[..., None] * direction
        stress = trial - 2.0 * self.shear * flow + np.multiply.outer(self.bulk * volume, UNIT)
        back = (before.back_stress + 2.0 / 3.0 * self.kinematic * flow) / (1.0 + self.recall * dq)[..., None]
        after = PlasticState(before.plastic_strain + flow, back, before.accumulated + dq)
        return PlasticStep(stress, after, self._tangent(before, dq, direction, size) if tangent else None)

    def _excess(self, trial: RealArray, before: PlasticState, dq: RealArray) -> tuple[RealArray, RealArray]:
        """Yield condition after a step Δq, and its derivative with respect to it."""
        faded = 1.0 + self.recall * dq
        eta = trial - before.back_stress / faded[..., None]
        size = norm(eta)
        q = before.accumulated + dq
        left = (
            math.sqrt(1.5) * size - 3.0 * self.shear * dq - self.kinematic * dq / faded - self.hardening.yield_stress(q)
        )
        turned = (eta * before.back_stress) @ WEIGHTS / np.where(size > 0.0, size, 1.0)
        slope = math.sqrt(1.5) * turned * self.recall / faded**2 - 3.0 * self.shear - self.kinematic / faded**2
        return left, slope - self.hardening.slope(q)

    def _tangent(self, before: PlasticState, dq: RealArray, n: RealArray, size: RealArray) -> RealArray:
        """Consistent tangent (Simo and Taylor 1985), of which that without recall is symmetric."""
        G, faded = self.shear, 1.0 + self.recall * dq
        deviator = np.diag(1.0 / WEIGHTS) - np.outer(UNIT, UNIT) / 3.0
        elastic = self.bulk * np.outer(UNIT, UNIT) + 2.0 * G * deviator
        flows = dq > 0.0
        q = before.accumulated + dq
        along = (n * before.back_stress) @ WEIGHTS
        slope = (
            math.sqrt(1.5) * along * self.recall / faded**2
            - 3.0 * G
            - self.kinematic / faded**2
            - self.hardening.slope(q)
        )
        turn = np.where(flows, dq / np.where(flows, size, 1.0), 0.0)
        outer = n[..., :, None] * n[..., None, :]
        fading = (self.recall / faded**2)[..., None]
        across = (before.back_stress - along[..., None] * n) * fading * turn[..., None]
        per_strain = np.where(flows, -math.sqrt(1.5) * 2.0 * G / slope, 0.0)[..., None, None] * n[..., None, :]
        change = -math.sqrt(6.0) * G * (n + across)[..., :, None] * per_strain
        bend = -math.sqrt(6.0) * G * 2.0 * G * turn[..., None, None] * (deviator - outer)
        return elastic + np.where(flows[..., None, None], change + bend, 0.0)


def norm(tensor: RealArray) -> RealArray:
    """sqrt(a : a) of symmetric tensors (…, 6)."""
    found: RealArray = np.sqrt(tensor**2 @ WEIGHTS)
    return found


def von_mises(stress: ArrayLike) -> RealArray:
    """sqrt(3/2 dev σ : dev σ) of stresses (…, 6), components xx, yy, zz, xy, xz, yz."""
    s = np.asarray(stress, dtype=float)
    return math.sqrt(1.5) * norm(s - np.multiply.outer(s @ UNIT / 3.0, UNIT))
