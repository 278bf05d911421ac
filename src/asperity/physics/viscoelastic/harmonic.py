"""Small harmonic oscillation of a loaded viscoelastic contact: complex stiffness and loss, by the
complex modulus.

Where the area of contact does not change, the elastic solution holds with complex moduli
(correspondence). A small oscillation about a contact at rest leaves its area as it is, so that one
linear problem on it, K(omega) p = 1, replaces a march through many cycles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...contact.operators import prepare_operator
from ...contact.result import ContactResult, stiffness_of
from ...core import require
from ...core.arrays import ComplexArray
from ...core.errors import ConvergenceError, InputError
from ...solids.compliance.creep import SharedCreep, contact_creep
from .coupling import LayeredPast

_TOLERANCE = 1e-8
"""Relative residual of the linear problem."""

_MOST = 40
"""Cycles of 100 products at most."""


@dataclass(frozen=True)
class HarmonicResponse:
    """Response of a contact to a small oscillation of its approach.

    Attributes
    ----------
    frequency
        Hz.
    stiffness
        Complex amplitude of the mean pressure over that of the approach, Pa/m, for the time
        dependence exp(+i omega t).
    area
        Nominal area, m².
    """

    frequency: float
    stiffness: complex
    area: float

    @property
    def loss_tangent(self) -> float:
        """Imaginary over real part of the stiffness."""
        return self.stiffness.imag / self.stiffness.real

    def heat(self, amplitude: float) -> float:
        """Heat of one cycle in J of an approach that oscillates with ``amplitude`` (m): pi Im(k)
        amplitude² area."""
        return (
            math.pi
            * self.stiffness.imag
            * require.positive(amplitude, "amplitude of the approach (m)") ** 2
            * self.area
        )


def harmonic(result: ContactResult, frequency: float) -> HarmonicResponse:
    """Complex stiffness of the contact ``result`` under a small oscillation of ``frequency``
    (Hz, > 0) about it.

    Of layers it is the mean pressure (Pa) that displaces all points that move by 1 m.

    The area of contact stays as it is, plastic points carry what they carried. Bodies that creep by
    one factor need no further solve than their instantaneous stiffness; layers one linear problem.

    Raises
    ------
    InputError
        If the frequency is not positive, nothing relaxes or touches.
    ConvergenceError
        If the linear problem does not converge.
    """
    omega = 2.0 * math.pi * require.positive(frequency, "frequency (Hz)")
    problem = result.problem
    creep = contact_creep(problem.body, problem.counter_body)
    if creep is None or not result.contact.any():
        raise InputError(
            "contact that oscillates must touch and have a viscoelastic body, but has not. Solve a "
            "ContactProblem with a Viscoelastic."
        )
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    if isinstance(creep, SharedCreep):
        growth = complex(creep.ratio.complex_compliance(omega))
        return HarmonicResponse(frequency, stiffness_of(result, operator=operator) / growth, problem.grid.area)
    from scipy.sparse.linalg import LinearOperator, gmres

    past = LayeredPast.prepared(creep, operator)
    flows = np.isinf(creep.times)
    each = np.where(flows, 1.0 / (1j * omega), 1.0 / (1.0 + 1j * omega * np.where(flows, 0.0, creep.times)))
    kernel = operator.kernel + np.tensordot(each, past.kernels, 1)
    moves = np.asarray(result.contact & ~result.plastic)
    points, scale = np.flatnonzero(moves), float(np.abs(kernel).max())

    def product(values: ComplexArray) -> ComplexArray:
        field = np.zeros(moves.shape, dtype=complex)
        field.flat[points] = values
        x, y = (past.spectrum(np.ascontiguousarray(part)) for part in (field.real, field.imag))
        real, imaginary = past.field(kernel.real * x - kernel.imag * y), past.field(kernel.imag * x + kernel.real * y)
        return np.asarray((real + 1j * imaginary).flat[points] / scale)

    system = LinearOperator((points.size, points.size), matvec=product, dtype=complex)
    ones = np.ones(points.size, dtype=complex)
    found, failed = gmres(system, ones, rtol=_TOLERANCE, restart=min(100, points.size), maxiter=_MOST)
    if failed:
        residual = float(np.linalg.norm(product(found) - ones) / np.linalg.norm(ones))
        raise ConvergenceError(
            f"The linear problem of the oscillation has still a residual of {residual:.1e}. Use a coarser grid."
        )
    return HarmonicResponse(frequency, complex(found.sum()) / (scale * moves.size), problem.grid.area)
