"""Every theory of rough contact beside the numerical solution, on one surface."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..contact.boundary import Periodic
from ..contact.controls import MeanPressure
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..contact.roughness import roughness_of
from ..contact.solve import default_solver, steps
from ..contact.solvers.protocol import Solver
from ..core import require
from ..core.arrays import RealArray
from ..core.engine import Engine
from ..core.errors import AsperityError, InputError, NoSolutionError
from ..core.status import Advice, Progress
from ..parts.advice import advise, review
from ..solids.elastic import Rigid
from ..solids.layers import Body
from ..surfaces.pair import composite
from ..surfaces.surface import Surface
from ..theories.protocol import QUANTITIES, Prediction, SurfaceTheory
from ..theories.statistics.roughness import Roughness
from .comparison import Comparison, NumericalCurve, TheoryCurve
from .comparison_theories import LeftOut, check, chosen_theories, family, known_of_bodies, remarks

MOST_CONTACTS = 1000
"""Contacts up to which interacting crests are solved: a load takes some 0.3 s with a thousand of
them, eight times that with twice as many.
"""

_PILOT = 5.0
"""Share of the most contacts, as a divisor, up to which loads are solved first; interaction adds as
many where heights differ much.
"""

LIGHTEST, HEAVIEST, LOADS = 0.004, 0.25, 12
"""Lowest and highest p/(E* h'_rms), and number of loads, where none are given: about 1 % to 45 % of
the area."""


def compare(
    surface: Surface | ContactProblem,
    bodies: Body | tuple[Body, Body] | None = None,
    pressures: ArrayLike | None = None,
    *,
    theories: Iterable[str | SurfaceTheory] | None = None,
    inputs: Mapping[str, float] | None = None,
    numerical: bool = True,
    most_contacts: int = MOST_CONTACTS,
    solver: Solver | None = None,
    progress: Progress | None = None,
    engine: Engine | None = None,
) -> Comparison:
    """Compare the theories of the catalogue with each other and with the boundary-element solution.

    Theories are made from what ``roughness_of`` measures on the surface, or on the sum of two. One
    that cannot be made is listed with its reason, one that cannot carry the highest loads has NaN
    there and a note.

    Parameters
    ----------
    surface
        Surface that is pressed against a rigid flat plane, prepared as it is to be; or a whole
        ``ContactProblem``.
    bodies
        Its body, or body and counter body; left out with a problem.
    pressures
        Nominal pressures in Pa, positive, in any order; a dozen from 0.004 to 0.25 E* h'_rms if not
        given.
    theories
        Names of theories, or theories made already, which may be any with ``at_pressure`` and
        ``validity``; every theory of the catalogue that is made from a surface if not given.
    inputs
        Parameters of theories that the bodies do not state, in SI units: ``work`` of adhesion
        (J/m²), ``spacing`` (m), ``hardness`` and ``yield_stress`` (Pa), ``nu``.
    numerical
        Whether the contact is solved too, on one load path.
    most_contacts
        Loads at which more crests touch are left out for the theory of interacting crests, whose
        time grows with the cube.
    solver, progress, engine
        See ``solve``.

    Raises
    ------
    InputError
        If bodies are missing or given twice, a pressure is not positive, a theory is unknown, the
        surface is flat, one line only or has missing points.
    """
    if isinstance(surface, ContactProblem):
        if bodies is not None:
            raise InputError("bodies must be left out with a ContactProblem, which has its own, but are given.")
        problem = surface
    else:
        if bodies is None:
            raise InputError('bodies must be given with a surface, such as asperity.material("DLC"), but are not.')
        body, counter_body = bodies if isinstance(bodies, tuple) else (bodies, Rigid())
        problem = ContactProblem(surface, body, counter_body=counter_body)
    counter = problem.counter_surface
    whole = composite(problem.surface, counter) if isinstance(counter, Surface) else problem.surface
    if whole.shape[1] == 1:
        raise InputError(
            "surface of a comparison must be a map, but is one line: the theories are those of isotropic surfaces, and "
            "grooves without end have more contact. Compare on an isotropic surface with the spectrum of the line "
            "({isotropic}), or evaluate the theories alone.",
            subject="surface of a comparison",
        )
    roughness = roughness_of(whole)
    if pressures is None:
        loads = np.geomspace(LIGHTEST, HEAVIEST, LOADS) * (problem.contact_modulus * roughness.rms_gradient)
    else:
        loads = np.unique(np.asarray(pressures, dtype=float))
        if loads.size == 0:
            raise InputError("pressures (Pa) of a comparison must hold at least one, but are empty.")
        for value in loads.tolist():
            require.positive(value, "pressure (Pa) of a comparison")
    known = known_of_bodies(problem) | dict(inputs or {})
    chosen = chosen_theories(roughness, problem.contact_modulus, theories=theories, known=known)
    periodic = isinstance(problem.boundary, Periodic)
    found = [
        _curve(name, theory, loads, roughness, most_contacts=most_contacts, periodic=periodic)
        for name, theory in chosen.theories.items()
    ]
    exact = solved(problem, loads, solver=solver, progress=progress, engine=engine) if numerical else None
    return Comparison(
        problem=problem,
        surface=whole,
        roughness=roughness,
        pressures=loads,
        curves=tuple(curve for curve in found if isinstance(curve, TheoryCurve)),
        left_out=(*chosen.left_out, *(curve for curve in found if isinstance(curve, LeftOut))),
        numerical=None if exact is None else exact.curve,
        remarks=remarks(problem, chosen.theories, math.nan if exact is None else exact.mean_radius),
        findings=() if exact is None else exact.findings,
    )


def _curve(
    name: str, theory: SurfaceTheory, loads: RealArray, roughness: Roughness, *, most_contacts: int, periodic: bool
) -> TheoryCurve | LeftOut:
    """Curve of one theory as far as it goes along the ``loads`` (n,) in Pa, NaN behind;
    ``periodic`` where the surface repeats."""
    count, first_notes = _reach(theory, loads, most_contacts)
    found, reason = _leading(theory, loads[:count]) if count else (None, "")
    if found is None:
        return LeftOut(name, theory.title, " ".join([*first_notes, reason]).strip())
    from ..theories.rough.interacting_crests import InteractingCrests

    checked = check(theory, found, roughness)
    rest = loads.size - len(found)
    values = {item.name: np.append(getattr(found, item.name), np.full(rest, np.nan)) for item in QUANTITIES}
    beyond = np.zeros(rest, dtype=bool)
    return TheoryCurve(
        name=name,
        title=theory.title,
        family=family(theory),
        prediction=Prediction(**values | {"pressure": loads}),
        valid_for={name: np.concatenate([holds, beyond]) for name, holds in checked.valid_for.items()},
        notes=(*first_notes, *((reason,) if reason else ()), *checked.notes),
        comparable_gap=not (periodic and isinstance(theory, InteractingCrests)),
        citation_keys=tuple(theory.citation_keys),
    )


def _reach(theory: SurfaceTheory, loads: RealArray, most_contacts: int) -> tuple[int, tuple[str, ...]]:
    """How many of the ``loads``, from the lowest, are worth their time, and a note if that is not
    all.

    Contacts of interacting crests are those of crests alone, or what their growth at lighter loads
    makes of them if more.
    """
    from ..theories.rough.discrete_summits import DiscreteSummits
    from ..theories.rough.interacting_crests import InteractingCrests

    if not isinstance(theory, InteractingCrests):
        return loads.size, ()
    radius = np.asarray(theory.wavelength) ** 2 / (2.0 * np.pi**2 * np.asarray(theory.depth))
    alone = DiscreteSummits(theory.E_star, theory.height, radius, theory.area).at_pressure(loads).contact_density
    contacts = alone * theory.area
    light = int(np.count_nonzero(contacts * _PILOT <= most_contacts))
    pilot = _leading(theory, loads[:light])[0] if light else None
    if pilot is not None and len(pilot) > 1:
        (p1, p2), (n1, n2) = loads[len(pilot) - 2 : len(pilot)], pilot.contact_density[-2:] * theory.area
        contacts = np.maximum(contacts, n2 * (loads / p2) ** (math.log(n2 / n1) / math.log(p2 / p1)))
    count = int(np.count_nonzero(contacts <= most_contacts))
    if count == loads.size:
        return count, ()
    note = (
        f"Computed at {count} of {loads.size} loads: beyond, some {contacts[count]:.0f} crests and more touch, "
        f"and the time grows with their cube; most_contacts ({most_contacts}) sets the limit."
    )
    return count, (note,)


def _leading(theory: SurfaceTheory, loads: RealArray) -> tuple[Prediction | None, str]:
    """Prediction at as many of the rising ``loads`` as the theory can carry, and the error for the
    others."""
    low, high, found, reason = 0, loads.size, None, ""
    middle = high
    while low < high:
        try:
            found = theory.at_pressure(loads[:middle])
            low = middle
        except AsperityError as error:
            high, reason = middle - 1, f"Computed at {{}} of {loads.size} loads: {error}"
        middle = (low + high + 1) // 2
    return found, reason.format(low) if low else reason.partition(": ")[2]


# The boundary-element solution: one load path, of which a few numbers a load are kept.


@dataclass(frozen=True, eq=False)
class Solved:
    """The ``curve``, the ``findings`` at the lowest and highest load, the mean radius in m of the
    spots at the highest."""

    curve: NumericalCurve
    findings: tuple[Advice, ...]
    mean_radius: float


def solved(
    problem: ContactProblem,
    pressures: RealArray,
    *,
    solver: Solver | None = None,
    progress: Progress | None = None,
    engine: Engine | None = None,
) -> Solved:
    """Solution of ``problem`` at rising ``pressures`` (n,) in Pa, each from the interface the last
    one left.

    Loads that do not converge, or that the law cannot bear, are NaN and noted.
    """
    method = solver or default_solver(problem)
    columns = np.full((4, pressures.size), np.nan)
    faults: list[str] = []
    findings: dict[str, Advice] = {}
    last: ContactResult | None = None
    started = time.perf_counter()
    controls = map(MeanPressure, pressures)
    path = steps(problem, controls, solver=method, progress=progress, engine=engine, on_failure="return")
    try:
        for number, result in enumerate(path):
            if not result.converged:
                faults.append(f"At {pressures[number]:.4g} Pa: {result.status.message}")
                continue
            spots = result.n_spots / math.prod(problem.grid.size)
            columns[:, number] = result.area_fraction, result.area_fraction_corrected, spots, result.mean_gap
            last = result
            if number in (0, pressures.size - 1):
                found = (*advise(result.problem, result.control), *review(result))
                findings |= {item.criterion: item for item in found}
    except NoSolutionError as error:
        faults.append(str(error))
    seconds, keys = time.perf_counter() - started, problem.citation_keys if last is None else last.citation_keys
    radius = math.sqrt(last.mean_spot_area / math.pi) if last is not None and last.n_spots else math.nan
    pixels, area, density, gap = columns
    curve = NumericalCurve(pixels, area, density, gap, seconds, method.name, tuple(faults), keys)
    return Solved(curve, tuple(findings.values()), radius)
