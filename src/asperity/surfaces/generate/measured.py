"""Spectra taken from numbers: a table, or a measured surface ("more like this one")."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.units import show
from ..surface import Surface

if TYPE_CHECKING:
    from ..characterise.spectrum import PowerSpectrum

_NOTHING = 1e-300  # C in m⁴ that stands for none
_MIXED = 2.5  # modes below are mixed with the mean by a window


@dataclass(frozen=True, eq=False, init=False)
class TabulatedSpectrum:
    """Isotropic spectrum given by a table: ln C linear in ln q between the rows, constant below, zero beyond the last.

    Parameters
    ----------
    q
        Wavenumbers in rad/m, positive and ascending.
    psd
        C in m⁴ at these wavenumbers, not negative; zero rows cut the spectrum between their neighbours.
    words
        What it is, for the history.
    citation_keys
        Papers behind it.

    Raises
    ------
    InputError
        If the two columns are not of one length of at least 2, or hold values out of range.
    """

    q: RealArray
    psd: RealArray
    words: str
    citation_keys: tuple[str, ...]

    def __init__(
        self, q: ArrayLike, psd: ArrayLike, *, words: str = "tabulated spectrum", citation_keys: tuple[str, ...] = ()
    ) -> None:
        columns = [np.array(values, dtype=np.float64) for values in (q, psd)]
        _require_table(columns[0], columns[1])
        for values in columns:
            values.flags.writeable = False
        given = {"q": columns[0], "psd": columns[1], "words": words, "citation_keys": tuple(citation_keys)}
        for name, value in given.items():
            object.__setattr__(self, name, value)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: the longest wave of the table."""
        return float(2.0 * np.pi / self.q[0])

    def interpolated(self, q: RealArray) -> RealArray:
        """C in m⁴ at the wavenumbers ``q`` (rad/m, any shape), zero at q = 0."""
        with np.errstate(divide="ignore"):
            log_c = np.interp(np.log(q), np.log(self.q), np.log(np.maximum(self.psd, _NOTHING)), right=-np.inf)
        values: RealArray = np.where(q > 0.0, np.exp(log_c), 0.0)
        return values

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        return self.interpolated(grid.wavenumber())

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        longest, shortest = 2.0 * np.pi / self.q[0], 2.0 * np.pi / self.q[-1]
        return f"{self.words}, waves of {show(shortest, 'm')} to {show(longest, 'm')}"


