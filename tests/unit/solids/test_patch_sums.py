"""Sums of weights and influence coefficients without the latter, and of weights and tables."""

from __future__ import annotations

import numpy as np
import pytest

from asperity.core.arrays import RealArray
from asperity.core.grid import Grid
from asperity.core.interpolation import covering_grid, log_table
from asperity.solids.compliance.influence import Limits, patch_coefficients, point_kernel, wavenumber_grid
from asperity.solids.compliance.patch_sums import PatchSums


@pytest.mark.parametrize("grid", [Grid((64, 48), (1.0, 1.0)), Grid((40, 70), (1.0, 0.6)), Grid((9, 1), (1.0, 2.0))])
def test_sums_are_those_of_the_coefficients(grid: Grid) -> None:
    weights = np.random.default_rng(3).standard_normal(grid.shape)
    limits = [Limits(high, low, 2.0) for high, low in ((1.0, 3.0), (2.0, 0.5), (0.0, 1.0))]

    def values(alpha: RealArray) -> RealArray:
        return np.array(
            [each.high + (each.low - each.high) * np.exp(-2.0 * alpha) + alpha * np.exp(-alpha) for each in limits]
        )

    kernels = [point_kernel(samples, each) for samples, each in zip(values(wavenumber_grid(2.0)), limits, strict=True)]
    found = PatchSums.of(grid, weights, 2.0).sums(values, limits, thinnest=0.5, width=0.1)
    wanted = [float((weights * patch_coefficients(kernel, grid)).sum()) for kernel in kernels]
    size = float((np.abs(weights) * patch_coefficients(kernels[0], grid)).sum())
    # what is left out at long waves
    assert found == pytest.approx(wanted, abs=1e-10 * size)


def test_moments_of_a_table_give_sums_of_its_values() -> None:
    nodes = covering_grid(0.1, 50.0)
    table = log_table(float(nodes[0]), np.exp(-nodes) + 1.0 / (1.0 + nodes))
    generator = np.random.default_rng(5)
    x, weights = generator.uniform(0.1, 50.0, 400), generator.standard_normal(400)
    found = float((table.moments(x, weights) * table.coefficients).sum())
    assert found == pytest.approx(float((weights * table(x)).sum()), abs=1e-12 * float(np.abs(weights).sum()))
