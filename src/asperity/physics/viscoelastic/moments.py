"""Steps of time through a load on viscoelastic bodies: how long they are, and what happened at
each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ...contact.answer import Answer
from ...contact.certificate import Certificate
from ...contact.controls import Approach, Control, FixedGrips, Force, MeanGap, MeanPressure, Pull, Step, Unloaded
from ...contact.couplings.protocol import Memory
from ...contact.tangential import Shift, TangentialForce
from ...contact.time_division import TimeSteps
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import Quantity, measured
from ...core.status import Advice
from ...core.units import percent
from .coupling import Past

if TYPE_CHECKING:
    from ...contact.couplings.driver import Settled
    from ...contact.state import InterfaceState

_SHORTER = 0.7
"""Factor to the length of a step that was rejected at most."""

LEAST_ENERGY_ERROR = 5e-3
"""Energy in time that is missed over the largest work and does not count: the estimate of what
steps explain is too small for a ramp of few steps from first touch. One such ramp in some 70 random
histories, with menisci, missed 3.8e-3 where 1.0e-3 was explained."""

COLUMNS = (
    Quantity("time", "s", "time"),
    Quantity("mean_pressure", "Pa", "mean (nominal) pressure"),
    Quantity("force", "N", "force"),
    Quantity("approach", "m", "approach from first touch"),
    Quantity("mean_gap", "m", "mean gap"),
    Quantity("area_fraction", "1", "real contact area / nominal area (edges between pixels)"),
    Quantity("max_pressure", "Pa", "maximum pressure"),
    Quantity("stored_energy", "J", "stored energy"),
    Quantity("dissipated", "J", "heat since the virgin state"),
    Quantity("time_error", "1", "error of the displacement that the step of time adds"),
)
"""What is recorded after every step of time."""


@dataclass(frozen=True, eq=False)
class Creeping(Answer):
    """What happened to a viscoelastic contact during one step of a history.

    Attributes
    ----------
    records
        (steps of time + 1, columns of ``COLUMNS``): before the step, and after each step of time.
    retarded_displacement
        Displacement (nx, ny) in m at the end that is not by the pressure then.
    stored_energy, dissipated
        Energy stored at the end; heat of this step; J.
    work
        Work of the force between the solids over the approach in this step, J: through the steps of
        time as ``energy_in_time.force_work``, and of a step at once what is stored and taken.
    tries
        Solves, those of rejected steps of time included.
    tangential_work, step_work
        Of surfaces that stick and slip: work of tangential force and torque in this step, and what
        of it the length of implicit steps of time takes, as of ``EnergyBalance``, J.
    shear_work
        Work of the displacement by the shear of gross sliding in this step, J.
    missed, explained, largest_work
        Since the virgin state, J: works less all that is stored or taken; what of that the length
        of the steps of time explains; and the largest work.
    """

    records: RealArray = measured("", "what was recorded", "moment", columns=COLUMNS)
    retarded_displacement: RealArray = measured("m", "displacement that is not by the pressure then", "x", "y")
    stored_energy: float = measured("J", "stored energy")
    dissipated: float = measured("J", "heat of the step")
    work: float = measured("J", "work of the force in the step")
    tries: int = measured("1", "solves, rejected steps of time included")
    tangential_work: float = measured("J", "work of the tangential force in the step", default=0.0)
    step_work: float = measured("J", "part of it that the length of implicit steps of time takes", default=0.0)
    shear_work: float = measured("J", "work of the displacement by shear in the step", default=0.0)
    missed: float = measured("J", "works so far less all that is stored or taken", default=0.0)
    explained: float = measured("J", "what of that the length of the steps of time explains", default=0.0)
    largest_work: float = measured("J", "largest work so far", default=0.0)

    @property
    def energy_error(self) -> float:
        """Energy that is missed so far over the largest work; zero where no work was done."""
        return abs(self.missed) / self.largest_work if self.largest_work > 0.0 else 0.0

    @property
    def explained_error(self) -> float:
        """What of ``energy_error`` the length of the steps of time explains, estimated."""
        return self.explained / self.largest_work if self.largest_work > 0.0 else 0.0

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of contacts that grow and recede."""
        return ("Ferry1980", "Lee1960", "Park1999", "Ting1966")

    def springs(self) -> float:
        """Energy of all springs."""
        return self.stored_energy

    def retarded(self) -> RealArray:
        """The retarded displacement."""
        return self.retarded_displacement

    def worked(self) -> float:
        """Work through the steps of time."""
        return self.work

    def heat(self) -> float:
        """Heat of this step."""
        return self.dissipated

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """Whether works and what is stored or taken differ by more than the steps of time
        explain."""
        if self.energy_error <= max(self.explained_error, LEAST_ENERGY_ERROR):
            return
        yield Advice(
            "warning",
            "energy balance",
            f"The energies of the viscoelastic contact miss by {percent(self.energy_error, 2)} of the largest "
            f"work, where its steps of time explain {percent(self.explained_error, 2)}: heat and force may be "
            "wrong.",
            "Take a smaller tolerance ({time_tolerance}) or more steps of time ({time_steps}).",
            {"error": self.energy_error, "explained": self.explained_error},
            ("viscoelastic_", "force", "mean_pressure"),
        )

    def column(self, name: str) -> RealArray:
        """Values of the column ``name`` of ``COLUMNS``, the first one before the step. InputError
        if there is none."""
        names = [item.name for item in COLUMNS]
        require.one_of(name, names, "column of a viscoelastic step")
        return np.asarray(self.records[:, names.index(name)])

    @property
    def time(self) -> RealArray:
        """Time (s) since the virgin state."""
        return self.column("time")

    @property
    def time_error(self) -> float:
        """Sum of the errors of the displacement that the steps of time add, relative: an estimate
        of the error by their length."""
        return float(self.column("time_error").sum())


