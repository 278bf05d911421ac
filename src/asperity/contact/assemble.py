"""From the solution of the discrete problem to the result a user sees."""

from __future__ import annotations

import numpy as np

from . import measure
from .certificate import Certificate
from .control import Control
from .problem import ContactProblem
from .result import ContactResult
from .solvers.optimality import level
from .solvers.protocol import ContactQP, Solution
from .state import InterfaceState
from .stiffness import normal_stiffness


def assemble(
    problem: ContactProblem,
    control: Control,
    qp: ContactQP,
    solution: Solution,
    *,
    state: InterfaceState | None,
    stiffness: bool,
    certificate: Certificate,
    citations: tuple[str, ...],
) -> ContactResult:
    """Fields and scalars of ``solution``; ``state`` is the interface before this load."""
    p, u = solution.state.pressure, solution.state.deflection
    grid, cap = problem.grid, qp.cap
    gap = u - qp.profile
    offset = -level(qp, p, gap)
    gap += offset
    contact = p > 0.0
    capped = contact & (p >= cap)
    indentation = np.where(capped, np.maximum(-gap, 0.0), 0.0)
    permanent = indentation if state is None else state.permanent_indentation + indentation
    pixels = int(np.count_nonzero(contact))
    wraps = problem.boundary.wraps
    area = measure.corrected_area(contact, grid, wraps=wraps)
    spots = measure.contact_spots(contact, wraps=wraps) * grid.pixel_area
    np.maximum(gap, 0.0, out=gap)
    load = float(p.sum(dtype=np.float64))
    return ContactResult(
        problem=problem,
        control=control,
        pressure=p,
        displacement=u,
        gap=gap,
        permanent_indentation=permanent,
        offset=offset,
        mean_pressure=load / grid.n_points,
        force=load * grid.pixel_area,
        area_fraction=pixels / grid.n_points,
        area_fraction_corrected=area / grid.area,
        contact_area=area,
        mean_real_pressure=load / pixels if pixels else 0.0,
        max_pressure=float(p.max()),
        approach=float(problem.profile().max()) - offset,
        mean_gap=float(gap.mean()),
        elastic_energy=0.5 * float(np.multiply(p, u, dtype=np.float64).sum()) * grid.pixel_area,
        plastic_work=float((np.where(capped, cap, 0.0) * indentation).sum()) * grid.pixel_area,
        plastic_area_fraction=int(np.count_nonzero(capped)) / pixels if pixels else 0.0,
        max_permanent_indentation=float(permanent.max()),
        normal_stiffness=normal_stiffness(qp.operator, p, cap) if stiffness else np.nan,
        n_spots=int(spots.size),
        spot_areas=spots,
        mean_spot_area=float(spots.mean()) if spots.size else 0.0,
        contact_perimeter=measure.contact_perimeter(contact, grid, wraps=wraps),
        certificate=certificate,
        status=solution.status,
        citation_keys=citations,
    )
