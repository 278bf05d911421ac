"""The one spectrum of many scans: fit, combined curve, agreement of the scans, and findings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.late import Drawn
from ...core.quadrature import gauss
from ...core.status import Advice
from ...core.units import percent, show
from .scans_corners import CORNERS, Corner
from .scans_curve import FEWEST, Agreement, CombinedCurve, agreements, combined_curve
from .whittle_lines import LineFit, LineModes, corner_bound, fit_lines

PLATEAU_MODES = 10
"""Independent modes below the corner that a roll-off needs to be reported."""

PLATEAU_ERROR = 0.5
"""Standard error of ln q0 up to which a roll-off is reported."""

_APART = 3.0  # standard errors by which scans of one surface differ at most, of a few dozen comparisons
_CALIBRATED = 0.1  # ratio of powers below which a deviation is of no interest
_SCATTERED = 1.5  # sandwich over Fisher error from which the lines differ by more than their modes
_NAMED = 6  # scans in the history of a surface
_NODES, _PIECES = 8, 16  # Gauss points of a piece, pieces per factor of ten of wavenumber
_SPAN = 1e4  # corner over the least wavenumber of an integral


@dataclass(frozen=True, eq=False, repr=False)
class ScansSpectrum(Drawn):
    """Isotropic spectrum of a surface from many scans; ``asperity.generate.gaussian`` takes it.

    It is that of the fit up to the shortest reliable wave, and zero beyond: shorter waves have not
    been seen. Convention of Jacobs, Junge & Pastewka (2017).

    Attributes
    ----------
    fit
        Parameters and errors of the likelier corner.
    tried
        Fits by the corner that was tried.
    curve
        Combined C1D in bands.
    agreements
        Each scan against the others, decade by decade.
    scans
        Names of the scans used.
    bands
        Shortest and longest wave in m of each.
    rolloff_seen
        Whether ten independent modes or more lie below the corner and it is known to 50 %.
    corner_bound
        Largest q0 in rad/m at 95 % confidence; NaN where a roll-off was seen.
    shortest_wavelength
        Where the spectrum ends, in m.
    measured_to
        Shortest reliable wave of all scans in m.
    findings
        What should be known before the numbers are used.
    """

    fit: LineFit
    tried: dict[str, LineFit]
    curve: CombinedCurve
    agreements: tuple[Agreement, ...]
    scans: tuple[str, ...]
    bands: tuple[tuple[float, float], ...]
    rolloff_seen: bool
    corner_bound: float
    shortest_wavelength: float
    measured_to: float
    findings: tuple[Advice, ...] = ()
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017", "Sykulski2019", "DerSimonian1986")

    @property
    def criteria(self) -> dict[str, float]:
        """-2 ln L above the least, by the corner that was tried."""
        return {name: item.deviance - self.fit.deviance for name, item in self.tried.items()}

    @property
    def model(self) -> Corner:
        """The fitted spectrum, without its cut at the shortest wave."""
        return self.fit.model

    @property
    def hurst(self) -> float:
        """Hurst exponent H."""
        return self.fit.model.hurst

    @property
    def hurst_error(self) -> float:
        """Standard error of H: the larger one of Fisher information and scatter of the lines."""
        return self.error("H")

    def error(self, name: str) -> float:
        """Larger one of both standard errors of ``ln m0``, ``ln q0`` or ``H``.

        Raises InputError if there is no such parameter.
        """
        values = (self.fit.error(name), self.fit.error(name, by="sandwich"))
        return float(np.nanmax(values))

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: two roll-off
        wavelengths."""
        return 4.0 * math.pi / self.model.corner

    @property
    def rolloff_wavelength(self) -> float:
        """2π/q0 in m, of the fit; not seen unless ``rolloff_seen``."""
        return 2.0 * math.pi / self.model.corner

    def extended(self, shortest_wavelength: float) -> ScansSpectrum:
        """The same spectrum down to ``shortest_wavelength`` in m; a shorter one than was measured
        is an extrapolation, which the history of a generated surface says.

        Raises InputError if the wavelength is not positive.
        """
        return replace(self, shortest_wavelength=require.positive(shortest_wavelength, "shortest wavelength (m)"))

    def psd(self, q: RealArray | float) -> RealArray:
        """C in m⁴ at the wavenumbers ``q`` (rad/m, any shape), zero at q = 0 and beyond the
        shortest wave."""
        number = np.asarray(q, dtype=float)
        last = 2.0 * math.pi / self.shortest_wavelength * (1.0 + 1e-9)
        return np.where((number > 0.0) & (number <= last), self.model.psd(number), 0.0)

    def profile_psd(self, k: RealArray | float) -> RealArray:
        """Two-sided C1D in m³ of the fit at the wavenumbers ``k`` > 0 (rad/m, any shape), without
        the cut of the map."""
        return self.model.profile_psd(k)

    def moments(
        self, shortest_wavelength: float | None = None, longest_wavelength: float = math.inf
    ) -> tuple[float, float, float]:
        """Profile moments m0 (m²), m2 and m4 (1/m²) of the waves of the map between two wavelengths
        in m; down to the end of the spectrum by default.

        Raises InputError if the wavelengths are out of order.
        """
        shortest = self.shortest_wavelength if shortest_wavelength is None else shortest_wavelength
        high = 2.0 * math.pi / require.positive(shortest, "shortest wavelength (m)")
        low = 2.0 * math.pi / longest_wavelength
        if not low < high:
            raise InputError(
                f"longest wavelength (m) must be above the shortest of {shortest:g}, but is {longest_wavelength:g}."
            )
        start = max(low, min(self.model.corner, high) / _SPAN)
        kink = [self.model.corner] if start < self.model.corner < high else []
        edges = np.geomspace(start, high, 2 + math.ceil(_PIECES * math.log10(high / start)))
        q, weight = gauss(np.union1d(edges, kink), _NODES)
        density = weight * self.model.psd(q) / math.pi
        flat = float(self.model.psd(start)) / math.pi * 0.25 * (start**2 - low**2)
        return (
            float(density @ (0.5 * q)) + flat,
            float(density @ (0.25 * q**3)),
            float(density @ (0.1875 * q**5)),
        )

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid holds no wave of the spectrum.
        """
        values = self.psd(grid.wavenumber())
        if not values.any():
            raise InputError(
                f"grid of {grid.size[0]:g} x {grid.size[1]:g} m must hold waves longer than "
                f"{self.shortest_wavelength:g} m, but has none. Change its size."
            )
        return values

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        named = ", ".join(self.scans[:_NAMED]) + (", …" if len(self.scans) > _NAMED else "")
        text = (
            f"spectrum of {len(self.scans)} scan{'s' * (len(self.scans) != 1)} ({named}), {self.model.name} roll-off "
            f"at {show(self.rolloff_wavelength, 'm')}, H = {self.hurst:.3g} ± {self.hurst_error:.2g}, waves down to "
            f"{show(self.shortest_wavelength, 'm')}"
        )
        if self.shortest_wavelength < self.measured_to * (1.0 - 1e-9):
            text += f", extrapolated beyond {show(self.measured_to, 'm')}"
        pixel = 2.0 * max(grid.spacing)
        if pixel > self.shortest_wavelength * (1.0 + 1e-9):
            text += f", of which the grid holds those above {show(pixel, 'm')}"
        return text

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and main numbers."""
        modes, lines = self.fit.error("H"), self.fit.error("H", by="sandwich")
        by_lines = "too few lines to tell more" if math.isnan(lines) else f"{lines:.2g} by lines"
        rows = [
            ("scans", ", ".join(self.scans)),
            ("Hurst exponent H", f"{self.hurst:.3g} ± {self.hurst_error:.2g}"),
            ("errors of H", f"{modes:.2g} by modes, {by_lines}"),
            ("roll-off", self._rolloff_words()),
        ]
        if self.rolloff_seen:
            rms = math.sqrt(self.model.variance)
            rows.append(("rms height", f"{show(rms, 'm')} ± {percent(0.5 * self.error('ln m0'))}"))
        else:
            first = 2.0 * math.pi / max(longest for _, longest in self.bands)
            known = float(self.model.psd(first))
            rows.append(("C at the longest wave", f"{known:.4g} m^4 at {show(2.0 * math.pi / first, 'm')}"))
        slope = math.sqrt(2.0 * self.moments()[1])
        rows.append(("rms gradient", f"{slope:.4g} of waves above {show(self.shortest_wavelength, 'm')}"))
        return "Spectrum of many scans", rows

    def _rolloff_words(self) -> str:
        if self.rolloff_seen:
            return f"{self.model.name}, {show(self.rolloff_wavelength, 'm')} ± {percent(self.error('ln q0'))}"
        if math.isfinite(self.corner_bound):
            return f"not seen, longer than {show(2.0 * math.pi / self.corner_bound, 'm')} (95 %)"
        return "not seen"