@dataclass(frozen=True, eq=False)
class Moment:
    """Contact after one step of time: what settled, the past then, the state to go on from, its
    record, its displacement by the past, its stored energy (J), the length (s) of the step, zero
    where none is known, what the couplings remember and found, the work of tangential force and
    torque in this step of time with the part that implicit steps take, and that of displacements by
    gross sliding (J)."""

    settled: Settled | None
    past: Past
    state: InterfaceState | None
    record: RealArray
    retarded: RealArray | float = 0.0
    stored: float = 0.0
    length: float = 0.0
    ends: Mapping[str, tuple[Memory, object]] = field(default_factory=dict)
    shear_works: tuple[float, float] = (0.0, 0.0)
    lift_work: float = 0.0

    @property
    def answers(self) -> tuple[Answer, ...]:
        """What the couplings found."""
        return tuple(found for _, found in self.ends.values() if isinstance(found, Answer))

    @property
    def plastic_work(self) -> float:
        """J since the virgin surface."""
        return 0.0 if self.state is None else self.state.plastic_work


def control_at(end: Control, share: float, place: tuple[float, float, float], area: float) -> Control:
    """Control after a ``share`` of a ramp to ``end`` from a ``place`` (mean pressure in Pa,
    approach and mean gap in m) on an ``area`` (m²)."""
    if share >= 1.0:
        return end
    mean, approach, gap = place
    if isinstance(end, FixedGrips):
        return replace(end, value=approach + share * (end.value - approach))
    kinds: dict[type, tuple[Callable[[float], Control], float, float]] = {
        MeanPressure: (MeanPressure, mean, 1.0),
        Force: (Force, mean * area, 1.0),
        Approach: (Approach, approach, 1.0),
        MeanGap: (MeanGap, gap, 1.0),
        Unloaded: (Force, mean * area, 1.0),
        Pull: (Force, mean * area, -1.0),
    }
    if type(end) not in kinds:
        raise InputError(
            "load or position of a step with a duration must be one of "
            f"{', '.join(k.__name__ for k in kinds)}, but is {end!r}."
        )
    kind, start, sign = kinds[type(end)]
    value = start + share * (sign * end.value - start)
    if value < 0.0 and kind in (Force, MeanPressure):
        return Pull(-value if kind is Force else -value * area)
    return kind(value) if value > 0.0 else Unloaded()


def step_at(end: Step, share: float, begin: Moment, area: float) -> Step:
    """Step to the controls after a ``share`` of a ramp from ``begin`` to those of ``end``, on an
    ``area`` (m²)."""
    normal, aim = control_at(end.normal, share, begin.past.place, area), end.tangential
    if aim is None or share >= 1.0:
        return Step(normal, aim)
    memory = {} if begin.state is None else begin.state.memory.get("stick_slip", {})
    if isinstance(aim, Shift):
        start = memory["shift"] if memory else np.zeros(3)
        x, y, twist = start + share * (np.array([aim.x, aim.y, aim.twist]) - start)
        return Step(normal, Shift(float(x), float(y), float(twist)))
    first = np.zeros(2)
    if memory:
        first = area * np.array([memory["traction_x"].mean(), memory["traction_y"].mean()])
    x, y = first + share * (np.array([aim.x, aim.y]) - first)
    return Step(normal, TangentialForce(float(x), float(y)))


class March(Protocol):
    """What steps of time are taken of."""

    @property
    def area(self) -> float:
        """Nominal area, m²."""

    def advanced(self, moment: Moment, control: Control | Step, length: float) -> Moment:
        """Contact under ``control`` a step of time of this ``length`` (s) after ``moment``."""

    def error(self, first: Moment, second: Moment, third: Moment) -> float:
        """Error that the last of two steps of time adds to the displacement, relative to it, or one
        of them to the energy where that is more."""


_RESOLVED = 1e3
"""Shortest duration over the rounding of the time before it."""


def marched(begin: Moment, end: Step, settings: TimeSteps, march: March) -> tuple[list[Moment], int]:
    """Moments through a ramp to the controls of ``end`` in its duration, and the number of solves
    tried.

    The error of a step is that of the curvature of the pressure over it and the one before; the
    first two steps are one try. The last two steps are equal, so that none is very short.
    """
    duration = end.duration
    if duration == 0.0:
        return [march.advanced(begin, end, 0.0)], 1
    least = _RESOLVED * float(np.spacing(begin.past.time))
    if duration < least:
        raise InputError(
            f"duration of a step (s) must be at least {least:.3g} after {begin.past.time:.3g} s, since less is "
            f"lost in rounding, but is {duration:.3g}."
        )
    moments, length, tries, equal = [begin], settings.first(duration), 0, settings.number is not None
    while tries < settings.most:
        done = moments[-1].past.time - begin.past.time
        left = duration - done
        if settings.number:
            share = len(moments) / settings.number
            step = duration * share - done
        elif left <= length * (1.0 + 1e-9):
            step, share = left, 1.0
        else:
            step = 0.5 * left if left < 2.0 * length else length
            share = (done + step) / duration
        now = march.advanced(moments[-1], step_at(end, share, begin, march.area), step)
        tries += 1
        if now.settled is None or not now.settled.status.converged:
            return [*moments[1:], now], tries
        if len(moments) > 1:
            found = march.error(moments[-2], moments[-1], now)
            factor = settings.factor(found)
            if found > settings.tolerance and not equal:
                length = step * min(factor, _SHORTER)
                moments = moments[:1] if len(moments) == 2 else moments
                continue
            length = step * factor
            record = now.record.copy()
            record[-1] = found
            now = replace(now, record=record)
        moments.append(now)
        if share >= 1.0:
            break
    return moments[1:], tries
