"""Hankel transforms of functions that are smooth on a logarithmic scale (Talman 1978; Hamilton 2000)."""

from __future__ import annotations

import numpy as np

from .arrays import RealArray
from .panels import STEP


def log_hankel(values: RealArray, order: float) -> RealArray:
    """A(r) = ∫ a(k) J_order(kr) r dk for ``values`` of a on a logarithmic grid k_j.

    Parameters
    ----------
    values
        (n,), n even: a at k_j = k_0 exp(j·STEP); it must fall to zero towards both ends of the grid.
    order
        Order of the Bessel function, > -1.

    Returns
    -------
    RealArray
        (n,): A at r_j = exp((j + 1 - n)·STEP)/k_0, which descends to the reciprocal of the largest k. On a logarithmic
        scale the transform is a convolution whose spectrum has modulus one, so it neither loses nor amplifies; its
        error is the alias of A and a beyond the ends, and rounding of the largest value (1e-15 for k exp(-k)).
    """
    from scipy.special import loggamma

    n = values.size
    w = 2.0 * np.pi * np.arange(n // 2 + 1) / (n * STEP)
    phase = 2.0 * loggamma(0.5 * (order + 1.0 + 1j * w)).imag + w * np.log(2.0)
    spectrum = np.fft.rfft(values) * np.exp(1j * phase)
    spectrum[-1] = spectrum[-1].real
    descending: RealArray = np.fft.irfft(spectrum, n)  # index j belongs to k_0 r = exp(-j STEP)
    return descending[::-1]
