"""Motion of a sliding block in time: with smoothed friction, or with stick and slip as events; and
what it comes to."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import ConvergenceError
from ...core.quantity import Quantity
from . import block_kernel as kernel
from .block import SlidingBlock
from .motion import Event, Guard, Motion, Phase, integrated, sample_times

TOLERANCE = 1e-8
"""Local error of the integration unless said otherwise. At 1e-6 LSODA damps weak flutter away
(growth below 30 1/s at 5 kHz was lost)."""

PROMINENCE = 0.05
"""Rise and fall of the displacement, over that under static friction, from which it counts as
stick-slip."""


NO_SLIP = 1e-6
"""Sliding speed over that of the belt below which the base is at rest on it."""

NO_VIBRATION = 1e-6
"""Standard deviation of the penetration over that at rest below which errors of the integration may
have made it: no frequency is given."""


@dataclass(frozen=True, eq=False)
class BlockRun:
    """A motion of a sliding block, and what it comes to.

    Attributes
    ----------
    block
        The block.
    motion
        Its motion.
    smoothing
        Sliding speed about which friction turned over, m/s; 0 where the base sticks and slips.
    """

    block: SlidingBlock
    motion: Motion
    smoothing: float = 0.0

    def numbers(self, start: float = 0.0) -> dict[str, float]:
        """``BLOCK_SCALARS`` by name, of the motion from the time ``start`` in s on; the peak is
        that of the whole motion."""
        from scipy.signal import find_peaks

        late, block = self.motion.after(start), self.block
        reference, load, unit = block.reference_displacement, block.load, block.rest
        spring, normal, x = late["spring_force"], late["normal_force"], late["displacement"]
        scaled = x / max(reference, 1e-300)
        peaks, _ = find_peaks(scaled, prominence=PROMINENCE)
        valleys, _ = find_peaks(-scaled, prominence=PROMINENCE)
        # the base is at rest on the belt; of smoothed friction, to within its smoothing
        rests = late["sliding_speed"] >= -max(self.smoothing, NO_SLIP * block.speed)
        sticks = all(bool(rests[first:last].any()) for first, last in itertools.pairwise(peaks))
        swing = float(late["penetration"].std())
        mean = float(np.trapezoid(spring, late.time)) / float(np.ptp(late.time)) if late.time.size > 1 else spring[0]
        found = {
            "peak_friction": float(self.motion["spring_force"].max()) / load,
            "apparent_friction": mean / load,
            "friction_reduction": mean / (reference * block.stiffness) if reference > 0.0 else math.nan,
            "smallest_normal_force": float(normal.min()) / load,
            "largest_normal_force": float(normal.max()) / load,
            "penetration_vibration": swing / unit,
            "tilt_vibration": float(late["tilt"].std()) * block.length / (2.0 * unit),
            "vibration_frequency": late.dominant_frequency("penetration") if swing > NO_VIBRATION * unit else 0.0,
            "smallest_velocity": float(late["velocity"].min()),
            "largest_velocity": float(late["velocity"].max()),
            "stick_slip_peak": math.nan,
            "stick_slip_valley": math.nan,
            "stick_slip_period": math.nan,
        }
        if peaks.size >= 2 and valleys.size and sticks:
            found |= {
                "stick_slip_peak": float(x[peaks].mean()) / reference,
                "stick_slip_valley": float(x[valleys].mean()) / reference,
                "stick_slip_period": float(np.diff(late.time[peaks]).mean()),
            }
        return found


BLOCK_SCALARS = (
    Quantity("peak_friction", "1", "largest spring force / load"),
    Quantity("apparent_friction", "1", "mean spring force / load"),
    Quantity("friction_reduction", "1", "mean spring force / friction at rest"),
    Quantity("smallest_normal_force", "1", "smallest normal force / load"),
    Quantity("largest_normal_force", "1", "largest normal force / load"),
    Quantity("penetration_vibration", "1", "standard deviation of the penetration / penetration at rest"),
    Quantity("tilt_vibration", "1", "standard deviation of the tilt, times half the length / penetration at rest"),
    Quantity("vibration_frequency", "Hz", "dominant frequency of the penetration"),
    Quantity("smallest_velocity", "m/s", "smallest velocity"),
    Quantity("largest_velocity", "m/s", "largest velocity"),
    Quantity("stick_slip_peak", "1", "displacement where slip begins / that under the friction at rest"),
    Quantity("stick_slip_valley", "1", "displacement where slip ends / that under the friction at rest"),
    Quantity("stick_slip_period", "s", "period of stick-slip"),
)
"""What a run of a sliding block comes to; those of stick-slip are NaN where there is none."""


def move_block(
    block: SlidingBlock,
    duration: float,
    *,
    start: Sequence[float] | None = None,
    smoothing_speed: float | None = None,
    samples: int | None = None,
    tolerance: float = TOLERANCE,
    disturbance: float = 0.0,
) -> BlockRun:
    """Motion of ``block`` over ``duration`` (s).

    Parameters
    ----------
    block
        The block.
    duration
        In s, > 0.
    start
        x, y (m), φ (rad) and their rates at the start; at rest with the spring unstretched if not
        given. The ``end`` of another motion goes on from there.
    smoothing_speed
        ε in m/s, >= 0: friction is v/sqrt(v² + ε²) times its largest value. A twentieth of the
        speed of the belt if not given. With 0 the base sticks and slips, with an event for each
        change: exact, and slower.
    samples
        Number of intervals in which the motion is given; ten a period of the normal vibration if
        not given.
    tolerance
        Local error of the integration, relative to the penetration at rest, the displacement under
        friction and the speed of the belt.
    disturbance
        Amplitude over the penetration at rest, >= 0, of a normal impulse that the block gets, as
        from roughness, half a period of its spring after it begins to slide; only with smoothed
        friction. Without it a block that was long at rest is as quiet as rounding lets it, and the
        integration, which takes long steps then, damps flutter before it begins.

    Returns
    -------
    BlockRun

    Raises
    ------
    InputError
        If a value is out of range.
    ConvergenceError
        If the integration fails.

    Notes
    -----
    Smoothed friction is stiff, at a rate of μN (1/M + h²/I)/ε, while the block oscillates freely in
    between: LSODA, which changes between implicit and explicit steps. It also damps: at small U/ε
    it can suppress flutter (compare with 0).
    """
    smoothing = (
        block.speed / 20.0
        if smoothing_speed is None
        else require.not_negative(smoothing_speed, "smoothing speed (m/s)")
    )
    require.between(tolerance, 0.0, 1e-2, "tolerance")
    if samples is None:
        samples = max(
            200, math.ceil(10.0 * require.positive(duration, "duration (s)") * block.normal_frequency / (2.0 * math.pi))
        )
    times = sample_times(duration, samples)
    solving = _Solving(block, smoothing, tolerance)
    state = np.zeros(8)
    first = (0.0, block.rest, 0.0, 0.0, 0.0, 0.0) if start is None else tuple(start)
    state[:6] = [require.finite(value, "start") for value in first[:6]] / solving.scales[:6]
    if smoothing == 0.0:
        return BlockRun(block, solving.sticking(times, state))
    smoothed = solving.smoothed(times, state, require.not_negative(disturbance, "disturbance"))
    return BlockRun(block, smoothed, smoothing)


@dataclass(frozen=True, eq=False)
class _Solving:
    """A block on its way through the integration."""

    block: SlidingBlock
    smoothing: float
    tolerance: float

    @cached_property
    def scales(self) -> RealArray:
        """What the parts of the state are divided by: else absolute tolerances mean nothing for
        amplitudes of 1e-7 m."""
        block = self.block
        y, U = block.rest, block.speed
        x = max(block.reference_displacement, U / block.normal_frequency)
        work = x * max(block.friction, 1e-3) * block.load
        return np.array([x, y, y / block.length, U, U, U / block.length, work, work])

    @cached_property
    def numbers(self) -> RealArray:
        """Of the block, as the compiled rates take them."""
        block, law = self.block, self.block.law
        m, ell, power = law.exponents
        found = np.empty(kernel.COUNT)
        found[: kernel.NORMAL] = [
            block.mass,
            block.inertia,
            0.5 * block.height,
            block.spring_height,
            block.stiffness,
            block.damping,
            block.load,
            block.speed,
            self.smoothing,
        ]
        found[kernel.NORMAL :] = [
            law.normal_coefficient,
            m,
            law.damping_coefficient,
            ell,
            law.friction_coefficient,
            power,
        ]
        return found

    def rates(self, state: RealArray, sign: float) -> RealArray:
        """d/dt of the scaled state."""
        found: RealArray = kernel.block_rates(state, self.scales, self.numbers, *self.block.base, sign)
        return found

    def smoothed(self, times: RealArray, state: RealArray, disturbance: float) -> Motion:
        """Motion with smoothed friction, disturbed once after the block has begun to slide."""
        block = self.block
        to_load = max(block.reference_displacement - float(state[0] * self.scales[0]), 0.0) / block.speed
        moment = to_load + math.pi * math.sqrt(block.mass / block.stiffness)
        place = int(np.searchsorted(times, moment))
        if disturbance == 0.0 or place >= times.size - 1:
            states, count = self._integrated(times, state)
            return self._motion(times, states, np.full(times.size, 2.0), (), count)
        before, first = self._integrated(times[: place + 1], state)
        struck = before[-1].copy()  # by an impulse, whose work is supplied from outside
        kick, rate = disturbance * block.rest * block.normal_frequency, float(struck[4] * self.scales[4])
        struck[4] += kick / self.scales[4]
        struck[6] += block.mass * kick * (rate + 0.5 * kick) / self.scales[6]
        after, second = self._integrated(times[place:], struck)
        events = (Event(float(times[place]), "disturbance"),)
        states = np.vstack([before[:-1], after])
        return self._motion(times, states, np.full(times.size, 2.0), events, first + second)

    def _integrated(self, times: RealArray, state: RealArray) -> tuple[RealArray, int]:
        """States at the ``times`` with smoothed friction, and the number of evaluations of the
        rates."""
        from scipy.integrate import odeint

        scales, numbers, (xi, area), rates = self.scales, self.numbers, self.block.base, kernel.block_rates
        count = 0

        def right_side(time: float, s: RealArray) -> RealArray:
            nonlocal count
            count += 1
            found: RealArray = rates(s, scales, numbers, xi, area, 2.0)
            return found

        states, info = odeint(
            right_side,
            state,
            times,
            tfirst=True,
            rtol=self.tolerance,
            atol=self.tolerance,
            mxstep=10_000_000,
            full_output=True,
        )
        if info["message"] != "Integration successful." or not np.isfinite(states).all():
            raise ConvergenceError(f"The motion of the block could not be integrated: {info['message']}")
        return states, count

    def sticking(self, times: RealArray, state: RealArray) -> Motion:
        """Motion with stick and slip as events."""
        phases = {name: self._phase(name, sign) for name, sign in SIGNS.items()}
        speed = self._sliding(state)
        first = "slip" if speed < 0.0 else "slip ahead" if speed > 0.0 else self._after_stop(state)
        course = integrated(phases, first, state, times, method="LSODA", tolerance=self.tolerance, scales=np.ones(8))
        signs = np.array([SIGNS[name] for name in course.phases])
        return self._motion(times, course.states, signs, course.events, course.evaluations)

    def _sliding(self, state: RealArray) -> float:
        """Velocity of the base over that of the belt, in units of the latter."""
        block, scales = self.block, self.scales
        base = state[3] * scales[3] + 0.5 * block.height * state[5] * scales[5]
        return float(base / block.speed - 1.0)

    def _interface(self, state: RealArray) -> tuple[float, float, float]:
        """Normal force, largest friction, and the friction under which the base sticks."""
        real = state[:6] * self.scales[:6]
        normal, moment, most, _ = kernel.interface_forces(*real[[1, 2, 4, 5]], self.numbers, *self.block.base)
        held = -self.block.stiffness * real[0] - self.block.damping * real[3]
        return normal, most, kernel.stick_force(moment, held, self.numbers)

    def _after_stop(self, state: RealArray) -> str:
        """Phase after the base has come to rest on the belt."""
        _, most, needed = self._interface(state)
        if abs(needed) <= most:
            return "stick"
        return "slip" if needed > 0.0 else "slip ahead"

    def _phase(self, name: str, sign: float) -> Phase:
        def rates(time: float, s: RealArray) -> RealArray:
            return self.rates(s, sign)

        longest = 0.5 / self.block.normal_frequency
        if name != "stick":
            stop = Guard(lambda time, s: self._sliding(s), -sign, "slip", lambda time, s: self._after_stop(s))
            return Phase(rates, (stop,), longest)

        def spare(time: float, s: RealArray, direction: float) -> float:
            _, most, needed = self._interface(s)
            return (most - direction * needed) / self.block.load

        behind = Guard(lambda time, s: spare(time, s, 1.0), -1.0, "slip", lambda time, s: "slip")
        ahead = Guard(lambda time, s: spare(time, s, -1.0), -1.0, "slip", lambda time, s: "slip ahead")
        return Phase(rates, (behind, ahead), longest, self._on_belt)

    def _on_belt(self, state: RealArray) -> RealArray:
        """``state`` whose base has exactly the speed of the belt."""
        state[3] -= self._sliding(state) * self.block.speed / self.scales[3]
        return state

    def _motion(self, times: RealArray, states: RealArray, signs: RealArray, events: tuple, count: int) -> Motion:  # type: ignore[type-arg]
        """The motion in SI units, with its forces and energies."""
        block, law, (xi, area) = self.block, self.block.law, self.block.base
        real = states * self.scales
        x, y, tilt, v, rate, tilt_rate, supplied, dissipated = real.T
        approach = y[:, None] - xi * tilt[:, None]
        pressure = law.pressure(approach, rate[:, None] - xi * tilt_rate[:, None])
        most = law.friction(approach) @ area
        sliding = v + 0.5 * block.height * tilt_rate - block.speed
        held = block.stiffness * x + block.damping * v
        if self.smoothing > 0.0:
            friction = -most * sliding / np.hypot(sliding, self.smoothing)
        else:
            needed = np.array([self._interface(state)[2] for state in states])
            friction = np.where(signs == 0.0, needed, -signs * most)
        values = {
            "displacement": x,
            "penetration": y,
            "tilt": tilt,
            "velocity": v,
            "penetration_rate": rate,
            "tilt_rate": tilt_rate,
            "sliding_speed": sliding,
            "normal_force": pressure @ area,
            "friction_force": friction,
            "spring_force": held,
            "kinetic_energy": 0.5 * (block.mass * (v**2 + rate**2) + block.inertia * tilt_rate**2),
            "elastic_energy": 0.5 * block.stiffness * x**2 + law.energy(approach) @ area - block.load * y,
            "supplied": supplied,
            "dissipated": dissipated,
        }
        return Motion(times, values, events, tuple(map(float, real[-1, :6])), count)


SIGNS = {"slip": -1.0, "stick": 0.0, "slip ahead": 1.0}
"""Sign of the sliding velocity in each phase."""
