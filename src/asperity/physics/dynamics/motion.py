"""A motion in time: its labelled values, its events, and its energy balance; and the integration
phase by phase that makes it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.quantity import Quantity, measured

QUANTITIES = (
    Quantity("displacement", "m", "displacement along the sliding direction"),
    Quantity("penetration", "m", "penetration of the interface"),
    Quantity("tilt", "rad", "tilt"),
    Quantity("velocity", "m/s", "velocity along the sliding direction"),
    Quantity("penetration_rate", "m/s", "rate of penetration"),
    Quantity("tilt_rate", "rad/s", "rate of tilt"),
    Quantity("sliding_speed", "m/s", "velocity of the block over that of the belt, at the interface"),
    Quantity("normal_force", "N", "normal force"),
    Quantity("friction_force", "N", "friction force on the block"),
    Quantity("spring_force", "N", "force that the spring and dashpot bear"),
    Quantity("contact_time", "s", "state of the interface (age of the contacts)"),
)
"""What a motion may hold."""

ENERGIES = (
    Quantity("kinetic_energy", "J", "kinetic energy"),
    Quantity("elastic_energy", "J", "energy in spring and interface, and of the load"),
    Quantity("supplied", "J", "work of the drive and of the forcing"),
    Quantity("dissipated", "J", "energy dissipated by friction and damping"),
)
"""Energies that every motion holds."""


@dataclass(frozen=True)
class Event:
    """What happened at a ``time`` in s: ``kind`` is "stick", "slip", "loss of contact", "contact"
    or "disturbance"."""

    time: float = measured("s", "when it happened")
    kind: str = measured("", "what happened")


@dataclass(frozen=True, eq=False)
class Motion:
    """How a model moved.

    Attributes
    ----------
    time
        (n,) in s, ascending.
    values
        Arrays (n,) in SI units by the names in ``QUANTITIES`` and ``ENERGIES``.
    events
        In the order of time.
    end
        State at the end, from which the model moves on.
    evaluations
        Number of evaluations of the rates.
    """

    time: RealArray = measured("s", "time", "time")
    values: Mapping[str, RealArray] = measured("", "what moved", "time", columns=(*QUANTITIES, *ENERGIES))
    events: tuple[Event, ...] = measured("", "what happened", default=())
    end: tuple[float, ...] = measured("", "state at the end, from which the model moves on", default=())
    evaluations: int = measured("1", "evaluations of the rates", default=0)

    def require_sound(self) -> None:
        """Refuse values of a file that are not over the time, with a ValueError."""
        if self.time.ndim != 1 or any(item.shape != self.time.shape for item in self.values.values()):
            raise ValueError("values of the motion are not over its time")

    def __getitem__(self, name: str) -> RealArray:
        """Values of the quantity ``name``.

        Raises
        ------
        InputError
            If this motion has no such quantity.
        """
        if name not in self.values:
            raise InputError(f"motion has the quantities {', '.join(self.values)}, but {name!r} was asked for.")
        return self.values[name]

    @property
    def energy_residual(self) -> RealArray:
        """(n,) in J: change of kinetic and elastic energy, less what was supplied, plus what was
        dissipated. Zero for an exact motion."""
        stored = self["kinetic_energy"] + self["elastic_energy"]
        found: RealArray = stored - stored[0] - self["supplied"] + self["dissipated"]
        return found

    @property
    def energy_error(self) -> float:
        """Largest energy residual over the largest of: change of one of the energies, work,
        dissipation."""
        scale = max(float(np.ptp(self[item.name])) for item in ENERGIES)
        return float(np.abs(self.energy_residual).max()) / scale if scale > 0.0 else 0.0

    def after(self, start: float) -> Motion:
        """The part of this motion from the time ``start`` in s on.

        Raises
        ------
        InputError
            If nothing is left.
        """
        kept: Any = self.time >= start
        if not kept.any():
            raise InputError(f"start must be at most the end of the motion, {self.time[-1]:g} s, but is {start!r}.")
        values = {name: item[kept] for name, item in self.values.items()}
        return Motion(self.time[kept], values, tuple(e for e in self.events if e.time >= start), self.end)

    def dominant_frequency(self, name: str) -> float:
        """Frequency in Hz of the largest peak of the spectrum of a quantity; 0 where it does not
        move.

        The times are resampled evenly; a Hann window and a parabola through the three points about
        the peak give a fraction of 1/duration.
        """
        import scipy.signal

        periodogram: Any = scipy.signal.periodogram

        even = np.linspace(self.time[0], self.time[-1], self.time.size)
        signal = np.interp(even, self.time, self[name])
        if np.ptp(signal) <= 1e-9 * np.abs(signal).max():
            return 0.0
        frequency, power = periodogram(signal, 1.0 / (even[1] - even[0]), window="hann", detrend="linear")
        k = int(np.argmax(power[1:-1])) + 1
        left, top, right = (math.log(max(power[j], 1e-300)) for j in (k - 1, k, k + 1))
        curved = left - 2.0 * top + right
        shift = 0.5 * (left - right) / curved if curved < 0.0 else 0.0
        return float(frequency[k] + shift * (frequency[1] - frequency[0]))


# Integration.

Rates: TypeAlias = Callable[[float, RealArray], RealArray]
Function: TypeAlias = Callable[[float, RealArray], float]


@dataclass(frozen=True, eq=False)
class Guard:
    """Ends a phase where ``function`` crosses zero in ``direction`` (+1 upwards, -1 downwards);
    ``then`` gives the name of the next phase.

    ``kind`` names the event.
    """

    function: Function
    direction: float
    kind: str
    then: Callable[[float, RealArray], str]


@dataclass(frozen=True, eq=False)
class Phase:
    """Equations of motion that hold until a guard ends them.

    ``on_entry`` sets what is exact in the phase. Two crossings within a step are not seen: no step
    is longer than ``longest`` in s.
    """

    rates: Rates
    guards: tuple[Guard, ...] = ()
    longest: float = math.inf
    on_entry: Callable[[RealArray], RealArray] = field(default=lambda state: state)


@dataclass(frozen=True, eq=False)
class Course:
    """States (n, k) at the ``time`` (n,), the phase of each, the events, and the number of
    evaluations."""

    time: RealArray
    states: RealArray
    phases: tuple[str, ...]
    events: tuple[Event, ...]
    evaluations: int


MOST_PHASES = 200_000
"""Phases after which a motion is taken for one that chatters: changes of phase that follow each
other without end."""


def integrated(
    phases: Mapping[str, Phase],
    first: str,
    state: ArrayLike,
    times: RealArray,
    *,
    method: str,
    tolerance: float,
    scales: RealArray,
) -> Course:
    """States at the ascending ``times`` from ``state`` in the phase ``first`` on, by SciPy's solver
    ``method``.

    Local errors are held to ``tolerance`` times the state plus ``scales``. A crossing of a guard
    ends the phase where it is.

    Raises
    ------
    ConvergenceError
        If the solver fails, or phases follow each other without end.
    """
    import scipy.integrate

    solve: Any = scipy.integrate.solve_ivp
    current = phases[first].on_entry(np.array(state, dtype=float))
    now, name, done, evaluations = float(times[0]), first, 0, 0
    kept, names, events = np.empty((times.size, current.size)), [first] * times.size, list[Event]()
    for _ in range(MOST_PHASES):
        phase = phases[name]
        found = solve(
            phase.rates,
            (now, float(times[-1])),
            current,
            t_eval=times[done:],
            events=[_terminal(guard) for guard in phase.guards] or None,
            max_step=phase.longest,
            method=method,
            rtol=tolerance,
            atol=tolerance * scales,
        )
        evaluations += found.nfev
        if found.status < 0:
            raise ConvergenceError(f"The motion could not be integrated beyond {now:.6g} s: {found.message}")
        count = len(found.t)  # an empty list where no sample lies in the phase
        if count:
            kept[done : done + count], names[done : done + count] = found.y.T, [name] * count
        done += count
        if found.status == 0:
            return Course(times, kept, tuple(names), tuple(events), evaluations)
        index = next(k for k, crossed in enumerate(found.t_events) if crossed.size)
        guard, now, current = phase.guards[index], float(found.t_events[index][0]), found.y_events[index][0]
        name = guard.then(now, current)
        current = phases[name].on_entry(current.copy())
        events.append(Event(now, guard.kind if name != "stick" else "stick"))
    raise ConvergenceError(
        f"The motion changes between {first} and other phases more than {MOST_PHASES} times before "
        f"{times[-1]:g} s. Shorten the duration, or smooth the friction."
    )


def _terminal(guard: Guard) -> Any:
    """The function of ``guard`` as SciPy takes an event."""
    crossing = partial(guard.function)
    crossing.__dict__.update(terminal=True, direction=guard.direction)
    return crossing


def sample_times(duration: float, samples: int) -> RealArray:
    """``samples`` + 1 times from zero to ``duration`` > 0 in s.

    Raises
    ------
    InputError
        If there are fewer than two samples, or more than ten million.
    """
    require.positive(duration, "duration (s)")
    if require.integer(samples, 2, "samples") > 10_000_000:
        raise InputError(f"samples must be at most 10000000, but is {samples}. Take fewer, or a shorter duration.")
    return np.linspace(0.0, duration, samples + 1)
