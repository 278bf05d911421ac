"""Other packages, each called as its documentation says, on the same heights with the same
tolerance.

Pixels have unit size and every package gets the contact modulus 1, so pressures come in units of
E*. Times include everything from heights in memory to pressure: models, operators and plans are
made anew in each solve.
"""

from __future__ import annotations

import importlib.util
import time
from dataclasses import dataclass
from importlib.metadata import version
from typing import ClassVar

import numpy as np
from method import Method, Solved
from numpy.typing import NDArray

_MANY = 100_000


@dataclass
class Tamaas:
    """Polonsky & Keer's conjugate gradients in C++ with FFTW and OpenMP; its error is the one of
    the field."""

    threads: int
    name: str = "Tamaas"

    def __post_init__(self) -> None:
        import tamaas

        self.version = version("tamaas")
        tamaas.set_log_level(tamaas.LogLevel.error)
        tamaas.initialize(self.threads)

    def supports(self, n: int) -> bool:
        return n > 0

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float) -> Solved:
        import tamaas

        own = heights.copy()
        started = time.perf_counter()
        model = tamaas.Model(tamaas.model_type.basic_2d, list(own.shape), list(own.shape))
        model.E, model.nu = 0.91, 0.3  # before the solver registers operators, which take them over
        solver = tamaas.PolonskyKeerRey(model, own, tolerance)
        solver.max_iter = _MANY
        error = solver.solve(load * model.E_star)
        seconds = time.perf_counter() - started
        if not error <= tolerance:
            raise RuntimeError(f"Tamaas stopped at the error {error:.2e}.")
        return Solved(np.array(model.traction).reshape(own.shape) / model.E_star, seconds)


@dataclass
class ContactMechanicsCG:
    """Polonsky & Keer's constrained conjugate gradients in NumPy with the serial FFT of muGrid: one
    thread."""

    threads: int
    name: str = "ContactMechanics"

    def __post_init__(self) -> None:
        self.version = version("ContactMechanics")
        self.threads = 1

    def supports(self, n: int) -> bool:
        return n > 0

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float) -> Solved:
        from ContactMechanics import PeriodicFFTElasticHalfSpace
        from ContactMechanics.Systems import NonSmoothContactSystem
        from SurfaceTopography import Topography

        started = time.perf_counter()
        shape = heights.shape
        substrate = PeriodicFFTElasticHalfSpace(shape, 1.0, shape)  # Young's modulus at nu = 0: the contact modulus
        system = NonSmoothContactSystem(substrate, Topography(heights, shape, periodic=True))
        found = system.minimize_proxy(
            external_force=load * heights.size, pentol=tolerance * float(heights.std()), maxiter=_MANY
        )
        seconds = time.perf_counter() - started
        if not found.success:
            raise RuntimeError(f"ContactMechanics did not converge: {found.message}")
        return Solved(np.array(found.jac), seconds, {"iterations": float(found.nit)})  # pixels of unit area


@dataclass
class Aspher:
    """Nested grids and preconditioned conjugate gradients in C++, periodic spectral operator,
    double precision.

    Its tolerance is relative to the range of the heights, not to their rms; ``matched`` passes one
    that is smaller by that ratio, so that the field's error is what is asked for.
    """

    threads: int
    matched: bool = False
    name: str = "ASPHER"
    coarsest: ClassVar[int] = 64

    def __post_init__(self) -> None:
        self.version = version("aspher")
        self.name = "ASPHER matched" if self.matched else "ASPHER"

    def supports(self, n: int) -> bool:
        ratio, rest = divmod(n, self.coarsest)
        return rest == 0 and ratio > 0 and ratio & (ratio - 1) == 0

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float) -> Solved:
        import aspher

        started = time.perf_counter()
        n = heights.shape[0]
        share = float(heights.std() / np.ptp(heights)) if self.matched else 1.0
        found = aspher.solve_nested(
            grid_size=n,
            gap=heights.max() - heights,
            p_nominal=load,
            domain_size=float(n),
            E_star=1.0,
            coarsest=self.coarsest,
            tol=tolerance * share,
            precision="double",
            backend="periodic",
        )
        seconds = time.perf_counter() - started
        if not found.converged:
            raise RuntimeError(f"ASPHER did not converge: {found.status}")
        pressure = np.array(found.pressure, dtype=float).reshape(heights.shape)
        return Solved(pressure, seconds, {"iterations": float(found.iterations)})


_PACKAGES = {
    "tamaas": "tamaas",
    "contactmechanics": "ContactMechanics",
    "aspher": "aspher",
    "aspher-matched": "aspher",
}

PEERS = tuple(_PACKAGES)
"""Names on the command line."""


def make(peer: str, threads: int) -> Method:
    """The adapter of ``peer``."""
    if peer == "tamaas":
        return Tamaas(threads)
    return ContactMechanicsCG(threads) if peer == "contactmechanics" else Aspher(threads, peer == "aspher-matched")


def installed(peer: str) -> bool:
    """Whether the package of ``peer`` can be imported."""
    return importlib.util.find_spec(_PACKAGES[peer]) is not None
