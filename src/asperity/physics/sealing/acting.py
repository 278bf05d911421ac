"""The pressure of a fluid on both bodies: that of the flow where it flows, and what fluid would
have in closed pools and where it came between the touching surfaces.

Surfaces stay closed as long as they press each other with more than that: the contact pressure less
the pressure of the fluid around (Terzaghi's effective stress) is what a contact problem finds that
is at least zero. Inside a contact the pressure of the fluid is so only a reference, which changes
nothing; it joins that at the edge smoothly.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from ...core.arrays import BoolArray, RealArray
from ...core.spectral import RealTransform, fast_length
from .flow import GapFlow
from .fluids import IdealGas, Leak, with_dead_ends
from .network import clusters, open_cells

if TYPE_CHECKING:
    from .law import FluidPressure

POWER = 3.0
"""Power of the distance with which the fluid elsewhere counts: its weight in the plane adds up, so
that the nearest decides, and at a thousand pixels it is still far above the rounding of a
transform."""

SIDE = 4
"""Rows of fluid beyond each side between two pressures."""


def acting_pressure(flow: GapFlow, leak: Leak, given: FluidPressure, before: RealArray) -> RealArray:
    """(nx, ny) pressure in Pa of the fluid on the bodies at every cell, of a ``leak`` by ``flow``
    between the pressures that are ``given``, after that ``before`` (nx, ny) in Pa.

    Under a mean gradient it is the mean of inlet and outlet, over the volume of the gap, and what
    the flow changes in it, without the part that falls steadily: this would not repeat with the
    bodies. A pool that has closed keeps the mean of what it had before: any pressure could be in
    it.
    """
    inlet, outlet = given.inlet, given.outlet
    known, values = _known(flow, leak, inlet, outlet)
    opened = open_cells(flow.gap) if flow.gap.any() else np.zeros(flow.gap.shape, bool)
    fall = (inlet - outlet) / flow.gap.shape[flow.axis] if flow.repeats else 0.0
    sides = None if fall else (inlet, outlet)
    if sides is None and not known.any():
        return np.full(flow.gap.shape, 0.5 * (inlet + outlet))
    pools = opened & ~known
    if pools.any():
        labels = clusters(pools, flow.wraps).labels
        means = ndimage.mean(before, labels, np.arange(labels.max() + 1))
        values, known = np.where(pools, np.asarray(means)[labels], values), opened
    if known.all():
        return values
    # a gas that does not slip flows with the squares of its pressure
    power = 2.0 if isinstance(given.fluid, IdealGas) and given.fluid.slip_length == 0.0 and not fall else 1.0
    inside = np.where(known, values, spread(values, known, flow, sides))
    return _at_edges(values, known, flow, inside, fall, power)


def _known(flow: GapFlow, leak: Leak, inlet: float, outlet: float) -> tuple[BoolArray, RealArray]:
    """Cells (nx, ny) whose fluid is joined to one that flows or to a side, and its pressure
    (Pa)."""
    if flow.sealed or not flow.repeats:
        known, inside = with_dead_ends(flow, leak, inlet, outlet)
    else:
        known, inside = flow.net.carrying, np.where(flow.net.carrying, leak.pressure, 0.0)
    if not flow.repeats or not known.any():
        return known, inside
    axis = flow.axis
    count, shape = known.shape[axis], [1, 1]
    shape[axis] = count
    fall = 0.5 - (np.arange(count) + 0.5) / count
    changed = np.where(known, inside - (inlet - outlet) * fall.reshape(shape), 0.0)
    # the mean over the volume of each cluster, to which a gap that closes adds less and less
    labels = np.where(known, clusters(open_cells(flow.gap), flow.wraps).labels, 0)
    volumes = np.bincount(labels.ravel(), flow.gap.ravel())
    sums = np.bincount(labels.ravel(), (flow.gap * changed).ravel())
    means = np.divide(sums, volumes, out=np.zeros_like(sums), where=volumes > 0.0)
    return known, np.where(known, changed - means[labels] + 0.5 * (inlet + outlet), 0.0)


def _at_edges(
    values: RealArray, known: BoolArray, flow: GapFlow, elsewhere: RealArray, fall: float, power: float
) -> RealArray:
    """``elsewhere`` (nx, ny), but beside cells with fluid the mean over their ``values``, weighted
    by their gaps: what a cell has that has just opened, so that the pressure does not jump there.

    ``fall`` (Pa) is what falls steadily from cell to cell beside the values; ``power`` is that of
    the pressure with which the fluid flows.
    """
    weights, total = np.zeros(known.shape), np.zeros(known.shape)
    gap, given = np.where(known, flow.gap, 0.0), np.where(known, values, 0.0)
    for axis in (0, 1):
        for step in (1, -1):
            beside = np.roll(gap, step, axis)
            pressure = np.roll(given, step, axis) + (step * fall if axis == flow.axis else 0.0)
            if not flow.wraps[axis] or (axis == flow.axis and not fall):
                beside[(slice(None),) * axis + (0 if step == 1 else -1,)] = 0.0
            weights += beside
            total += beside * pressure**power
    edge = ~known & (weights > 0.0)
    mean = np.divide(total, weights, out=elsewhere**power, where=edge)
    return np.where(edge, mean ** (1.0 / power), elsewhere)


def spread(values: RealArray, known: BoolArray, flow: GapFlow, sides: tuple[float, float] | None) -> RealArray:
    """(nx, ny) mean of the ``values`` in the ``known`` cells, weighted by the inverse cube of their
    distance, with fluid of the pressures beyond the two ``sides`` of the flow, if any."""
    weights, given = known.astype(float), np.where(known, values, 0.0)
    before = [0, 0]
    if sides is not None:
        before[flow.axis] = SIDE
        width = [(0, 0), (0, 0)]
        width[flow.axis] = (SIDE, SIDE)
        given = np.moveaxis(np.pad(given, width), flow.axis, 0)
        given[:SIDE], given[-SIDE:] = sides
        given = np.moveaxis(given, 0, flow.axis)
        weights = np.pad(weights, width, constant_values=1.0)
    wraps = [flow.wraps[axis] and (sides is None or axis != flow.axis) for axis in (0, 1)]
    counts = weights.shape
    lengths = [n if wrap else fast_length(2 * n) for n, wrap in zip(counts, wraps, strict=True)]
    lags = [
        np.minimum(np.arange(n), n - np.arange(n)) * step for n, step in zip(lengths, flow.grid.spacing, strict=True)
    ]
    distance = np.hypot(lags[0][:, None], lags[1][None]) / min(flow.grid.spacing)
    distance[0, 0] = np.inf
    transform = RealTransform((lengths[0], lengths[1]))
    kernel = transform.forward(distance**-POWER).copy()

    def around(field: RealArray) -> RealArray:
        padded = np.zeros(transform.shape)
        padded[: counts[0], : counts[1]] = field
        found = transform.backward(kernel * transform.forward(padded))
        shape = flow.gap.shape
        return found[before[0] : before[0] + shape[0], before[1] : before[1] + shape[1]].copy()

    least, most = given[weights > 0.0].min(), given[weights > 0.0].max()
    return np.clip(around(given) / np.maximum(around(weights), 1e-300), least, most)
