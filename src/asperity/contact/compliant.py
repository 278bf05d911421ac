"""Half-spaces in contact through an interface of normal compliance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.quantity import measured
from ..solids.compliant_interface import CompliantInterface
from .law import HardWall
from .operators import Operator, prepare_operator
from .problem import ContactProblem

TOLERANCE = 1e-10
"""Residual over the approach at which the interface has settled."""

MOST_ITERATIONS = 60
"""Newton iterations; 6 to 20 are usual."""

MOST_STEPS = 2000
"""Conjugate gradients in each; some 20 on soft interfaces, some hundred on hard ones."""


@dataclass(frozen=True, eq=False)
class CompliantContact:
    """Bodies that press on an interface between them.

    Attributes
    ----------
    pressure
        (nx, ny), positive wherever the interface is compressed.
    overlap
        (nx, ny) compression of the interface, negative where it is open.
    force
        Sum of the pressure.
    area
        Where the interface is compressed.
    residuals
        For each Newton iteration, over the approach.
    """

    pressure: RealArray = measured("Pa", "contact pressure", "x", "y")
    overlap: RealArray = measured("m", "compression of the interface", "x", "y")
    force: float = measured("N", "normal force")
    area: float = measured("m^2", "area where the interface is compressed")
    residuals: tuple[float, ...] = measured("1", "residual over the approach", "iteration")


def compliant_contact(problem: ContactProblem, interface: CompliantInterface, approach: float) -> CompliantContact:
    """Press the bodies of ``problem`` onto an interface p = c w^m between them, without friction.

    The interface gives way beside the bodies, w = Δ - g - K p, a layer of nonlinear springs in
    series with the half-spaces. The pressure minimises a convex energy and is unique. Newton's
    method on w with D = dp/dw,

        (I + sqrt(D) K sqrt(D)) v = -sqrt(D) F,

    whose matrix is symmetric and positive. A hard interface leads to the contact without one, from
    which it departs as (p/c)^(1/m) over the approach.

    Parameters
    ----------
    problem
        Of elastic or layered bodies, without other physics of the interface and without a limit of
        the pressure.
    interface
        Its law.
    approach
        Δ in m since first touch of the highest point, > 0; on periodic grids, where the datum of
        displacement is its mean, that of the mean planes.

    Raises
    ------
    InputError
        If the approach is not positive, or the problem has what the interface does not know.
    ConvergenceError
        If Newton's method does not settle.

    Examples
    --------
    >>> import asperity as asp
    >>> grid = asp.Grid((64, 64), (1e-7, 1e-7))
    >>> wave = asp.generate.sinusoid(grid, amplitude=10e-9, wavelength=6.4e-6)
    >>> problem = asp.ContactProblem(wave, asp.Elastic(91e9, 0.3))
    >>> joint = asp.fem.CompliantInterface(stiffness=1e25, exponent=2.0)
    >>> found = compliant_contact(problem, joint, approach=5e-9)
    >>> f"{found.pressure.mean() / 1e6:.0f} MPa over {found.area / grid.area:.0%}"
    '23 MPa over 33%'
    """
    require.positive(approach, "approach of the interface (m)")
    if problem.physics or not isinstance(problem.law, HardWall):
        more = ", ".join(type(item).__name__ for item in (*problem.physics, problem.law))
        raise InputError(
            f"problem of a compliant interface must have the bodies alone, but has {more}. Leave out its physics and "
            "its limit of the pressure."
        )
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    profile = problem.profile()
    wanted: RealArray = approach - (profile.max() - profile)
    overlap = 0.5 * np.maximum(wanted, 0.0) + np.minimum(wanted, 0.0)
    left = overlap + operator.apply(interface.pressure(overlap)) - wanted
    residuals: list[float] = []
    for _ in range(MOST_ITERATIONS):
        residuals.append(float(np.abs(left).max()) / approach)
        if residuals[-1] <= TOLERANCE:
            pressure = interface.pressure(overlap)
            pixel = problem.grid.pixel_area
            area = pixel * float((overlap > 0.0).sum())
            return CompliantContact(pressure, overlap, pixel * float(pressure.sum()), area, tuple(residuals))
        root = np.sqrt(interface.slope(overlap))
        move = -left - operator.apply(root * _conjugate(operator, root, -root * left))
        part, size = 1.0, float(np.linalg.norm(left))
        while True:  # the residual must fall
            tried = overlap + part * move
            new = tried + operator.apply(interface.pressure(tried)) - wanted
            if float(np.linalg.norm(new)) < (1.0 - 1e-4 * part) * size or part < 1e-6:
                break
            part *= 0.5
        overlap, left = tried, new
    raise ConvergenceError(
        f"The compression of the interface is not found: a residual of {residuals[-1]:.1e} of the approach is left. "
        "Take a softer interface."
    )


def _conjugate(operator: Operator, root: RealArray, right: RealArray) -> RealArray:
    """v of (I + √D K √D) v = ``right`` by conjugate gradients."""
    found, left = np.zeros_like(right), right.copy()
    direction, square = left.copy(), float((left * left).sum())
    goal = 1e-18 * square
    for _ in range(MOST_STEPS):
        if square <= goal:
            break
        image = direction + root * operator.apply(root * direction)
        step = square / float((direction * image).sum())
        found += step * direction
        left -= step * image
        before, square = square, float((left * left).sum())
        direction = left + square / before * direction
    return found
