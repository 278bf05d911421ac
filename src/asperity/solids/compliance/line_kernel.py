"""Plane strain: surface displacement of strips along y, from the spectrum of the body.

A line force gives u(x) with x du/dx = -L(x)/pi, L(x) = ∫ alpha C sin(alpha x) x d(alpha), which runs from alpha C at short
wavelengths to alpha C at long ones. On a half-space base u grows like -ln x for ever (Flamant 1892): the plane problem
fixes it up to a constant only, and the displacement at a stated distance, the datum, is called zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.hankel import log_hankel
from ...core.panels import LogTable, log_table
from .point_kernel import Limits, wavenumber_grid


@dataclass(frozen=True, eq=False)
class LineKernel:
    """``descent``, the integral of L/x, and ``moment``, the integral of L, both from 0 (1/Pa, m/Pa), over x in m.

    ``infinity`` is the distance (m) that serves as datum on a rigid base; infinite on a half-space, where none serves.
    """

    descent: LogTable
    moment: LogTable
    infinity: float


_DIED_OUT = 1e4
"""Distance over thickness of the layers at which displacements on a rigid base are zero: they fall exponentially, over 30
thicknesses where a film is a million times stiffer than what it lies on."""


def line_kernel(values: RealArray, limits: Limits) -> LineKernel:
    """Kernel of the compliance with ``values`` of alpha C (1/Pa) on ``wavenumber_grid(limits.depth)``.

    sin z = sqrt(pi z/2) J_1/2(z) makes L a Hankel transform.
    """
    d, jump = limits.depth, limits.low - limits.high
    alpha = wavenumber_grid(d)
    x = 1.0 / alpha[::-1]
    remainder = values - limits.high - jump * np.exp(-alpha * d)
    wave = np.sqrt(0.5 * np.pi * x) * log_hankel(remainder * np.sqrt(alpha), 0.5)
    slope = limits.high + jump * x**2 / (x**2 + d**2) + wave
    start = float(x[0])
    moment = log_table(start, slope * x)
    moment = moment.integral(float(slope[0]) * moment.start)
    return LineKernel(log_table(start, slope).integral(), moment, infinity=np.inf if limits.low else _DIED_OUT * d)


def strip_coefficients(kernel: LineKernel, grid: Grid, datum: float) -> RealArray:
    """Displacement (m/Pa), shape (nx, 1), at offsets (0…nx-1) dx from a strip of width dx under unit pressure.

    It is relative to that at the distance ``datum`` (m) from a line load; on a rigid base relative to the base.
    With the descent D and the moment M, the integral of u from 0 to X is [X (D(datum) - D(X)) + M(X)]/pi.
    """
    zero = kernel.descent(np.array([datum if kernel.infinity == np.inf else kernel.infinity]))
    edge = (np.arange(grid.shape[0]) + 0.5) * grid.spacing[0]
    integral: RealArray = (edge * (zero - kernel.descent(edge)) + kernel.moment(edge)) / np.pi
    return _between_edges(integral)


def half_space_strips(grid: Grid, datum: float) -> RealArray:
    """``strip_coefficients`` of a half-space with E' = 1: the integral of -2/pi ln(x/datum) (Johnson 1985, eq. 2.24)."""
    edge = (np.arange(grid.shape[0]) + 0.5) * grid.spacing[0]
    return _between_edges(2.0 / np.pi * edge * (1.0 - np.log(edge / datum)))


def _between_edges(integral: RealArray) -> RealArray:
    """Differences of an odd ``integral`` given at the upper edges of the strips; the first strip reaches from -edge to edge."""
    differences: RealArray = np.diff(integral, prepend=-integral[0])
    return differences[:, None]
