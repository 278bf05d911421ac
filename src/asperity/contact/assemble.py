"""From the solution of the discrete problem to the result a user sees."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..core.arrays import RealArray
from . import measure
from .certificate import Certificate
from .control import Control
from .depth_limit import added_indentation
from .laws import work_density
from .problem import ContactProblem
from .result import ContactResult
from .solvers.protocol import ContactQP, Solution, level
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
    grid = problem.grid
    gap = u - qp.profile
    offset = -level(qp, p, gap)
    gap += offset
    contact = p > 0.0
    capped = contact & (p >= qp.cap)
    indentation = added_indentation((qp, solution))
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
        plastic=capped,
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
        plastic_area_fraction=int(np.count_nonzero(capped)) / pixels if pixels else 0.0,
        normal_stiffness=normal_stiffness(qp.operator, p, qp.cap) if stiffness else np.nan,
        n_spots=int(spots.size),
        spot_areas=spots,
        mean_spot_area=float(spots.mean()) if spots.size else 0.0,
        contact_perimeter=measure.contact_perimeter(contact, grid, wraps=wraps),
        certificate=certificate,
        status=solution.status,
        citation_keys=citations,
        **_indentation(problem, state, permanent),
    )


def _indentation(problem: ContactProblem, state: InterfaceState | None, permanent: RealArray) -> dict[str, Any]:
    """What a result says of the ``permanent`` indentation (nx, ny) in m that it leaves in place of that of ``state``."""
    before = np.broadcast_to(0.0, permanent.shape) if state is None else state.permanent_indentation
    pixel, work = problem.grid.pixel_area, 0.0
    if permanent.any():  # indentations never shrink: where there is none now there was none
        work = float(work_density(problem.law, before, permanent).sum()) * pixel
    return {
        "permanent_indentation": permanent,
        "plastic_work": work,
        "total_plastic_work": work + (0.0 if state is None else state.plastic_work),
        "indented_area": int(np.count_nonzero(permanent)) * pixel,
        "plastic_volume": float(permanent.sum()) * pixel,
        "max_permanent_indentation": float(permanent.max()),
    }
