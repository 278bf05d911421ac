"""Each physics of the interface alone against stored values of an independent route: plain loops
around a dense solver.

``python tests/agreement/test_coupling_references.py`` (in ``tests``, with it on the path) writes
``tests/reference/couplings.csv`` anew: every normal contact by the dense active set to rounding,
menisci and shear repeated until nothing changes, limits of a film damped (soft) or as they are
(hard), load paths step by step from the indentation left.
"""

from __future__ import annotations

import csv
from typing import NamedTuple

import numpy as np
import pytest
from contact_cases import rough
from reference_data import FOLDER, reference

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.solvers.protocol import feasible_start
from asperity.core.arrays import RealArray
from asperity.physics.friction.sliding import ShearKernel
from asperity.physics.menisci.film import wetting
from asperity.solvers import ContactQP, DenseActiveSet, FixedMean, run

BODY = asp.Elastic(0.91, 0.2)
MU = 0.8
LOADS = (0.05, 0.15, 0.02, 0.2)


def film(base: float, top: float) -> asp.Layered:
    upper, lower = (asp.Elastic(0.91, 0.3, asp.Strength(hardness=h)) for h in (top, base))
    return asp.Layered([asp.Layer(upper, 0.2)], lower)


def case(name: str) -> asp.ContactProblem:
    bodies = {"soft film": film(0.8, 0.3), "hard film": film(0.3, 0.6)}
    body = bodies.get(name, BODY)
    laws = {"path": asp.Hardness(0.4)} | {key: asp.plasticity.LayeredHardness(found) for key, found in bodies.items()}
    liquid = asp.LiquidFilm(surface_tension=0.02, thickness=0.4, contact_angles=(0.0, 0.0))
    return asp.ContactProblem(
        rough((16, 12), 2),
        body,
        law=laws.get(name, asp.plasticity.HardWall()),
        film=liquid if name == "menisci" else None,
        friction=asp.Coulomb(MU, 0.3) if name == "sliding" else None,
    )


class Solved(NamedTuple):
    """Pressure (Pa), plane level and overlap at the cap (m)."""

    pressure: RealArray
    level: float
    overlap: RealArray
    gap: RealArray


class Dense:
    """Normal contacts of one problem to rounding."""

    def __init__(self, problem: asp.ContactProblem) -> None:
        self.problem, self.profile = problem, problem.profile()
        self.operator = prepare_operator(
            problem.compliance, problem.grid, problem.boundary, engine=asp.engines.CpuEngine(1)
        )

    def solved(self, mean: float, lift: RealArray | float = 0.0, cap: RealArray | float = np.inf) -> Solved:
        heights = self.profile - lift
        qp = ContactQP(self.operator, heights, cap, FixedMean(mean), float(self.profile.std()))
        solution = run(DenseActiveSet(tolerance=1e-10), qp, feasible_start(qp, None))
        assert solution.status.converged
        p = solution.state.pressure
        r = self.operator.apply(p) - heights
        between = (p > 0.0) & (p < cap)
        level = float(np.average(r[between], weights=p[between]))
        return Solved(p, level, np.where(p >= cap, np.maximum(level - r, 0.0), 0.0), np.maximum(r - level, 0.0))


def independent(name: str) -> dict[str, float]:
    """Values of the case ``name`` by the independent route."""
    problem = case(name)
    dense, mean, extra = Dense(problem), 0.1, {}
    if name == "menisci":
        pixel, pull = problem.film.suction * problem.grid.pixel_area, 0.0
        for _ in range(100):
            found = dense.solved(mean + pull / problem.grid.area)
            latest = pixel * np.count_nonzero(
                wetting(found.gap, found.pressure > 0.0, problem.film, wraps=(True, True)).menisci
            )
            if latest == pull:
                break
            pull = latest
        extra = {"extra": pull}
    elif name == "sliding":
        shear = ShearKernel.of(problem, (MU * np.cos(0.3), MU * np.sin(0.3)))
        lift = np.zeros(problem.grid.shape)
        for _ in range(300):
            found = dense.solved(mean, lift)
            lift = 0.5 * (lift + shear.displacement(found.pressure))
        extra = {"extra": float(np.abs(lift).max())}
    elif name in ("soft film", "hard film"):
        cap, share = np.full(problem.grid.shape, problem.law.pressure_cap()), 0.1 if name == "soft film" else 1.0
        for _ in range(600):
            found = dense.solved(mean, 0.0, cap)
            cap = cap + share * (problem.law.cap_at(found.overlap) - cap)
        extra = {"extra": float(found.overlap.sum())}
    else:
        indentation = np.zeros(problem.grid.shape)
        for mean in LOADS:
            found = dense.solved(mean, indentation, 0.4)
            indentation = indentation + found.overlap
        extra = {"extra": float(indentation.sum())}
    top = float(dense.profile.max())
    area = np.count_nonzero(found.pressure) / found.pressure.size
    return {"area": area, "peak": float(found.pressure.max()), "approach": top + found.level, **extra}


def coupled(name: str) -> dict[str, float]:
    """The same by ``solve``."""
    problem = case(name)
    tight = asp.solvers.ActiveSet(tolerance=1e-12)
    control = asp.History([asp.MeanPressure(load) for load in LOADS]) if name == "path" else asp.MeanPressure(0.1)
    answer = asp.solve(problem, control, solver=tight)
    found = answer.last if isinstance(answer, asp.HistoryResult) else answer
    extra = float(found.permanent_indentation.sum())
    if found.menisci is not None:
        extra = found.menisci.meniscus_force
    if found.sliding is not None:
        extra = float(np.abs(found.sliding.shear_displacement).max())
    return {"area": found.area_fraction, "peak": found.max_pressure, "approach": found.approach, "extra": extra}


CASES = ("menisci", "sliding", "soft film", "hard film", "path")


def test_every_coupling_alone_gives_the_stored_values() -> None:
    rows, wrong = {row["case"]: row for row in reference("couplings")}, []
    for name in CASES:
        for key, value in coupled(name).items():
            if value != pytest.approx(rows[name][key], rel=2e-5):
                wrong.append(f"{name}, {key}: {value}, stored {rows[name][key]}")
    assert not wrong, wrong


if __name__ == "__main__":
    with (FOLDER / "couplings.csv").open("w", encoding="utf-8") as file:
        file.write("# test_coupling_references.py: plain loops around a dense solver; unit E*-scale, 16 x 12 points\n")
        file.write("# extra: force of the menisci, largest displacement by shear, sum of the permanent indentation\n")
        writer = csv.DictWriter(file, ["case", "area", "peak", "approach", "extra"])
        writer.writeheader()
        for name in CASES:
            writer.writerow({"case": name, **{key: f"{value:.10g}" for key, value in independent(name).items()}})
