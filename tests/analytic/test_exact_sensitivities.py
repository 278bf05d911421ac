"""Sensitivities of contacts with exact answers: Westergaard's wave and spheres on coatings.

The edge of a contact lies somewhere between pixels, which scatters derivatives by some per mille.
Grids on which it lies elsewhere show by how much: the mean over them must be exact within their
range.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pytest
from reference_data import Row, reference

import asperity as asp
from asperity.sensitivities import PressureNorm, sensitivities
from asperity.solvers import ActiveSet

CLOSE = ActiveSet(tolerance=1e-8)


def number(row: Row, name: str) -> float:
    """The number in a column."""
    return float(row[name])


def assert_exact(found: Iterable[Mapping[str, float]], wanted: Mapping[str, float], most: float) -> None:
    """The mean over grids is ``wanted`` within their range, which relative to it is at most
    ``most``."""
    several = list(found)
    for name, exact in wanted.items():
        values = np.array([one[name] for one in several])
        spread = float(np.ptp(values))
        assert spread <= most * abs(exact), name
        assert abs(values.mean() - exact) <= spread + 1e-6 * abs(exact), name


@pytest.mark.parametrize(
    "row", reference("sensitivities/westergaard_sensitivities"), ids=lambda row: f"{row['case']:g}"
)
def test_waves(row: Row) -> None:
    norm, found = PressureNorm(number(row, "m")), []
    for n in (1000, 1003, 1010, 1017, 1026, 1033):
        wave = np.cos(2.0 * np.pi * np.arange(n) / n)[:, None]
        problem = asp.ContactProblem(asp.Surface(0.01 * wave, 1.0 / n, 1.0), asp.Elastic(1.0, 0.0))
        result = asp.solve(problem, asp.MeanPressure(number(row, "pbar")), solver=CLOSE)
        of_norm = sensitivities(result, norm, ("force", "heights", "body.youngs_modulus"))
        found.append(
            {
                "p_norm": of_norm.value,
                "dnorm_dpbar": of_norm["force"],
                "dnorm_dEstar": of_norm["body.youngs_modulus"],
                "dnorm_dDelta": float((np.asarray(of_norm["heights"]) * wave).sum()),
                "dapproach_dpbar": sensitivities(result, "approach", "force")["force"],
            }
        )
    wanted = {name: number(row, name) for name in found[0]}
    assert_exact(found, wanted, 0.2 if row["pbar_over_pstar"] == 0.05 else 0.03)


@pytest.mark.parametrize(
    "row", reference("sensitivities/coated_sphere_sensitivities"), ids=lambda row: f"{row['case']:g}"
)
def test_coated_spheres(row: Row) -> None:
    E1, nu1, E2, nu2, h, R, P, a = (number(row, name) for name in ("E1", "nu1", "E2", "nu2", "h", "R", "P", "a"))
    body = asp.Layered([asp.Layer(asp.Elastic(E1, nu1), h)], asp.Elastic(E2, nu2))
    names = {
        "force": "P",
        "body.layers[0].thickness": "h",
        "body.layers[0].youngs_modulus": "E1",
        "body.layers[0].poisson_ratio": "nu1",
        "body.base.youngs_modulus": "E2",
        "body.base.poisson_ratio": "nu2",
    }
    found = []
    for reach in (1.20, 1.215, 1.23, 1.245, 1.26, 1.275):
        n = 96
        x = (np.arange(n) - 0.5 * n + 0.5) * (2.0 * reach * a / n)
        sphere = -0.5 * np.add.outer(x**2, x**2) / R
        problem = asp.ContactProblem(asp.Surface(sphere, x[1] - x[0]), body, boundary=asp.Free())
        result = asp.solve(problem, asp.Force(P), solver=CLOSE)
        # the zero of heights is the apex of the sphere, so that its approach is the offset down
        of_offset = sensitivities(result, "offset")
        one = {f"ddelta_d{symbol}": -float(of_offset[name]) for name, symbol in names.items()}
        one["ddelta_dR"] = float((np.asarray(of_offset["heights"]) * sphere).sum()) / R
        found.append(one)
    assert_exact(found, {name: number(row, name) for name in found[0]}, 0.02)
