"""Fluids that leak: liquids of a viscosity, and ideal gases that slip at the walls.

A liquid flows with the difference of pressure. An ideal gas of even temperature flows with that of
the squares, and the leak rate is its throughput, pressure times volume per time. Its slip adds
6 λ/g to the cube of the gap, first order in the Knudsen number λ/g, the mean free path λ over the
gap.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import ClassVar, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from ...theories.sealing.gaps import ATMOSPHERE
from .flow import GapFlow
from .network import clusters, network, open_cells
from .solver import System

GAS_CONSTANT = 8.31446261815324
"""Molar gas constant, J/(mol K)."""

ROOM = 293.15
"""Temperature in K of the table of gases."""

ROUNDS, TOLERANCE = 60, 1e-10
"""Rounds of the pressure of a gas that slips at most, and the relative change at which they end."""


@dataclass(frozen=True)
class ViscousLiquid:
    """Incompressible fluid.

    Parameters
    ----------
    viscosity
        In Pa s, > 0.

    Raises
    ------
    InputError
        If the viscosity is not > 0.
    """

    viscosity: float
    unit: ClassVar[str] = "m**3/s"
    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886",)

    def __post_init__(self) -> None:
        require.positive(self.viscosity, "viscosity of a liquid (Pa s)")

    def leak(self, flow: GapFlow, inlet: float, outlet: float) -> Leak:
        """What leaks by ``flow`` between the pressures at ``inlet`` and ``outlet`` (Pa)."""
        drop = _drop(inlet, outlet)
        share = _driven(flow)
        return Leak(flow.rate * drop / (12.0 * self.viscosity), outlet + drop * share, 0.0, 1.0)


@dataclass(frozen=True)
class IdealGas:
    """Ideal gas of even temperature.

    Parameters
    ----------
    viscosity
        In Pa s, > 0.
    mean_free_path
        In m at ``ATMOSPHERE``, >= 0; zero for no slip.
    accommodation
        Share of the molecules that walls send back at random, above 0 and at most 1; the mean free
        path counts (2 - a)/a times.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    viscosity: float
    mean_free_path: float
    accommodation: float = 1.0
    unit: ClassVar[str] = "Pa*m**3/s"
    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886", "Burgdorfer1959")

    def __post_init__(self) -> None:
        require.positive(self.viscosity, "viscosity of a gas (Pa s)")
        require.not_negative(self.mean_free_path, "mean free path of a gas (m)")
        if not 0.0 < require.finite(self.accommodation, "accommodation of a gas") <= 1.0:
            raise InputError(f"accommodation of a gas must be above 0 and at most 1, but is {self.accommodation:g}.")

    @classmethod
    def of(cls, viscosity: float, molar_mass: float, temperature: float = ROOM) -> IdealGas:
        """IdealGas of a ``viscosity`` (Pa s) and ``molar_mass`` (kg/mol): the mean free path is
        √(π/2) η √(R T/M)/P.

        Raises
        ------
        InputError
            If a number is not > 0.
        """
        mass = require.positive(molar_mass, "molar mass of a gas (kg/mol)")
        heat = GAS_CONSTANT * require.positive(temperature, "temperature of a gas (K)")
        eta = require.positive(viscosity, "viscosity of a gas (Pa s)")
        return cls(eta, float(np.sqrt(0.5 * np.pi * heat / mass)) * eta / ATMOSPHERE)

    @property
    def slip_length(self) -> float:
        """Mean free path times pressure, with the accommodation, Pa m."""
        return self.mean_free_path * ATMOSPHERE * (2.0 - self.accommodation) / self.accommodation

    def leak(self, flow: GapFlow, inlet: float, outlet: float) -> Leak:
        """Throughput by ``flow`` between the absolute pressures at ``inlet`` and ``outlet`` (Pa).

        Between two sides the pressure of each cell is solved with its own slip. Under a mean
        gradient the slip is that at the mean of both pressures, which is exact for an even gap.
        """
        _drop(inlet, outlet)
        if outlet < 0.0:
            raise InputError(f"pressure of a gas must be at least zero, but is {outlet:g} Pa.")
        squares = 0.5 * (inlet**2 - outlet**2)
        plain = flow.rate * squares / (12.0 * self.viscosity)
        mean = 0.5 * (inlet + outlet)
        if flow.sealed or self.slip_length == 0.0:
            inside = np.sqrt(np.maximum(outlet**2 + 2.0 * squares * _driven(flow), 0.0))
            return Leak(plain, inside, 0.0, 1.0)
        at = np.full(flow.gap.shape, mean)
        if flow.repeats:
            slipping = _with_slip(flow, self.slip_length / mean)
            rate = slipping.rate * squares / (12.0 * self.viscosity)
            inside = np.sqrt(np.maximum(outlet**2 + 2.0 * squares * _driven(slipping), 0.0))
        else:
            rate, inside = _slipping(flow, self, inlet, outlet)
            at = inside
        gap = flow.gap[flow.net.carrying]
        # where most of the gas passes: weighted by what is dissipated
        spent = flow.dissipated[flow.net.carrying]
        number = float((spent * self.slip_length / (gap * at[flow.net.carrying])).sum() / spent.sum())
        return Leak(rate, inside, number, rate / plain)


Fluid: TypeAlias = ViscousLiquid | IdealGas
"""A fluid that leaks."""

GASES = MappingProxyType(
    {
        "air": IdealGas.of(18.2e-6, 28.965e-3),
        "nitrogen": IdealGas.of(17.6e-6, 28.013e-3),
        "helium": IdealGas.of(19.6e-6, 4.0026e-3),
        "hydrogen": IdealGas.of(8.8e-6, 2.0159e-3),
        "argon": IdealGas.of(22.3e-6, 39.948e-3),
    }
)
"""Gases at 20 °C and one atmosphere; viscosities of the usual tables, good to one per cent."""

