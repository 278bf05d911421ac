"""Linear viscoelastic solids: an elastic response at the first instant, and what of it relaxes in
time."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import ComplexArray, RealArray
from ..core.errors import InputError
from .elastic import Elastic
from .relaxation import NEGLIGIBLE, Creep, Relaxation, Terms, not_negative, require_terms

_TOO_MUCH = 1e-12
"""Rounding by which the shares that relax may add up to more than one."""


@dataclass(frozen=True)
class WilliamsLandelFerry:
    """Shift of all relaxation times with temperature, log10 a_T = -c1 (T - T_ref)/(c2 + T - T_ref)
    (Williams, Landel & Ferry 1955).

    ``reference``: T_ref in K, > 0, at which the times of the solid hold; ``c1``: > 0; ``c2``: in
    K, > 0.

    InputError if a value is outside its range.
    """

    reference: float
    c1: float
    c2: float
    name: ClassVar[str] = "WLF"
    citation_keys: ClassVar[tuple[str, ...]] = ("Williams1955",)

    def __post_init__(self) -> None:
        require.positive(self.reference, "reference temperature (K)")
        require.positive(self.c1, "constant c1 of the shift with temperature")
        require.positive(self.c2, "constant c2 of the shift with temperature (K)")

    def factor(self, temperature: float) -> float:
        """a_T at ``temperature`` (K), above T_ref - c2. InputError if it is not."""
        require.between(temperature, max(self.reference - self.c2, 0.0), math.inf, "temperature (K)")
        difference = temperature - self.reference
        return _power(-self.c1 * difference / (self.c2 + difference) * math.log(10.0))

    def seen_from(self, temperature: float) -> WilliamsLandelFerry:
        """The same shift with ``temperature`` (K) as reference: c2 grows by the difference, c1 c2
        stays."""
        c2 = self.c2 + temperature - self.reference
        return WilliamsLandelFerry(float(temperature), self.c1 * self.c2 / c2, c2)


@dataclass(frozen=True)
class Arrhenius:
    """Shift of all relaxation times with temperature, ln a_T = Q/R (1/T - 1/T_ref) (Ferry 1980).

    ``reference``: T_ref in K, > 0, at which the times of the solid hold; ``activation_energy``: Q
    in J/mol, > 0.

    InputError if a value is outside its range.
    """

    reference: float
    activation_energy: float
    name: ClassVar[str] = "Arrhenius"
    citation_keys: ClassVar[tuple[str, ...]] = ("Ferry1980",)

    def __post_init__(self) -> None:
        require.positive(self.reference, "reference temperature (K)")
        require.positive(self.activation_energy, "activation energy (J/mol)")

    def factor(self, temperature: float) -> float:
        """a_T at ``temperature`` > 0 (K). InputError if it is not."""
        require.positive(temperature, "temperature (K)")
        return _power(self.activation_energy / _GAS_CONSTANT * (1.0 / temperature - 1.0 / self.reference))

    def seen_from(self, temperature: float) -> Arrhenius:
        """The same shift with ``temperature`` (K) as reference."""
        return Arrhenius(float(temperature), self.activation_energy)


_GAS_CONSTANT = 8.31446261815324
"""R in J/(mol K), exact."""

_LARGEST_LOG = 600.0


def _power(log: float) -> float:
    if abs(log) > _LARGEST_LOG:
        raise InputError(
            f"temperature of a viscoelastic solid must shift its times by less than exp({_LARGEST_LOG:g}), but "
            f"shifts them by exp({log:.4g})."
        )
    return math.exp(log)


TemperatureShift: TypeAlias = WilliamsLandelFerry | Arrhenius
"""How relaxation times change with temperature."""


@dataclass(frozen=True, repr=False)
class Viscoelastic(Elastic):
    """Isotropic linear viscoelastic half-space: the elastic constants are those of the first
    instant.

    Wherever only the first instant matters it acts as the ``Elastic`` with these constants. The
    usual models have makers of their own: ``prony``, ``maxwell``, ``kelvin_voigt``,
    ``standard_linear``, ``power_law``; measured moduli are fitted by ``fitted_solid``, in
    time by ``fitted_relaxation`` and ``fitted_creep``.

    Parameters
    ----------
    youngs_modulus, poisson_ratio
        E in Pa and nu at the first instant (glassy).
    strength, name, sources, conduction
        As of ``Elastic``.
    spectrum
        Pairs (share of the modulus that relaxes, > 0; relaxation time in s, > 0). The shares add up
        to at most one, to one in a fluid.
    elastic_bulk
        False: Poisson's ratio is constant and all moduli relax alike. True: the bulk modulus stays
        what it is and the shares are those of the shear modulus, so that Poisson's ratio rises
        towards 1/2.
    shift
        How times change with temperature, see ``at_temperature``; None if that is not known.

    Raises
    ------
    InputError
        If a value is outside its range, the shares add up to more than one, or an incompressible
        solid is given an elastic bulk.
    """

    spectrum: Terms = ()
    elastic_bulk: bool = False
    shift: TemperatureShift | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        total = sum(share for share, _ in self.spectrum)
        if total > 1.0 + _TOO_MUCH:
            raise InputError(
                f"shares of a viscoelastic spectrum must add up to at most one, but add up to {total:.6g}."
            )
        series = Relaxation(max(1.0 - total, 0.0) if total < 1.0 - _TOO_MUCH else 0.0, self.spectrum)
        object.__setattr__(self, "spectrum", series.terms)
        if self.elastic_bulk and not -1.0 < self.poisson_ratio < 0.5:
            raise InputError(
                f"Poisson's ratio of a solid of elastic bulk must be less than 0.5, but is {self.poisson_ratio:g}. "
                "Leave out elastic_bulk: an incompressible solid stays incompressible."
            )
        if not isinstance(self.shift, TemperatureShift | None):
            raise InputError(
                "shift of a viscoelastic solid must be WilliamsLandelFerry(...), Arrhenius(...) or None, but "
                f"is {self.shift!r}."
            )

    @classmethod
    def prony(cls, relaxed: float, terms: Terms, poisson_ratio: float, **more: Any) -> Self:
        """Solid of Young's modulus E(t) = ``relaxed`` + sum E_k exp(-t/tau_k), generalised Maxwell
        model.

        Parameters
        ----------
        relaxed
            E_inf in Pa, >= 0.
        terms
            Pairs (E_k in Pa, tau_k in s).
        poisson_ratio
            nu at the first instant; with ``elastic_bulk=True`` the terms give the shape of the
            shear relaxation.
        **more
            Further parameters of ``Viscoelastic``.
        """
        series = Relaxation(relaxed, terms)
        total = series.instantaneous
        spectrum = tuple((strength / total, tau) for strength, tau in series.terms)
        return cls(total, poisson_ratio, spectrum=spectrum, **more)

    @classmethod
    def maxwell(cls, youngs_modulus: float, time: float, poisson_ratio: float, **more: Any) -> Self:
        """Fluid of Young's modulus E exp(-t/``time``): a spring (Pa) and a dashpot of viscosity E
        ``time`` in series."""
        return cls.prony(
            0.0, ((require.positive(youngs_modulus, "Young's modulus (Pa)"), time),), poisson_ratio, **more
        )

    @classmethod
    def standard_linear(
        cls, relaxed: float, instantaneous: float, time: float, poisson_ratio: float, **more: Any
    ) -> Self:
        """Solid of Young's modulus E_inf + (E_0 - E_inf) exp(-t/``time``), moduli in Pa, E_0 >
        E_inf, time in s (Zener)."""
        require.positive(relaxed, "relaxed modulus (Pa)")
        require.positive(instantaneous, "instantaneous modulus (Pa)")
        if not instantaneous > relaxed:
            raise InputError(
                f"instantaneous modulus (Pa) must be greater than the relaxed modulus {relaxed:g} Pa, but is "
                f"{instantaneous:g} Pa."
            )
        return cls.prony(relaxed, ((instantaneous - relaxed, time),), poisson_ratio, **more)

    @classmethod
    def kelvin_voigt(
        cls, relaxed: float, time: float, poisson_ratio: float, *, instantaneous: float = 1e4, **more: Any
    ) -> Self:
        """Solid of a spring (``relaxed``, Pa) and a dashpot of viscosity E ``time`` side by side,
        J(t) = (1 - exp(-t/``time``))/E.

        The exact model is rigid at the first instant and carries no step load; here the modulus
        then is ``instantaneous`` times the relaxed one (1e4), which changes J by that part of it
        and nothing else: a standard linear solid of retardation time ``time``.
        """
        ratio = require.finite(instantaneous, "ratio of the instantaneous to the relaxed modulus")
        if not ratio > 1.0:
            raise InputError(
                f"ratio of the instantaneous to the relaxed modulus must be greater than one, but is {ratio:g}."
            )
        require.positive(relaxed, "relaxed modulus (Pa)")
        return cls.standard_linear(relaxed, ratio * relaxed, time / ratio, poisson_ratio, **more)

    @classmethod
    def power_law(
        cls,
        coefficient: float,
        exponent: float,
        poisson_ratio: float,
        *,
        shortest: float,
        longest: float,
        **more: Any,
    ) -> Self:
        """Solid of Young's modulus ``coefficient`` t^-``exponent``, as a Prony series fitted
        between two times.

        Parameters
        ----------
        coefficient
            E in Pa at t = 1 s, > 0.
        exponent
            alpha, 0 < alpha < 1.
        poisson_ratio
            nu.
        shortest, longest
            Times in s between which the power law holds; see ``power_law_series``.
        **more
            Further parameters of ``Viscoelastic``.
        """
        series = power_law_series(coefficient, exponent, shortest=shortest, longest=longest)
        return cls.prony(series.relaxed, series.terms, poisson_ratio, **more)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Linear viscoelasticity, the conversion between relaxation and creep, the shift with
        temperature."""
        return ("Ferry1980", "Park1999", *(self.shift.citation_keys if self.shift else ()))

    @property
    def instantaneous(self) -> Elastic:
        """Elastic solid that it is at the first instant."""
        constants = self.youngs_modulus, self.poisson_ratio
        return Elastic(*constants, self.strength, self.name, self.sources, conduction=self.conduction)

    @property
    def relaxed_share(self) -> float:
        """Relaxed over instantaneous modulus (of shear, if the bulk is elastic); zero for a
        fluid."""
        return Relaxation(self._rest, self.spectrum).relaxed

    @property
    def _rest(self) -> float:
        rest = 1.0 - sum(share for share, _ in self.spectrum)
        return rest if rest > _TOO_MUCH else 0.0

    @property
    def shear(self) -> Relaxation:
        """Relaxation of the shear modulus, Pa."""
        return Relaxation(self._rest, self.spectrum).times(self.shear_modulus)

    @property
    def bulk_modulus(self) -> float:
        """K = E/3(1 - 2nu) in Pa at the first instant."""
        return self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poisson_ratio)) if self.poisson_ratio < 0.5 else math.inf

    @property
    def uniaxial_creep(self) -> Creep:
        """Creep of Young's modulus, 1/Pa: 1/E = 1/9K + 1/3G."""
        creep = self.shear.creep
        if not self.elastic_bulk:
            return creep.times(self.shear_modulus / self.youngs_modulus)
        return creep.times(1.0 / 3.0) + Creep(1.0 / (9.0 * self.bulk_modulus))

    @property
    def relaxation(self) -> Relaxation:
        """Relaxation of Young's modulus, Pa."""
        if not self.elastic_bulk:
            return Relaxation(self._rest, self.spectrum).times(self.youngs_modulus)
        return self.uniaxial_creep.relaxation

    @property
    def contact_creep(self) -> Creep:
        """Creep (1/Pa) of the plane-strain modulus, in which a half-space answers to pressure.

        With an elastic bulk (1 - nu²)/E = (3K + 4G)/4G(3K + G) = 1/4G + 3/4(3K + G) in operational
        form, a sum of two creeps.
        """
        if not self.elastic_bulk:
            return self.shear.creep.times(self.shear_modulus / self.plane_strain_modulus)
        shear = self.shear
        stiff = Relaxation(shear.relaxed + 3.0 * self.bulk_modulus, shear.terms)
        return shear.creep.times(0.25) + stiff.creep.times(0.75)

    @property
    def contact_relaxation(self) -> Relaxation:
        """Relaxation (Pa) of the plane-strain modulus."""
        if not self.elastic_bulk:
            return Relaxation(self._rest, self.spectrum).times(self.plane_strain_modulus)
        return self.contact_creep.relaxation

    def operational(self, s: ArrayLike) -> tuple[ComplexArray, ComplexArray]:
        """Shear modulus (Pa) and Poisson's ratio in operational form at complex ``s`` (1/s); at s =
        i omega the complex ones."""
        G = self.shear.operational(s)
        if not self.elastic_bulk:
            return G, np.full(G.shape, complex(self.poisson_ratio))
        K = self.bulk_modulus
        return G, (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G))

    def complex_modulus(self, omega: ArrayLike) -> ComplexArray:
        """Young's modulus E' + i E'' in Pa at the angular frequency ``omega`` (rad/s)."""
        return self.relaxation.complex_modulus(omega)

    def at_temperature(self, temperature: float) -> Self:
        """The same solid at ``temperature`` (K), its times multiplied by a_T.

        InputError if it has no ``shift`` or the temperature is outside the range of that.
        """
        if self.shift is None:
            raise InputError(
                f"viscoelastic solid {self.name or 'without a name'} must have a shift to be taken to another "
                "temperature, but has none. "
                "Give {shift_of_time}."
            )
        moved = self.with_times(self.shift.factor(temperature))
        return replace(moved, shift=self.shift.seen_from(temperature))

    def with_times(self, factor: float) -> Self:
        """The same solid with all relaxation times multiplied by ``factor`` > 0."""
        require.positive(factor, "factor to relaxation times")
        return replace(self, spectrum=tuple((share, tau * factor) for share, tau in self.spectrum))


