"""Greenwood & Williamson on the summits of a map, sinusoidal and with elastic interaction."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.parameters import Help
from ...core.values import Number, Several
from ..protocol import (
    FEW_CONTACTS,
    Bound,
    Limit,
    Modulus,
    Prediction,
    Theory,
    curve,
    highest_first,
    prediction,
)
from ..single.waves import TWO_TERMS, two_term_approach, two_term_load, two_terms
from ..statistics.roughness import Roughness
from .discrete_summits import DiscreteSummits

# Interacting sinusoidal crests: complementarity problem and least squares.
#
# With w_i = a_i² of the contact radii and the far-field approach δ_i = δ - (z_M - z_i) of each
# crest,
#
# r_i(w) = ω_i(w_i) + Σ_j≠i F_j(w_j)/(π E* r_ij) - δ_i,   w_i >= 0,  r_i >= 0,  w_i r_i = 0:
#
# a crest touches, or the others have pressed it below the plane. Displacements between crests are
# those of point forces.


_STEPS = 200
_TOLERANCE = 1e-13  # of the residual over the approach
_LIFTED = 1e-9  # share of the approach above which a residual is not rounding of the optimiser

_LOAD_STEP, _APPROACH_STEP = 2.0, 1.25  # ratios to the value before for which the iteration converges
_FIRST_SHARE = 0.03  # of a load or an approach with so few contacts that the iteration converges from any start


@dataclass(frozen=True, eq=False)
class CrestSystem:
    """The crests that may touch, the highest first.

    Parameters
    ----------
    A1, A2
        (n,) coefficients of the crests in 1/m and 1/m³.
    largest
        (n,) largest a² in m² for which the two terms hold, infinite for paraboloids (A_2 = 0).
    coupling
        (n, n) displacement at i per F_j/E* at j in 1/m, zero on the diagonal.
    """

    A1: RealArray
    A2: RealArray
    largest: RealArray
    coupling: RealArray

    def residual(self, w: RealArray, delta: RealArray) -> RealArray:
        """r_i in m."""
        return self.own_approach(w) + self.coupling @ self.loads(w) - delta

    def own_approach(self, w: RealArray) -> RealArray:
        """ω_i in m; the approach of a punch is the displacement of its centre by its own load,
        too."""
        return two_term_approach(np.sqrt(w), self.A1, self.A2)

    def own_slope(self, w: RealArray) -> RealArray:
        """dω_i/dw_i in 1/m."""
        return 2.0 * self.A1 + 16.0 / 3.0 * self.A2 * w

    def loads(self, w: RealArray) -> RealArray:
        """F_i/E* in m²."""
        return two_term_load(np.sqrt(w), 1.0, self.A1, self.A2)

    def load_slope(self, w: RealArray) -> RealArray:
        """d(F_i/E*)/dw_i."""
        return (4.0 * self.A1 + 32.0 / 3.0 * self.A2 * w) * np.sqrt(w)

    def jacobian(self, w: RealArray, among: BoolArray) -> RealArray:
        """dr_i/dw_j of the crests ``among``."""
        matrix: RealArray = self.coupling[np.ix_(among, among)] * self.load_slope(w)[among]
        matrix[np.diag_indices_from(matrix)] += self.own_slope(w)[among]
        return matrix

    def isolated(self, delta: RealArray) -> RealArray:
        """w_i of crests without interaction, at most the largest."""
        omega = np.maximum(delta, 0.0)
        discriminant = self.A1**2 + 8.0 / 3.0 * self.A2 * omega  # negative beyond the largest approach, 9h/8
        alone = omega / (self.A1 + np.sqrt(np.where(discriminant >= 0.0, discriminant, np.nan)))
        return np.where(np.isnan(alone), self.largest, np.minimum(alone, self.largest))

    @property
    def count(self) -> int:
        """Number of crests."""
        return int(self.A1.size)

    def nearness(self, w: RealArray) -> RealArray:
        """1/distance in 1/m of each crest to the next one that touches; 0 without interaction."""
        return np.asarray(math.pi * np.max(self.coupling * (w > 0.0), axis=1, initial=0.0))

    def leading(self, count: int) -> Self:
        """The ``count`` highest crests."""
        part = slice(0, count)
        return type(self)(self.A1[part], self.A2[part], self.largest[part], self.coupling[part, part])


def solve_complementarity(system: CrestSystem, delta: RealArray, start: RealArray) -> RealArray:
    """w (n,) by Newton steps on the touching crests, which crests leave and enter as the conditions
    say.

    InputError if a crest is pressed beyond the range of its two terms; ConvergenceError if the
    iteration does not converge.
    """
    w, scale = start.copy(), float(delta.max())
    for _ in range(_STEPS):
        r = system.residual(w, delta)
        touching = (w > 0.0) | (r < 0.0)
        if np.all(np.abs(r[touching]) <= _TOLERANCE * scale):
            return w
        w[touching] -= _solved(system.jacobian(w, touching), r[touching])
        np.clip(w, 0.0, 0.999 * system.largest, out=w)
    raise _not_solved(system, w)


def _solved(matrix: RealArray, right: RealArray) -> RealArray:
    """Solution of a linear system, the shortest one where contacts within each other leave it
    open."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.lstsq(matrix, right)[0])


