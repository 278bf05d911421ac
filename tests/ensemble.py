"""Statistics of one realisation, and the acceptance intervals of averages over an ensemble."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from reference_data import Row, reference

from asperity.core.grid import Grid

ROWS = reference("surfaces_ensemble_generation")
"""Acceptance intervals of the generated surfaces beyond the three spectral cases of the Gaussian
ones."""


def rows(case: str) -> list[Row]:
    """Rows of ``case``."""
    return [row for row in ROWS if row["case"] == case]


def row_id(row: Row) -> str:
    return f"{row['case']}-{row['statistic']}"


def average(statistics: Iterable[dict[str, float]]) -> dict[str, float]:
    """Mean of every statistic over the realisations."""
    every = list(statistics)
    return {name: float(np.mean([one[name] for one in every])) for name in every[0]}


def require_accepted(case: str, averages: dict[str, float]) -> None:
    """Every row of ``case`` whose statistic was computed lies in its interval; none may be left out
    but the spectral ones."""
    listed = {row["statistic"]: (row["lower"], row["upper"]) for row in rows(case)}
    assert set(averages) == {name for name in listed if "spec" not in name}
    outside = {name: (averages[name], listed[name]) for name in averages if not _inside(averages[name], listed[name])}
    assert outside == {}


def _inside(value: float, interval: tuple[float, float]) -> bool:
    return interval[0] <= value <= interval[1]


def periodic_statistics(
    heights: np.ndarray, spacing: tuple[float, float], lags: Iterable[tuple[int, int]] = ()
) -> dict:
    """Moments about the realised mean, wrapped differences and autocovariances of a periodic
    map."""
    z = heights - heights.mean()
    dx, dy = spacing
    m0 = np.mean(z**2)
    found = {
        "m0": m0,
        "m2x_fd": np.mean((np.roll(z, -1, 0) - z) ** 2) / dx**2,
        "m2y_fd": np.mean((np.roll(z, -1, 1) - z) ** 2) / dy**2,
        "m4x_fd": np.mean((np.roll(z, -1, 0) - 2 * z + np.roll(z, 1, 0)) ** 2) / dx**4,
        "m4y_fd": np.mean((np.roll(z, -1, 1) - 2 * z + np.roll(z, 1, 1)) ** 2) / dy**4,
        "Ssk": np.mean(z**3) / m0**1.5,
        "Sku": np.mean(z**4) / m0**2,
        "Sa_over_Sq": np.mean(np.abs(z)) / np.sqrt(m0),
    }
    for k, m in lags:
        found[f"acf({k},{m})"] = np.mean(z * np.roll(z, (-k, -m), (0, 1)))
    return found


def raw_statistics(heights: np.ndarray, lags: Iterable[tuple[int, int]] = ()) -> dict[str, float]:
    """Moments and autocovariances about zero."""
    found = {f"raw{power}": np.mean(heights**power) for power in (2, 3, 4)}
    for k, m in lags:
        found[f"acf0({k},{m})"] = np.mean(heights * np.roll(heights, (-k, -m), (0, 1)))
    return found


def exact_lattice(grid: Grid, psd: np.ndarray, weight: Callable[..., np.ndarray]) -> float:
    """(1/A) Σ weight(qx, qy) C over all modes, by an explicit sum over the full plane of modes."""
    nx, ny = grid.shape
    qx, qy = (2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(grid.shape, grid.spacing, strict=True))
    full = np.empty((nx, ny))
    full[:, : ny // 2 + 1] = psd
    for column in range(ny // 2 + 1, ny):
        full[:, column] = np.roll(psd[::-1, ny - column], 1)
    return float(np.sum(weight(qx[:, None], qy[None, :]) * full) / grid.area)
