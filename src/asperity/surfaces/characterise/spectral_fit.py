"""Fit of a plateau and power laws to a measured spectrum by Whittle's likelihood.

The values of a periodogram are exponentially distributed about C(q), so -2 ln L = Σ N_b [I_b/C(q_b) + ln C(q_b)] over
rings of N_b modes with the mean I_b, each pair of opposite modes counted once (Whittle 1953).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.errors import InputError
from .spectral_cutoff import short_cutoff
from .spectral_model import SpectralModel
from .spectrum import PowerSpectrum, RadialSpectrum, default_edges, radial_spectrum
from .whittle import Shape, Solution, fitted_shape
from .windows import LOST_MODES

_TOP = 0.95  # share of the Nyquist wavenumber up to which modes serve
_FIRST_WINDOWED = 2.5  # first two modes of a windowed map are mixed with its mean
_PLATEAU_MODES = 10.0  # fewer modes below the roll-off say nothing of a plateau
_FEWEST_RINGS = 8  # two more than the parameters of the richest shape

SHAPES = tuple(
    Shape(plateau, slopes, floor) for slopes in (1, 2) for plateau in (False, True) for floor in (False, True)
)
"""The shapes that are tried: one or two power laws, with or without a plateau, with or without a floor."""


@dataclass(frozen=True, eq=False)
class SpectralFit:
    """Model of a spectrum with the standard errors of its parameters.

    ``model``; ``errors``: relative standard error of ``level``, ``rolloff_wavelength``, ``crossover_wavelength`` and
    ``floor``, absolute one of ``exponent_1``, ``exponent_2``, for the parameters that were fitted (Fisher information,
    modes lost to the window counted); ``first``, ``last`` wavenumber (rad/m) of the fitted range; ``short_cutoff``
    wavelength (m) below which the spectrum vanishes, NaN if it goes on to the end of the range; ``mean_square_ratio``,
    ``slope_ratio`` mean square height and slope of the model over those of the spectrum in the range; ``rings`` the
    spectrum that was fitted; ``candidates`` Bayesian information criterion, less the best, by shape.
    """

    model: SpectralModel
    errors: dict[str, float]
    first: float
    last: float
    short_cutoff: float
    mean_square_ratio: float
    slope_ratio: float
    rings: RadialSpectrum
    candidates: dict[str, float]
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017", "Whittle1953")

    @property
    def has_rolloff(self) -> bool:
        """Whether the scan shows a plateau; without one, its roll-off lies beyond the scan."""
        return self.model.has_plateau

    @property
    def hurst_error(self) -> float:
        """Standard error of the Hurst exponent of the first power law."""
        return 0.5 * self.errors["exponent_1"]


def fit_spectrum(
    spectrum: PowerSpectrum,
    *,
    plateau: bool | None = None,
    slopes: int | None = None,
    floor: bool | None = None,
    reliable_wavelength: float = 0.0,
    model_error: float = 0.0,
) -> SpectralFit:
    """Fit ``spectrum`` by the shape that the Bayesian information criterion prefers.

    Parameters
    ----------
    spectrum
        Spectrum of a levelled surface.
    plateau, slopes, floor
        Whether the model has a plateau, how many power laws (1 or 2), whether it has a floor of white noise; by default
        the criterion decides. A plateau of less than ten modes is found only if it is asked for.
    reliable_wavelength
        Shortest wavelength in m that the instrument resolves (see ``tip_cutoff``); shorter ones are left out.
    model_error
        Relative error of the form itself, which no real surface has exactly; 0.1 keeps the thousands of short waves of a
        measured map from ruling the fit, 0 suits surfaces that were generated with such a spectrum.

    Raises
    ------
    InputError
        If fewer than eight rings of modes hold power, or an argument is out of range.
    """
    if slopes not in (None, 1, 2):
        raise InputError(f"number of power laws of a spectrum must be 1 or 2, but is {slopes!r}.")
    require.finite(reliable_wavelength, "shortest reliable wavelength (m)")
    rings, cutoff = _usable(spectrum, reliable_wavelength)
    lost = LOST_MODES[spectrum.window] ** 2
    weighed = _with_model_error(rings, lost, require.finite(model_error, "relative error of the model"))
    found = _solutions(weighed, rings, (plateau, slopes, floor))
    criteria = {item.shape.name: _criterion(item, weighed, lost) for item in found}
    best = min(found, key=lambda item: criteria[item.shape.name])
    model = replace(best.model(2.0 * math.pi / rings.low[0]), shortest_wavelength=0.0 if math.isnan(cutoff) else cutoff)
    return SpectralFit(
        model,
        best.errors(weighed, lost),
        first=float(rings.low[0]),
        last=float(rings.high[-1]),
        short_cutoff=cutoff,
        mean_square_ratio=_ratio(model, rings, 0),
        slope_ratio=_ratio(model, rings, 2),
        rings=rings,
        candidates={name: value - criteria[best.shape.name] for name, value in criteria.items()},
    )


def _criterion(item: Solution, rings: RadialSpectrum, lost: float) -> float:
    """Bayesian information criterion: -2 ln L + k ln(number of independent modes)."""
    return item.deviance / lost + item.shape.parameters * math.log(0.5 * float(rings.modes.sum()))


def _ratio(model: SpectralModel, rings: RadialSpectrum, power: int) -> float:
    """Mean square height (``power`` 0) or slope (2) of ``model`` over that of the spectrum, in the range of ``rings``."""
    weight = rings.modes * rings.q**power
    return float(weight @ model.psd(rings.q) / (weight @ rings.psd))


def _with_model_error(rings: RadialSpectrum, lost: float, error: float) -> RadialSpectrum:
    """Rings that count as few modes as give their means the variance 2 ``lost``/N + ``error``² relative to C²."""
    return replace(rings, modes=1.0 / (1.0 / rings.modes + error**2 / (2.0 * lost)))


def _usable(spectrum: PowerSpectrum, reliable_wavelength: float) -> tuple[RadialSpectrum, float]:
    """Rings that serve a fit, and the short cut-off wavelength (m, NaN if there is none)."""
    first = 0.0 if spectrum.window == "none" else _FIRST_WINDOWED * 2.0 * np.pi / min(spectrum.grid.size)
    last = _TOP * spectrum.nyquist
    if reliable_wavelength > 0.0:
        last = min(last, 2.0 * np.pi / reliable_wavelength)
    edges = default_edges(spectrum)
    edges = np.unique(np.clip(edges, max(first, edges[0]), max(last, edges[0])))
    rings = radial_spectrum(spectrum, edges) if edges.size > 1 else _empty(spectrum)
    cutoff = short_cutoff(spectrum, rings)
    if not math.isnan(cutoff):
        edges = np.unique(np.minimum(edges, cutoff))
        rings = radial_spectrum(spectrum, edges)
    if rings.q.size < _FEWEST_RINGS or not np.all(rings.psd > 0.0):
        raise InputError(
            f"spectrum must hold power in at least {_FEWEST_RINGS} rings of modes for a fit, but has {rings.q.size}. "
            "Use a map of more points, or one that is not flat."
        )
    return rings, 2.0 * math.pi / cutoff


def _empty(spectrum: PowerSpectrum) -> RadialSpectrum:
    none = np.empty(0)
    return RadialSpectrum(none, none, none, none, none, spectrum.window)


def _solutions(
    weighed: RadialSpectrum, rings: RadialSpectrum, wishes: tuple[bool | None, int | None, bool | None]
) -> list[Solution]:
    """Fits of the shapes that agree with the ``wishes``; a plateau that was not asked for must be seen."""
    found = [fitted_shape(weighed, shape) for shape in SHAPES if _wanted(shape, wishes)]
    return [item for item in found if wishes[0] is not None or _plateau_is_seen(item, rings)]


def _wanted(shape: Shape, wishes: tuple[bool | None, int | None, bool | None]) -> bool:
    features = (shape.plateau, shape.slopes, shape.floor)
    return all(wish is None or wish == feature for wish, feature in zip(wishes, features, strict=True))


def _plateau_is_seen(item: Solution, rings: RadialSpectrum) -> bool:
    """Whether a plateau, if the shape has one, is held by enough modes."""
    if not item.shape.plateau:
        return True
    on_plateau = rings.modes[rings.q < 2.0 * math.pi / item.model(math.inf).rolloff_wavelength]
    return bool(on_plateau.sum() >= _PLATEAU_MODES)
