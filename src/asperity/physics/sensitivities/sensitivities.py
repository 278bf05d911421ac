"""Derivatives of one number of a solved contact: by one linear solve on its set, or from several
loads."""

from __future__ import annotations

from collections.abc import Iterable

from ...contact.result import ContactResult
from ...core.engine import Engine
from ...core.errors import InputError
from .answer import Sensitivities
from .one_load import at_one_load
from .outputs import Output, output
from .ranged import RANGED, over_loads
from .system import RESIDUAL, Held
from .yielding import FirstYield, yield_factor


def sensitivities(
    result: ContactResult,
    of: str | Output = "approach",
    to: str | Iterable[str] = "all",
    *,
    held: Held | None = None,
    tolerance: float = RESIDUAL,
    engine: Engine | None = None,
) -> Sensitivities:
    """Derivatives of a number of the contact ``result`` with respect to its parameters.

    The solution of a contact is piecewise smooth: while no point changes its state it follows
    parameters linearly on its set, and one linear solve with the adjoint right-hand side gives the
    derivatives of the number with respect to all parameters at once, every height included (Giles
    & Pierce 2000). Before, the pressure is corrected on the set where its residual is above 1e-8.

    Parameters
    ----------
    result
        A contact of elastic bodies under pressure, with a hardness or none: periodic, free or a
        line. Solve it to a tolerance of 1e-6 or better where derivatives matter.
    of
        ``"approach"`` from first touch (m), ``"offset"`` of the bodies (m; without the highest
        point, from which the approach counts), ``"force"`` (N; at held approach),
        ``"mean_gap"`` (m), ``"elastic_energy"`` or ``"complementary_energy"`` p·u/2 - p·h (J),
        ``PressureNorm(m)``, ``PressureAt(x, y)``, ``StressNorm(layer, planes)``,
        ``SmoothArea(pressure)`` or ``EdgeArea(pressure)``, or an ``Output`` of one's own; and, from
        solves at several loads, ``"area"`` (m²), ``"stiffness"`` dP/dδ (N/m), of clean contact
        ``"electrical_conductance"`` (S) and ``"thermal_conductance"`` (W/K), and
        ``FirstYield(stress)``, the load at first yield over that of the result.
    to
        ``"all"``, or names of parameters: ``"heights"`` of the composite surface (m), ``"force"``
        (N) or, where that is held, ``"approach"`` (m), ``"hardness"`` (Pa), constants of the bodies
        such as ``"body.layers[0].thickness"``, ``"body.base.youngs_modulus"`` and
        ``"counter_body.poisson_ratio"``, for conductances
        ``"body.base.electrical_resistivity"`` (Ω m) and ``"body.thermal_conductivity"`` (W/(m K));
        ``"body"`` and ``"body.layers"`` take all that begin so.
    held
        ``"load"`` or ``"approach"``; by default what the control of the result prescribes.
    tolerance
        Relative residual of the linear system: about the relative error of the derivatives.
    engine
        Machine to compute on.

    Raises
    ------
    InputError
        If the output or a parameter is none of these, or the contact holds what has no derivative
        here: friction, adhesion, films, fluids, plastic flow, viscoelastic bodies, an indentation
        of an earlier load, a hardness that changes with depth.
    ConvergenceError
        If a linear solve does not converge.
    """
    if isinstance(of, str) and of in RANGED:
        return over_loads(result, RANGED[of], to, held=held, tolerance=tolerance, engine=engine)
    if isinstance(of, FirstYield):
        if held == "approach":
            raise InputError(f"held of sensitivities must be load for the {of.name}, but is approach.")
        return yield_factor(result, of, to, engine=engine)
    return at_one_load(result, output(of), to, held=held, tolerance=tolerance, engine=engine)