def alike(solids: tuple[Elastic, ...]) -> bool:
    """Whether all moduli of all ``solids`` relax in proportion to one another."""
    first = solids[0]
    if not any(isinstance(solid, Viscoelastic) and solid.spectrum for solid in solids):
        return True
    if not isinstance(first, Viscoelastic):
        return False
    return all(
        isinstance(solid, Viscoelastic) and not solid.elastic_bulk and solid.spectrum == first.spectrum
        for solid in solids
    )


# Series for functions of time and frequency: a fixed grid of times, strengths by non-negative least
# squares.


def power_law_series(
    coefficient: float, exponent: float, *, shortest: float, longest: float, per_decade: int = 3
) -> Relaxation:
    """Prony series of ``coefficient`` t^-``exponent`` (Pa), fitted relative to it between
    ``shortest`` and ``longest`` (s).

    Terms reach two decades beyond the longest time and 2/(1 - alpha) decades, at most 8, below the
    shortest: what a creep has missed before falls off with time to the power 1 - alpha. Those still
    slower are a constant. InputError if a value is outside its range.
    """
    require.positive(coefficient, "coefficient of a power law (Pa)")
    alpha = require.between(exponent, 0.0, 1.0, "exponent of a power law")
    require.positive(shortest, "shortest time of a power law (s)")
    if not require.positive(longest, "longest time of a power law (s)") > shortest:
        raise InputError(
            f"longest time of a power law (s) must be greater than the shortest {shortest:g} s, but is {longest:g} s."
        )
    count = require.integer(per_decade, 1, "number of terms a decade")
    beyond = min(2.0 / (1.0 - alpha), 8.0)
    require_terms(math.log10(longest) - math.log10(shortest) + beyond + 4.0, count)
    first, last = shortest * 10.0**-beyond, longest * 100.0
    steps = math.ceil(math.log10(last / first) * count)
    taus = first * 10.0 ** (np.arange(-count, steps + count + 1) / count)
    times = np.geomspace(first, last, 8 * steps)
    columns = np.exp(-times[:, None] / taus)
    relative = np.hstack([columns, np.ones((times.size, 1))]) / (times**-alpha)[:, None]
    strengths = not_negative(relative, np.ones(times.size))
    terms = tuple((coefficient * g, float(tau)) for g, tau in zip(strengths[:-1], taus, strict=True))
    return Relaxation(coefficient * float(strengths[-1]), terms)


