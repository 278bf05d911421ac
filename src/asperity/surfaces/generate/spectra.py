"""Power spectra of random surfaces in the convention C of Jacobs, Junge & Pastewka (2017).

m0 = (1/A) Σ C(q) over the modes of a periodic map, → (1/4π²) ∫ C d²q; C in m⁴, wavenumbers q = 2π/λ
in rad/m.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import Declared, checked
from ...core.units import show
from ...core.values import Hurst, Length, NonNegativeLength, Number, Positive
from ..characterise.spectrum import PowerSpectrum, default_edges, power_spectrum, radial_spectrum
from ..surface import Surface
from .gaussian import Spectrum
from .power_laws import (
    Amplitude,
    PlateauPSD,
    PowerLaws,
    RmsHeight,
    RmsSlope,
    amplitude_text,
    lattice_level,
    lattice_psd,
    require_amplitude,
)

__all__ = ["PlateauPSD", "RmsHeight", "RmsSlope", "SelfAffine", "Spectrum", "TwoSlopes"]


RollOff: TypeAlias = Annotated[Length, "wavelength λ_r above which the spectrum is flat"]
ShortestWave: TypeAlias = Annotated[NonNegativeLength, "shortest wave λ_s; 0m for all that the grid holds"]
LongestWave: TypeAlias = Annotated[float, Number("length", above=0.0, infinite=True), "longest wave λ_L; inf for all"]


class _PowerLawSpectrum(Declared, ABC):
    """What spectra of power laws share: of this ``kind``, with wavelengths in the ``order``."""

    amplitude: Amplitude
    rolloff_wavelength: float
    shortest_wavelength: float
    longest_wavelength: float
    kind: ClassVar[str]
    order: ClassVar[tuple[str, ...]]
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    def __post_init__(self) -> None:
        super().__post_init__()
        require_amplitude(self.amplitude, self.kind)
        waves = [getattr(self, f"{name.replace('-', '')}_wavelength") for name in self.order]
        if not all(short <= long for short, long in pairwise(waves)):
            listed = ", ".join(f"{wave:g}" for wave in waves)
            raise InputError(
                f"wavelengths of a {self.kind} spectrum must satisfy {' <= '.join(self.order)}, but are {listed} m."
            )

    @property
    @abstractmethod
    def bends(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Wavenumbers (rad/m) at which the spectrum bends, and the exponents with which it falls
        beyond each."""

    @cached_property
    def law(self) -> PowerLaws:
        """Shape of the spectrum."""
        high = math.inf if self.shortest_wavelength == 0.0 else 2.0 * np.pi / self.shortest_wavelength
        return PowerLaws(*self.bends, 2.0 * np.pi / self.longest_wavelength, high)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are uncorrelated: two roll-off wavelengths or the
        longest wave."""
        twice = 2.0 * self.rolloff_wavelength
        return twice if math.isinf(self.longest_wavelength) else max(twice, self.longest_wavelength)

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ of the continuous surface at wavenumbers ``q`` (rad/m, any shape).

        C0 follows from <h²> = (1/2π) ∫ q C dq or <|∇h|²> = (1/2π) ∫ q³ C dq. Raises InputError if
        the integral diverges.
        """
        level = self.amplitude.value
        if not isinstance(self.amplitude, PlateauPSD):
            moment = self.law.integral(1.0 if isinstance(self.amplitude, RmsHeight) else 3.0) / (2.0 * np.pi)
            if math.isinf(moment):
                raise InputError(
                    "shortest wavelength must be greater than zero for an rms slope of the continuous surface "
                    "to be finite, but is 0. Give a cut-off, or the plateau of the spectrum."
                )
            level = self.amplitude.value**2 / moment
        return level * self.law.relative(np.asarray(q, dtype=float))

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid cannot resolve the shortest wavelength or holds no mode of the
        spectrum.
        """
        return lattice_psd(self.law, self.amplitude, grid)


@dataclass(frozen=True, kw_only=True)
class SelfAffine(_PowerLawSpectrum):
    """Plateau and power law: C = C0 for q_L <= q <= q_r, C0 (q/q_r)^(-2-2H) for q_r < q <= q_s,
    zero elsewhere.

    ``amplitude`` fixes C0; on a grid an rms height or rms slope is met exactly by the sum over the
    modes of that grid (ensemble average), in :meth:`psd` by the integral. Source: Jacobs, Junge &
    Pastewka (2017), section 2. λ_s <= λ_r <= λ_L; λ_L = λ_r has no plateau, λ_L = inf excludes only
    the mean, λ_s = 0 keeps all modes of the grid, those in the corners of the Nyquist square too.
    Raises InputError if the wavelengths are out of order.
    """

    amplitude: Annotated[Amplitude, "what fixes C0"]
    hurst: Annotated[Hurst, "Hurst exponent H"]
    rolloff_wavelength: RollOff
    shortest_wavelength: ShortestWave
    longest_wavelength: LongestWave = math.inf
    kind: ClassVar[str] = "self-affine"
    order: ClassVar[tuple[str, ...]] = ("shortest", "roll-off", "longest")

    @property
    def bends(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Roll-off (rad/m) and the exponent beyond."""
        return (2.0 * np.pi / self.rolloff_wavelength,), (2.0 + 2.0 * self.hurst,)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        waves = (
            f"roll-off {show(self.rolloff_wavelength, 'm')}, {_ends(self.shortest_wavelength, self.longest_wavelength)}"
        )
        return f"self-affine, Hurst exponent {self.hurst:.4g}, {waves}, {amplitude_text(self.amplitude)}"