def spectrum_of_scans(
    scans: Sequence[LineModes],
    names: Sequence[str],
    *,
    corner: str = "auto",
    per_decade: int = 10,
    unused: Sequence[tuple[str, str]] = (),
) -> ScansSpectrum:
    """Spectrum of ``scans`` in their reliable bands.

    ``names`` of the scans; ``corner`` rounded, sharp or auto; ``unused`` names of scans without
    reliable band and what limits them. Raises InputError if the corner is unknown.
    """
    require.one_of(corner, ("auto", *CORNERS), "corner of a spectrum")
    first, *others = CORNERS if corner == "auto" else (corner,)
    tried = {first: fit_lines(scans, corner=first)}
    tried |= {name: fit_lines(scans, corner=name, weights=tried[first].weights) for name in others}
    best = min(tried, key=lambda name: tried[name].deviance)
    fit = tried[best]
    below = sum(
        float(scan.independent(fit.model.hurst, fit.model.corner)[scan.q < fit.model.corner].sum()) / scan.lost
        for scan in scans
    )
    seen = below >= PLATEAU_MODES and fit.error("ln q0") < PLATEAU_ERROR and "ln q0" not in fit.at_bound
    bands = tuple((2.0 * math.pi / float(scan.q[-1]), 2.0 * math.pi / float(scan.q[0])) for scan in scans)
    shortest = min(short for short, _ in bands)
    curve, compared = combined_curve(scans, fit.model, per_decade=per_decade), agreements(scans, fit.model)
    found = ScansSpectrum(
        fit,
        tried,
        curve,
        compared,
        tuple(names),
        bands,
        rolloff_seen=seen,
        corner_bound=math.nan if seen else corner_bound(scans, fit),
        shortest_wavelength=shortest,
        measured_to=shortest,
    )
    return replace(found, findings=tuple(_findings(found, unused)))