def power_law_error(series: Relaxation, coefficient: float, exponent: float, times: ArrayLike) -> float:
    """Largest relative difference of ``series`` from ``coefficient`` t^-``exponent`` (Pa) at
    ``times`` (s)."""
    t = np.asarray(times, dtype=float)
    return float(np.abs(series.at(t) / (coefficient * t**-exponent) - 1.0).max())


class MeasuredCurve(ABC):
    """How well the curve of a solid meets what was measured."""

    @property
    @abstractmethod
    def errors(self) -> RealArray:
        """Relative deviation at every point that was measured, (n,)."""

    @property
    def rms_error(self) -> float:
        """Root of the mean square of ``errors``."""
        return float(np.sqrt(np.mean(self.errors**2)))

    @property
    def largest_error(self) -> float:
        """Largest of ``errors``."""
        return float(self.errors.max())


@dataclass(frozen=True, eq=False)
class MasterCurve(MeasuredCurve):
    """Fit of a Prony series to measured storage and loss moduli.

    Attributes
    ----------
    solid
        The solid found.
    frequency
        Measured frequencies, Hz.
    storage, loss
        Measured moduli, Pa.
    fitted
        Complex modulus of the solid at these frequencies, Pa.
    """

    solid: Viscoelastic
    frequency: RealArray
    storage: RealArray
    loss: RealArray
    fitted: ComplexArray

    @property
    def errors(self) -> RealArray:
        """|fitted - measured| / |measured| of the complex modulus at every frequency."""
        measured = self.storage + 1j * self.loss
        return np.asarray(np.abs(self.fitted - measured) / np.abs(measured))