@dataclass(frozen=True, kw_only=True)
class TwoSlopes(_PowerLawSpectrum):
    """Plateau and two power laws: C0 up to q_r, C0 (q/q_r)^-a1 up to q_c, then continued as q^-a2
    up to q_s.

    Films whose asperities are smooth, or rounded by the tip of the instrument, fall faster than
    q^-4 (H > 1): such a spectrum is no fractal, and is accepted. ``amplitude`` as for
    ``SelfAffine``. λ_s <= λ_c <= λ_r <= λ_L. Raises InputError if the wavelengths are out of order.
    """

    amplitude: Annotated[Amplitude, "what fixes C0"]
    exponents: Annotated[
        tuple[Positive, Positive], "exponents a1,a2 of the falling spectrum q^-a before and after the crossover"
    ]
    rolloff_wavelength: RollOff
    crossover_wavelength: Annotated[Length, "wavelength λ_c at which the exponent changes"]
    shortest_wavelength: ShortestWave = 0.0
    longest_wavelength: LongestWave = math.inf
    kind: ClassVar[str] = "two-slope"
    order: ClassVar[tuple[str, ...]] = ("shortest", "crossover", "roll-off", "longest")

    @property
    def bends(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Roll-off and crossover (rad/m) and the exponents beyond."""
        return (2.0 * np.pi / self.rolloff_wavelength, 2.0 * np.pi / self.crossover_wavelength), tuple(self.exponents)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        first, second = self.exponents
        bends = (
            f"q^-{first:.4g} from {show(self.rolloff_wavelength, 'm')}, q^-{second:.4g} from "
            f"{show(self.crossover_wavelength, 'm')}"
        )
        ends = _ends(self.shortest_wavelength, self.longest_wavelength)
        return f"two slopes, {bends}, {ends}, {amplitude_text(self.amplitude)}"


def _ends(shortest: float, longest: float) -> str:
    short = "all short waves of the grid" if shortest == 0.0 else f"shortest wave {show(shortest, 'm')}"
    return short if math.isinf(longest) else f"{short}, longest wave {show(longest, 'm')}"


# Spectra taken from numbers: a table, or a measured surface ("more like this one").


_NOTHING = 1e-300  # C in m⁴ that stands for none
_MIXED = 2.5  # modes below are mixed with the mean by a window


@dataclass(frozen=True, eq=False, init=False)
class TabulatedSpectrum:
    """Isotropic spectrum given by a table: ln C linear in ln q between the rows, constant below,
    zero beyond the last.

    Raises InputError if the two columns are not of one length of at least 2, or hold values out of
    range.

    Parameters
    ----------
    q
        Wavenumbers in rad/m, positive and ascending.
    psd
        C in m⁴ at these wavenumbers, not negative; zero rows cut the spectrum between their
        neighbours.
    words
        What it is, for the history.
    citation_keys
        Papers behind it.
    """

    q: RealArray
    psd: RealArray
    words: str
    citation_keys: tuple[str, ...]

    def __init__(
        self, q: ArrayLike, psd: ArrayLike, *, words: str = "tabulated spectrum", citation_keys: tuple[str, ...] = ()
    ) -> None:
        q, psd = (np.array(values, dtype=np.float64) for values in (q, psd))
        if q.ndim != 1 or q.shape != psd.shape or q.size < 2:
            raise InputError(
                f"table of a spectrum must have two columns of equal length, at least 2, but has {q.shape} and "
                f"{psd.shape}."
            )
        if not (np.isfinite(q).all() and np.isfinite(psd).all() and q[0] > 0.0 and (np.diff(q) > 0.0).all()):
            raise InputError("wavenumbers of a spectrum (rad/m) must be positive and ascending numbers, but are not.")
        if not ((psd >= 0.0).all() and psd.any()):
            raise InputError("spectrum C (m^4) of a table must not be negative, and positive somewhere, but is not.")
        q.flags.writeable = psd.flags.writeable = False
        given = {"q": q, "psd": psd, "words": words, "citation_keys": tuple(citation_keys)}
        for name, value in given.items():
            object.__setattr__(self, name, value)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: the longest wave of the
        table."""
        return float(2.0 * np.pi / self.q[0])

    def interpolated(self, q: RealArray) -> RealArray:
        """C in m⁴ at the wavenumbers ``q`` (rad/m, any shape), zero at q = 0."""
        with np.errstate(divide="ignore"):
            log_c = np.interp(np.log(q), np.log(self.q), np.log(np.maximum(self.psd, _NOTHING)), right=-np.inf)
        return np.where(q > 0.0, np.exp(log_c), 0.0)

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        return self.interpolated(grid.wavenumber())

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        longest, shortest = 2.0 * np.pi / self.q[0], 2.0 * np.pi / self.q[-1]
        return f"{self.words}, waves of {show(shortest, 'm')} to {show(longest, 'm')}"


@dataclass(frozen=True, eq=False)
class MeasuredSpectrum:
    """Spectrum of a measured surface with all its directions: C of the nearest modes, linear in
    between, zero outside.

    ``spectrum`` of ``source``; on the grid of a periodic surface it is met mode by mode. Waves
    longer than the measured surface have the power of its longest ones.
    """

    spectrum: PowerSpectrum
    source: str = "a surface"
    citation_keys: tuple[str, ...] = ()

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: the size of the measured
        surface."""
        return max(self.spectrum.grid.size)

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        from scipy.ndimage import map_coordinates

        measured = self.spectrum.grid
        psd = self.spectrum.psd.copy()
        beside = [*(psd[k, 0] for k in (1, -1) if psd.shape[0] > 1), *psd[0, 1:2]]  # modes next to the mean
        psd[0, 0] = float(np.mean(beside)) if beside else 0.0
        # the modes kx = -(nx // 2) … nx // 2 and ky = -1 … ny // 2
        rows = np.roll(psd, measured.shape[0] // 2, axis=0)
        if measured.shape[0] % 2 == 0:
            rows = np.concatenate([rows, rows[:1]])  # both signs of the Nyquist wavenumber
        before = min(1, measured.shape[1] // 2)
        plane = np.concatenate([rows[::-1, before : before + 1], rows], axis=1)
        step_x, step_y = (2.0 * np.pi / side for side in measured.size)
        qx, qy = grid.wavevector()
        modes = []  # numbers, whole where they differ from a whole one by rounding only
        for number in (qx / step_x, qy / step_y):
            whole = np.round(number)
            modes.append(np.where(np.abs(number - whole) < 1e-9, whole, number))
        row = np.broadcast_to(modes[0] + measured.shape[0] // 2, (qx.size, qy.size))
        column = np.broadcast_to(modes[1] + 1.0, row.shape)
        values: RealArray = map_coordinates(plane, [row, column], order=1, mode="constant", cval=0.0)
        values[0, 0] = 0.0
        return values

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        window = "" if self.spectrum.window == "none" else f" through a {self.spectrum.window} window"
        return f"spectrum of {self.source}{window}"


@checked
def spectrum_of(
    surface: Annotated[Surface, "measured heights; levelled and filled"],
    *,
    isotropic: Annotated[bool, "average over all directions"] = True,
    window: str = "auto",
    per_decade: int = 20,
    floor: Annotated[
        float,
        Number("power spectrum", least=0.0),
        "noise C_n to be subtracted: mean square height of the noise times dx dy",
    ] = 0.0,
) -> TabulatedSpectrum | MeasuredSpectrum:
    """Spectrum of a measured ``surface``, to generate more of the same on any grid.

    Level the surface and fill missing points first. One that is not periodic is windowed (Hann),
    without which the jump between its borders would be generated too; the lowest modes, which a
    window mixes with the mean, take the power of the next ones. Waves longer than the surface have
    that power too, waves shorter than those of its grid none. The shortest waves of a square grid
    run along its diagonals: the isotropic average takes their power for all directions, and keeps
    that of every ring of wavenumbers. ``window`` is that of ``power_spectrum``, ``per_decade`` the
    rings per factor of ten in wavenumber of an isotropic spectrum. Raises InputError if points are
    missing, all heights are equal, or nothing is left above the floor.
    """
    spectrum = power_spectrum(surface, window)
    source = surface.origin.source or "a surface"
    keys = tuple(dict.fromkeys((*surface.citation_keys, *spectrum.citation_keys)))
    first = 0.0 if spectrum.window == "none" else _MIXED
    if isotropic:
        lowest = first * 2.0 * np.pi / min(spectrum.grid.size)
        q, psd = ring_table(spectrum, per_decade=per_decade, lowest=lowest, floor=floor)
    else:
        qx, qy = spectrum.grid.wavevector()
        step_x, step_y = (2.0 * np.pi / side for side in spectrum.grid.size)
        distance = np.hypot(qx / step_x, qy / step_y)
        psd, mixed = spectrum.psd.copy(), distance < first
        beyond = (distance >= first) & (distance < first + 1.0)
        if mixed.any() and beyond.any():
            psd[mixed] = psd[beyond].mean()
        psd[0, 0] = 0.0
        psd = np.maximum(psd - floor, 0.0)
    if not psd.any():
        raise InputError(
            f"surface whose spectrum is to be generated must be rough beyond the floor of {floor:g} m^4, but is not."
        )
    if isotropic:
        return TabulatedSpectrum(q, psd, words=f"radial spectrum of {source}", citation_keys=keys)
    return MeasuredSpectrum(replace(spectrum, psd=psd), source, keys)


# The table of an isotropic spectrum whose interpolation keeps the power of every ring of modes it
# was averaged over.


_PARTS = 8  # of a ring, for the sum of the interpolated spectrum over it
_MOST = 3.0  # factor that a mean is scaled by at most: between empty rings nothing keeps the power of one
_ROUNDS = 12  # they leave 1e-4 of the power of a ring of a smooth spectrum, 1e-2 where it is cut off within one


def ring_table(spectrum: PowerSpectrum, *, per_decade: int, lowest: float, floor: float) -> tuple[RealArray, RealArray]:
    """Wavenumbers (rad/m) and C (m⁴) of the rings beyond ``lowest`` (rad/m) to the corners of the
    grid, less the ``floor`` (m⁴).

    The means of C over the rings, between which a power law is taken, would lose power where C is
    curved: 2 % of the mean square height at a roll-off, 12 % of the mean square curvature at a
    cut-off. They are scaled until the interpolated spectrum sums up to the power of each ring.
    """
    edges = default_edges(spectrum, per_decade, corners=True)
    rings = radial_spectrum(spectrum, edges)
    kept = rings.q >= lowest
    q, modes = rings.q[kept], rings.modes[kept]
    wanted = np.maximum(rings.psd[kept] - floor, 0.0) * modes
    q, psd = np.append(q, rings.high[-1]), wanted / modes
    if not wanted.any():
        return q, np.append(psd, 0.0)
    steps = np.arange(_PARTS * (edges.size - 1) + 1) / _PARTS
    parts = radial_spectrum(spectrum, np.exp(np.interp(steps, np.arange(edges.size), np.log(edges))))
    middle = np.sqrt(parts.low * parts.high)
    inside = middle > rings.low[kept][0]
    ring = np.searchsorted(rings.high[kept], middle[inside])
    for _ in range(_ROUNDS):
        table = TabulatedSpectrum(q, np.append(psd, psd[-1]))
        found = np.bincount(ring, table.interpolated(parts.q[inside]) * parts.modes[inside], psd.size)
        psd *= np.divide(wanted, found, out=np.ones_like(psd), where=(found > 0.0) & (wanted > 0.0))
        psd = np.clip(psd, wanted / modes / _MOST, wanted / modes * _MOST)
    return q, np.append(psd, psd[-1])


# Spectra column by column of the half spectrum, for grids whose modes do not fit into the memory.


Columns = Callable[[slice], RealArray]
"""C in m⁴ on the columns of the half spectrum that a slice names, shape (nx, columns)."""


def spectrum_columns(spectrum: Spectrum, grid: Grid, width: int) -> Columns:
    """``spectrum.lattice_psd(grid)`` in pieces; ``width`` columns at a time where a sum over all
    modes is needed first.

    Raises InputError if the spectrum is not a function of the wavenumber alone, or the grid does
    not suit it.
    """
    if isinstance(spectrum, TabulatedSpectrum):
        table = spectrum
        return lambda columns: table.interpolated(_wavenumber(grid, columns))
    if not isinstance(spectrum, SelfAffine | TwoSlopes):
        raise InputError(
            "spectrum of a surface beyond the memory must be SelfAffine, TwoSlopes or a table of the "
            f"wavenumber, but is {type(spectrum).__name__}. Use endless(), or on the command line "
            "digital_filter, for autocorrelations."
        )
    law = spectrum.law
    level = lattice_level(
        law, spectrum.amplitude, grid, ((c, law.relative(_wavenumber(grid, c))) for c in column_slices(grid, width))
    )
    return lambda columns: level * law.relative(_wavenumber(grid, columns))


def column_slices(grid: Grid, width: int) -> Iterator[slice]:
    """All columns of the half spectrum of ``grid``, ``width`` at a time."""
    count = grid.shape[1] // 2 + 1
    return (slice(start, min(start + width, count)) for start in range(0, count, width))


def _wavenumber(grid: Grid, columns: slice) -> RealArray:
    qx, qy = grid.wavevector()
    return np.hypot(qx, qy[:, columns])
