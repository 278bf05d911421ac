"""Flow factors of Patir and Cheng from the gap itself: how much roughness adds to or takes from the
flow by pressure and by shear, for codes of mixed lubrication.

With the separation H of the mean planes, the flow per width averaged over the roughness is
q_i = -φ_ij H³/(12 η) ∂P/∂x_j + u_m h_T ± Δu σ φ_s/2. The factors by pressure are the effective
tensor of the gap over H³. For that by shear the smooth counter surface moves along and drags the
fluid past the rough body at rest: ∇·(g³ ∇ψ/12) = -∂g/∂x, and φ_s σ = <g> - <g + g³/12 ∂ψ/∂x>, for
a rough body 1 that moves with u_1; the sign changes where body 2 is the rough one, and two alike
have none.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, TypeAlias

import numpy as np

from ...contact.controls import MeanGap
from ...contact.problem import ContactProblem
from ...contact.solve import solve
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.late import Tabled
from ...core.quantity import Quantity
from ...core.spectral import RealTransform
from .flow import FlowTensor, flow_tensor
from .network import Network
from .solver import Method

Overlap: TypeAlias = Literal["deformed", "cut"]
"""What becomes of summits that reach beyond the other surface: the contact is solved, or they are
cut off as Patir and Cheng have it."""

OVERLAPS = ("deformed", "cut")

COLUMNS = (
    Quantity("separation_over_roughness", "1", "separation of the mean planes / rms height", symbol="H/σ"),
    Quantity("pressure_x", "1", "pressure flow factor along x", symbol="φ_x"),
    Quantity("pressure_y", "1", "pressure flow factor along y", symbol="φ_y"),
    Quantity("pressure_xy", "1", "pressure flow factor across", symbol="φ_xy"),
    Quantity("shear_x", "1", "shear flow factor along x", symbol="φ_s"),
    Quantity("shear_y", "1", "shear flow factor along y", symbol="φ_s"),
    Quantity("contact_fraction", "1", "real contact area / nominal area (pixels)"),
    Quantity("mean_gap_over_roughness", "1", "mean gap / rms height", symbol="h_T/σ"),
    Quantity("mean_pressure", "Pa", "mean contact pressure"),
)
"""Columns of a table of flow factors."""


@dataclass(frozen=True, eq=False, repr=False)
class FlowFactors(Tabled):
    """Flow factors at n separations, each (n,): the ``COLUMNS``.

    Attributes
    ----------
    separation_over_roughness
        Separation of the mean planes over the rms height of the composite profile.
    pressure_x, pressure_y, pressure_xy
        φ_ij, the effective tensor of the gap over the cube of the separation.
    shear_x, shear_y
        φ_s for sliding along x and y of a rough body 1.
    contact_fraction, mean_gap_over_roughness, mean_pressure
        State of the contact; the pressure in Pa, NaN where it was not solved.
    """

    separation_over_roughness: RealArray
    pressure_x: RealArray
    pressure_y: RealArray
    pressure_xy: RealArray
    shear_x: RealArray
    shear_y: RealArray
    contact_fraction: RealArray
    mean_gap_over_roughness: RealArray
    mean_pressure: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("PatirCheng1978",)

    def __len__(self) -> int:
        """Number of separations."""
        return int(self.separation_over_roughness.size)

    def table(self) -> Iterator[tuple[Any, ...]]:
        """Its rows for ``export_csv``, the headings first."""
        yield tuple(f"{item.name} ({item.unit})" for item in COLUMNS)
        yield from zip(*(getattr(self, item.name) for item in COLUMNS), strict=True)


def flow_factors(
    gap: RealArray,
    grid: Grid,
    roughness: float,
    *,
    separation: float | None = None,
    mean_pressure: float = np.nan,
    method: Method = "auto",
) -> FlowFactors:
    """Flow factors of one ``gap`` (nx, ny) in m on a ``grid`` that repeats.

    Parameters
    ----------
    roughness
        Rms height σ of the composite profile in m, > 0.
    separation
        Distance H of the mean planes in m, > 0; by default the mean gap, as of surfaces that are
        deformed and not cut.
    mean_pressure
        That of the contact in Pa, for the table.
    method
        As of ``flow_through``.

    Raises
    ------
    InputError
        If a number is not > 0 or the gap is no map of this grid.
    """
    sigma = require.positive(roughness, "roughness of flow factors (m)")
    given = float(np.mean(gap)) if separation is None else separation
    height = require.positive(given, "separation of flow factors (m)")
    tensor = flow_tensor(gap, grid, method=method)
    phi = tensor.matrix / height**3
    shear = shear_flows(tensor) / sigma
    columns = (
        height / sigma,
        phi[0, 0],
        phi[1, 1],
        0.5 * (phi[0, 1] + phi[1, 0]),
        *shear,
        np.mean(np.asarray(gap) <= 0.0),
        np.mean(gap) / sigma,
        mean_pressure,
    )
    return FlowFactors(*(np.array([float(value)]) for value in columns))


def shear_flows(tensor: FlowTensor) -> RealArray:
    """(2,) φ_s σ in m for sliding along x and y: mean gap less the mean flow per width that a
    smooth counter surface drags through with a mean speed of one.

    On a face between gaps that change linearly from g1 to g2 the dragged flow is exact with their
    harmonic mean: the pressure that stops it is 1/(g1 g2) per length.
    """
    gap, grid = tensor.x.gap, tensor.x.grid
    both = tensor.x.net if tensor.x.net.carrying.any() else tensor.y.net
    if tensor.system is None:
        return np.full(2, float(gap.mean()))
    found = []
    for axis in (0, 1):
        product = gap * np.roll(gap, -1, axis)
        there = both.across[axis] > 0.0
        drop = np.zeros((2, *gap.shape))
        drop[axis] = np.divide(grid.spacing[axis], product, out=np.zeros_like(product), where=there)
        net: Network = replace(both, drop=drop)
        pressure = tensor.system.pressure(net.imbalance(np.zeros(gap.shape)))
        dragged = net.flux(pressure)[axis].mean() / grid.spacing[1 - axis]
        found.append(float(gap.mean() - dragged))
    return np.array(found)


def tabulated_flow_factors(
    problem: ContactProblem,
    separations: Iterable[float],
    *,
    overlap: Overlap = "deformed",
    method: Method = "auto",
) -> FlowFactors:
    """Flow factors of a rough contact that repeats at several ``separations`` of the mean planes
    over the rms height.

    Parameters
    ----------
    problem
        Rough contact with the boundary ``Periodic``. Each separation is one solve under a mean gap;
        where the surfaces do not touch the profile is only shifted.
    separations
        H/σ, each > 0.
    overlap
        ``"deformed"`` where the surfaces touch, or ``"cut"`` off there, as Patir and Cheng have it.
    method
        As of ``flow_through``.

    Raises
    ------
    InputError
        If the contact does not repeat, the profile is flat, or a separation is not > 0.
    """
    require.one_of(overlap, OVERLAPS, "overlap of flow factors")
    sigma = require_averaged(problem)
    profile = np.asarray(problem.profile())
    rows = []
    for ratio in separations:
        height = require.positive(ratio, "separation over roughness") * sigma
        shifted = height - (profile - profile.mean())
        pressure = 0.0
        if shifted.min() < 0.0 and overlap == "cut":
            shifted, pressure = np.maximum(shifted, 0.0), np.nan
        elif shifted.min() < 0.0:
            result = solve(problem, MeanGap(height))
            shifted, pressure = np.where(result.contact, 0.0, result.gap), result.mean_pressure
        row = flow_factors(shifted, problem.grid, sigma, separation=height, mean_pressure=pressure, method=method)
        rows.append(row)
    if not rows:
        raise InputError("separations of flow factors must hold at least one number, but hold none.")
    names = [item.name for item in COLUMNS]
    return FlowFactors(*(np.concatenate([getattr(row, name) for row in rows]) for name in names))


def require_averaged(problem: ContactProblem) -> float:
    """Rms height σ in m of the profile of a ``problem`` over which flow factors are averages.

    Raises
    ------
    InputError
        If the contact does not repeat, or the profile is flat or a line.
    """
    if problem.boundary.wraps != (True, True):
        raise InputError(
            f"boundary of flow factors must be periodic, but is {problem.boundary.name}: they are averages over a "
            "surface that repeats. Choose {boundary.kind=periodic}."
        )
    if min(problem.grid.shape) < 2:
        raise InputError(
            f"surface of flow factors must have points along x and y, but has {problem.grid.shape[0]} x "
            f"{problem.grid.shape[1]}."
        )
    sigma = float(np.std(problem.profile()))
    if sigma == 0.0:
        raise InputError("surface of flow factors must be rough, but is flat: give the one with the roughness.")
    return sigma


def with_its_spectrum(heights: RealArray, seed: int) -> RealArray:
    """Heights (nx, ny) of a Gaussian surface with the power spectrum of ``heights`` and random
    phases by the ``seed``."""
    transform = RealTransform(heights.shape)
    white = transform.forward(np.random.default_rng(seed).standard_normal(heights.shape)).copy()
    size = np.abs(transform.forward(heights - heights.mean()))
    return transform.backward(size * np.exp(1j * np.angle(white)))
