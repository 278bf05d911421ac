"""Area of a contact, and flow through layered conductors: their derivatives by the edge that
moves.

All of the derivative of the area is by the edge, and that of a conductance at given conductors:
moved by dε, an edge at which the flux density is K/√d lets (2π/k_s) K² dε more through per length
(as the work of a crack that grows, with the conductivity for the modulus). How far it moves
follows from the adjoint solution of the contact for a smooth step at the edge (``EdgeArea``), each
place weighted with the square of the flux density of the pixels there. On a grid that errs by how
the edge lies between pixels, and near full contact, where the square of the pressure bends soon
within the edge; but for all parameters much alike. The derivative to the load is also the slope of
a straight line through several loads, of the area as the edges between pixels enclose it: of waves
and spheres within 1 to 3 %. So all derivatives are multiplied with what takes that of the load
there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...contact.edges import Edges
from ...contact.operators import prepare_operator
from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.scipy_parts import ndimage
from ..conductance.conductance import ContactConductance, conductance
from ..conductance.operator import Flow, conductors
from ..conductance.pixels import WIDER
from .answer import Sensitivities, SensitivityCertificate
from .conducting import ConductorParameter
from .loads import EVENLY, factors_about, open_over_touching, solved_at, worst_of
from .one_load import at_one_load
from .outputs import Slopes, State, edge_step
from .parameters import LOAD, responses

EDGE = 0.75
"""Pressure of the step at an edge over the mean real pressure."""

_SMOOTHED = 2.0
"""Standard deviation in pixels of the average of the square of a flux density along an edge."""


@dataclass(frozen=True, eq=False)
class EdgeSum:
    """∫ w dA over the contact, whose derivative is that by its edge: as ``EdgeArea``, with the
    ``weight`` (nx, ny) or 1, in the unit over m², and its ``pressure`` in Pa."""

    weight: RealArray | float
    pressure: float
    name: str = "sum over the contact"
    unit: str = "m**2"
    degree: float | None = None

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        step, weight = edge_step(state.pressure, self.pressure), self.weight * state.operator.grid.pixel_area
        return Slopes(float((weight * step.value).sum()), np.asarray(weight * step.slope))

    def by_pressure(self, result: ContactResult) -> float:
        """Derivative to the logarithm of its ``pressure``."""
        slope = edge_step(result.pressure, self.pressure).slope
        return -float((self.weight * slope * result.pressure).sum()) * result.problem.grid.pixel_area


class ByEdges(NamedTuple):
    """A number J, its derivatives by name, what the adjoint solutions were multiplied with, and
    they themselves."""

    value: float
    values: Mapping[str, float | RealArray]
    factor: float
    several: Sequence[Sensitivities]

    @property
    def certificate(self) -> SensitivityCertificate:
        """Of all loads."""
        return worst_of([each.certificate for each in self.several], self.factor)


def of_area(result: ContactResult, names: Sequence[str], tolerance: float, engine: Engine | None) -> ByEdges:
    """Mean area over loads about that of ``result``, with its derivatives to the parameters
    ``names``, which are those of the contact."""
    contacts = solved_at(result.problem, result.mean_pressure * factors_about(result, EVENLY), engine)
    sums = [EdgeSum(1.0, each) for each in _reaches(result)]
    return _by_edges(contacts, sums, np.array([each.contact_area for each in contacts]), names, tolerance, engine)


def conductance_at(contacts: Sequence[ContactResult], flow: Flow, engine: Engine | None) -> list[ContactConductance]:
    """Conductances of several contacts."""
    return [conductance(each, flow.name, engine=engine) for each in contacts]  # type: ignore[arg-type]


def of_conductance(
    result: ContactResult,
    flow: Flow,
    names: Sequence[str],
    of_conductors: Iterable[ConductorParameter],
    tolerance: float,
    engine: Engine | None,
) -> ByEdges:
    """Mean conductance (S or W/K) over loads about that of ``result``, freed of the pixels, with
    its derivatives to the parameters ``names`` of the contact and those ``of_conductors``.

    On a given contact dG = -j·dZ j of the flux density j per unit drop.
    """
    problem = result.problem
    contacts = solved_at(problem, result.mean_pressure * factors_about(result, EVENLY), engine)
    flows = conductance_at(contacts, flow, engine)
    amounts = np.array([each.extrapolated for each in flows])
    made = conductors(problem.body, problem.counter_body, flow)
    # a strip beyond the edge lets a j² Δ/k through per area, k being that of the shortest waves
    pixel = math.sqrt(problem.grid.pixel_area)
    strip = WIDER * 0.5 * math.pi * float(made.spectral(np.array([math.pi / pixel]))[0])
    sums = [
        EdgeSum(strip * _at_edges(one.edges, each.density**2), reach)
        for one, each, reach in zip(contacts, flows, _reaches(result), strict=True)
    ]
    found = _by_edges(contacts, sums, amounts, names, tolerance, engine)
    values, asked = dict(found.values), list(of_conductors)
    if asked:
        operator = prepare_operator(made, problem.grid, problem.boundary, engine=engine)
        shares = dict.fromkeys((each.name for each in asked), 0.0)
        for each in flows:
            for name, part in responses(operator, asked, each.density, each.density).items():
                shares[name] -= part * problem.grid.pixel_area / each.total * each.extrapolated / len(flows)
        for name, part in shares.items():
            values[name] = values.get(name, 0.0) + part
    return found._replace(values=values)


def _reaches(result: ContactResult) -> list[float]:
    """Pressure in Pa of the step at the edge for each load, in proportion to it: so the sum has no
    unit of stress, and Euler's relation holds."""
    mean = result.force / (float(result.contact.sum()) * result.problem.grid.pixel_area)
    return [EDGE * open_over_touching(result) * mean * float(each) for each in factors_about(result, EVENLY)]


