"""Conductance of a solved contact: current or heat through contact, film and gap, with its
bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from ...contact.boundary import FreeLine
from ...contact.measure import labelled
from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.engine import Engine
from ...core.errors import InputError
from ...core.late import Shown
from ...theories.conductance.spots import sharvin, wexler
from .law import ConductingInterface
from .operator import ELECTRICAL, THERMAL, Flow, conductors, harmonic_mean, layers_in_series
from .pixels import freed_of_pixels
from .solver import Flux, flux, flux_with_gap

FLOWS = {"electrical": ELECTRICAL, "thermal": THERMAL}

EDGE_BIAS = 0.2
"""Bias of the conductance over the sum of j² dx³/k_s along the edges: constant flux on pixels
conducts like a contact that is smaller. Measured against closed forms: 0.20 for discs of 5 to 120
pixels in the radius (periodic strips 0.32, squares 0.31 to 0.34). In elastic contacts the pixels at
the edges, which reach a little too far, counteract it: of Hertzian contacts of 6 to 100 pixels in
the radius the error was below a half of it, on either side."""


@dataclass(frozen=True, eq=False, repr=False)
class ContactConductance(Shown):
    """How a contact conducts; per unit drop of potential or temperature between the bodies.

    Attributes
    ----------
    flow
        ``"electrical"`` (S, Ω) or ``"thermal"`` (W/K, K/W).
    density
        (nx, ny), flux density in S/m² or W/(m² K).
    drop
        (nx, ny), share of the drop that bodies and film spend at each point; one in contact.
    contact
        (nx, ny), where the bodies touch.
    per_area
        Conductance per nominal area, S/m² or W/(m² K); infinite in periodic full contact without a
        film, where the flux is uniform and there is no constriction.
    lower, upper
        Bounds of ``per_area`` on this grid (Thomson's principle and the residual).
    pixel_error
        Relative error of ``per_area`` by the size of the pixels at the edges; an estimate.
    extrapolated, extrapolated_error
        Conductance in S or W/K to pixels of no size, by the place of the edges between them, and
        its relative error. Against closed forms it errs a quarter as much or less: circles and
        squares from 6 pixels across, ellipses, strips, Hertzian contacts.
    through_gap
        Share of the flux that crosses the gap beside the contact.
    layers
        Specific resistance of all layers in series, m² K/W or Ω m², which a uniform flow meets. In
        periodic contacts it is not in ``resistance``, nor are the bodies themselves: that is the
        constriction alone, between mean planes.
    k_s
        Harmonic mean of the conductivities at the surfaces, S/m or W/(m K).
    residual
        Root mean square of what is left of the drop on the points that conduct.
    area, pixel_area
        Nominal area and that of a pixel, m².
    wraps
        Whether the map repeats along x and along y.
    """

    flow: Literal["electrical", "thermal"]
    density: RealArray
    drop: RealArray
    contact: BoolArray
    per_area: float
    lower: float
    upper: float
    pixel_error: float
    extrapolated: float
    extrapolated_error: float
    through_gap: float
    layers: float
    k_s: float
    residual: float
    area: float
    pixel_area: float
    wraps: tuple[bool, bool]
    citation_keys: ClassVar[tuple[str, ...]] = ("Holm1967", "Barber2003")

    @property
    def total(self) -> float:
        """Conductance in S or W/K."""
        return self.per_area * self.area

    @property
    def resistance(self) -> float:
        """One over it, Ω or K/W; infinite without contact."""
        return 1.0 / self.total if self.total else math.inf

    @property
    def error(self) -> float:
        """Relative error: half the distance of the bounds, and that by the pixels."""
        spread = 0.5 * (self.upper - self.lower) / self.per_area if 0.0 < self.per_area < math.inf else 0.0
        return spread + self.pixel_error

    @cached_property
    def spots(self) -> SpotFlows:
        """The spots of the contact and what each carries."""
        labels, count = labelled(self.contact, wraps=self.wraps)
        flat = labels.ravel()
        areas = np.bincount(flat, minlength=count + 1)[1:] * self.pixel_area
        flows = np.bincount(flat, self.density.ravel(), minlength=count + 1)[1:] * self.pixel_area
        order = np.argsort(flows)[::-1]
        return SpotFlows(areas[order], flows[order])

    def with_ballistic_spots(self, mean_free_path: float) -> float:
        """Conductance (S or W/K) of the spots as a network where carriers have this
        ``mean_free_path`` ℓ (m, >= 0).

        To each spot, of the radius of a circle of its area, Sharvin's resistance is added, and
        Wexler's factor taken off that of its own constriction. Small spots with ℓ above their
        radius conduct by their area, not by their radius.
        """
        require.not_negative(mean_free_path, "mean free path (m)")
        spots = self.spots
        if not spots.flow.size or not math.isfinite(self.per_area):
            return self.total
        radius = np.sqrt(spots.area / math.pi)
        own = (1.0 - wexler(mean_free_path / radius)) / (2.0 * self.k_s * radius)
        in_series = 1.0 / spots.flow - own + sharvin(self.k_s, radius, mean_free_path)
        return float((1.0 / in_series).sum()) + self.through_gap * self.total


@dataclass(frozen=True, eq=False)
class SpotFlows:
    """Spots of a contact, pixels joined by their sides, those that carry most first: their ``area``
    (n,) in m² and their ``flow`` (n,) per unit drop, S or W/K."""

    area: RealArray
    flow: RealArray
    radius: RealArray = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", np.sqrt(self.area / math.pi))

    def needed(self, share: float = 0.5) -> int:
        """Number of spots that carry that ``share`` of the whole, 0 to 1."""
        total = float(self.flow.sum())
        if not total:
            return 0
        return int(np.searchsorted(np.cumsum(self.flow), share * total * (1.0 - 1e-12))) + 1


def conductance(
    result: ContactResult,
    flow: Literal["electrical", "thermal"] = "electrical",
    interface: ConductingInterface = ConductingInterface(),
    *,
    engine: Engine | None = None,
) -> ContactConductance:
    """Conductance of the contact of ``result`` for current or heat.

    Both bodies conduct as half-spaces or layers on one, a rigid body and a rigid base have one
    potential. Every point that touches conducts, whether it has yielded or not; the flux has the
    same potential drop there, less that in the film resistance of the ``interface``, whose gap
    conducts in parallel. One linear system of the kind of the contact's stiffness.

    Parameters
    ----------
    result
        A solved contact, periodic or free.
    flow
        ``"electrical"`` or ``"thermal"``.
    interface
        Film and gap; by default clean contact in an insulating gap.
    engine
        Machine to compute on, as of ``solve``.

    Raises
    ------
    InputError
        If the conductivity of a material is not known, both bodies are rigid, or it is a line
        contact, whose resistance has no limit.
    ConvergenceError
        If the linear system is not solved.
    """
    of = FLOWS[require.one_of(flow, FLOWS, "flow")]
    problem = result.problem
    require_conducting(problem, of)
    made = conductors(problem.body, problem.counter_body, of, interface.film_resistance)
    operator = prepare_operator(made, problem.grid, problem.boundary, engine=engine)
    contact = result.contact
    if interface.bridges:
        gap = interface.gap_resistance(np.maximum(result.gap, 0.0))
        found = flux_with_gap(operator, contact, np.where(contact, np.inf, gap), interface.film_resistance)
    else:
        found = flux(operator, contact)
    return _answered(result, of, interface, found)


def require_conducting(problem: ContactProblem, flow: Flow) -> None:
    """Refuse what cannot conduct, with an ``InputError``."""
    if isinstance(problem.boundary, FreeLine):
        raise InputError(
            "boundary of a conducting contact must be periodic or free, but is that of a line contact: the "
            "resistance of a strip grows with the logarithm of the distance. Take {periodic} or {free}."
        )
    harmonic_mean(problem.body, problem.counter_body, flow)
    conductors(problem.body, problem.counter_body, flow)


def _answered(result: ContactResult, flow: Flow, interface: ConductingInterface, found: Flux) -> ContactConductance:
    problem = result.problem
    grid, contact = problem.grid, result.contact
    k_s = harmonic_mean(problem.body, problem.counter_body, flow)
    whole = found.mean * grid.area
    extrapolated, error = _extrapolated(result, flow, interface, found) if 0.0 < whole < math.inf else (whole, 0.0)
    total = float(found.density.sum())
    outside = float(found.density[~contact].sum())
    return ContactConductance(
        flow=flow.name,  # type: ignore[arg-type]
        density=found.density,
        drop=found.drop,
        contact=contact,
        per_area=found.mean,
        lower=found.lower,
        upper=found.upper,
        pixel_error=_pixel_error(result, found, k_s, interface.film_resistance),
        extrapolated=extrapolated,
        extrapolated_error=error,
        through_gap=outside / total if 0.0 < total < math.inf else 0.0,
        layers=layers_in_series(problem.body, problem.counter_body, flow),
        k_s=k_s,
        residual=found.residual,
        area=grid.area,
        pixel_area=grid.pixel_area,
        wraps=problem.boundary.wraps,
    )


def _extrapolated(
    result: ContactResult, flow: Flow, interface: ConductingInterface, found: Flux
) -> tuple[float, float]:
    """Conductance freed of the pixels, S or W/K, and its relative error.

    The conductivity is that which the shortest waves on the grid meet: of a layer that is thinner
    than a pixel only a part counts. Where the gap conducts, the flux crowds less than the
    correction supposes, which then counts as error, too.
    """
    problem = result.problem
    shortest = math.pi / math.sqrt(problem.grid.pixel_area)
    resists = conductors(problem.body, problem.counter_body, flow).spectral(np.array([shortest]))[0]
    freed = freed_of_pixels(result.edges, found.density, 2.0 / (shortest * float(resists)), interface.film_resistance)
    whole = found.mean * problem.grid.area
    error = freed.error + (abs(freed.gain) if interface.bridges else 0.0)
    return whole + freed.gain, error / whole


def _pixel_error(result: ContactResult, found: Flux, k_s: float, film_resistance: float) -> float:
    """Relative error by the pixels at the edges.

    For each pair of neighbours across an edge a share of j² dx³/k_s, which the crowding of the flow
    there makes; and with a film, whose conductance is that of the area, ρ j² times the area between
    the pixels and the edge as the contact places it.
    """
    edges, (dx, dy) = result.edges, result.problem.grid.spacing
    if not edges.inner.size or not 0.0 < found.mean < math.inf:
        return 0.0
    along = np.where(edges.axis == 0, dx, dy)
    square = found.density.ravel()[edges.inner] ** 2
    bias = EDGE_BIAS * float((edges.weight * square * along).sum()) * result.problem.grid.pixel_area / k_s
    bias += film_resistance * abs(float((edges.excess * square).sum())) * result.problem.grid.pixel_area
    return bias / (found.mean * result.problem.grid.area)
