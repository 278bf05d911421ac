"""Height parameters of ISO 25178-2 about the mean of the valid points, normalised by their number N."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface


def rms_height(surface: Surface) -> float:
    """Sq = sqrt(<z²>) in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.1)."""
    return float(np.sqrt(np.mean(np.square(_deviations(surface)))))


def mean_absolute_height(surface: Surface) -> float:
    """Sa = <|z|> in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.7)."""
    return float(np.mean(np.abs(_deviations(surface))))


def highest_peak(surface: Surface) -> float:
    """Sp = max z in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.4)."""
    return float(_deviations(surface).max())


def deepest_valley(surface: Surface) -> float:
    """Sv = -min z in m, positive, z measured from the mean of the valid points (ISO 25178-2, 4.1.5)."""
    return float(-_deviations(surface).min())


def peak_to_valley(surface: Surface) -> float:
    """Sz = Sp + Sv = max z - min z in m over the valid points (ISO 25178-2, 4.1.6)."""
    valid = _valid(surface)
    return float(valid.max() - valid.min())


def skewness(surface: Surface) -> float:
    """Ssk = <z³>/Sq³, 0 for Gaussian heights (ISO 25178-2, 4.1.2).

    Raises
    ------
    InputError
        If all heights are equal.
    """
    return float(np.mean(_standardised(surface, "skewness") ** 3))


def kurtosis(surface: Surface) -> float:
    """Sku = <z⁴>/Sq⁴, 3 for Gaussian heights (not the excess), never below 1 + Ssk² (ISO 25178-2, 4.1.3).

    Raises
    ------
    InputError
        If all heights are equal.
    """
    return float(np.mean(_standardised(surface, "kurtosis") ** 4))


def _valid(surface: Surface) -> RealArray:
    valid: RealArray = surface.heights[~surface.mask].astype(np.float64, copy=False)
    return valid


def _deviations(surface: Surface) -> RealArray:
    valid = _valid(surface)
    shifted = valid - valid[0]  # a large common offset must not cost digits
    deviations: RealArray = shifted - shifted.mean()
    return deviations


def _standardised(surface: Surface, what: str) -> RealArray:
    deviations = _deviations(surface)
    rms = np.sqrt(np.mean(np.square(deviations)))
    if rms == 0.0:
        raise InputError(f"surface must have heights that differ for its {what} to be defined, but all are equal.")
    standardised: RealArray = deviations / rms
    return standardised
