"""Many scans of one surface, of any instrument, size and spacing, and the spectrum they share."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.late import Shown
from ..core.spectral import line_transform
from ..core.status import Advice
from ..core.units import show
from .characterise.correlation import scale_dependence, tip_cutoff
from .characterise.scans_scales import QUANTITIES, LevelLines, ScaleCurve, scale_curve
from .characterise.scans_spectrum import ScansSpectrum, spectrum_of_scans
from .characterise.slopes import axis_index
from .characterise.whittle_lines import LineModes, window_correlation
from .profile import Profile
from .surface import Surface

FEWEST_MODES = 8
"""Modes in the reliable band that a scan must have to be used."""

_FIRST = {"none": 1, "hann": 3}  # mode; the window mixes the first ones with mean and tilt
_ALIASED = 4.0  # spacings in the shortest wave: aliases are part of the expectation
_OF_TIP = 2.0  # wavelength over the length at which the tip touches with its flank: 10 % of the power
_OF_RESOLUTION = {"optical": 1.0 / 0.3}  # wavelength over the stated resolution; 2 for all others
_OF_FILTER = 4.0  # wavelength over a cut-off at which a Gaussian filter takes half the amplitude
_MISSING = 0.1  # of the points of a line beyond which it is left out


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Scan(Shown):
    """Lines of one scan along one direction, with what is known of the instrument.

    Raises InputError if heights are not a real array of one or two dimensions with eight points or
    more along a line, a number is not positive, or no line has nine tenths of its points.

    Parameters
    ----------
    heights
        (lines, n) or (n,) heights in m; NaN marks a missing point, bridged linearly. Lines with
        more than a tenth missing are left out.
    spacing
        Distance Δ of neighbouring points along a line in m.
    line_distance
        Distance in m of neighbouring lines of a map; NaN for lines that are independent, from
        places far apart.
    periodic
        Whether point n equals point 0 (a generated map); a measured scan is not periodic.
    name
        What to call it.
    kind
        ``stylus``, ``optical``, ``afm`` or other words. Of an ``optical`` one the transfer of an
        incoherent lens is taken out of the power.
    tip_radius, resolution, noise
        Radius of the tip, lateral resolution and rms noise of the heights in m; NaN where unknown.
    short_cutoff
        Wavelength in m below which waves have been filtered, or at which the spectrum of a
        generated map ends; 0 if none.

    Its ``findings`` are what was doubtful in its file, for a scan ``of`` one.
    """

    heights: RealArray
    spacing: float
    line_distance: float
    periodic: bool
    name: str
    kind: str
    tip_radius: float
    resolution: float
    noise: float
    short_cutoff: float
    findings: tuple[Advice, ...] = ()

    def __init__(
        self,
        heights: ArrayLike,
        spacing: float,
        *,
        line_distance: float = math.nan,
        periodic: bool = False,
        name: str = "",
        kind: str = "",
        tip_radius: float = math.nan,
        resolution: float = math.nan,
        noise: float = math.nan,
        short_cutoff: float = 0.0,
    ) -> None:
        values = np.array(np.atleast_2d(np.asarray(heights)), dtype=np.float64)
        if values.ndim != 2 or values.shape[1] < FEWEST_MODES:
            raise InputError(
                f"heights of a scan (m) must have the shape (lines, n) or (n,), n >= {FEWEST_MODES}, but have the "
                f"shape {np.shape(heights)}."
            )
        if np.isinf(values).any():
            raise InputError("heights of a scan (m) must be finite or NaN (missing), but hold infinities.")
        given = {"line_distance": line_distance, "tip_radius": tip_radius, "resolution": resolution, "noise": noise}
        for key, value in given.items():
            if not (isinstance(value, float) and math.isnan(value)):
                given[key] = require.positive(value, f"{key.replace('_', ' ')} of a scan (m)")
        values.flags.writeable = False
        for key, whole in (
            ("heights", values),
            ("spacing", require.positive(spacing, "spacing of a scan (m)")),
            ("periodic", bool(periodic)),
            ("name", str(name)),
            ("kind", str(kind)),
            ("short_cutoff", require.not_negative(short_cutoff, "short cut-off of a scan (m)")),
            *given.items(),
        ):
            object.__setattr__(self, key, whole)

    @classmethod
    def of(cls, item: Any, *, axis: str = "x", **known: Any) -> Self:
        """Scan of a map, of a line scan, or of another scan; ``known`` replaces what that says
        itself, such as ``tip_radius=2e-6``.

        ``item`` is a ``Surface``, whose lines run along ``axis``, a ``Profile`` or a ``Scan``.
        Raises InputError if it is none of these.
        """
        if isinstance(item, Scan):
            leave = ("heights", "spacing", "findings")
            told = {key: getattr(item, key) for key in Scan.__annotations__ if key not in leave}
            lines, spacing, doubts = item.heights, item.spacing, item.findings
        elif isinstance(item, Surface):
            along = axis_index(axis)
            lines = item.heights.T if along == 0 else item.heights
            spacing, across = (item.dx, item.dy) if along == 0 else (item.dy, item.dx)
            told = {"periodic": item.periodic, "name": item.origin.source}
            doubts = item.origin.findings
            if lines.shape[0] > 1:
                told["line_distance"] = across
        elif isinstance(item, Profile):
            told = {key: getattr(item.instrument, key) for key in ("kind", "tip_radius", "resolution", "noise")}
            told |= {"periodic": item.periodic, "short_cutoff": item.short_cutoff, "name": item.origin.source}
            lines, spacing, doubts = item.heights, item.spacing, item.origin.findings
        else:
            raise InputError(
                "scan of a surface must be a Surface, a Profile or a Scan, but is of the type "
                f"{type(item).__name__}. Read the file first, or make a Scan(heights, spacing)."
            )
        made = cls(lines, spacing, **{**told, **known})
        object.__setattr__(made, "findings", doubts)
        return made

    @property
    def n_points(self) -> int:
        """Number n of points along a line."""
        return int(self.heights.shape[1])

    @property
    def length(self) -> float:
        """n Δ in m."""
        return self.n_points * self.spacing

    @property
    def window(self) -> str:
        """Window of its periodograms: ``none`` if periodic, else ``hann``."""
        return "none" if self.periodic else "hann"

    def levelled_lines(self) -> RealArray:
        """(lines, n) heights in m without missing points, each line less its least-squares line
        (less its mean, if periodic).

        Raises InputError if every line lacks more than a tenth of its points.
        """
        missing = np.isnan(self.heights)
        kept = missing.mean(axis=1) <= _MISSING
        if not kept.any():
            raise InputError(
                f"scan {self.name or 'of heights'} must have lines with nine tenths of their points, but has none. "
                "Fill the missing points first: {fill}."
            )
        heights: RealArray = self.heights[kept].copy()
        n = self.n_points
        at = np.arange(n) - 0.5 * (n - 1)
        for line, gaps in zip(heights, missing[kept], strict=True):
            if gaps.any():
                line[gaps] = np.interp(at[gaps], at[~gaps], line[~gaps])
        heights -= heights.mean(axis=1, keepdims=True)
        if not self.periodic:
            heights -= np.outer(heights @ at / (at @ at), at)
        return heights

    def limits(self) -> ScanLimits:
        """Waves that this scan shows reliably, and what limits them."""
        lines = self.levelled_lines()
        ends = [(_ALIASED * self.spacing, "sampling")]
        if math.isfinite(self.tip_radius):
            as_map = Surface(lines.T, self.spacing, periodic=self.periodic)
            ends.append((_OF_TIP * tip_cutoff(scale_dependence(as_map), self.tip_radius), "tip"))
        if math.isfinite(self.resolution):
            ends.append((_OF_RESOLUTION.get(self.kind, 2.0) * self.resolution, "resolution"))
        if self.short_cutoff > 0.0:
            ends.append((_OF_FILTER * self.short_cutoff, "filter"))
        shortest, by = max(ends)
        first = _FIRST[self.window]
        last = 0
        if shortest < self.length / first:  # a mode that is an end but for rounding is inside
            last = min(math.floor(self.length / shortest * (1.0 + 1e-9)), math.ceil(self.n_points / 4) - 1)
        return ScanLimits(self.length / first, shortest, by, first, last)

    def modes(self, limits: ScanLimits | None = None) -> LineModes:
        """Periodograms of the lines inside the ``limits`` (its own by default)."""
        band = limits or self.limits()
        lines, n = self.levelled_lines(), self.n_points
        weights = np.ones(n)
        if not self.periodic:  # of the midpoints, so that it is symmetric
            weights = 1.0 - np.cos(2.0 * np.pi * (np.arange(n) + 0.5) / n)
            weights /= math.sqrt(float(np.mean(np.square(weights))))
        numbers = np.arange(band.first, band.last + 1)
        power = self.spacing / n * np.square(np.abs(line_transform(lines * weights, 1)[:, numbers]))
        return LineModes(
            power,
            numbers.astype(float),
            n,
            self.spacing,
            window_correlation(weights),
            self.window,
            self._transfer(numbers / self.length),
            floor=self.spacing * self.noise**2 if math.isfinite(self.noise) else 0.0,
            distance=self.line_distance,
            periodic=self.periodic,
        )

    def _transfer(self, frequency: RealArray) -> RealArray:
        """Factor of the power at a ``frequency`` (1/m): of an incoherent lens whose amplitude is
        zero at the stated resolution, {(2/π) [arccos x - x sqrt(1 - x²)]}², x = frequency times
        resolution; one for any other instrument."""
        if self.kind != "optical" or not math.isfinite(self.resolution):
            return np.ones(frequency.size)
        x = np.minimum(frequency * self.resolution, 1.0)
        return np.asarray(np.square(2.0 / np.pi * (np.arccos(x) - x * np.sqrt(1.0 - x * x))))

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and main numbers."""
        lines = self.heights.shape[0]
        rows = [
            ("lines", f"{lines} of {self.n_points} points, {show(self.spacing, 'm')} apart"),
            ("length", show(self.length, "m")),
            ("instrument", self.kind or "not known"),
        ]
        return self.name or "Scan", rows