@dataclass(frozen=True, eq=False)
class MeasuredSpectrum:
    """Spectrum of a measured surface with all its directions: C of the nearest modes, linear in between, zero outside.

    ``spectrum`` of ``source``; on the grid of a periodic surface it is met mode by mode. Waves longer than the measured
    surface have the power of its longest ones.
    """

    spectrum: PowerSpectrum
    source: str = "a surface"
    citation_keys: tuple[str, ...] = ()

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: the size of the measured surface."""
        return max(self.spectrum.grid.size)

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        from scipy.ndimage import map_coordinates

        measured = self.spectrum.grid
        psd = self.spectrum.psd.copy()
        psd[0, 0] = _beside_mean(psd)
        plane = _plane(psd, measured.shape[1])
        step_x, step_y = (2.0 * np.pi / side for side in measured.size)
        qx, qy = grid.wavevector()
        row = np.broadcast_to(_on_modes(qx / step_x) + measured.shape[0] // 2, (qx.size, qy.size))
        column = np.broadcast_to(_on_modes(qy / step_y) + 1.0, row.shape)
        values: RealArray = map_coordinates(plane, [row, column], order=1, mode="constant", cval=0.0)
        values[0, 0] = 0.0
        return values

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        window = "" if self.spectrum.window == "none" else f" through a {self.spectrum.window} window"
        return f"spectrum of {self.source}{window}"


def spectrum_of(
    surface: Surface, *, isotropic: bool = True, window: str = "auto", per_decade: int = 20, floor: float = 0.0
) -> TabulatedSpectrum | MeasuredSpectrum:
    """Spectrum of a measured ``surface``, to generate more of the same on any grid.

    Level the surface and fill missing points first. One that is not periodic is windowed (Hann), without which the
    jump between its borders would be generated too; the lowest modes, which a window mixes with the mean, take the power
    of the next ones. Waves longer than the surface have that power too, waves shorter than those of its grid none. The
    shortest waves of a square grid run along its diagonals: the isotropic average takes their power for all directions, and
    keeps that of every ring of wavenumbers.

    Parameters
    ----------
    surface
        Complete surface.
    isotropic
        Average over directions; otherwise keep them, with the scatter that the single modes of one surface have.
    window
        As for ``power_spectrum``.
    per_decade
        Rings per factor of ten in wavenumber over which an isotropic spectrum is averaged.
    floor
        Constant C_n in m⁴ to be subtracted: white noise of the instrument, mean square height times dx dy.

    Raises
    ------
    InputError
        If points are missing, all heights are equal, or nothing is left above the floor.
    """
    from ..characterise.spectrum import power_spectrum
    from .rings import ring_table

    if not require.finite(floor, "floor of the spectrum (m^4)") >= 0.0:
        raise InputError(f"floor of the spectrum (m^4) must be zero or greater, but is {floor:g}.")
    spectrum = power_spectrum(surface, window)
    source = surface.origin.source or "a surface"
    keys = tuple(dict.fromkeys((*surface.citation_keys, *spectrum.citation_keys)))
    first = 0.0 if spectrum.window == "none" else _MIXED
    if isotropic:
        lowest = first * 2.0 * np.pi / min(spectrum.grid.size)
        q, psd = ring_table(spectrum, per_decade=per_decade, lowest=lowest, floor=floor)
        _require_some(psd, floor)
        return TabulatedSpectrum(q, psd, words=f"radial spectrum of {source}", citation_keys=keys)
    psd = np.maximum(_without_mixed(spectrum, first) - floor, 0.0)
    _require_some(psd, floor)
    return MeasuredSpectrum(replace(spectrum, psd=psd), source, keys)


def _on_modes(number: RealArray) -> RealArray:
    """Numbers of modes, whole where they differ from a whole one by rounding only."""
    whole = np.round(number)
    return np.where(np.abs(number - whole) < 1e-9, whole, number)


def _beside_mean(psd: RealArray) -> float:
    """Mean of C over the modes next to the mean, along x and y."""
    neighbours = [*(psd[k, 0] for k in (1, -1) if psd.shape[0] > 1), *psd[0, 1:2]]
    return float(np.mean(neighbours)) if neighbours else 0.0


def _require_some(psd: RealArray, floor: float) -> None:
    if not psd.any():
        raise InputError(
            f"surface whose spectrum is to be generated must be rough beyond the floor of {floor:g} m^4, but is not."
        )


def _without_mixed(spectrum: PowerSpectrum, first: float) -> RealArray:
    """C with the modes nearer than ``first`` steps to the mean replaced by the mean of those of the next step."""
    qx, qy = spectrum.grid.wavevector()
    step_x, step_y = (2.0 * np.pi / side for side in spectrum.grid.size)
    distance = np.hypot(qx / step_x, qy / step_y)
    psd, mixed = spectrum.psd.copy(), distance < first
    beyond = (distance >= first) & (distance < first + 1.0)
    if mixed.any() and beyond.any():
        psd[mixed] = psd[beyond].mean()
    psd[0, 0] = 0.0
    return psd


def _plane(psd: RealArray, count_y: int) -> RealArray:
    """C on the modes kx = -(nx // 2) … nx // 2 and ky = -1 … ny // 2, from the half spectrum."""
    count_x = psd.shape[0]
    rows = np.roll(psd, count_x // 2, axis=0)
    if count_x % 2 == 0:
        rows = np.concatenate([rows, rows[:1]])  # both signs of the Nyquist wavenumber
    column = min(1, count_y // 2)
    return np.concatenate([rows[::-1, column : column + 1], rows], axis=1)


def _require_table(q: RealArray, psd: RealArray) -> None:
    if q.ndim != 1 or q.shape != psd.shape or q.size < 2:
        raise InputError(
            f"table of a spectrum must have two columns of equal length, at least 2, but has {q.shape} and {psd.shape}."
        )
    if not (np.isfinite(q).all() and np.isfinite(psd).all() and q[0] > 0.0 and (np.diff(q) > 0.0).all()):
        raise InputError("wavenumbers of a spectrum (rad/m) must be positive and ascending numbers, but are not.")
    if not ((psd >= 0.0).all() and psd.any()):
        raise InputError("spectrum C (m^4) of a table must not be negative, and positive somewhere, but is not.")
