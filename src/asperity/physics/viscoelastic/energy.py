"""Energies of viscoelastic contacts in time: the work of a step, and what of it nothing takes,
which says how far its steps of time can be trusted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...contact.answer import Answer
from ...core.arrays import RealArray
from ...core.status import Outcome, Status
from ...core.units import percent, times
from .coupling import Past
from .moments import Creeping, Moment

LARGEST_MISS = 0.05
"""Energy that is missed over the largest work above which a history in time has not converged."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)
"""Rule that is exact for force times rate, a polynomial of fifth degree between two moments."""


@dataclass(frozen=True)
class Account:
    """Energies (J) since the virgin state, or since they are known.

    Attributes
    ----------
    stored
        In the solids and in their adhesion.
    work, along
        Of the force over the approach, and of tangential force and torque.
    largest
        Largest magnitude of either so far, or what was stored when the account began.
    missed
        Works less all that is stored or taken.
    explained
        What of that the steps of time explain: bound by the curvature of the pressure and of the
        course of force and approach over them.
    """

    stored: float
    work: float = 0.0
    along: float = 0.0
    largest: float = 0.0
    missed: float = 0.0
    explained: float = 0.0

    @classmethod
    def of(cls, past: Past) -> Account | None:
        """That of a ``past``; None if it does not know it."""
        return cls(*map(float, past.account)) if len(past.account) else None

    @classmethod
    def begun(cls, stored: float) -> Account:
        """A new one of a contact that holds the energy ``stored`` (J) by now."""
        return cls(stored, largest=abs(stored))

    @property
    def numbers(self) -> tuple[float, ...]:
        """All of them in order, as a past remembers them."""
        return self.stored, self.work, self.along, self.largest, self.missed, self.explained


def force_work(records: RealArray) -> tuple[float, float]:
    """∫ F dδ (J) through the moments of ``records``, and its error.

    Force and approach are monotone cubics in time between the moments (Fritsch & Carlson 1980),
    straight where there are two of them. A force over a fixed approach does no work, and a fixed
    force just its own. The error is the difference from trapezia.
    """
    time, force, approach = records[:, 0], records[:, 2], records[:, 3]
    trapezia = float((0.5 * (force[1:] + force[:-1]) * np.diff(approach)).sum())
    if len(time) < 3:
        return trapezia, 0.5 * float(np.abs(np.diff(force) * np.diff(approach)).sum())
    from scipy.interpolate import PchipInterpolator

    half = 0.5 * np.diff(time)[:, None]
    at = time[:-1, None] + half * (1.0 + _NODES)
    power = PchipInterpolator(time, force)(at) * PchipInterpolator(time, approach)(at, 1)
    found = float((power * half * _WEIGHTS).sum())
    return found, abs(found - trapezia)


def stored_in(moment: Moment) -> float:
    """Energy (J) in the solids and in what acts between them."""
    return moment.stored + sum(answer.stores(relaxing=True) for answer in moment.answers)


def taken_by(before: Moment, moment: Moment) -> float:
    """Heat, plastic work, work of the displacement by shear and of slip less the tangential work in
    the step of time from ``before`` (J)."""
    slip = sum(answer.slipped() for answer in moment.answers)
    along, step = moment.shear_works
    plastic = moment.plastic_work - before.plastic_work
    return moment.past.dissipated - before.past.dissipated + plastic + moment.lift_work + slip + step - along


def step_error(before: Moment, moment: Moment) -> float:
    """Energy that the step of time from ``before`` misses beyond the error of the trapezium, over
    what is stored; zero where that is not known.

    A step that is many times as long as a retardation may end at the right displacement and yet
    miss how it came there, and with it the heat. What adhesive surfaces lose as they jump is not
    missed.
    """
    stored = stored_in(before), stored_in(moment)
    scale = max(map(abs, stored))
    jumped = any(answer.has_jumped() for answer in moment.answers)
    if not scale > 0.0 or np.isnan(stored[0]) or jumped or not _begun(before, moment):
        return 0.0
    (f0, d0), (f1, d1) = before.record[2:4], moment.record[2:4]
    missed = 0.5 * (f0 + f1) * (d1 - d0) - (stored[1] - stored[0]) - taken_by(before, moment)
    return max(0.0, float(abs(missed) - 0.5 * abs((f1 - f0) * (d1 - d0))) / scale)


def _begun(before: Moment, moment: Moment) -> bool:
    """Whether the energies of what attracts the surfaces in the ``moment``, if anything, are known
    ``before`` a step."""
    attracting = {
        name
        for name, (_, found) in moment.ends.items()
        if isinstance(found, Answer) and found.traction_beside() is not None
    }
    return not attracting or (before.state is not None and attracting <= before.state.memory.keys())


def accounted(begin: Moment, moments: list[Moment], found: Creeping) -> tuple[Creeping, Account]:
    """What was ``found`` of the step through ``moments`` after ``begin`` with its work and what is
    missed, and the account then.

    A step at once is elastic but for what the interface takes: its work is the sum of what is
    stored and taken, with no error of any rule. Nothing is missed in a step in which adhesive
    surfaces jump, since nothing else says what a jump loses. The first step of adhesive surfaces
    begins at no known approach.
    """
    before, stored = Account.of(begin.past), stored_in(moments[-1])
    if before is None or not _begun(begin, moments[0]):
        account = Account.begun(stored)
    else:
        jumped = any(answer.has_jumped() for moment in moments for answer in moment.answers)
        taken = stored - before.stored + sum(taken_by(*pair) for pair in pairwise([begin, *moments]))
        error = force_work(found.records)[1]
        if found.records[-1, 0] == found.records[0, 0] and not jumped:
            found, error = replace(found, work=taken), 0.0
        missed = before.missed + (0.0 if jumped else found.work - taken)
        works = before.work + found.work, before.along + found.tangential_work
        largest = max(before.largest, *map(abs, works))
        explained = before.explained + error + 2.0 * found.time_error * largest
        account = Account(stored, *works, largest, missed, explained)
    found = replace(found, missed=account.missed, explained=account.explained, largest_work=account.largest)
    return found, account


def balanced(status: Status, found: Creeping) -> Status:
    """``status``, or that the energies of a step in time miss by too much."""
    if not status.converged or not found.energy_error > LARGEST_MISS:
        return status
    error = found.energy_error
    much = f"{percent(error, 2)} of" if error < 1.0 else f"{times(error)} times"
    message = f"The energies miss by {much} the largest work: the steps of time are too long."
    return Status(Outcome.STAGNATED, message, "Take a smaller tolerance of the steps of time, or more of them.")
