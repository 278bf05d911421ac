"""A sliding block with three degrees of freedom on a rough interface: steady sliding and its linear
stability."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, ClassVar, Literal

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.parameters import Declared
from ...core.quadrature import rule
from ...core.values import NonNegative, Number
from .belt import BeltSpeed, SpringStiffness
from .interface import NormalCompliance
from .normal_motion import Mass

NODES = 16
"""Points of the Gauss-Legendre rule along the base; where parts of it lift off, the result depends
on them."""

BlockLength = Annotated[float, Number("length", above=0.0)]


@dataclass(frozen=True)
class SlidingBlock(Declared):
    """Rigid rectangular block on a belt, held by a spring, free to move along x, to penetrate and
    to tilt (Martins, Oden and Simoes 1990).

    M x'' = -k x - c x' + T, M y'' = W - N, I φ'' = M_p + (H/2) T + h_s (k x + c x'), with I = M
    (b² + H²)/12, the local approach δ = y - ξφ along the base, N and M_p force and moment of the
    pressure on it, and the friction T = -s w ∫ c_t δ^{m_t} dξ, where s is the sign of the sliding
    velocity v = x' + (H/2) φ' - U.

    Parameters
    ----------
    law
        Of the interface, with friction.
    mass
        M in kg, > 0.
    length, width, height
        b along the sliding direction, w and H in m, > 0.
    load
        W in N, > 0, weight included, at the centroid.
    stiffness
        k in N/m, > 0, of the spring.
    speed
        U in m/s, > 0, of the belt.
    damping
        c in N s/m, >= 0.
    spring_height
        h_s in m, height of the spring above the centroid.

    Raises
    ------
    InputError
        If a parameter is out of its range.

    Examples
    --------
    >>> law = NormalCompliance.amontons(2.8e18, 2.0, friction=0.3)
    >>> sides = {"length": 0.1, "width": 0.02, "height": 0.05}
    >>> block = SlidingBlock(law, mass=1.0, **sides, load=100.0, stiffness=2e5, speed=1e-3)
    >>> block.stability.kind
    'flutter'
    """

    law: NormalCompliance
    mass: Annotated[Mass, "Mass."]
    length: Annotated[BlockLength, "Length along the sliding direction."]
    width: Annotated[BlockLength, "Width."]
    height: Annotated[BlockLength, "Height."]
    load: Annotated[float, Number("force", above=0.0), "Load, weight included."]
    stiffness: Annotated[SpringStiffness, "Stiffness of the spring that holds the block."]
    speed: Annotated[BeltSpeed, "Speed of the belt."]
    damping: Annotated[NonNegative, "Dashpot beside the spring, in N s/m."] = 0.0
    spring_height: Annotated[float, Number("length"), "Height of the spring above the centroid."] = 0.0
    name: ClassVar[str] = "sliding block"
    citation_keys: ClassVar[tuple[str, ...]] = ("Oden1985", "Martins1990", "Rabier1986")

    def __post_init__(self) -> None:
        super().__post_init__()
        require.instance(self.law, NormalCompliance, "law", "Give an NormalCompliance.")

    @property
    def inertia(self) -> float:
        """I about the centroid in kg m²."""
        return self.mass * (self.length**2 + self.height**2) / 12.0

    @property
    def area(self) -> float:
        """Of the base in m²."""
        return self.length * self.width

    @property
    def rest(self) -> float:
        """Penetration y_0 at rest, in m."""
        return float(self.law.approach(self.load / self.area))

    @property
    def friction(self) -> float:
        """Coefficient of friction at rest."""
        return float(self.law.coefficient(self.load / self.area))

    @property
    def reference_displacement(self) -> float:
        """μ W/k in m: displacement under the friction at rest; k/m where there is no friction."""
        return self.friction * self.load / self.stiffness

    @property
    def normal_frequency(self) -> float:
        """sqrt(m W/(M y_0)) in rad/s."""
        return math.sqrt(self.law.normal_exponent * self.load / (self.mass * self.rest))

    @cached_property
    def base(self) -> tuple[RealArray, RealArray]:
        """Coordinates ξ along the base in m, and the areas in m² that the points of the rule stand
        for."""
        nodes, weights = rule(NODES)
        return 0.5 * self.length * nodes, 0.5 * self.length * self.width * weights

    def forces(self, penetration: float, tilt: float) -> tuple[float, float, float]:
        """Normal force N, its moment M_p (N m) and the largest friction (N) at rest in that
        position."""
        xi, area = self.base
        approach = penetration - xi * tilt
        pressed = area * self.law.pressure(approach)
        return float(pressed.sum()), float(xi @ pressed), float(area @ self.law.friction(approach))

    @cached_property
    def steady(self) -> SteadySliding:
        """Steady sliding.

        Raises
        ------
        NoSolutionError
            If the block topples: the moment of the friction is more than the base can bear.
        """
        from scipy.optimize import root

        xi, area = self.base
        arm = 0.5 * self.height + self.spring_height
        unit, scale = self.rest, self.load * self.length

        def unbalanced(z: RealArray) -> RealArray:
            normal, moment, friction = self.forces(unit * z[0], unit * z[1] / self.length)
            return np.array([normal / self.load - 1.0, (moment + arm * friction) / scale])

        found = root(unbalanced, [1.0, 0.0], tol=1e-14)
        y, tilt = unit * float(found.x[0]), unit * float(found.x[1]) / self.length
        if np.abs(unbalanced(found.x)).max() > 1e-9:
            raise NoSolutionError(
                f"The block topples: friction {self.friction:.3g} at the arm {arm:.3g} m is more than the base "
                f"of length {self.length:.3g} m bears. Lower the height or the friction, or make the block "
                "longer."
            )
        friction = float(area @ self.law.friction(y - xi * tilt))
        return SteadySliding(friction / self.stiffness, y, tilt, friction)

    @cached_property
    def stability(self) -> Stability:
        """Eigenvalues about steady sliding, all points of which slide with one sign of the
        velocity."""
        stiffness, damping = self.linearised()
        inertia = np.array([self.mass, self.mass, self.inertia])
        zero, one = np.zeros((3, 3)), np.eye(3)
        # lengths over y_0, angles times b over y_0: else the entries differ by many powers of ten
        unit = np.array([1.0, 1.0, 1.0 / self.length])
        scaled = [(matrix * unit) / (inertia * unit)[:, None] for matrix in (stiffness, damping)]
        values, vectors = np.linalg.eig(np.block([[zero, one], [-scaled[0], -scaled[1]]]))
        return Stability.of(values, vectors)

    def linearised(self) -> tuple[RealArray, RealArray]:
        """Stiffness and damping matrices, (3, 3) for displacement, penetration and tilt, about
        steady sliding; not symmetric by the friction."""
        found, law, (xi, area) = self.steady, self.law, self.base
        ell = law.exponents[1]
        approach = np.maximum(found.penetration - xi * found.tilt, 0.0)
        K = [float(area @ (xi**n * law.stiffness(approach))) for n in range(3)]
        C = [float(area @ (xi**n * law.damping_coefficient * approach**ell)) for n in range(3)]
        slope = law.friction_slope(approach)
        F = [float(area @ (xi**n * slope)) for n in range(2)]
        h, arm = 0.5 * self.height, self.spring_height
        stiffness = np.array(
            [
                [self.stiffness, -F[0], F[1]],
                [0.0, K[0], -K[1]],
                [-arm * self.stiffness, -(K[1] + h * F[0]), K[2] + h * F[1]],
            ]
        )
        damping = np.array([[self.damping, 0.0, 0.0], [0.0, C[0], -C[1]], [-arm * self.damping, -C[1], C[2]]])
        return stiffness, damping

    def critical_friction(self, most: float = 2.0) -> float:
        """Smallest friction coefficient above which steady sliding is unstable; infinite if there
        is none up to ``most``, or before it topples.

        By bisection between the last stable and the first unstable of 200 coefficients, to 1e-10.
        """

        def growth(mu: float) -> float:
            return replace(self, law=self.law.with_friction(mu)).stability.margin

        low = 0.0
        for high in np.linspace(most / 200.0, most, 200):
            try:
                unstable = growth(float(high)) > 0.0
            except NoSolutionError:
                return math.inf
            if unstable:
                break
            low = float(high)
        else:
            return math.inf
        while high - low > 1e-10:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if growth(middle) > 0.0 else (middle, high)
        return float(high)


@dataclass(frozen=True)
class SteadySliding:
    """Block that slides steadily.

    Attributes
    ----------
    displacement, penetration, tilt
        x and y in m, φ in rad; the block digs in at its upstream edge, φ > 0.
    friction_force
        In N.
    """

    displacement: float
    penetration: float
    tilt: float
    friction_force: float


Kind = Literal["stable", "flutter", "divergence"]

UNDAMPED = 1e-9
"""Growth rate over the largest frequency below which rounding may have made it."""


@dataclass(frozen=True, eq=False)
class Stability:
    """Modes of small motion about steady sliding.

    Attributes
    ----------
    growth_rates
        (3,) real parts in 1/s, in the order of the frequencies, of two modes in flutter the growing
        one first.
    frequencies
        (3,) angular frequencies in rad/s; 0 for a motion that only grows or decays.
    """

    growth_rates: RealArray
    frequencies: RealArray

    @classmethod
    def of(cls, values: RealArray, vectors: RealArray) -> Stability:
        """One mode of each pair of the eigenvalues."""
        upper = values[np.imag(values) > 0.0]
        plain = np.real(values[np.imag(values) == 0.0])
        grown = np.sort(plain)[::-1][: 3 - upper.size]
        rates = np.concatenate([np.real(upper), grown])
        omega = np.concatenate([np.imag(upper), np.zeros(grown.size)])
        # frequencies that agree to rounding belong to a pair in flutter
        order = np.lexsort((-rates, np.round(omega / max(float(omega.max()), 1.0), 9)))
        return cls(rates[order], omega[order])

    @property
    def margin(self) -> float:
        """Largest growth rate in 1/s; what rounding may have made of zero counts as stable."""
        worst = float(self.growth_rates.max())
        return worst if abs(worst) > UNDAMPED * float(self.frequencies.max()) else min(worst, 0.0)

    @property
    def kind(self) -> Kind:
        """ "stable", "flutter" (a growing oscillation), or "divergence" (growth without
        oscillation)."""
        if self.margin <= 0.0:
            return "stable"
        return "flutter" if self.frequencies[int(np.argmax(self.growth_rates))] > 0.0 else "divergence"
