"""Sums of weights and influence coefficients without the latter, and of weights and tables."""

from __future__ import annotations

import numpy as np
import pytest

from asperity.core.grid import Grid
from asperity.core.interpolation import covering_grid, log_table
from asperity.solids.compliance.influence import Limits, patch_coefficients, patch_sums, point_kernel, wavenumber_grid


@pytest.mark.parametrize("grid", [Grid((64, 48), (1.0, 1.0)), Grid((40, 70), (1.0, 0.6)), Grid((9, 1), (1.0, 2.0))])
def test_sums_are_those_of_the_coefficients(grid: Grid) -> None:
    weights = np.random.default_rng(3).standard_normal(grid.shape)
    alpha = wavenumber_grid(2.0)
    kernels = [
        point_kernel(high + (low - high) * np.exp(-2.0 * alpha) + alpha * np.exp(-alpha), Limits(high, low, 2.0))
        for high, low in ((1.0, 3.0), (2.0, 0.5), (0.0, 1.0))
    ]
    found = patch_sums(kernels, grid, weights)
    wanted = [float((weights * patch_coefficients(kernel, grid)).sum()) for kernel in kernels]
    size = float((np.abs(weights) * patch_coefficients(kernels[0], grid)).sum())
    assert found == pytest.approx(wanted, abs=1e-12 * size)


def test_moments_of_a_table_give_sums_of_its_values() -> None:
    nodes = covering_grid(0.1, 50.0)
    table = log_table(float(nodes[0]), np.exp(-nodes) + 1.0 / (1.0 + nodes))
    generator = np.random.default_rng(5)
    x, weights = generator.uniform(0.1, 50.0, 400), generator.standard_normal(400)
    found = float((table.moments(x, weights) * table.coefficients).sum())
    assert found == pytest.approx(float((weights * table(x)).sum()), abs=1e-12 * float(np.abs(weights).sum()))