@dataclass(frozen=True)
class ScanLimits:
    """Reliable waves of a scan: ``longest`` and ``shortest`` in m, ``by`` what ends them on the
    short side (``sampling``, ``tip``, ``resolution`` or ``filter``); ``first`` and ``last`` mode of
    a line, none if ``last`` is smaller."""

    longest: float
    shortest: float
    by: str
    first: int
    last: int

    @property
    def usable(self) -> bool:
        """Whether enough modes are left for a spectrum."""
        return self.last - self.first + 1 >= FEWEST_MODES


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Scans(Shown):
    """Scans of one surface, from which follow one spectrum, one set of scale-dependent parameters
    and generated surfaces.

    The surface is taken as isotropic, Gaussian and the same everywhere; where the scans overlap,
    the spectrum tests whether they agree. Raises InputError if there is none, or an item is no
    scan.

    Parameters
    ----------
    items
        Maps, line scans, and ``Scan`` objects, in any mixture.
    axis
        Axis of the maps along which their lines run.
    """

    scans: tuple[Scan, ...]

    def __init__(self, items: Iterable[Any], *, axis: str = "x") -> None:
        found = tuple(Scan.of(item, axis=axis) for item in items)
        if not found:
            raise InputError("scans of a surface must be at least one, but are none.")
        named = [replace_name(scan, f"scan {number + 1}") for number, scan in enumerate(found)]
        object.__setattr__(self, "scans", tuple(named))

    def spectrum(self, *, corner: str = "auto", per_decade: int = 10) -> ScansSpectrum:
        """One spectrum of all scans with errors, reliability limits and findings.

        ``corner`` of the roll-off: ``rounded``, ``sharp``, or the likelier of both (``auto``);
        ``per_decade`` bands of the combined curve per factor of ten.
        Raises InputError if the corner is unknown or no scan has eight reliable modes.
        """
        limits = [scan.limits() for scan in self.scans]
        used = [number for number, band in enumerate(limits) if band.usable]
        if not used:
            bands = "; ".join(
                f"{scan.name}: {max(0, band.last - band.first + 1)}, limited by {band.by}"
                for scan, band in zip(self.scans, limits, strict=True)
            )
            raise InputError(
                f"scans of a surface must have at least {FEWEST_MODES} reliable modes each to be used, but have {bands}"
                ". Take longer scans, or a smaller spacing, tip or filter cut-off."
            )
        modes = [self.scans[number].modes(limits[number]) for number in used]
        names = [scan.name for scan in self.scans]
        unused = tuple((names[number], limits[number].by) for number in range(len(names)) if number not in used)
        found = spectrum_of_scans(
            modes, [names[number] for number in used], corner=corner, per_decade=per_decade, unused=unused
        )
        doubts = [
            replace(item, fact=f"Scan {scan.name}: {item.fact}")
            for scan in self.scans
            for item in scan.findings
            if item.level == "warning"
        ]
        return replace(found, findings=(*doubts, *found.findings))

    def scale_curves(self, spectrum: ScansSpectrum | None = None) -> dict[str, ScaleCurve]:
        """Rms ``height`` in windows, rms ``slope`` and ``curvature`` of profiles against the length
        they are measured over; ``spectrum`` of these scans if it is known already."""
        fit = self.spectrum() if spectrum is None else spectrum
        parts = []
        for scan in self.scans:
            band = scan.limits()
            if band.usable:
                together = math.isfinite(scan.line_distance)
                lines = scan.levelled_lines()
                parts.append(LevelLines(lines, scan.spacing, band.shortest, together, not scan.periodic))
        return {quantity: scale_curve(parts, fit.model, quantity) for quantity in QUANTITIES}

    def limits(self) -> dict[str, ScanLimits]:
        """Reliable waves by the name of the scan."""
        return {scan.name: scan.limits() for scan in self.scans}

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and main numbers."""
        return "Scans of one surface", [(scan.name, scan.in_words()[1][0][1]) for scan in self.scans]


def replace_name(scan: Scan, name: str) -> Scan:
    """``scan`` called ``name`` if it has no name of its own."""
    return scan if scan.name else Scan.of(scan, name=name)
