"""Balance of adhesion and menisci together, by a search for the approach at which the forces add
up.

Attraction and menisci change each other's contact, and menisci come and go pixel by pixel: rounds
at a given force may come to rest where the forces do not add up. At a given approach both are found
without feedback. The search follows the curve of external force against approach from where the
surfaces are until the force wanted is between two approaches, and closes in on it, always from the
contact nearer to the start.

Where pixels of liquid come or go the force jumps, and what is wanted may lie in the jump: then they
are under liquid in part (``menisci.bracket``). Contact and attraction hardly change across it, so
that the force of the liquid is what the balance leaves to it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...contact.controls import Control, FixedGrips
from ...contact.couplings.driver import CouplingCheck, Rounds, Settled, settle
from ...contact.couplings.protocol import Contact, Coupling, Memory, Posed
from ...contact.solvers.protocol import Solver
from ...core.errors import NoSolutionError
from ...core.status import Outcome, Progress, Status
from ..adhesion.coupling import AdhesionCoupling
from ..menisci.bracket import SMALL, End, astray
from ..menisci.coupling import MeniscusCoupling
from ..menisci.film import between

_EXACT = 1e-4
"""Error of the force over the reference at which it is balanced."""

_OF_CONTACT = 1e-2
"""Share of the force of the contact that the reference is at least: attraction and pressure may be
far larger than what is left of them."""

_FIRST = 1e-2
"""First step of the approach over the range of the attraction and the thickness of the film,
whichever is less."""

_GROWTH = 2.0
_STEPS = 60
_NARROW = 1e-7
"""Width of the bracket, over the first step, at which the contact itself jumps."""

_INSIDE = 0.1
"""Share of the bracket that a step by the secant keeps from its ends."""

_UNKNOWN: Memory = {key: np.asarray(math.nan) for key in ("energy", "force", "approach", "gap")} | {
    key: np.asarray(0.0) for key in ("jumps", "dissipated")
}
"""What the adhesion remembers of a virgin interface."""


@dataclass(frozen=True, eq=False)
class _Held:
    """Contact held at an ``approach`` (m): force (N) between the ``solids`` less that wanted from
    outside, and that of the ``liquid``."""

    approach: float
    solids: float
    liquid: float
    settled: Settled

    @property
    def force(self) -> float:
        """External force (N) less the one wanted."""
        return self.solids - self.liquid

    @property
    def converged(self) -> bool:
        """Whether its couplings have settled; if not, its force tells nothing, and the search ends
        with it."""
        return self.settled.status.converged


def settle_forces(
    posed: Posed,
    couplings: Sequence[Coupling],
    memories: Mapping[str, Memory],
    solver: Solver,
    *,
    rounds: Rounds = Rounds(),
    progress: Progress | None = None,
) -> Settled:
    """``settle`` for couplings that hold adhesion and menisci, where a force is balanced; the
    arguments are the same.

    Rounds are tried first. Where their forces do not add up to 1e-4 of the external force, or of
    the menisci's or a hundredth of that of the contact if one is larger, the approach is searched
    for.

    Raises
    ------
    NoSolutionError
        If the interface bears no such force.
    """
    held = partial(settle, couplings=couplings, solver=solver, rounds=rounds, progress=progress)
    if not next(c for c in couplings if isinstance(c, MeniscusCoupling)).film.feedback:
        return held(posed, memories=memories)
    search = _Search(posed, couplings, memories, held)
    first: Settled | None = None
    try:
        first = held(posed, memories=memories)
    except NoSolutionError as error:
        if error.subject != "force":
            raise
    if first is not None and first.status.converged:
        start = search.measured(first)
        if abs(start.force) <= search.exact(start):
            return first
    return search.found(first)


class _Search:
    """Contacts of one step held at approaches, by ``settle`` of the couplings."""

    def __init__(
        self, posed: Posed, couplings: Sequence[Coupling], memories: Mapping[str, Memory], held: Callable[..., Settled]
    ) -> None:
        self.posed, self.memories, self.settle = posed, memories, held
        self.law = next(c for c in couplings if isinstance(c, AdhesionCoupling)).law
        self.film = next(c for c in couplings if isinstance(c, MeniscusCoupling)).film
        self.pixel = self.film.suction * posed.operator.grid.pixel_area
        self.first_step = _FIRST * min(self.film.meniscus_height, self.law.range or posed.height_scale)
        self.count = 0

    def found(self, first: Settled | None) -> Settled:
        """The balance, or the jump that takes its place, from the rounds ``first`` or from before
        the step."""
        # from the approach that rounds came to, else that before the step, else first touch
        if first is not None:
            start = self._held(self.measured(first).approach, first)
        else:
            start = self._held(float(self.memories.get("adhesion", {}).get("approach", 0.0)), None)
        near, far = self._bracket(start)
        narrow = _NARROW * self.first_step
        while self._apart_still(near, far) and abs(far.approach - near.approach) > narrow:
            # by the secant or by half
            share = near.force / (near.force - far.force)
            if self.count % 2 or not _INSIDE < share < 1.0 - _INSIDE:
                share = 0.5
            middle = self._held(near.approach + share * (far.approach - near.approach), near.settled)
            if not middle.converged or abs(middle.force) <= self.exact(middle):
                near = far = middle
            elif middle.force * near.force > 0.0:
                near = middle
            else:
                far = middle
        # the contact between these two under the control, with how well its forces add up
        best, across = sorted((near, far), key=lambda held: abs(held.force))
        settled, allowed = best.settled, self.exact(best)
        exchanges = dict(settled.exchanges)
        adhesion, menisci = exchanges["adhesion"], exchanges["menisci"]
        stands = menisci.note.found
        if abs(best.force) > allowed and not self._apart_still(near, far):  # the jump is one of the liquid
            share = (best.solids - best.liquid) / (across.liquid - best.liquid)
            stands = between(stands, across.settled.exchanges["menisci"].note.found, min(max(share, 0.0), 1.0))
        liquid = self.film.suction * stands.share("filled") * self.posed.operator.grid.area
        missed = abs(best.solids - liquid)
        exchanges["adhesion"] = replace(adhesion, note=replace(adhesion.note, posed=self.posed))
        # with the force of the first round, which tells the feedback
        known = replace(menisci.note, was_dry=False) if first is None else first.exchanges["menisci"].note
        note = replace(known, external=self.posed.external_force or 0.0, found=stands, force=liquid)
        exchanges["menisci"] = replace(menisci, x=np.asarray(liquid), note=note)
        reference = self._reference(best)
        check = CouplingCheck("menisci", missed / reference, 0.0, allowed / reference)
        status, forces = settled.status, "Attraction, menisci and external force"
        where = f"at the approach {best.approach:.6g} m, found by {self.count} contacts"
        if status.converged and missed > allowed:
            message = f"{forces} miss their balance by {missed:.3g} N in a jump of the contact {where}."
            remedy = "Take smaller steps of the load, or prescribe the position, with {grips}."
            status = Status(Outcome.STAGNATED, message, remedy)
        elif status.converged:
            jump = f" in a jump of the menisci by {abs(far.liquid - near.liquid):.3g} N, of which part is there,"
            inside = jump if abs(best.force) > allowed else ""
            status = Status(Outcome.CONVERGED, f"{forces} are in balance to {missed:.1e} N{inside} {where}.")
        return replace(
            settled,
            contact=replace(settled.contact, posed=self.posed).with_work_of(None if first is None else first.contact),
            exchanges=exchanges,
            checks=(check, *(item for item in settled.checks if item.name != check.name)),
            rounds=self.count + (0 if first is None else first.rounds),
            status=status,
        )

    def measured(self, settled: Settled) -> _Held:
        """Approach and force of what has ``settled``."""
        contact, exchanges = settled.contact, settled.exchanges
        grid, approach = self.posed.operator.grid, self.posed.top + settled.contact.level
        pull = float(exchanges["adhesion"].x.sum()) * grid.pixel_area
        liquid = float(exchanges["menisci"].note.force)
        return _Held(approach, contact.force - pull - self._wanted(approach), liquid, settled)

    def exact(self, held: _Held) -> float:
        """Error (N) of the force at which it is balanced."""
        return _EXACT * self._reference(held)

    def _apart_still(self, near: _Held, far: _Held) -> bool:
        """Whether the contact itself, or more than pixels at the edge of the liquid, changes
        between the two."""
        if abs(far.solids - near.solids) > self.exact(near):
            return True
        ends = []
        for held in (near, far):
            contact: Contact = held.settled.contact
            found = held.settled.exchanges["menisci"].note.found
            ends.append(End(held.solids, held.liquid, found, contact.gap, contact.pressure))
        # pixels that fill or dry at once, where their force counts
        return astray(ends[0], ends[1], self.film.meniscus_height) * self.pixel > SMALL * self._reference(near)

    def _reference(self, held: _Held) -> float:
        known = max(abs(self._wanted(held.approach)), held.liquid, _OF_CONTACT * held.settled.contact.force)
        return known or self.pixel

    def _wanted(self, approach: float) -> float:
        """External force (N) wanted at this ``approach`` (m)."""
        control: Control = self.posed.control
        if isinstance(control, FixedGrips):
            return control.stiffness * (control.value - approach)
        force = self.posed.external_force
        assert force is not None
        return force

    def _held(self, approach: float, before: Settled | None) -> _Held:
        """Contact at this ``approach`` (m), followed from the one ``before``."""
        self.count += 1
        posed = replace(self.posed, control=FixedGrips(approach), earlier=None, deflections=None, ahead=None)
        memories = dict(self.memories)
        if before is not None:
            followed = {"attraction": before.exchanges["adhesion"].x}
            memories["adhesion"] = {**_UNKNOWN, **self.memories.get("adhesion", {}), **followed}
            pressure = before.contact.pressure
            posed = replace(posed, start=pressure if pressure.any() else posed.start)
        return self.measured(self.settle(posed, memories=memories))

    def _bracket(self, near: _Held) -> tuple[_Held, _Held]:
        """Contacts on both sides of the force wanted, the nearer to the start first."""
        step = -math.copysign(self.first_step, near.force)
        for _ in range(_STEPS):
            if not near.converged or abs(near.force) <= self.exact(near):
                return near, near
            left, contact = near.force + self._wanted(near.approach), near.settled.contact
            if near.force > 0.0 and not contact.pressure.any() and abs(left) <= _EXACT * self.pixel:
                break  # no force is left
            further = self._held(near.approach + step, near.settled)
            if further.converged and further.force * near.force <= 0.0:
                return near, further
            near, step = further, _GROWTH * step
        raise NoSolutionError(
            f"force must be one that the adhesion and the menisci bear, but {self._wanted(near.approach):.6g} "
            "N is not: the surfaces part. "
            "Prescribe the position, with {grips}, to follow them.",
            subject="force",
        )