LIQUIDS = MappingProxyType({"water": ViscousLiquid(1.002e-3)})
"""Liquids at 20 °C."""

FLUIDS: Mapping[str, ViscousLiquid | IdealGas] = MappingProxyType({**LIQUIDS, **GASES})
"""All of them by name."""


@dataclass(frozen=True, eq=False)
class Leak:
    """What leaks.

    Attributes
    ----------
    rate
        m³/s of a liquid; Pa m³/s of a gas.
    pressure
        (nx, ny) pressure of the fluid in Pa, NaN where it does not flow.
    knudsen
        Knudsen number, mean over the dissipation; zero without slip.
    slip_factor
        Rate over that without slip.
    """

    rate: float
    pressure: RealArray
    knudsen: float
    slip_factor: float


def with_dead_ends(flow: GapFlow, leak: Leak, inlet: float, outlet: float) -> tuple[BoolArray, RealArray]:
    """Cells (nx, ny) whose fluid is joined to one that flows or to a side, and its pressure in Pa:
    in dead ends that of the side they open to; zero in closed pools and in contact."""
    axis, known = flow.axis, flow.net.carrying.copy()
    inside = np.where(known, leak.pressure, 0.0)
    if flow.gap.any():
        across = flow.wraps[0] and axis != 0, flow.wraps[1] and axis != 1
        labels = clusters(open_cells(flow.gap), across).labels
        for place, value in ((-1, outlet), (0, inlet)):
            there = np.unique(np.take(labels, place, axis))
            joined = np.isin(labels, there[there > 0]) & ~flow.net.carrying
            inside[joined] = value
            known |= joined
    return known, inside


def _drop(inlet: float, outlet: float) -> float:
    require.finite(inlet, "pressure at the inlet (Pa)")
    require.finite(outlet, "pressure at the outlet (Pa)")
    if not inlet > outlet:
        raise InputError(f"pressure at the inlet must be above that at the outlet, {outlet:g} Pa, but is {inlet:g} Pa.")
    return inlet - outlet


def _driven(flow: GapFlow) -> RealArray:
    """(nx, ny) pressure from 1 to 0 along the flow, with what falls steadily of a mean gradient."""
    if not flow.repeats:
        return flow.pressure
    count = flow.gap.shape[flow.axis]
    fall = 1.0 - (np.arange(count) + 0.5) / count
    # a cluster's own level is free: that of its middle is that of the steady fall
    shape = [1, 1]
    shape[flow.axis] = count
    inside = flow.pressure - np.nanmean(flow.pressure) if not flow.sealed else flow.pressure
    return np.asarray(inside + fall.reshape(shape))


def _with_slip(flow: GapFlow, length: float) -> GapFlow:
    """The flow with 6 ``length`` g² added to the cubes."""
    slip = network(flow.gap, flow.grid.spacing, flow.wraps, axis=None if flow.repeats else flow.axis, faces="slip")
    net = replace(flow.net, across=flow.net.across + 6.0 * length * slip.across, ends=flow.net.ends)
    system = System(net, flow.labels)
    pressure = np.where(net.carrying, system.pressure(net.imbalance(np.zeros(flow.gap.shape))), np.nan)
    return replace(flow, net=net, pressure=pressure)


def _slipping(flow: GapFlow, gas: IdealGas, inlet: float, outlet: float) -> tuple[float, RealArray]:
    """Throughput (Pa m³/s) and pressure (nx, ny) of a gas that slips between two sides;
    ConvergenceError where it is not found.

    In u = P² the flow through a face is (u1 - u2) [T/2 + 6 λP S/(P1 + P2)], with its conductances T
    by the cube of the gap and S by the square: a linear balance whose coefficients change little,
    solved by rounds with those of the round before.
    """
    slip = network(flow.gap, flow.grid.spacing, flow.wraps, axis=flow.axis, faces="slip")
    carrying, sides = flow.net.carrying, np.array([inlet, outlet])[:, None, None]
    inside = np.where(carrying, np.sqrt(outlet**2 + (inlet**2 - outlet**2) * np.nan_to_num(flow.pressure)), 0.0)
    system: System | None = None
    rate = 0.0
    for _ in range(ROUNDS):
        pairs = np.stack([inside + np.roll(inside, -1, axis) for axis in (0, 1)])
        sums = inside + sides
        factor = 6.0 * gas.slip_length
        across = 0.5 * flow.net.across + factor * _over(slip.across, pairs)
        ends = 0.5 * flow.net.ends + factor * _over(slip.ends, sums)
        net = replace(flow.net, across=across, ends=ends)
        right = net.imbalance(np.zeros(flow.gap.shape))
        if system is None:
            system = System(net)
            share = system.pressure(right)
        else:
            share = system.like(net)(right)
        before, drop = rate, inlet**2 - outlet**2
        flux = net.inflow(share)
        rate = 0.5 * float(flux[0].sum() - flux[1].sum()) * drop
        inside = np.where(carrying, np.sqrt(outlet**2 + drop * np.clip(share, 0.0, 1.0)), 0.0)
        if abs(rate - before) <= TOLERANCE * rate:
            return rate / (12.0 * gas.viscosity), np.where(carrying, inside, np.nan)
    raise ConvergenceError(
        f"The pressure of the gas that slips was not found in {ROUNDS} rounds: its leak rate still changes by "
        f"{abs(rate - before) / rate:.1e}.",
        subject="pressure of a gas that slips",
    )


def _over(conductance: RealArray, pressures: RealArray) -> RealArray:
    return np.divide(conductance, pressures, out=np.zeros_like(conductance), where=conductance > 0.0)