def solve_load(
    system: CrestSystem, depth: RealArray, total: float, *, delta: float, start: RealArray
) -> tuple[float, RealArray]:
    """Approach δ in m, and w (n,), at which the loads F_i/E* of the crests sum to ``total`` in m².

    Newton steps in δ and all w at once; crests lie ``depth`` (n,) in m below the highest, and
    ``delta`` and ``start`` are first values of δ and w.

    Raises
    ------
    InputError, ConvergenceError
        As for ``solve_complementarity``.
    """
    w = start.copy()
    for _ in range(_STEPS):
        r = system.residual(w, delta - depth)
        touching = (w > 0.0) | (r < 0.0)
        excess = system.loads(w).sum() - total
        if np.all(np.abs(r[touching]) <= _TOLERANCE * delta) and abs(excess) <= _TOLERANCE * total:
            return delta, w
        sides = np.stack([r[touching], np.ones(int(touching.sum()))], axis=1)
        fall, rise = _solved(system.jacobian(w, touching), sides).T
        slope = system.load_slope(w)[touching]
        step = np.clip((slope @ fall - excess) / (slope @ rise), -0.5 * delta, delta)
        w[touching] += step * rise - fall
        delta += float(step)
        np.clip(w, 0.0, 0.999 * system.largest, out=w)
    raise _not_solved(system, w)


def solve_least_squares(system: CrestSystem, delta: RealArray, start: RealArray) -> RealArray:
    """w (n,) by minimising |r|²/2 over the contact radii a >= 0 of the touching crests, with
    scipy's optimiser.

    A crest that ends with a positive residual is pressed below the plane and leaves; one with a
    negative residual enters.

    Raises
    ------
    InputError, ConvergenceError
        As for ``solve_complementarity``.
    """
    w, scale = start.copy(), float(delta.max())
    unit = np.sqrt(np.where(np.isinf(system.largest), system.isolated(delta) + scale / system.A1, system.largest))
    touching = w > 0.0
    for _ in range(_STEPS):
        w = _least_squares(system, delta, w, touching, unit=unit)
        r = system.residual(w, delta)
        # a crest that cannot reach the plane holds a positive residual, and the others a negative
        # one
        pressed, missed = touching & (r > _LIFTED * scale), ~touching & (r < 0.0)
        if not pressed.any() and not missed.any():
            return w
        w[pressed] = 0.0
        touching = (touching & ~pressed) | missed
    raise _not_solved(system, w)


def _least_squares(
    system: CrestSystem, delta: RealArray, start: RealArray, among: BoolArray, *, unit: RealArray
) -> RealArray:
    """w of the crests ``among`` with the least sum of squared residuals, the others zero; unknowns
    are a over ``unit``."""
    from scipy.optimize import least_squares

    def squares(x: RealArray) -> RealArray:
        w = np.zeros_like(delta)
        w[among] = np.square(x * unit[among])
        return w

    def residual(x: RealArray) -> RealArray:
        return system.residual(squares(x), delta)[among] / scale

    def jacobian(x: RealArray) -> RealArray:
        return system.jacobian(squares(x), among) * (2.0 * x * unit[among] ** 2) / scale

    scale = float(delta.max())
    found = least_squares(
        residual,
        np.clip(np.sqrt(start[among]) / unit[among], 1e-6, 0.999),
        jacobian,
        bounds=(0.0, 1.0),  # of paraboloids as well: interaction makes contacts smaller
        xtol=_TOLERANCE,
        ftol=_TOLERANCE,
        gtol=_TOLERANCE,
    )
    return squares(found.x)


