"""Greenwood & Williamson on the summits of a map, sinusoidal and pressing each other down."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .crest_system import (
    CrestSystem,
    graded_approaches,
    graded_loads,
    settled,
    solve_complementarity,
    solve_least_squares,
    solve_load,
)
from .discrete_summits import DiscreteSummits
from .limits import area_limit
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .roughness import Roughness
from .sinusoidal_asperity import TWO_TERMS, two_terms

INTERACTIONS = ("far field", "off", "printed")
METHODS = ("complementarity", "least squares")
SHAPES = ("sine", "paraboloid")
SHALLOW = 0.15
"""Contact radius over wavelength up to which two terms of the sine are good to 0.5 %."""

APART = 0.5
"""Contact radius over distance up to which a point force stands for a contact to 2.7 %."""

State: TypeAlias = tuple[CrestSystem, RealArray]
"""The crests that may touch, the highest first, and the squares of their contact radii in m²."""


@dataclass(frozen=True, eq=False)
class InteractingCrests:
    """Crests of depth h_i and wavelength λ_i at their places, each pressed down by the forces on the others.

    Parameters
    ----------
    E_star
        Contact modulus in Pa.
    x, y
        (n,) positions in m; the surface is not repeated.
    height
        (n,) heights of the crests above the mean plane of the surface in m.
    depth, wavelength
        (n,) crest-to-trough heights and wavelengths in m; the radius of a crest is λ²/(2π² h).
    area
        Nominal area in m².
    interaction
        ``"far field"``: displacements of point forces between crests; ``"off"``: none; ``"printed"``: the published
        system, which adds the displacement of each crest by its own force once more and loses two fifths of the load.
    method
        ``"complementarity"``: Newton steps on the touching crests; ``"least squares"``: the published form, by a library
        optimiser. Both solve the same equations.
    shape
        ``"sine"``: two terms of the sine, for approaches up to about the depth; ``"paraboloid"``: spheres of the same
        radius, for any approach.

    Raises
    ------
    InputError
        If the arrays differ in length, a size is not positive, two crests lie at one place, or a choice is unknown.
    """

    E_star: float
    x: ArrayLike = field(repr=False)
    y: ArrayLike = field(repr=False)
    height: ArrayLike = field(repr=False)
    depth: ArrayLike = field(repr=False)
    wavelength: ArrayLike = field(repr=False)
    area: float
    interaction: str = "far field"
    method: str = "complementarity"
    shape: str = "sine"
    name: ClassVar[str] = "interacting-crests"
    title: ClassVar[str] = "Greenwood-Williamson with interacting sinusoidal crests"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("x", "m", "positions of the crests", many=True),
        Input("y", "m", "positions of the crests", many=True),
        Input("height", "m", "heights of the crests above the mean plane", many=True),
        Input("depth", "m", "crest-to-trough heights", many=True),
        Input("wavelength", "m", "wavelengths", many=True),
        Input("area", "m^2", "nominal area"),
        Input(
            "interaction", "", "how crests feel each other", "choice", "far field", tuple((i, i) for i in INTERACTIONS)
        ),
        Input(
            "method", "", "how the equations are solved", "choice", "complementarity", tuple((m, m) for m in METHODS)
        ),
        Input("shape", "", "shape of the crests", "choice", "sine", tuple((s, s) for s in SHAPES)),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.area, "nominal area (m^2)")
        require.one_of(self.interaction, INTERACTIONS, "interaction of crests")
        require.one_of(self.method, METHODS, "method for interacting crests")
        require.one_of(self.shape, SHAPES, "shape of crests")
        columns = {name: curve(getattr(self, name), f"{name} of crests (m)") for name in ("x", "y", "height")}
        for name in ("depth", "wavelength"):
            columns[name] = curve(getattr(self, name), f"{name} of crests (m)", positive=True)
        if len({column.size for column in columns.values()}) != 1:
            sizes = ", ".join(f"{name} {column.size}" for name, column in columns.items())
            raise InputError(f"arrays of crests must have the same length, but have {sizes}.")
        order = np.argsort(-columns["height"], kind="stable")
        for name, column in columns.items():
            object.__setattr__(self, name, column[order])

    @classmethod
    def from_roughness(
        cls,
        roughness: Roughness,
        E_star: float,
        *,
        interaction: str = "far field",
        method: str = "complementarity",
        shape: str = "paraboloid",
    ) -> Self:
        """Theory for the summits of a map.

        A map gives the curvatures of crests, not their depth: paraboloids need no more. Sines all take the depth
        2 sqrt(2) m2/sqrt(m4) of a wave with the mean square slope and curvature of the profiles.
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
        """Squares of the contact radii in m² of the crests that may touch, the highest first; 0 for those lifted off.

        Parameters
        ----------
        approach
            Far-field approach δ > 0 in m from first touch.

        Raises
        ------
        InputError
            If a crest is pressed beyond the range of its two terms.
        ConvergenceError
            If the crests do not settle.
        """
        (_, squares), *_ = self._states(np.array([require.positive(approach, "approach (m)")]))
        return squares

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane: the far-field approach is ``highest`` less them."""
        h = curve(separation, "separations (m)")
        return self._predicted(h, self._states(self.highest - h))

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa; the time is that of solving for all touching crests at each.

        Two hundred points take 0.2 s with 240 contacts at the highest pressure, 5 s with 960.

        Raises
        ------
        InputError
            If a pressure is not positive, or presses a crest beyond the range of its two terms.
        ConvergenceError
            If the crests do not settle.
        """
        wanted = curve(pressure, "pressures (Pa)", positive=True)
        approaches, states = self._loaded(wanted)
        return self._predicted(self.highest - approaches, states)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts, small against their wavelength and against their distance."""
        states = self._states(self.highest - prediction.separation)
        wavelength = np.asarray(self.wavelength)
        slender = [math.sqrt(float(np.max(w / wavelength[: w.size] ** 2, initial=0.0))) for _, w in states]
        near = [math.sqrt(float(np.max(w * system.nearness(w) ** 2, initial=0.0))) for system, w in states]
        return (
            area_limit(prediction),
            Limit(
                "contact radius over wavelength",
                np.array(slender),
                0.0,
                SHALLOW,
                citation="Johnson1985",
                message="Two terms of the sine err by more than 0.5 % (at 0.34 they end), paraboloids by more than 2 %.",
            ),
            Limit(
                "contact radius over distance to the next contact",
                np.array(near),
                0.0,
                APART,
                citation="Johnson1985",
                message="The displacement by a near contact is more than 3 % larger than that of a point force.",
            ),
        )

    def _loaded(self, pressure: RealArray) -> tuple[RealArray, list[State]]:
        """Approaches δ in m at which the crests carry ``pressure`` (n,) in Pa, and the crests there.

        Spheres without interaction carry it at a smaller approach; what is lacking grows slowly with the load, so that
        the last one starts the next. With the method of least squares the radii are solved for once more.
        """
        path = graded_loads(pressure)
        depths = self.highest - np.asarray(self.height)
        spheres = DiscreteSummits(
            self.E_star, self.height, np.asarray(self.wavelength) ** 2 / self._twice_depth, self.area
        )
        alone = self.highest - spheres.at_pressure(path).separation
        loads, approaches, more = path * self.area / self.E_star, np.empty_like(path), 1.0
        system = self._system(0)
        w = self._system(depths.size, alone=True).isolated(float(alone[0]) - depths)
        states: list[State] = [(system, w)] * path.size
        for n, load in enumerate(loads):
            delta, solved = more * float(alone[n]), 0
            # crests that the approach uncovers take part in the next round
            while solved < (count := int(np.searchsorted(depths, delta, side="left"))):
                if count > system.count:
                    system = self._system(min(count + count // 4 + 16, depths.size))
                part, solved = system.leading(count), count
                delta, w[:count] = solve_load(part, depths[:count], float(load), delta=delta, start=w[:count])
                states[n] = part, w[:count].copy()
            approaches[n], more = delta, delta / float(alone[n])
        found = np.searchsorted(path, pressure)
        wanted = approaches[found]
        return wanted, self._states(wanted) if self.method == "least squares" else [states[n] for n in found]

    @property
    def _twice_depth(self) -> RealArray:
        """2π² h in m, the square of the wavelength over the radius."""
        values: RealArray = 2.0 * math.pi**2 * np.asarray(self.depth)
        return values

    def _states(self, deltas: RealArray) -> list[State]:
        """The crests that may touch at each approach in m, and the squares of their radii, each from those at the one before."""
        z, path = np.asarray(self.height), graded_approaches(deltas)
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

    def _system(self, count: int, *, alone: bool = False) -> CrestSystem:
        """Equations of the ``count`` highest crests, ``alone`` without what they do to each other."""
        x, y, depth, wavelength = (
            np.asarray(column)[:count] for column in (self.x, self.y, self.depth, self.wavelength)
        )
        if alone or self.interaction == "off":
            coupling = np.zeros((count, count))
        else:
            distance = np.hypot(np.subtract.outer(x, x), np.subtract.outer(y, y))
            distance[np.diag_indices(count)] = np.inf
            if not np.all(distance > 0.0):
                raise InputError("crests must lie at different places, but two of them coincide.")
            coupling = np.divide(1.0 / math.pi, distance, out=distance)  # in place: these arrays are the largest
        A1, A2 = np.array([two_terms(h, wave) for h, wave in zip(depth, wavelength, strict=True)]).reshape(-1, 2).T
        largest = np.square(TWO_TERMS * wavelength)
        if self.shape == "paraboloid":
            A2, largest = np.zeros_like(A2), np.full_like(largest, np.inf)
        return CrestSystem(A1, A2, largest, coupling, self_term=self.interaction == "printed")

    def _predicted(self, h: RealArray, states: list[State]) -> Prediction:
        """Prediction from the touching crests at separations ``h`` (n,) in m."""
        sums = np.zeros((2, h.size))
        for n, (system, w) in enumerate(states):
            touching = w > 0.0
            if touching.any():
                rates = np.linalg.solve(system.jacobian(w, touching), np.ones(int(touching.sum())))
                sums[:, n] = system.loads(w).sum(), system.load_slope(w)[touching] @ rates
        sums *= self.E_star / self.area
        return prediction(
            sums[0],
            area_fraction=math.pi * np.array([w.sum() for _, w in states]) / self.area,
            contact_density=np.array([np.count_nonzero(w) for _, w in states]) / self.area,
            separation=h,
            stiffness=sums[1],
        )
