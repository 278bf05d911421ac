"""Gaussian random surfaces by filtered white noise."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform
from ..surface import Origin, Surface
from .spectra import Spectrum, mode_sum


def gaussian(grid: Grid, spectrum: Spectrum, *, seed: int, exact_rms: bool = False) -> Surface:
    """Periodic Gaussian surface with the given power spectrum and zero mean.

    White noise η (standard normal, NumPy's PCG64 stream of ``seed``, drawn in the order of the array) is filtered:
    h = IFFT[FFT[η] sqrt(C/(dx dy))]. Amplitudes and phases are random, so every spectral mode has the expected power
    C only on average and the rms height of one realisation scatters. Equal seeds give equal surfaces on every
    machine up to rounding of the transform.

    Parameters
    ----------
    grid
        Nodes of the surface.
    spectrum
        ``SelfAffine``, ``ExponentialAutocorrelation`` or any object with ``lattice_psd`` and ``describe``; the
        surface cites the papers in its ``citation_keys``, if it has any.
    seed
        Whole number >= 0.
    exact_rms
        Rescale this realisation to the expected rms height. That is another ensemble: mean square slopes and
        curvatures are then biased by up to the relative variance of the mean square height.

    Raises
    ------
    InputError
        If the seed is not a whole number >= 0 or the grid does not suit the spectrum.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    psd = spectrum.lattice_psd(grid)
    target = np.sqrt(mode_sum(grid, psd))
    if not target > 0.0:
        raise InputError("spectrum of a random surface must be positive at some mode, but is zero on this grid.")
    transform = RealTransform(grid.shape)
    noise = np.random.Generator(np.random.PCG64(seed)).standard_normal(grid.shape)
    heights = transform.backward(transform.forward(noise) * np.sqrt(psd / grid.pixel_area))
    text = f"generated: Gaussian, {spectrum.describe(grid)}, PCG64 seed {seed}"
    if exact_rms:
        heights *= target / np.sqrt(np.mean(np.square(heights)))
        text += f", rescaled to the rms height {target:g} m"
    dx, dy = grid.spacing
    origin = Origin(source="gaussian", history=(text,), citation_keys=citation_keys(spectrum))
    return Surface(heights, dx, dy, periodic=True, origin=origin)
