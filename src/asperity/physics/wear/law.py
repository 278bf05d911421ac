"""Laws of wear: the depth that a body loses at a point by the pressure and sliding that it has
borne."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...solids.elastic import Elastic
from ...solids.layers import Body, Layered
from .third_body import Debris


@dataclass(frozen=True, eq=False)
class WearLaw:
    """Worn depth of one body as a function of the dose, the pressure that a point has borne times
    the distance slid under it.

    The depth is linear in the dose as long as one material is at the surface (Archard 1953, local
    form):

    dh/ds = k_i p

    with the wear coefficient k_i of the material of the stage that the worn depth is in. Because
    the depth depends on the dose alone, a coating that is worn through within a step is resolved
    inside it.

    Parameters
    ----------
    stages
        Pairs (thickness in m, wear coefficient in m²/N) from the surface down. The thickness of the
        last is infinite. A coefficient is > 0, that of the last >= 0.
    threshold_pressure
        Pa, >= 0: only the pressure above it wears.
    threshold_dose
        Pa m, >= 0: dose that a point bears before it begins to wear.
    factor
        Number or array (nx, ny), > 0, by which all coefficients are multiplied at each point.

    Raises
    ------
    InputError
        If a value is out of its range, or the last stage has an end.
    """

    stages: tuple[tuple[float, float], ...]
    threshold_pressure: float = 0.0
    threshold_dose: float = 0.0
    factor: float | RealArray = 1.0
    citation_keys: ClassVar[tuple[str, ...]] = ("Archard1953",)

    def __post_init__(self) -> None:
        stages = tuple((float(thickness), float(coefficient)) for thickness, coefficient in self.stages)
        if not stages or stages[-1][0] != math.inf:
            raise InputError(
                f"stages of a law of wear must end with one of infinite thickness, but are {stages}. "
                "Add (inf, coefficient) of what lies under all layers."
            )
        for number, (thickness, coefficient) in enumerate(stages):
            if number < len(stages) - 1:
                require.positive(thickness, "thickness of a layer that wears (m)")
                require.positive(coefficient, "wear coefficient (m²/N)")
            else:
                require.not_negative(coefficient, "wear coefficient (m²/N)")
        require.not_negative(self.threshold_pressure, "pressure from which on a body wears (Pa)")
        require.not_negative(self.threshold_dose, "dose from which on a body wears (Pa m)")
        factor = np.asarray(self.factor, dtype=float)
        if factor.ndim not in (0, 2) or not (np.isfinite(factor).all() and factor.min() > 0.0):
            worst = float(factor.min()) if factor.size else math.nan
            raise InputError(
                "factor on a wear coefficient must be a positive number or an (nx, ny) array of them, but has "
                f"{factor.ndim} dimension(s) and the smallest value {worst:g}."
            )
        object.__setattr__(self, "stages", stages)
        object.__setattr__(self, "factor", float(factor) if factor.ndim == 0 else factor)

    @cached_property
    def _knots(self) -> tuple[RealArray, RealArray, RealArray]:
        """Effective doses (Pa m) and depths (m) at which stages begin, and their coefficients."""
        thickness, coefficients = (np.array(values) for values in zip(*self.stages, strict=True))
        spans = thickness[:-1] / coefficients[:-1]
        doses, depths = (np.concatenate([[0.0], np.cumsum(values)]) for values in (spans, thickness[:-1]))
        return doses, depths, coefficients

    def _effective(self, dose: RealArray) -> RealArray:
        beyond = np.maximum(dose - self.threshold_dose, 0.0) if self.threshold_dose else dose
        return np.asarray(beyond if isinstance(self.factor, float) and self.factor == 1.0 else self.factor * beyond)

    def stage(self, dose: RealArray) -> NDArray[np.intp]:
        """Number of the stage from 0 that points of this ``dose`` (Pa m) are in."""
        found: NDArray[np.intp] = np.searchsorted(self._knots[0], self._effective(np.asarray(dose)), side="right") - 1
        return found

    def depth(self, dose: RealArray) -> RealArray:
        """Worn depth (m) after a ``dose`` (Pa m) of any shape, or of (nx, ny) where the factor is a
        map."""
        doses, depths, coefficients = self._knots
        effective = self._effective(np.asarray(dose))
        if len(doses) == 1:
            return np.asarray(coefficients[0] * effective)
        if len(doses) == 2:  # twice as fast as to look up stages
            upper, lower = np.minimum(effective, doses[1]), np.maximum(effective - doses[1], 0.0)
            return np.asarray(coefficients[0] * upper + coefficients[1] * lower)
        stage = np.searchsorted(doses, effective, side="right") - 1
        return np.asarray(depths[stage] + coefficients[stage] * (effective - doses[stage]))

    def slope(self, dose: RealArray) -> RealArray:
        """Depth per dose (m²/N) at a ``dose`` (Pa m): the wear coefficient of what is at the
        surface."""
        dose = np.asarray(dose)
        found = self._knots[2][self.stage(dose)] * self.factor
        return np.asarray(found if self.threshold_dose == 0.0 else np.where(dose >= self.threshold_dose, found, 0.0))

    def dose_at(self, depth: float) -> float:
        """Dose (Pa m) after which the worn depth is ``depth`` (m, > 0); infinite where it is never
        reached.

        InputError if the factor is a map.
        """
        require.positive(depth, "worn depth (m)")
        if isinstance(self.factor, np.ndarray):
            raise InputError("factor on the wear coefficient must be a number for the dose at a depth, but is a map.")
        doses, depths, coefficients = self._knots
        stage = int(np.searchsorted(depths, depth, side="left")) - 1
        beyond = depth - float(depths[stage])
        if coefficients[stage] == 0.0:
            return math.inf
        return self.threshold_dose + (float(doses[stage]) + beyond / float(coefficients[stage])) / self.factor

    @property
    def linear(self) -> bool:
        """Whether the depth is a multiple of the dose."""
        return len(self.stages) == 1 and self.threshold_dose == 0.0 and self.threshold_pressure == 0.0

    @property
    def dose_of_layers(self) -> float | RealArray:
        """Dose (Pa m) after which the last layer is worn through, a number or a map (nx, ny)."""
        return self.threshold_dose + float(self._knots[0][-1]) / self.factor

    @property
    def thickness(self) -> float:
        """Thickness (m) of all layers above the last material; zero where there is one alone."""
        return float(self._knots[1][-1])

    @property
    def largest(self) -> float:
        """Largest wear coefficient (m²/N) of all stages and points."""
        return float(self._knots[2].max() * np.max(self.factor))


def archard(
    coefficient: float,
    *,
    layers: Sequence[tuple[float, float]] = (),
    threshold_pressure: float = 0.0,
    factor: float | RealArray = 1.0,
) -> WearLaw:
    """Archard's law, local: dh/ds = k p.

    Parameters
    ----------
    coefficient
        k in m²/N, >= 0: volume per load and distance, K/H with Archard's dimensionless coefficient
        K and the hardness H. 1 mm³/(N m) is 1e-9 m²/N. Under ``layers`` it is that of the base.
    layers
        Pairs (thickness in m, coefficient in m²/N) of coatings, or of depths that wear differently,
        from the surface down.
    threshold_pressure
        Pa: only the pressure above it wears.
    factor
        Number or map (nx, ny) by which coefficients are multiplied.

    Raises
    ------
    InputError
        If a value is out of its range.
    """
    stages = (*((thickness, k) for thickness, k in layers), (math.inf, coefficient))
    return WearLaw(stages, threshold_pressure=threshold_pressure, factor=factor)


def dissipated_energy(
    coefficient: float,
    friction: float,
    *,
    threshold: float = 0.0,
    layers: Sequence[tuple[float, float]] = (),
    factor: float | RealArray = 1.0,
) -> WearLaw:
    """Wear by dissipated energy (Fouvry et al. 2003): the volume grows with the energy that
    friction turns into heat beyond a threshold, V = α (E - E_th).

    Locally, h = α (μ ∫ p ds - e_th). At a constant friction coefficient this is Archard's law with
    k = α μ, but for the threshold.

    Parameters
    ----------
    coefficient
        α in m³/J, >= 0.
    friction
        Friction coefficient μ, > 0.
    threshold
        e_th in J/m², >= 0: energy per area before a point begins to wear.
    layers
        Pairs (thickness in m, α in m³/J) of coatings from the surface down.
    factor
        Number or map (nx, ny) by which coefficients are multiplied.

    Raises
    ------
    InputError
        If a value is out of its range.
    """
    require.positive(friction, "friction coefficient of a law of wear by energy")
    require.not_negative(threshold, "energy per area from which on a body wears (J/m²)")
    stages = (*((thickness, friction * alpha) for thickness, alpha in layers), (math.inf, friction * coefficient))
    return WearLaw(stages, threshold_dose=threshold / friction, factor=factor)


@dataclass(frozen=True, eq=False)
class Sides:
    """Which body wears by which law, and how it takes part.

    Parameters
    ----------
    body, counter
        Law of the body under the surface, and of its counter body; None for one that does not
        wear.
    body_track, counter_track
        Length (m) of the track along x that the body is to the other, which runs over each of its
        points once every so many metres, as a disk under a pin; None where all points slide all the
        time. A track wears alike all along: at each y by the mean along x of the pressure, over the
        share of the track that the contact covers.
    debris
        Share of what is worn away that stays in the gap, and its modulus: ``Debris(share,
        modulus)``; None where all of it leaves.

    Raises
    ------
    InputError
        If no body wears, a track is no law of its own, both are tracks, or its coefficient is a
        map.
    """

    body: WearLaw | None = None
    counter: WearLaw | None = None
    body_track: float | None = None
    counter_track: float | None = None
    debris: Debris | None = None

    def __post_init__(self) -> None:
        for name in ("body", "counter"):
            law, track = getattr(self, name), getattr(self, f"{name}_track")
            if law is not None:
                require.instance(law, WearLaw, f"law of wear of the {name}", "Write archard(1e-15).")
            if track is None:
                continue
            require.positive(track, f"length of the track of the {name} (m)")
            if law is None or isinstance(law.factor, np.ndarray) or law.threshold_pressure:
                raise InputError(
                    f"{name} that is a track must have a law of wear of one coefficient without a threshold of the "
                    f"pressure, but has {law!r}."
                )
        if self.body is None and self.counter is None:
            raise InputError(
                "sides of a contact that wears must hold a law of wear, but hold none. Give body=archard(…)."
            )
        if self.debris is not None:
            require.instance(self.debris, Debris, "debris of a contact that wears", "Write Debris(0.5, 10e9).")
            if self.body_track is not None or self.counter_track is not None:
                raise InputError(
                    "debris of a contact that wears must be without a track, which carries it away, but one is given."
                )
        if self.body_track is not None and self.counter_track is not None:
            raise InputError(
                "one body at most can be a track, but both are. A point of one of them must be in contact all the time."
            )

    @property
    def laws(self) -> tuple[WearLaw, ...]:
        """The laws of the bodies that wear."""
        return tuple(law for law in (self.body, self.counter) if law is not None)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the laws."""
        return tuple(sorted({key for law in self.laws for key in law.citation_keys}))


def of_layers(body: Body) -> WearLaw:
    """Archard's law with the wear coefficients of the materials of ``body``, from the surface down.

    Raises
    ------
    InputError
        If a material has no wear coefficient, or the body is rigid.
    """
    reduced = body.reduced if isinstance(body, Layered) else Layered((), body) if isinstance(body, Elastic) else None
    if reduced is None or not isinstance(reduced.base, Elastic):
        raise InputError(
            "body whose wear coefficients are asked for must be elastic down to its base, but is "
            f"{type(body).__name__}. Give archard(coefficient) instead."
        )
    parts = [(layer.thickness, layer.material) for layer in reduced.layers] + [(math.inf, reduced.base)]
    for _, material in parts:
        if math.isnan(material.strength.wear_coefficient):
            raise InputError(
                f"wear coefficient of {material.name or 'a material'} must be known, but is not: it depends on the "
                "counter body and its surroundings. Measure it and give it ({wear_coefficient}), or give a law."
            )
    return WearLaw(tuple((thickness, material.strength.wear_coefficient) for thickness, material in parts))
