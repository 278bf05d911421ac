"""Every contact solver and the cases each must solve, as data; suites are cross products of the
two."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from asperity import (
    Approach,
    ContactProblem,
    Elastic,
    Force,
    Free,
    FreeLine,
    Frictionless,
    Grid,
    Hardness,
    Layer,
    Layered,
    MeanGap,
    MeanPressure,
    Periodic,
    RigidBase,
    Surface,
)
from asperity.contact.boundary import Boundary
from asperity.contact.controls import Control, Step
from asperity.contact.law import InterfaceLaw
from asperity.contact.solve import Prepared
from asperity.contact.solvers.protocol import scaled_to_load
from asperity.core.arrays import RealArray
from asperity.plasticity import HardWall
from asperity.solids.layers import Body
from asperity.solvers import (
    ActiveSet,
    ConjugateGradient,
    ContactQP,
    DenseActiveSet,
    FixedOffset,
    GradientProjection,
    Lemke,
    NogiKato,
    NonNegativeLeastSquares,
    QuasiNewton,
    Solution,
    Solver,
    SteepestDescent,
)

MODULUS = 100e9
"""Contact modulus of every case, Pa."""

BODY = Elastic(MODULUS * (1.0 - 0.3**2), 0.3)

HARD = Elastic(10.0 * MODULUS, 0.2)
SOFT = Elastic(0.05 * MODULUS, 0.45)
RUBBER = Elastic(0.05 * MODULUS, 0.5)

COATED = Layered([Layer(HARD, 0.2e-6)], BODY)
"""A stiff layer two pixels thick."""

LAYERS = Layered([Layer(HARD, 0.05e-6), Layer(SOFT, 0.3e-6, Frictionless()), Layer(HARD, 0.1e-6)], BODY)
"""Stiff on soft on stiff, the soft one slipping."""

ON_ROCK = Layered([Layer(SOFT, 0.5e-6)], RigidBase())
"""A compressible layer on a rigid base: the mean displacement is defined."""

RUBBER_ON_ROCK = Layered([Layer(RUBBER, 0.5e-6)], RigidBase())
"""An incompressible one, whose compliance falls to zero at long wavelengths."""

SOLVERS: dict[str, Solver] = {
    solver.name: solver
    for solver in (
        ActiveSet(tolerance=1e-9),
        ConjugateGradient(tolerance=1e-10),
        NogiKato(tolerance=1e-9),
        SteepestDescent(tolerance=1e-6),
        QuasiNewton(tolerance=1e-8),
        NonNegativeLeastSquares(),
        GradientProjection(tolerance=1e-9),
        DenseActiveSet(),
        Lemke(),
    )
}
"""Each solver with the tolerance that its method reaches in reasonable time."""

EXACT = DenseActiveSet()
"""The reference."""


@dataclass(frozen=True)
class Case:
    """A contact problem with its load; ``surface`` makes the heights when asked."""

    name: str
    surface: Callable[[], Surface]
    control: Control
    boundary: Boundary = Periodic()
    law: Callable[[], InterfaceLaw] = HardWall
    body: Body = BODY

    @property
    def problem(self) -> ContactProblem:
        return ContactProblem(self.surface(), self.body, boundary=self.boundary, law=self.law())


def solved(case: Case, solver: Solver) -> tuple[ContactQP, Solution]:
    """Discrete problem of ``case`` and its solution by ``solver``."""
    contact = Prepared(case.problem, solver=solver).settled(Step(case.control)).contact
    return contact.qp, contact.solution


def feasible_start(qp: ContactQP) -> RealArray:
    """Pressure (Pa) from which no solver can guess the contact: uniform, or none at prescribed
    position."""
    if isinstance(qp.constraint, FixedOffset):
        return np.zeros(qp.profile.shape)
    mean = qp.constraint.mean_pressure
    return scaled_to_load(np.full(qp.profile.shape, mean), qp.cap, mean)


def rough(shape: tuple[int, int] = (12, 12), seed: int = 1, spacing: tuple[float, float] = (1e-7, 1e-7)) -> Surface:
    """Periodic random surface of 1 nm rms height with amplitudes falling like q^-1.8."""
    rng = np.random.default_rng(seed)
    q = Grid(shape, spacing).wavenumber()
    q[0, 0] = np.inf
    heights = np.fft.irfft2(np.fft.rfft2(rng.standard_normal(shape)) * q**-1.8, s=shape)
    return Surface(1e-9 * heights / heights.std(), *spacing, periodic=True)


def oblong() -> Surface:
    """Rough on a grid with nx != ny, odd nx and dx != dy."""
    return rough((11, 16), seed=2, spacing=(1e-7, 0.6e-7))


def sphere() -> Surface:
    """Sphere of 50 µm radius."""
    grid = Grid((15, 15), (1e-7, 1e-7))
    x, y = grid.centred_coordinates()
    return Surface(-(x**2 + y**2) / (2 * 50e-6), *grid.spacing)


def sinusoid() -> Surface:
    """Product of two cosines, 1 nm high; four-fold symmetric, so that many points tie."""
    grid = Grid((12, 12), (1e-7, 1e-7))
    x, y = grid.coordinates()
    return Surface(
        1e-9 * np.cos(2 * np.pi * x / grid.size[0]) * np.cos(2 * np.pi * y / grid.size[1]), *grid.spacing, periodic=True
    )


def summit() -> Surface:
    """One pixel above a plane."""
    heights = np.zeros((8, 9))
    heights[3, 4] = 1e-9
    return Surface(heights, 1e-7, 1e-7)


def spikes() -> Surface:
    """One-pixel spikes of different heights on a rough ground."""
    heights = rough((12, 12), seed=5).heights.copy()
    heights[::4, 1::3] += 1e-8 * (1.0 + 0.1 * np.arange(12).reshape(3, 4))
    return Surface(heights, 1e-7, 1e-7)


def plateau() -> Surface:
    """A step with all points of each level at equal heights."""
    heights = np.zeros((12, 10))
    heights[2:7, 3:8] = 1e-9
    return Surface(heights, 1e-7, 1e-7)


def line(shape: tuple[int, int]) -> Surface:
    """Rough grid of one row or one column."""
    return rough(shape, seed=4)


def hardness_map() -> Hardness:
    """Hardness between 0.3 and 1.2 GPa, different at every point of a 12 x 12 grid."""
    return Hardness(np.random.default_rng(8).uniform(0.3e9, 1.2e9, (12, 12)))


def hardness() -> Hardness:
    """1 GPa."""
    return Hardness(1e9)


def soft() -> Hardness:
    """0.2 GPa."""
    return Hardness(0.2e9)


CASES: tuple[Case, ...] = (
    Case("rough periodic load", rough, MeanPressure(100e6)),
    Case("rough periodic approach", rough, Approach(1.2e-9)),
    Case("rough periodic mean gap", rough, MeanGap(0.8e-9)),
    Case("rough free mean gap", rough, MeanGap(0.8e-9), Free()),
    Case("rough free load", rough, MeanPressure(100e6), Free()),
    Case("rough free force", rough, Force(2e-5), Free()),
    Case("rough free approach", rough, Approach(3e-9), Free()),
    Case("rough periodic hardness load", rough, MeanPressure(150e6), law=hardness),
    Case("rough periodic hardness approach", rough, Approach(1.8e-9), law=soft),
    Case("rough free hardness load", rough, MeanPressure(150e6), Free(), soft),
    Case("rough periodic hardness beyond full contact", rough, Approach(3e-9), law=soft),
    Case("rough free hardness approach", rough, Approach(3e-9), Free(), soft),
    Case("rough periodic hardness map", rough, MeanPressure(200e6), law=hardness_map),
    Case("rough free hardness map", rough, Approach(4e-9), Free(), hardness_map),
    Case("rough larger", lambda: rough((22, 22), seed=3), MeanPressure(60e6)),
    Case("oblong periodic", oblong, MeanPressure(100e6)),
    Case("oblong free", oblong, Approach(2e-9), Free()),
    Case("oblong periodic hardness", oblong, MeanPressure(150e6), law=hardness),
    Case("sphere free force", sphere, Force(5e-5), Free()),
    Case("sphere free approach", sphere, Approach(2e-9), Free()),
    Case("sinusoid", sinusoid, MeanPressure(50e6)),
    Case("sinusoid hardness", sinusoid, MeanPressure(50e6), law=soft),
    Case("nearly full contact", sinusoid, MeanPressure(250e6)),
    Case("full contact", rough, MeanPressure(10e9)),
    Case("full contact free", rough, MeanPressure(10e9), Free()),
    Case("flat periodic", lambda: Surface(np.zeros((8, 8)), 1e-7, 1e-7), MeanPressure(1e6)),
    Case("flat free", lambda: Surface(np.zeros((8, 8)), 1e-7, 1e-7), MeanPressure(1e6), Free()),
    Case("single summit", summit, MeanPressure(1e3), Free()),
    Case("single summit pressed in", summit, MeanPressure(1e9)),
    Case("one-pixel spikes", spikes, MeanPressure(100e6)),
    Case("plateau periodic", plateau, MeanPressure(10e6)),
    Case("plateau free approach", plateau, Approach(0.5e-9), Free()),
    Case("plateau hardness", plateau, MeanPressure(20e6), law=soft),
    Case("one row", lambda: line((1, 48)), MeanPressure(50e6)),
    Case("one column", lambda: line((40, 1)), Approach(1e-9), Free()),
    Case("very low load", rough, MeanPressure(1.0)),
    Case("very low load hardness", rough, MeanPressure(1.0), Free(), hardness),
    Case("mean pressure just below the hardness", rough, MeanPressure(0.1998e9), law=soft),
    Case("mean pressure just below the hardness free", rough, MeanPressure(0.1998e9), Free(), soft),
    Case("coated periodic load", rough, MeanPressure(200e6), body=COATED),
    Case("coated periodic mean gap", oblong, MeanGap(0.8e-9), body=COATED),
    Case("coated free force", rough, Force(5e-5), Free(), body=COATED),
    Case("coated free hardness approach", rough, Approach(3e-9), Free(), soft, COATED),
    Case("three layers periodic load", rough, MeanPressure(100e6), body=LAYERS),
    Case("three layers free approach", oblong, Approach(3e-9), Free(), body=LAYERS),
    Case("soft layer on a rigid base load", rough, MeanPressure(5e6), body=ON_ROCK),
    Case("soft layer on a rigid base approach", rough, Approach(1.5e-9), body=ON_ROCK),
    Case("soft layer on a rigid base free", rough, Force(1e-6), Free(), body=ON_ROCK),
    Case("soft layer on a rigid base full contact", rough, Approach(6e-9), body=ON_ROCK),
    Case("rubber on a rigid base load", rough, MeanPressure(5e6), body=RUBBER_ON_ROCK),
    Case("rubber on a rigid base approach", rough, Approach(1e-9), body=RUBBER_ON_ROCK),
    Case("rubber on a rigid base free", rough, Force(2e-6), Free(), body=RUBBER_ON_ROCK),
    Case("line load", lambda: line((48, 1)), MeanPressure(50e6), FreeLine()),
    Case("line approach", lambda: line((40, 1)), Approach(2e-9), FreeLine(), body=COATED),
    Case("line hardness", lambda: line((40, 1)), MeanPressure(60e6), FreeLine(1e-3), soft, COATED),
    Case("line on a rigid base", lambda: line((40, 1)), Approach(1e-9), FreeLine(), body=ON_ROCK),
)
"""Every case; small, so that the exact solvers take milliseconds."""

UNSUPPORTED: dict[tuple[str, str], str] = {
    ("lemke", "rough larger"): "484 points are more than the 400 of the tableau method",
}
"""Reason by (solver, case) for what a solver refuses."""


def pair_id(value: Solver | Case) -> str:
    """Name of a parameter in test reports."""
    return value.name.replace(" ", "-")
