"""Surfaces that neither stick nor yield: roughness and designed caps under a film of liquid."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Force, Fraction, HardnessValue, Number, Positive
from ..ask import Way, asked
from ..protocol import Bound, Modulus, Theory, curve
from ..rough.greenwood_williamson import GreenwoodWilliamson
from .meniscus import film_force
from .summits import ContactAngle, FilmThickness, StatisticalMeniscus, SurfaceTension

ELASTIC_INDEX = 0.6
"""Plasticity index of Greenwood & Williamson (1966) below which summits are elastic at any
realistic load."""

Closure = Literal["product", "count"]

_ROUGHEST, _SMOOTHEST, _PER_DECADE = 1e3, 1e-4, 20
"""Standard deviations that are looked at, over the film and the wanted height, and steps a
decade."""


_RUN_AWAY = 1e6
"""Meniscus force over the load of menisci that run away."""


@dataclass(frozen=True, eq=False, repr=False)
class WindowAnswer(Tabled):
    """For summit radii in m: the smallest and the largest standard deviation of summit heights
    (m), arrays (n,), and whether the one is below the other (1, else 0)."""

    radius: RealArray
    smallest: RealArray
    largest: RealArray
    feasible: RealArray


@dataclass(frozen=True)
class RoughnessWindow(Theory):
    """Standard deviations of summit heights at which menisci pull by at most the share φ of the
    load, and summits stay elastic.

    With F_m of ``statistical-meniscus`` under the load W and Greenwood and Williamson's index
    ψ = 0.6:

        F_m(σ_(min), R, η)/W = φ,  σ_(max) = R (0.6 H/E*)².

    The density η is closed by η R σ = const, or by a given number of summits on the area. Where
    even all summits in the film pull by less than φ W, σ_min is zero. Menisci feed back: they add
    to the load of the summits.

    Examples
    --------
    >>> film = {"surface_tension": 0.025, "film_thickness": 1e-9}
    >>> window = RoughnessWindow(110e9, hardness=10e9, **film, load=0.1, area=1e-6, share=0.1)
    >>> answer = window.at_radius([1e-6, 10e-6])
    >>> print((answer.smallest * 1e9).round(2), (answer.largest * 1e9).round(2), "nm")
    [4.13 6.71] [ 2.98 29.75] nm
    >>> f"{window.critical_radius * 1e6:.2f} µm"
    '1.50 µm'
    """

    E_star: Modulus
    hardness: Annotated[HardnessValue, Help("hardness H of the softer body", of="bodies")]
    surface_tension: SurfaceTension
    film_thickness: FilmThickness
    load: Annotated[Force, Help("normal load W", of="bodies")]
    area: Annotated[float, Number("area", above=0.0), Help("nominal area", of="bodies")]
    share: Annotated[Positive, Help("largest meniscus force over the load φ", of="choice")] = 0.1
    contact_angle: ContactAngle = 0.0
    closure: Annotated[Closure, Help("what stays as the roughness changes: ηRσ, or the count", of="choice")] = "product"
    product: Annotated[Positive, Help("density times radius times deviation ηRσ", of="choice")] = 0.05
    count: Annotated[Positive, Help("number of summits on the nominal area", of="choice")] = 10000.0
    name: ClassVar[str] = "roughness-window"
    title: ClassVar[str] = "Roughness between stiction and yield"
    citation_keys: ClassVar[tuple[str, ...]] = ("Gao1995", "Chilamakuri1998", "Bhushan1998", "Greenwood1966")
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("critical_radius", "m", "summit radius at which the window opens"),
        Quantity("critical_deviation", "m", "standard deviation of summit heights there"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("radius", "m", "radius R of the summits"),
            "at_radius",
            (
                Quantity("smallest", "m", "standard deviation below which menisci pull by more than the share"),
                Quantity("largest", "m", "standard deviation above which summits yield"),
                Quantity("feasible", "1", "1 where the one is below the other"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        film_force(1.0, self.surface_tension, self.contact_angle)

    def at_radius(self, radius: ArrayLike) -> WindowAnswer:
        """Window for summits of the ``radius`` (n,) in m, > 0."""
        R = curve(radius, "radii of summits (m)", positive=True)
        smallest = np.array([self._smallest(float(each)) for each in R])
        largest = self._largest(R)
        return WindowAnswer(R, smallest, largest, (smallest <= largest).astype(float))

    @property
    def critical_radius(self) -> float:
        """Radius in m from which on there is a roughness that neither sticks nor yields."""
        return self._critical[0]

    @property
    def critical_deviation(self) -> float:
        """The only standard deviation there, in m."""
        return self._critical[1]

    @cached_property
    def _critical(self) -> tuple[float, float]:
        """Where the menisci pull by the share on the line of the largest deviations: the largest
        radius, beyond which the window stays open."""

        def excess(log_radius: float) -> float:
            R = math.exp(log_radius)
            return self._excess(float(self._largest(np.array([R]))[0]), R)

        found = math.exp(self._outermost(excess, self.film_thickness * (self.E_star / self.hardness) ** 2))
        return found, float(self._largest(np.array([found]))[0])

    def _largest(self, radius: RealArray) -> RealArray:
        return np.asarray(radius * (ELASTIC_INDEX * self.hardness / self.E_star) ** 2)

    def _smallest(self, radius: float) -> float:
        all_wet = self.count * film_force(radius, self.surface_tension, self.contact_angle)
        if self.closure == "count" and all_wet <= self.share * self.load:
            return 0.0
        return math.exp(self._outermost(lambda log: self._excess(math.exp(log), radius), self.film_thickness))

    def _excess(self, deviation: float, radius: float) -> float:
        """Meniscus force over the load less the share φ; very large for menisci that run away."""
        density = self.count / self.area if self.closure == "count" else self.product / (radius * deviation)
        summits = GreenwoodWilliamson(self.E_star, density, radius, deviation)
        film = StatisticalMeniscus(summits, self.surface_tension, self.film_thickness, self.contact_angle)
        try:
            found = film.at_pressure(self.load / self.area)
        except NoSolutionError:
            return _RUN_AWAY
        return float(found.meniscus_pressure[0] / found.pressure[0]) - self.share

    def _outermost(self, excess: Callable[[float], float], unit: float) -> float:
        """Logarithm of the largest argument at which ``excess`` is zero, sought down from the rough
        side in ``unit``.

        NoSolutionError if there is none.
        """
        from scipy.optimize import brentq

        steps = np.linspace(
            math.log(_ROUGHEST), math.log(_SMOOTHEST), 1 + round(_PER_DECADE * math.log10(_ROUGHEST / _SMOOTHEST))
        ) + math.log(unit)
        high = float(steps[0])
        if excess(high) > 0.0:
            raise NoSolutionError(
                f"share of the load that menisci may pull with must be larger than {self.share:g} for any roughness up "
                f"to {math.exp(high):.3g} m to do, but is not. Allow a larger share, or take a thinner film."
            )
        for low in map(float, steps[1:]):
            value = excess(low)
            if value > 0.0:
                return float(brentq(excess, low, high, xtol=1e-15, rtol=1e-14))
            high = low
        raise NoSolutionError(
            f"share of the load that menisci may pull with must be smaller than {self.share:g} for there to be a "
            f"smallest roughness, but is not: none down to {math.exp(high):.3g} m makes them pull by so much."
        )


@dataclass(frozen=True, eq=False, repr=False)
class CapsAnswer(Tabled):
    """Equal caps of some ``radius`` (m), arrays of one shape: the least number of them (not whole)
    dry and with menisci, the whole ``count``, and with this ``meniscus_force`` (N) and its share of
    the load, ``contact_area`` (m²), ``approach`` (m), least ``height`` of the caps (m), and
    ``safety`` on the load of first yield."""

    radius: RealArray
    least_dry: RealArray
    least: RealArray
    count: RealArray
    meniscus_force: RealArray
    force_ratio: RealArray
    contact_area: RealArray
    approach: RealArray
    height: RealArray
    safety: RealArray


_CAPS = (
    Quantity("least_dry", "1", "least number of caps without menisci"),
    Quantity("least", "1", "least number of caps"),
    Quantity("count", "1", "number of caps"),
    Quantity("meniscus_force", "N", "meniscus force"),
    Quantity("force_ratio", "1", "meniscus force over load"),
    Quantity("contact_area", "m^2", "contact area"),
    Quantity("approach", "m", "approach of the caps"),
    Quantity("height", "m", "least height of the caps"),
    Quantity("safety", "1", "load of first yield over that of a cap"),
)


@dataclass(frozen=True)
class DesignedCaps(Theory):
    """N equal caps of radius R that carry the load W without yield, taller than film and approach.

    A cap yields first at the mean pressure k H; with the safety S on its load:

        N ≥ W/(W_c/S - f_m),  W_c = 9 π³ R² (k H)³/(16 (E*)²),  f_m = 2 π R γ (1 + cos θ).

    For small f_m the meniscus force over the load is 32 S γ (1 + cos θ) (E*)²/(9 π² R (k H)³): the
    larger the caps, the less they stick, down to the three on which a body stands. The number is
    rounded up. Bhushan's 1/3 for k needs half as many caps more.

    Examples
    --------
    >>> film = {"surface_tension": 0.025, "film_thickness": 2e-9}
    >>> caps = DesignedCaps(110e9, hardness=10e9, load=0.05, **film, safety_asked=3.0)
    >>> answer = caps.at_radius([5e-6])
    >>> f"{answer.count.item():.0f} caps of {answer.height.item() * 1e9:.1f} nm at least"
    '75 caps of 18.1 nm at least'
    >>> f"F_m/W = {answer.force_ratio.item():.5f}"
    'F_m/W = 0.00236'
    """

    E_star: Modulus
    hardness: Annotated[HardnessValue, Help("hardness H of the softer body", of="bodies")]
    load: Annotated[Force, Help("normal load W", of="bodies")]
    surface_tension: SurfaceTension
    film_thickness: FilmThickness
    safety_asked: Annotated[Positive, Help("safety S on the load of first yield", of="choice")] = 2.0
    contact_angle: ContactAngle = 0.0
    yield_share: Annotated[Fraction, Help("mean pressure at first yield over the hardness k", of="bodies")] = 0.382
    name: ClassVar[str] = "designed-caps"
    title: ClassVar[str] = "Designed caps that neither stick nor yield"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Gao1995", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (
        Way(asked("radius", "m", "radius R of the caps"), "at_radius", _CAPS),
        Way(
            asked("radius", "m", "radius R of the caps"),
            "of_count",
            _CAPS,
            (asked("count", "1", "number of caps"),),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        film_force(1.0, self.surface_tension, self.contact_angle)

    def at_radius(self, radius: ArrayLike) -> CapsAnswer:
        """The least whole number of caps of the ``radius`` (n,) in m, > 0.

        NoSolutionError if menisci alone make caps of a radius yield.
        """
        R = curve(radius, "radii of caps (m)", positive=True)
        _, least = self._least(R)
        if not np.isfinite(least).all():
            worst = float(R[~np.isfinite(least)].max())
            raise NoSolutionError(
                f"radius of the caps (m) must be larger than {worst:g} for their menisci alone not to make them yield, "
                "but is not. Take larger caps, or a smaller safety."
            )
        return self._answer(R, np.ceil(least * (1.0 - 1e-12)))

    def of_count(self, radius: ArrayLike, count: ArrayLike) -> CapsAnswer:
        """So many caps (``count``, >= 1) of the ``radius`` (n,) in m, > 0; their ``safety`` tells
        whether they do."""
        R, N = np.broadcast_arrays(
            curve(radius, "radii of caps (m)", positive=True), curve(count, "numbers of caps", positive=True)
        )
        return self._answer(R, N)

    def _least(self, R: RealArray) -> tuple[RealArray, RealArray]:
        """Least numbers, dry and with menisci; infinite where there is none."""
        room = self._yield_load(R) / self.safety_asked
        left = room - self._pull(R)
        return self.load / room, np.where(left > 0.0, self.load / np.where(left > 0.0, left, 1.0), np.inf)

    def _yield_load(self, R: RealArray) -> RealArray:
        pressure = self.yield_share * self.hardness
        return np.asarray(9.0 * math.pi**3 * R**2 * pressure**3 / (16.0 * self.E_star**2))

    def _pull(self, R: RealArray) -> RealArray:
        return np.asarray(R * film_force(1.0, self.surface_tension, self.contact_angle))

    def _answer(self, R: RealArray, N: RealArray) -> CapsAnswer:
        pull = N * self._pull(R)
        each = (self.load + pull) / N
        approach = (9.0 * each**2 / (16.0 * R * self.E_star**2)) ** (1.0 / 3.0)
        return CapsAnswer(
            R,
            *self._least(R),
            np.asarray(N, dtype=float),
            pull,
            pull / self.load,
            math.pi * N * R * approach,
            approach,
            self.film_thickness + approach,
            self._yield_load(R) / each,
        )