def _by_edges(
    contacts: Sequence[ContactResult],
    sums: Sequence[EdgeSum],
    amounts: RealArray,
    names: Sequence[str],
    tolerance: float,
    engine: Engine | None,
) -> ByEdges:
    """Derivatives of the mean of ``amounts``, those of the contacts, from those of ``sums``."""
    asked = (*names, *(() if LOAD in names else (LOAD,)))
    several = [
        at_one_load(each, of, asked, held="load", tolerance=tolerance, engine=engine)
        for each, of in zip(contacts, sums, strict=True)
    ]
    forces = np.array([each.force for each in contacts])
    middle = float(forces.mean())
    slope = float(np.polyfit(forces / middle - 1.0, amounts, 1)[0])
    by_load = [
        float(each[LOAD]) * force + of.by_pressure(contact)
        for each, of, force, contact in zip(several, sums, forces, contacts, strict=True)
    ]
    factor = slope / float(np.mean(by_load))
    values = dict[str, float | RealArray]()
    for name in names:
        mean = factor * np.mean([np.asarray(each[name]) for each in several], axis=0)
        values[name] = mean if np.ndim(mean) else float(mean)
    if LOAD in names:
        values[LOAD] = slope / middle
    return ByEdges(float(amounts.mean()), values, factor, several)


def _at_edges(edges: Edges, field: RealArray) -> RealArray:
    """The ``field`` (nx, ny) of the pixels at the nearest edge, averaged along it."""
    grid = edges.grid
    at, weight = np.zeros(grid.n_points), np.zeros(grid.n_points)
    np.add.at(weight, edges.inner, edges.weight)
    at[edges.inner] = weight[edges.inner] * field.ravel()[edges.inner]
    margins = [
        (min(size, _MARGIN), min(size, _MARGIN)) if wrap else (0, 0)
        for size, wrap in zip(grid.shape, edges.wraps, strict=True)
    ]
    at, weight = (np.pad(each.reshape(grid.shape), margins, mode="wrap") for each in (at, weight))
    there = weight > 0.0
    at, weight = (ndimage.gaussian_filter(each, _SMOOTHED, mode="constant") for each in (at, weight))
    average = np.where(there, at / np.where(there, weight, 1.0), 0.0)
    nearest = ndimage.distance_transform_edt(~there, return_distances=False, return_indices=True)
    found = average[tuple(nearest)]
    return np.asarray(found[tuple(slice(low, low + size) for (low, _), size in zip(margins, grid.shape, strict=True))])


_MARGIN = 32
"""Pixels beyond the border of a map that repeats up to which the nearest edge is sought."""
