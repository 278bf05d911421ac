"""Criteria of stickiness beside an adhesive contact, from its own profile, bodies and law."""

from __future__ import annotations

import numpy as np

from ...contact.operators.convolution import spectral_kernel
from ...contact.problem import ContactProblem
from ...core.errors import InputError
from ...core.spectral import RealTransform
from ...theories.adhesion.stickiness import Stickiness, stickiness_of


def stickiness(problem: ContactProblem) -> Stickiness:
    """Pastewka and Robbins' and Persson and Tosatti's criteria for the profile of ``problem``,
    taken to repeat.

    Slope, Laplacian and the energy of full contact are sums over the waves of the grid; the energy
    is that of the layered bodies.

    Raises
    ------
    InputError
        If the problem has no adhesion, or its profile is flat.
    """
    if problem.adhesion is None:
        raise InputError(
            "problem of the stickiness must have adhesion, but has none. Give adhesion=ExponentialAdhesion(...)."
        )
    grid, heights = problem.grid, problem.profile()
    if not np.ptp(heights) > 0.0:
        raise InputError("profile of the stickiness must be rough, but is flat. A flat surface is always sticky.")
    power = np.abs(RealTransform(grid.shape).forward(heights - heights.mean())) ** 2 / grid.n_points**2
    twice = np.full(power.shape[1], 2.0)
    twice[0] = 1.0
    if grid.shape[1] % 2 == 0:
        twice[-1] = 1.0
    power = power * twice
    power[0, 0] = 0.0
    qx, qy = grid.wavevector()
    q = np.hypot(qx, qy)
    kernel = spectral_kernel(problem.compliance, grid)
    kernel[0, 0] = 1.0
    slope, laplacian = (float(np.sqrt((power * q ** (2 * order)).sum())) for order in (1, 2))
    full = 0.5 * float((power / kernel).sum())
    law = problem.adhesion
    return stickiness_of(
        slope, laplacian, full, E_star=problem.contact_modulus, work=law.work, reach=law.work / law.strength
    )