def _not_solved(system: CrestSystem, w: RealArray) -> InputError | ConvergenceError:
    if np.any(w >= 0.99 * system.largest):
        return InputError(
            f"contact radii must stay below {TWO_TERMS:.3f} wavelengths, where the two terms of the sine end, "
            "but a crest is pressed deeper. Lower the pressure or the approach."
        )
    return ConvergenceError(
        f"interacting crests did not converge in {_STEPS} steps; the crests may be too close.",
        subject="interacting crests",
    )


def settled(
    solve: Callable[[CrestSystem, RealArray, RealArray], RealArray],
    system: CrestSystem,
    delta: RealArray,
    start: RealArray,
) -> RealArray:
    """w (n,) by ``solve`` from ``start``, or where its steps swing, from a small approach upwards.

    Raises
    ------
    InputError, ConvergenceError
        As for ``solve_complementarity``.
    """
    try:
        return solve(system, delta, start)
    except ConvergenceError:
        w, top = np.zeros_like(start), float(delta.max())
        for approach in _graded(np.array([_FIRST_SHARE * top, top]), _APPROACH_STEP):
            w = solve(system, approach - (top - delta), w)
        return w


def _graded(values: RealArray, ratio: float) -> RealArray:
    rising = np.unique(values)
    parts = [rising[:1]]
    for low, high in itertools.pairwise(rising):
        growth = high / low if low > 0.0 else 1.0
        count = math.ceil(math.log(growth) / math.log(ratio))
        parts.append(np.append(low * growth ** (np.arange(1, count) / count), high))
    return np.concatenate(parts)


Interaction: TypeAlias = Literal["far field", "off"]
Method: TypeAlias = Literal["complementarity", "least squares"]
Shape: TypeAlias = Literal["sine", "paraboloid"]
SHALLOW = 0.15
"""Contact radius over wavelength up to which two terms of the sine are good to 0.5 %."""

APART = 0.5
"""Contact radius over distance up to which a point force stands for a contact to 2.7 %."""

State: TypeAlias = tuple[CrestSystem, RealArray]
"""The crests that may touch, the highest first, and the squares of their contact radii in m²."""


@dataclass(frozen=True, eq=False, repr=False)
class _Touching(Prediction):
    """A prediction with the largest contact radius over wavelength, and over the distance to the
    next contact, (n,)."""

    slender: RealArray
    near: RealArray


