"""Which waves of a rough surface decide area, plastic flow, gap and stiffness of a contact, and so
which scan size and sampling interval suffice."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from .persson import IsotropicSpectrum, PerssonGap
from .wave_questions import QUESTIONS

POINTS_PER_WAVE = 4
"""Sampling intervals in the shortest reliable wave of a scan."""

SIZE_PER_WAVE = {"mean_gap": 4.0, "compliance": 4.0, "height": 4.0}
"""Scan size over the longest wave that is needed; three, the first reliable mode, for the rest."""

PERCOLATION = 0.42
"""Area fraction at the magnification at which the open part of the gap percolates."""

_PER_OCTAVE = 4
_TOLERANCE = 0.05
_TERMS_END = 9.0  # standard deviations over which a term of the series has decayed


@dataclass(frozen=True)
class Need:
    """What a question needs of a scan.

    ``longest`` and ``shortest`` wave in m without which the answer changes by less than the
    tolerance; ``size`` of a scan and sampling ``interval`` in m; ``settled`` False if the answer
    still changes at the end of the spectrum: then it is a result of the cut-off; ``bounded`` False
    if it still changes at the beginning: it is a result of the longest wave, and no size is known
    to suffice.
    """

    longest: float
    shortest: float
    size: float
    interval: float
    settled: bool
    bounded: bool


@dataclass(frozen=True, eq=False)
class DecidingWaves:
    """Shares of every octave of wavelengths in the answers of a contact.

    Attributes
    ----------
    longest, shortest
        Wavelengths in m between which an octave lies, (n,), from long to short.
    shares
        Share of each octave, (n,), by question: of m0, m2, m4; of the plastic area, the mean gap
        and the compliance as waves are added from the longest; of the area, the change if the
        octave were left out, all summed to one.
    values
        Answers with all waves: ``height`` m0 (m²), ``slope`` m2, ``curvature`` m4 (1/m²), ``area``
        and ``plastic`` fraction of the nominal area, ``mean_gap`` (m), ``compliance`` (m/Pa).
    needs
        Waves, scan size and interval that each question needs.
    leak_wavelength
        Wave in m at which the open part of the gap percolates, whose throats decide the leakage;
        NaN if it does so at no scale of the spectrum: the gap is open everywhere or sealed.
    tolerance
        Relative change of an answer that counts as none.
    """

    longest: RealArray
    shortest: RealArray
    shares: Mapping[str, RealArray]
    values: Mapping[str, float]
    needs: Mapping[str, Need]
    leak_wavelength: float
    tolerance: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2007", "Yang2008")

    def findings(self, size: float, interval: float) -> tuple[Advice, ...]:
        """What a scan of this ``size`` and sampling ``interval`` in m leaves open, question by
        question.

        Raises InputError if a length is not positive.
        """
        require.positive(size, "size of a scan (m)")
        require.positive(interval, "sampling interval of a scan (m)")
        made = []
        for question, need in self.needs.items():
            name, level = QUESTIONS[question], _LEVELS.get(question, _WARNING)
            numbers = {"interval": need.interval} | ({"size": need.size} if need.bounded else {})
            if not need.settled:
                fact = (
                    f"The {name} is not settled at the shortest wave of {show(float(self.shortest[-1]), 'm', 3)}: "
                    f"the last octave decides {percent(float(self.shares[question][-1]), 3)}, so that it is a result "
                    "of the cut-off."
                )
                made.append(
                    Advice(level, f"waves of the {name}", fact, "Sample finer, or state the cut-off with it.", numbers)
                )
            elif interval > need.interval:
                fact = f"The {name} needs waves down to {show(need.shortest, 'm', 3)}, which an interval of "
                fact += f"{show(interval, 'm', 3)} does not show."
                remedy = f"Sample at {show(need.interval, 'm', 3)} or less."
                made.append(Advice(level, f"waves of the {name}", fact, remedy, numbers))
            if not need.bounded:
                fact = (
                    f"The {name} is not settled at the longest wave of {show(float(self.longest[0]), 'm', 3)}, above "
                    "which no roll-off is known, so that it is a result of the scan size."
                )
                remedy = "Take a longer scan that shows a roll-off, or state the size with it."
                made.append(Advice(level, f"waves of the {name}", fact, remedy, numbers))
            elif size < need.size:
                fact = f"The {name} needs waves up to {show(need.longest, 'm', 3)}, of which a scan of "
                fact += f"{show(size, 'm', 3)} holds too few."
                remedy = f"Scan {show(need.size, 'm', 3)} or more."
                made.append(Advice(level, f"waves of the {name}", fact, remedy, numbers))
        return tuple(made)


_WARNING: Literal["warning"] = "warning"
_LEVELS: dict[str, Literal["note"]] = dict.fromkeys(("height", "slope", "curvature"), "note")  # not of the contact


def deciding_waves(
    spectrum: IsotropicSpectrum,
    E_star: float,
    pressure: float,
    *,
    hardness: float = math.inf,
    tolerance: float = _TOLERANCE,
) -> DecidingWaves:
    """Shares of the octaves of ``spectrum`` in the contact at one load, by Persson's theory.

    Waves are added from the longest, and left out from the longest, a quarter of an octave at a
    time. With a ``hardness`` the pressure is absorbed there: what flows is plastic contact, and
    shorter waves do not divide it further (Persson 2001).

    Parameters
    ----------
    spectrum
        Composite spectrum of both surfaces, the sum of their C, down to its physical cut-off; from
        far above its roll-off, or the longest wave that is known where none is.
    E_star
        Contact modulus E* in Pa, > 0.
    pressure
        Nominal pressure in Pa, > 0 and below the hardness.
    hardness
        Indentation hardness in Pa; infinite for an elastic contact, which has no plastic area.
    tolerance
        Relative change of an answer that counts as none, between 0 and 1.

    Raises InputError if a number is out of its range or the spectrum is shorter than one octave.
    """
    modulus, nominal = require.positive(E_star, "contact modulus E* (Pa)"), require.positive(pressure, "pressure (Pa)")
    if not nominal < hardness:
        raise InputError(f"pressure (Pa) must be below the hardness of {hardness:g}, but is {pressure:g}.")
    allowed = require.between(tolerance, 0.0, 1.0, "tolerance of an answer")
    q = np.asarray(spectrum.wavenumber)
    octaves = math.floor(math.log2(float(q[-1] / q[0])) + 1e-9)
    if octaves < 1:
        raise InputError("spectrum must hold an octave of wavenumbers or more to be divided, but does not.")
    edges = q[-1] * 2.0 ** (np.arange(-octaves * _PER_OCTAVE, 1) / _PER_OCTAVE)
    edges[0] = q[0]  # the first octave takes the rest of the longest waves
    ask = _Answers(modulus, nominal, hardness)
    added = [ask.of(part(spectrum, float(q[0]), float(edge))) for edge in edges[1:]]
    left = [ask.of(part(spectrum, float(edge), float(q[-1]))) for edge in edges[:-1]]
    asked = [name for name in QUESTIONS if name != "plastic" or added[-1]["plastic"] > 0.0]
    shares, needs = {}, {}
    for name in asked:
        grown = np.array([ask.nothing[name], *(answer[name] for answer in added)])
        without = np.array([*(answer[name] for answer in left), ask.nothing[name]])
        steps = np.diff(grown) / (grown[-1] - grown[0])
        shares[name] = steps.reshape(octaves, _PER_OCTAVE).sum(axis=1)
        needs[name] = _need(name, edges, grown, without, allowed)
    lost = np.abs(np.log(ask.areas_without(shares["slope"], added[-1]["slope"]) / added[-1]["area"]))
    if lost.sum() > allowed:
        shares["area"] = lost / lost.sum()
    elif "plastic" in shares:  # no octave is missed: the area is load over hardness from some scale on
        shares["area"] = shares["plastic"]
    fractions = np.array([1.0, *(answer["area"] for answer in added)])
    below = np.flatnonzero(fractions < PERCOLATION)
    leak = math.nan
    if below.size:
        k = int(below[0])
        share = (PERCOLATION - fractions[k - 1]) / (fractions[k] - fractions[k - 1])
        leak = 2.0 * math.pi / float(edges[k - 1] * (edges[k] / edges[k - 1]) ** share)
    wave = 2.0 * math.pi / edges[::_PER_OCTAVE]
    values = {name: added[-1][name] for name in QUESTIONS}
    return DecidingWaves(wave[:-1], wave[1:], shares, values, needs, leak, allowed)


def part(spectrum: IsotropicSpectrum, first: float, last: float) -> IsotropicSpectrum:
    """``spectrum`` between two wavenumbers in rad/m inside its table."""
    q = np.asarray(spectrum.wavenumber)
    inside = q[(q > first * (1.0 + 1e-9)) & (q < last * (1.0 - 1e-9))]
    kept = np.concatenate([[first], inside, [last]])
    return IsotropicSpectrum(kept, spectrum.at(np.clip(np.log(kept / q[0]), 0.0, spectrum.span[-1])))


def _need(name: str, edges: RealArray, grown: RealArray, without: RealArray, tolerance: float) -> Need:
    """Waves without which the answer stays within the ``tolerance``, on both sides."""
    whole = grown[-1]
    late = np.abs(grown / whole - 1.0)  # with the waves up to each edge
    last = int(np.flatnonzero(late > tolerance)[-1]) + 1
    early = np.abs(without / whole - 1.0)  # with the waves from each edge on
    beyond = np.flatnonzero(early > tolerance)
    first = max(int(beyond[0]) - 1, 0) if beyond.size else edges.size - 1
    longest, shortest = 2.0 * math.pi / float(edges[first]), 2.0 * math.pi / float(edges[last])
    settled = last < edges.size - _PER_OCTAVE  # the whole last octave changes it by less
    bounded = first >= _PER_OCTAVE  # and so does the first
    size = SIZE_PER_WAVE.get(name, 3.0) * longest
    return Need(longest, shortest, size, shortest / POINTS_PER_WAVE, settled, bounded)


@dataclass(frozen=True)
class _Answers:
    """Answers of a contact at the pressure ``nominal`` for any band of the spectrum."""

    E_star: float
    nominal: float
    hardness: float

    @property
    def nothing(self) -> dict[str, float]:
        """Answers of a smooth surface."""
        return {**dict.fromkeys(QUESTIONS, 0.0), "area": 1.0}

    def of(self, spectrum: IsotropicSpectrum) -> dict[str, float]:
        """Answers for the waves of ``spectrum``."""
        m0, m2, m4 = spectrum.profile_moments
        gap = PerssonGap(self.E_star, spectrum)
        elastic, plastic = contact_areas(self.nominal, 0.5 * self.E_star * spectrum.rms_slope, self.hardness)
        found = {"height": m0, "slope": m2, "curvature": m4, "area": elastic + plastic, "plastic": plastic}
        found["mean_gap"] = float(gap.mean_gap(self.nominal))
        return found | {"compliance": 1.0 / float(gap.stiffness(self.nominal))}

    def areas_without(self, shares: RealArray, m2: float) -> RealArray:
        """Area fraction with all waves but those of each octave, by its ``shares`` of ``m2``."""
        spreads = 0.5 * self.E_star * np.sqrt(2.0 * m2 * np.maximum(1.0 - shares, 1e-12))
        return np.array([sum(contact_areas(self.nominal, float(spread), self.hardness)) for spread in spreads])


def contact_areas(pressure: float, spread: float, hardness: float) -> tuple[float, float]:
    """Elastic and plastic fraction of the nominal area under the nominal ``pressure`` in Pa.

    ``spread`` s in Pa, the standard deviation of the pressure in full contact; the diffusing
    pressure p is absorbed at zero, out of contact, and at the ``hardness`` H, plastic (Persson
    2001): elastic (4/π) Σ_odd sin(nπp/H) exp(-n²π²s²/2H²)/n, plastic p/H + (2/π) Σ (-1)^n
    sin(nπp/H) exp(-n²π²s²/2H²)/n. Elastic contact erf(p/(sqrt(2) s)) for an infinite hardness.
    """
    reach = (hardness - pressure) / spread
    if reach > _TERMS_END:  # the hardness is out of reach
        return math.erf(pressure / (math.sqrt(2.0) * spread)), 0.0
    n = np.arange(1, 2 + math.ceil(_TERMS_END * hardness / (math.pi * spread)))
    terms = np.sin(n * math.pi * pressure / hardness) / n * np.exp(-0.5 * np.square(n * math.pi * spread / hardness))
    elastic = 4.0 / math.pi * float(terms[::2].sum())
    plastic = pressure / hardness + 2.0 / math.pi * float(np.where(n % 2, -1.0, 1.0) @ terms)
    return max(elastic, 0.0), max(plastic, 0.0)
