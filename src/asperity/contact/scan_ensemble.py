"""Contact of the surface that many scans describe: which waves decide it, and area and gap with an
error bar."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.status import Advice
from ..core.units import percent, show
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..surfaces.generate.gaussian import gaussian, sub_seeds
from ..surfaces.surface import Surface
from ..theories.rough.deciding_waves import DecidingWaves, contact_areas, deciding_waves
from ..theories.rough.persson import IsotropicSpectrum
from .controls import MeanPressure
from .problem import ContactProblem
from .solve import solve

ANSWERS = ("area_fraction", "mean_gap", "normal_stiffness")
"""Real over nominal area, mean gap in m, normal stiffness per nominal area in Pa/m."""

_PER_DECADE = 30  # points of a table of the spectrum
_LONGER = 10.0  # wavelength of the first point over the longest of roll-off and scans
_ROLLOFFS = 4.0  # roll-off wavelengths along a side
_PER_WAVE = 4.0  # pixels in the shortest wave
_LOST = 0.05  # share of the mean square slope beyond the grid from which a finding says so
_TINY = 1e-4  # variance of a combination of parameters that is not worth two solves


@dataclass(frozen=True)
class EnsembleAnswer:
    """One number of the contact of many surfaces of one spectrum.

    ``mean`` over the realisations; ``scatter`` standard deviation from one to the next, what one
    window of this size may differ by; ``spectrum_error`` standard error from the parameters of the
    spectrum; ``error`` of the mean by both.
    """

    mean: float
    scatter: float
    spectrum_error: float
    error: float


@dataclass(frozen=True, eq=False)
class EnsembleContact:
    """Contact of surfaces generated with the spectrum of many scans.

    ``answers`` by name, see ``ANSWERS``; ``grid`` and number of ``realisations``;
    ``slope_shown`` share of the mean square slope in waves that the grid holds;
    ``area_with_short_waves`` area fraction with the waves it does not hold, by the ratio of
    Persson's areas; ``findings``.
    """

    answers: Mapping[str, EnsembleAnswer]
    grid: Grid
    realisations: int
    slope_shown: float
    area_with_short_waves: float
    findings: tuple[Advice, ...] = ()
    citation_keys: tuple[str, ...] = ("Persson2001",)


def spectrum_table(spectra: ScansSpectrum | Sequence[ScansSpectrum]) -> IsotropicSpectrum:
    """Composite spectrum of one or two surfaces as a table: the sum of their C, from a tenth of the
    smallest wavenumber seen to the shortest wave of all; from the longest wave that was measured
    where no roll-off is seen, beyond which nothing is known.

    Raises InputError if there is none.
    """
    several = (spectra,) if isinstance(spectra, ScansSpectrum) else tuple(spectra)
    if not several:
        raise InputError("spectra of the surfaces must be one or two, but are none.")
    longest = 0.0
    for one in several:
        measured = max(long for _, long in one.bands)
        longest = max(longest, _LONGER * max(one.rolloff_wavelength, measured) if one.rolloff_seen else measured)
    first, last = 2.0 * math.pi / longest, 2.0 * math.pi / min(one.shortest_wavelength for one in several)
    q = np.geomspace(first, last, 2 + math.ceil(_PER_DECADE * math.log10(last / first)))
    q[-1] = last * (1.0 - 1e-12)
    return IsotropicSpectrum(q, sum(one.psd(q) for one in several))


def deciding_waves_of(
    spectra: ScansSpectrum | Sequence[ScansSpectrum],
    E_star: float,
    pressure: float,
    *,
    hardness: float = math.inf,
    tolerance: float = 0.05,
) -> DecidingWaves:
    """Which waves of the scanned surfaces decide their contact, by ``deciding_waves``.

    ``spectra`` of one surface against a flat one, or of both; ``E_star`` contact modulus in Pa;
    ``pressure`` nominal in Pa; ``hardness`` in Pa; ``tolerance`` relative change that counts as
    none. Its ``findings`` tell which scan sizes and intervals are too small. Raises InputError if a
    number is out of its range.
    """
    return deciding_waves(spectrum_table(spectra), E_star, pressure, hardness=hardness, tolerance=tolerance)


def ensemble_contact(
    spectrum: ScansSpectrum,
    problem: Callable[[Surface], ContactProblem],
    pressure: float,
    *,
    grid: Grid | None = None,
    realisations: int = 8,
    seed: int,
) -> EnsembleContact:
    """Contact at the nominal ``pressure`` in Pa of periodic surfaces with the ``spectrum`` of many
    scans, with an error bar.

    Realisations differ by their seeds. The error from the spectrum follows from its covariance: the
    first realisation is solved again with the same random numbers, one standard error to either
    side along each principal combination of the parameters.

    Parameters
    ----------
    spectrum
        Spectrum of the scans; ``extended`` to a physical cut-off where it is known.
    problem
        Makes the problem of a surface, such as ``lambda rough: ContactProblem(rough, body)``.
    pressure
        Mean pressure in Pa, > 0.
    grid
        Nodes; by default 256 x 256 over four roll-off wavelengths (four of the longest waves where
        no roll-off is seen).
    realisations
        Number of surfaces, at least 2.
    seed
        Seed of the random numbers; equal seeds give equal answers.

    Raises InputError if a number is out of its range.
    """
    count = require.integer(realisations, 2, "number of realisations")
    nominal = require.positive(pressure, "pressure (Pa)")
    nodes = grid or _usual_grid(spectrum)
    seeds = [number >> 12 for number in sub_seeds(seed, count)]  # whole numbers that gaussian takes

    def answers(of: ScansSpectrum, number: int) -> RealArray:
        result = solve(problem(gaussian(nodes, of, seed=seeds[number])), MeanPressure(nominal))
        return np.array([result.area_fraction_corrected, result.mean_gap, result.normal_stiffness])

    found = np.array([answers(spectrum, number) for number in range(count)])
    parametric = np.zeros(len(ANSWERS))
    for step in _principal_steps(spectrum):
        high, low = (answers(_moved(spectrum, sign * step), 0) for sign in (1.0, -1.0))
        parametric += np.square(0.5 * (high - low))
    scatter = found.std(axis=0, ddof=1)
    error = np.sqrt(np.square(scatter) / count + parametric)
    rows = zip(ANSWERS, found.mean(axis=0), scatter, np.sqrt(parametric), error, strict=True)
    values = {name: EnsembleAnswer(*(float(value) for value in row)) for name, *row in rows}
    first = problem(gaussian(nodes, spectrum, seed=seeds[0]))
    return _with_short_waves(spectrum, first.contact_modulus, nominal, EnsembleContact(values, nodes, count, 1.0, 0.0))


def _usual_grid(spectrum: ScansSpectrum) -> Grid:
    longest = spectrum.rolloff_wavelength if spectrum.rolloff_seen else max(long for _, long in spectrum.bands)
    pixel = _ROLLOFFS * longest / 256
    return Grid((256, 256), (pixel, pixel))


def _principal_steps(spectrum: ScansSpectrum) -> list[RealArray]:
    """One standard error of each independent combination of (ln m0, ln q0, H), (3,) each."""
    fit = spectrum.fit
    wide = math.isfinite(fit.error("H", by="sandwich")) and fit.error("H", by="sandwich") > fit.error("H")
    variances, vectors = np.linalg.eigh(fit.sandwich if wide else fit.fisher)
    return [
        math.sqrt(variance) * vector
        for variance, vector in zip(variances, vectors.T, strict=True)
        if variance > _TINY * float(variances[-1])
    ]


def _moved(spectrum: ScansSpectrum, step: RealArray) -> ScansSpectrum:
    model = spectrum.fit.model
    values = np.array([math.log(model.variance), math.log(model.corner), model.hurst]) + step
    values[2] = min(max(float(values[2]), 0.02), model.largest_hurst)
    return replace(spectrum, fit=replace(spectrum.fit, model=type(model).of(values)))


@dataclass(frozen=True)
class ShortWaves:
    """Waves of a spectrum that a grid does not hold.

    ``shortest`` wave of the grid in m; ``shown`` share of the mean square slope above it;
    ``ratio`` of Persson's areas with all waves and with these; ``pixel`` in m that holds all.
    """

    shortest: float
    shown: float
    ratio: float
    pixel: float

    def findings(self, area: float) -> tuple[Advice, ...]:
        """What that means for the ``area`` fraction of a contact on the grid; nothing where the
        waves are a small part."""
        if self.shown >= 1.0 - _LOST:
            return ()
        fact = (
            f"The grid holds waves above {show(self.shortest, 'm', 3)}, {percent(self.shown, 3)} of the mean square "
            f"slope: with the shorter ones the area is {self.ratio * area:.3g} of the nominal area by Persson's theory "
            f"instead of {area:.3g}."
        )
        numbers = {"slope_shown": self.shown, "area": self.ratio * area}
        remedy, concerns = f"Use pixels of {show(self.pixel, 'm', 3)}.", ("area_fraction", "contact_area")
        return (Advice("warning", "short waves", fact, remedy, numbers, concerns),)


def short_waves(spectrum: ScansSpectrum, grid: Grid, E_star: float, pressure: float) -> ShortWaves:
    """Waves of the ``spectrum`` that the ``grid`` does not hold, in a contact with the modulus
    ``E_star`` and the nominal ``pressure`` in Pa."""
    shortest = max(spectrum.shortest_wavelength, 2.0 * max(grid.spacing))
    shown, whole = spectrum.moments(shortest)[1], spectrum.moments()[1]
    areas = [contact_areas(pressure, 0.5 * E_star * math.sqrt(2.0 * m2), math.inf)[0] for m2 in (shown, whole)]
    return ShortWaves(shortest, shown / whole, areas[1] / areas[0], spectrum.shortest_wavelength / _PER_WAVE)


def _with_short_waves(
    spectrum: ScansSpectrum, modulus: float, pressure: float, found: EnsembleContact
) -> EnsembleContact:
    """``found`` with the waves that its grid does not hold taken into account in the area."""
    unseen = short_waves(spectrum, found.grid, modulus, pressure)
    area_error = found.answers["area_fraction"]
    made = list(unseen.findings(area_error.mean))
    if not spectrum.rolloff_seen:
        fact = "No roll-off was seen in the scans: the mean gap depends on the size of the grid."
        made.append(Advice("warning", "long waves", fact, "Take a longer scan.", concerns=("mean_gap",)))
    if area_error.scatter / math.sqrt(found.realisations) > area_error.spectrum_error > 0.0:
        fact = "The scatter of the realisations is larger than the error of the spectrum."
        made.append(Advice("note", "realisations", fact, "Take more realisations or a larger grid."))
    area = area_error.mean * unseen.ratio
    return replace(found, slope_shown=unseen.shown, area_with_short_waves=area, findings=tuple(made))