@dataclass(frozen=True, eq=False)
class InteractingCrests(Theory):
    """Crests of depth h_i and wavelength λ_i at their places, each pressed down by the forces on
    the others.

    With A_1 = π² h/λ², A_2 = -π⁴ h/(3 λ⁴) and r_ij the distance of two crests, every touching crest
    obeys

        δ_i = 2 A_1 a_i² + (8/3) A_2 a_i⁴ + Σ_j F_j/(π E* r_(ij)),
        F_i = E* [(8/3) A_1 a_i³ + (64/15) A_2 a_i⁵],

    δ_i the approach of the plane less the depth of the crest below the highest. ``interaction``:
    displacements of point forces between crests (``far field``), or none (``off``). ``method``:
    Newton steps on the touching crests (``complementarity``), or the published form by a library
    optimiser (``least squares``); both solve the same equations. ``shape``: two terms of the
    ``sine``, for approaches up to about the depth, or a ``paraboloid`` of the same radius λ²/(2π²
    h), for any approach.

    InputError if the arrays differ in length, a size is not positive, two crests lie at one place,
    or a choice is unknown.
    """

    E_star: Modulus
    x: Annotated[ArrayLike, Several(Number("length")), "positions of the crests"] = field(repr=False)
    y: Annotated[ArrayLike, Several(Number("length")), "positions of the crests"] = field(repr=False)
    height: Annotated[ArrayLike, Several(Number("length")), "heights of the crests above the mean plane"] = field(
        repr=False
    )
    depth: Annotated[ArrayLike, Several(Number("length", above=0.0)), "crest-to-trough heights"] = field(repr=False)
    wavelength: Annotated[ArrayLike, Several(Number("length", above=0.0)), "wavelengths"] = field(repr=False)
    area: Annotated[float, Number("area", above=0.0), "nominal area"]
    interaction: Annotated[Interaction, Help("elastic interaction of the crests", of="choice")] = "far field"
    method: Annotated[Method, Help("how the equations are solved", of="choice")] = "complementarity"
    shape: Annotated[Shape, Help("shape of the crests", of="choice")] = "sine"
    name: ClassVar[str] = "interacting-crests"
    title: ClassVar[str] = "Greenwood-Williamson with interacting sinusoidal crests"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (
        FEW_CONTACTS,
        Bound(
            "contact radius over wavelength",
            lambda theory, answer: answer.slender,
            0.0,
            SHALLOW,
            "Johnson1985",
            "Two terms of the sine err by more than 0.5 % (at 0.34 they end), paraboloids by more than 2 %.",
        ),
        Bound(
            "contact radius over distance to the next contact",
            lambda theory, answer: answer.near,
            0.0,
            APART,
            "Johnson1985",
            "The displacement by a near contact is more than 3 % larger than that of a point force.",
        ),
    )
    equations: ClassVar[type[CrestSystem]] = CrestSystem

    def __post_init__(self) -> None:
        super().__post_init__()
        highest_first(self, "crests", {"depth": "depth", "wavelength": "wavelength"})

    @classmethod
    def from_roughness(
        cls,
        roughness: Roughness,
        E_star: float,
        *,
        interaction: Interaction = "far field",
        method: Method = "complementarity",
        shape: Shape = "paraboloid",
    ) -> Self:
        """Theory for the summits of a map.

        A map gives the curvatures of crests, not their depth: paraboloids need no more. Sines all
        take the depth 2 sqrt(2) m2/sqrt(m4) of a wave with the mean square slope and curvature of
        the profiles.
        """
        summits = roughness.known(roughness.summits, "its summits", cls.name)
        depth = np.full(summits.count, math.sqrt(8.0 / roughness.m4) * roughness.m2)
        wavelength = math.pi * np.sqrt(2.0 * summits.radius * depth)
        places = (summits.x, summits.y, summits.height)
        return cls(E_star, *places, depth, wavelength, summits.area, interaction, method, shape)

    @property
    def highest(self) -> float:
        """Height of the highest crest in m, where contact begins."""
        return float(np.asarray(self.height)[0])

    def squared_radii(self, approach: float) -> RealArray:
        """Squares of the contact radii in m² of the crests that may touch, the highest first; 0 for
        those lifted off.

        ``approach``: Far-field approach δ > 0 in m from first touch.

        InputError if a crest is pressed beyond the range of its two terms; ConvergenceError if the
        iteration does not converge.
        """
        (_, squares), *_ = self._states(np.array([require.positive(approach, "approach (m)")]))
        return squares

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane: the far-field approach is
        ``highest`` less them."""
        h = curve(separation, "separations (m)")
        return self._predicted(h, self._states(self.highest - h))

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa; the time is that of solving for all touching
        crests at each.

        Two hundred points take 0.2 s with 240 contacts at the highest pressure, 5 s with 960.

        InputError if a pressure is not positive, or presses a crest beyond the range of its two
        terms; ConvergenceError if the iteration does not converge.
        """
        wanted = curve(pressure, "pressures (Pa)", positive=True)
        # spheres without interaction carry the load at a smaller approach; what is lacking grows
        # slowly with the load, so that the last one starts the next. With the method of least
        # squares the radii are solved for once more lighter loads to begin with, and others between
        # those that are too far apart
        path = _graded(np.append(wanted, _FIRST_SHARE * wanted.min()), _LOAD_STEP)
        depths = self.highest - np.asarray(self.height)
        radius = np.asarray(self.wavelength) ** 2 / (2.0 * math.pi**2 * np.asarray(self.depth))
        spheres = DiscreteSummits(self.E_star, self.height, radius, self.area)
        alone = self.highest - spheres.at_pressure(path).separation
        loads, approaches, more = path * self.area / self.E_star, np.empty_like(path), 1.0
        system = self._system(0)
        w = self._system(depths.size, alone=True).isolated(float(alone[0]) - depths)
        states: list[State] = [(system, w)] * path.size
        for n, load in enumerate(loads):
            delta, solved = more * float(alone[n]), 0
            # crests newly in contact are included in the next round
            while solved < (count := int(np.searchsorted(depths, delta, side="left"))):
                if count > system.count:
                    system = self._system(min(count + count // 4 + 16, depths.size))
                part, solved = system.leading(count), count
                delta, w[:count] = solve_load(part, depths[:count], float(load), delta=delta, start=w[:count])
                states[n] = part, w[:count].copy()
            approaches[n], more = delta, delta / float(alone[n])
        found = np.searchsorted(path, wanted)
        reached = approaches[found]
        states = self._states(reached) if self.method == "least squares" else [states[n] for n in found]
        return self._predicted(self.highest - reached, states)

    def validity(self, answer: Prediction, roughness: Roughness | None = None) -> tuple[Limit, ...]:
        """Its ``limits``, for which the crests are solved again."""
        states = self._states(self.highest - answer.separation)
        wavelength = np.asarray(self.wavelength)
        slender = [math.sqrt(float(np.max(w / wavelength[: w.size] ** 2, initial=0.0))) for _, w in states]
        near = [math.sqrt(float(np.max(w * system.nearness(w) ** 2, initial=0.0))) for system, w in states]
        return super().validity(_Touching(**vars(answer), slender=np.array(slender), near=np.array(near)), roughness)

    def _states(self, deltas: RealArray) -> list[State]:
        """The crests that may touch at each approach in m, and the squares of their radii, each
        from those at the one before.
        """
        z, path = np.asarray(self.height), _graded(deltas, _APPROACH_STEP)
        counts = np.searchsorted(-z, path - z[0], side="left")
        system = self._system(int(counts.max()))
        solve = solve_complementarity if self.method == "complementarity" else solve_least_squares
        states: list[State] = []
        last: RealArray = np.empty(0)
        for delta, count in zip(path, counts, strict=True):
            own, part = delta - (z[0] - z[:count]), system.leading(int(count))
            start = part.isolated(own)
            start[: last.size] = last
            last = settled(solve, part, own, start) if count else start
            states.append((part, last))
        return [states[n] for n in np.searchsorted(path, deltas)]

    def _distances(self, x: RealArray, y: RealArray) -> RealArray:
        """Distances of crests at ``x``, ``y`` (n,) in m from each other, (n, n)."""
        return np.asarray(np.hypot(np.subtract.outer(x, x), np.subtract.outer(y, y)))

    def _system(self, count: int, *, alone: bool = False) -> CrestSystem:
        """Equations of the ``count`` highest crests, ``alone`` without what they do to each
        other."""
        x, y, depth, wavelength = (
            np.asarray(column)[:count] for column in (self.x, self.y, self.depth, self.wavelength)
        )
        if alone or self.interaction == "off":
            coupling = np.zeros((count, count))
        else:
            distance = self._distances(x, y)
            distance[np.diag_indices(count)] = np.inf
            if not np.all(distance > 0.0):
                raise InputError("crests must lie at different places, but two of them coincide.")
            coupling = np.divide(1.0 / math.pi, distance, out=distance)  # in place: these arrays are the largest
        A1, A2 = np.array([two_terms(h, wave) for h, wave in zip(depth, wavelength, strict=True)]).reshape(-1, 2).T
        largest = np.square(TWO_TERMS * wavelength)
        if self.shape == "paraboloid":
            A2, largest = np.zeros_like(A2), np.full_like(largest, np.inf)
        return self.equations(A1, A2, largest, coupling)

    def _predicted(self, h: RealArray, states: list[State]) -> Prediction:
        """Prediction from the touching crests at separations ``h`` (n,) in m."""
        sums = np.zeros((2, h.size))
        for n, (system, w) in enumerate(states):
            touching = w > 0.0
            if touching.any():
                rates = _solved(system.jacobian(w, touching), np.ones(int(touching.sum())))
                sums[:, n] = system.loads(w).sum(), system.load_slope(w)[touching] @ rates
        sums *= self.E_star / self.area
        return prediction(
            sums[0],
            area_fraction=math.pi * np.array([w.sum() for _, w in states]) / self.area,
            contact_density=np.array([np.count_nonzero(w) for _, w in states]) / self.area,
            separation=h,
            stiffness=sums[1],
        )
