"""Where the work of a load path goes: into elastic energy, which comes back, and into plastic flow, which does not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from .path import LoadPath


@dataclass(frozen=True, eq=False)
class EnergyBalance:
    """Energies after each step of a path in J, counted from its start.

    Parameters
    ----------
    external_work
        ∫ F dδ of the force over the approach, by the trapezoidal rule through the steps.
    elastic_energy
        Half of pressure times displacement, less that at the start.
    plastic_work
        Sum of the plastic works of the steps.
    """

    external_work: RealArray
    elastic_energy: RealArray
    plastic_work: RealArray

    @property
    def residual(self) -> RealArray:
        """External work less elastic energy and plastic work: the error of the trapezoidal rule, of second order."""
        return self.external_work - self.elastic_energy - self.plastic_work

    @property
    def relative_error(self) -> float:
        """Largest magnitude of the residual over the largest external work; zero where no work was done."""
        largest = float(np.abs(self.external_work).max())
        return float(np.abs(self.residual).max()) / largest if largest > 0.0 else 0.0


def energy_balance(path: LoadPath) -> EnergyBalance:
    """Energies along ``path``, counted from the touching of the unloaded bodies, dented as the path found them.

    A path that goes on from a loaded interface is counted from its first step instead.

    Where the bodies touch, gap = offset + u - h + w = 0 and dδ = du + dw, so that F dδ = Σ p du + Σ p dw: the change of
    the elastic energy, K being symmetric, and the plastic work, p being the hardness where dw > 0. Periodic bodies are
    measured without the mean mode on both sides.
    """
    force, approach, elastic, plastic = path.force, path.approach, path.elastic_energy, np.cumsum(path.plastic_work)
    if path.start is None or not path.start.pressure.any():
        virgin = path.results[0].problem.profile()
        dented = virgin if path.start is None else virgin - path.start.permanent_indentation
        force = np.concatenate([[0.0], force])
        approach = np.concatenate([[float(virgin.max() - dented.max())], approach])
        work = np.cumsum(_trapezia(force, approach))
    else:
        work = np.concatenate([[0.0], np.cumsum(_trapezia(force, approach))])
        elastic, plastic = elastic - elastic[0], plastic - plastic[0]
    return EnergyBalance(work, elastic, plastic)


def _trapezia(force: RealArray, approach: RealArray) -> RealArray:
    pieces: RealArray = 0.5 * (force[1:] + force[:-1]) * np.diff(approach)
    return pieces