def fitted_solid(
    frequency: ArrayLike,
    storage: ArrayLike,
    loss: ArrayLike,
    *,
    poisson_ratio: float,
    per_decade: int = 4,
    fluid: bool = False,
    **more: Any,
) -> MasterCurve:
    """Viscoelastic solid through measured storage and loss moduli, with the error of the fit.

    Relaxation times stand on a fixed grid over the measured band; strengths are found by
    non-negative least squares on both moduli, relative to |E| at each frequency, so that E' and E''
    are those of one passive solid.

    Parameters
    ----------
    frequency
        (n,), Hz, > 0 and different from each other; n >= 2.
    storage, loss
        (n,), E' > 0 and E'' >= 0 of Young's modulus, Pa.
    poisson_ratio
        nu.
    per_decade
        Relaxation times a decade of frequency.
    fluid
        Whether all of it relaxes, so that the series has no constant.
    **more
        Further parameters of ``Viscoelastic``, such as ``name`` and ``sources``.

    Raises
    ------
    InputError
        If the columns differ in length or hold values outside their ranges, or the series would
        have more than 400 terms.
    """
    f, real, imaginary = (np.atleast_1d(np.asarray(values, dtype=float)) for values in (frequency, storage, loss))
    if not (f.ndim == 1 and f.shape == real.shape == imaginary.shape and f.size >= 2):
        raise InputError(
            "frequency, storage and loss modulus must be columns of the same length of at least 2, but have the shapes "
            f"{f.shape}, {real.shape} and {imaginary.shape}."
        )
    if not (np.isfinite(f).all() and f.min() > 0.0 and np.unique(f).size == f.size):
        raise InputError(
            "frequencies (Hz) of a viscoelastic solid must be finite, positive and different from each other."
        )
    if not (np.isfinite(real).all() and np.isfinite(imaginary).all() and real.min() > 0.0 and imaginary.min() >= 0.0):
        raise InputError("storage moduli (Pa) must be positive, loss moduli (Pa) not negative, and all of them finite.")
    count = require.integer(per_decade, 1, "number of terms a decade")
    omega, size = 2.0 * np.pi * f, np.hypot(real, imaginary)
    require_terms(math.log10(omega.max()) - math.log10(omega.min()) + 2.0, count)
    longest, shortest = 1.0 / omega.min(), 1.0 / omega.max()
    taus = np.geomspace(shortest, longest, max(2, math.ceil(math.log10(longest / shortest) * count) + 1))
    beyond = (taus[1] / taus[0]) ** np.arange(1, count + 1)
    taus = np.concatenate(
        [taus[0] / beyond[::-1], taus, taus[-1] * beyond]
    )  # what relaxes a decade outside the band shows inside
    kernels = 1j * omega[:, None] * taus / (1.0 + 1j * omega[:, None] * taus)
    columns = np.hstack([kernels, np.full((f.size, 1), 0.0 if fluid else 1.0)])
    rows = np.vstack([columns.real / size[:, None], columns.imag / size[:, None]])
    strengths = not_negative(rows, np.concatenate([real / size, imaginary / size]))
    least = NEGLIGIBLE * float(strengths.max())
    terms = tuple((float(g), float(tau)) for g, tau in zip(strengths[:-1], taus, strict=True) if g > least)
    solid = Viscoelastic.prony(float(strengths[-1]), terms, poisson_ratio, **more)
    return MasterCurve(solid, f, real, imaginary, solid.complex_modulus(omega))
