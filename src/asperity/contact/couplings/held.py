"""A prescribed position that no load singles out: held by its offset, where a hardness bounds the
pressure.

The load is the unknown of a position (``position``), and where nearly every point yields it is a
poor one: whole intervals of positions belong to one load. Plateaus that yield as a whole sink until
others touch, and fully yielded surfaces, at a mean pressure equal to the hardness, go on sinking,
the plastic indentation taking the rest. With the pressure bounded the problem at a given offset has
a solution at every offset (a convex function on a compact set), so the bodies are held there
instead; a mean gap is a monotone function of the approach, which a bracket encloses.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.status import Outcome, Progress, Status
from ..controls import Approach, MeanGap
from ..solvers.protocol import Solver
from .driver import Rounds, Settled, settle
from .position import TARGET_ERROR
from .protocol import Contact, Coupling, Memory, Posed

_STEPS = 80
"""Approaches tried at most for a mean gap; ten to twenty are the rule."""

_CLOSED = 4.0 * np.finfo(float).eps
"""Width of the bracket of approaches over the range of heights that counts as closed."""

_Holding = Callable[[float, RealArray | None], Settled]


def settle_position(
    posed: Posed,
    couplings: Sequence[Coupling],
    memories: Mapping[str, Memory],
    solver: Solver,
    *,
    rounds: Rounds = Rounds(),
    progress: Progress | None = None,
) -> Settled:
    """``settle`` of a prescribed position; where a hardness bounds the pressure and no load is
    found for it, with the position held. The arguments are the same.

    Raises
    ------
    NoSolutionError
        As ``settle``.
    """
    searched = partial(settle, posed, couplings, memories, solver, rounds=rounds, progress=progress)
    bounding: list[Coupling] = []
    if not any(coupling.positions for coupling in couplings):
        bounding = [coupling for coupling in couplings if coupling.bounds]
    if len(bounding) != 1 or any(coupling.feedback for coupling in couplings if coupling is not bounding[0]):
        return searched()  # no hardness bounds the pressure, or something else reacts to the contact
    last: Contact | None = None

    def held(approach: float, start: RealArray | None) -> Settled:
        nonlocal last
        at = replace(posed, control=Approach(approach), start=start, earlier=None, held=True)
        settled = settle(at, couplings, memories, solver, rounds=rounds, progress=progress)
        last = settled.contact.with_work_of(last)
        return replace(settled, contact=last)

    control = posed.control
    caps = [coupling.cap for coupling in couplings if coupling.cap is not None]
    far = isinstance(control, Approach) and control.value >= posed.top - float(posed.dented.mean())
    if far and len(caps) == 1:
        # whether the approach takes all points to a constant hardness
        full = np.array(np.broadcast_to(caps[0], posed.dented.shape), dtype=np.float64)
        reached = bool(np.all(posed.operator.apply(full) - posed.dented <= control.value - posed.top))
        if reached and control.value > 0.0:
            return held(control.value, full)
    found: Settled | None = None
    failure: NoSolutionError | None = None
    try:
        found = searched()
        if found.status.converged:
            return found
        last = found.contact
    except NoSolutionError as error:
        failure = error
    start = None if found is None else found.contact.pressure
    at_gap = isinstance(posed.control, MeanGap)
    instead = _at_gap(posed, held, start) if at_gap else held(posed.control.value, start)
    if instead.status.converged or found is None:
        if failure is not None and not (instead.status.converged and instead.contact.pressure.any()):
            raise failure
        return replace(instead, contact=replace(instead.contact, posed=posed))
    return found


def _at_gap(posed: Posed, held: _Holding, start: RealArray | None) -> Settled:
    """Contact at the mean gap prescribed, by the regula falsi (Illinois) between approaches on
    either side."""
    wanted, first = posed.control.value, posed.top - float(posed.dented.max())
    depth = float(np.ptp(posed.dented)) or posed.height_scale
    touch = float(posed.dented.max() - posed.dented.mean())
    low, high = (
        (first, touch - wanted),
        (first + depth, -wanted),
    )  # approach (m) and the gap there beyond the one wanted
    found = held(high[0], start)
    for _ in range(_STEPS):
        if not found.status.converged:
            return found
        miss = float(found.contact.gap.mean()) - wanted
        if miss <= 0.0 or abs(miss) <= TARGET_ERROR * wanted:
            high = high[0], miss
            break
        low, depth = (high[0], miss), 2.0 * depth
        high = first + depth, -wanted
        found = held(high[0], found.contact.pressure)
    side = 0
    for step in range(_STEPS):
        miss = float(found.contact.gap.mean()) - wanted
        if not found.status.converged or abs(miss) <= TARGET_ERROR * wanted:
            return found
        if high[0] - low[0] <= _CLOSED * (depth + posed.top):
            break
        share = 0.5 if step % 4 == 3 or not low[1] > high[1] else low[1] / (low[1] - high[1])
        at = low[0] + min(max(share, 1e-3), 1.0 - 1e-3) * (high[0] - low[0])
        found = held(at, found.contact.pressure)
        miss = float(found.contact.gap.mean()) - wanted
        if miss > 0.0:
            low, high = (at, miss), (high[0], 0.5 * high[1] if side > 0 else high[1])
            side = 1
        else:
            low, high = (low[0], 0.5 * low[1] if side < 0 else low[1]), (at, miss)
            side = -1
    text = f"The mean gap prescribed is still missed by {abs(miss) / wanted:.1e} of itself; it jumps with the approach."
    return replace(found, status=Status(Outcome.STAGNATED, text, "Prescribe a load or an approach."))