def _findings(found: ScansSpectrum, unused: Sequence[tuple[str, str]]) -> list[Advice]:
    """What should be known before the spectrum is used."""
    made = []
    for name, by in unused:
        fact = f"Scan {name} has fewer than eight reliable modes, limited by {by}, and was left out."
        made.append(Advice("warning", "reliable band", fact, "Scan a longer line with this instrument."))
    if not found.rolloff_seen:
        longest = max(long for _, long in found.bands)
        fact = (
            f"No roll-off is seen in waves up to {show(longest, 'm')}: rms height and mean gap depend on the scan size."
        )
        remedy = "Take a scan that is at least four times as long."
        made.append(Advice("warning", "roll-off", fact, remedy, {"longest_wave": longest}))
    fisher, sandwich = found.fit.error("H"), found.fit.error("H", by="sandwich")
    if sandwich > _SCATTERED * fisher:
        fact = (
            f"Lines scatter more than their modes explain: the error of H is {sandwich:.2g} by lines and {fisher:.2g} "
            "by modes. The surface is not the same everywhere, or not isotropic."
        )
        made.append(Advice("note", "scatter", fact, "Take scans at more places.", {"lines": sandwich, "modes": fisher}))
    for name, other in found.criteria.items():
        if 0.0 < other < 2.0:
            hurst = found.tried[name].model.hurst
            fact = (
                f"A {name} corner is as likely as the {found.model.name} one (-2 ln L {other:.2g} apart) and has "
                f"H = {hurst:.3g}."
            )
            made.append(Advice("note", "corner", fact, "", {"difference": other, "hurst": hurst}))
    made += _apart(found)
    few = int(np.count_nonzero(found.curve.few))
    if few:
        fact = (
            f"{few} of {found.curve.q.size} bands hold fewer than {FEWEST} independent lines or maps: their errors are "
            "those of the modes alone."
        )
        made.append(Advice("note", "few scans", fact, "Take three scans of each size.", {"bands": float(few)}))
    return made


def _apart(found: ScansSpectrum) -> list[Advice]:
    """Scans whose power differs from that of the others, and what that looks like."""
    made = []
    for number, name in enumerate(found.scans):
        own = [item for item in found.agreements if item.scan == number]
        off = [item for item in own if abs(item.deviation) > _APART and abs(item.ratio - 1.0) > _CALIBRATED]
        if not off:
            continue
        worst = max(off, key=lambda item: abs(item.deviation))
        waves = f"{show(2.0 * math.pi / worst.last, 'm', 3)} to {show(2.0 * math.pi / worst.first, 'm', 3)}"
        fact = f"Scan {name} has {worst.ratio:.3g} times the power of the others at waves of {waves}"
        if len(off) == len(own):
            fact += f", in all {len(own)} decades that they share."
            remedy = f"Check the calibration of its heights (a factor of {math.sqrt(worst.ratio):.3g}) and its place."
        elif off == own[-1:]:
            fact += ", at its short end only."
            remedy = "Check its tip radius or resolution."
        elif off == own[:1]:
            fact += ", at its long end only."
            remedy = "Check its levelling."
        else:
            fact += "."
            remedy = "Check its place on the surface."
        numbers = {"ratio": worst.ratio, "deviation": worst.deviation}
        made.append(Advice("warning", "agreement", fact, remedy, numbers))
    return made
