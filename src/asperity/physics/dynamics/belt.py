"""A block on a belt, held by a spring: stick-slip with static and kinetic friction, and with
rate-and-state friction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Declared
from ...core.values import NonNegative, Number, Positive
from .motion import Guard, Motion, Phase, integrated, sample_times
from .normal_motion import TOLERANCE, Mass, started

SpringStiffness = Annotated[float, Number("N/m", above=0.0)]
BeltSpeed = Annotated[float, Number("speed", above=0.0)]


@dataclass(frozen=True)
class StaticKinetic(Declared):
    """Friction with a static coefficient, above which slip begins, and a kinetic one while it
    slips.

    Parameters
    ----------
    static, kinetic
        Coefficients, 0 <= kinetic <= static.

    Raises
    ------
    InputError
        If a coefficient is negative, or the kinetic one above the static one.
    """

    static: Annotated[NonNegative, "Static coefficient of friction."]
    kinetic: Annotated[NonNegative, "Kinetic coefficient of friction."]
    name: ClassVar[str] = "static and kinetic friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Oden1985",)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.kinetic > self.static:
            raise InputError(
                f"kinetic must be at most the static coefficient of friction, {self.static:g}, but is {self.kinetic!r}."
            )


@dataclass(frozen=True)
class RateState(Declared):
    """Rate-and-state friction: μ = μ_0 + a ln(V/V_0) + b ln(V_0 θ/D), θ the age of the contacts.

    Parameters
    ----------
    reference
        μ_0, > 0, at the speed V_0.
    direct
        a, > 0: growth of the friction at once with the speed.
    evolution
        b, >= 0: decay of the friction as the contacts are renewed; friction falls with the speed if
        it is above a.
    distance
        D in m, > 0: slip that renews the contacts.
    reference_speed
        V_0 in m/s, > 0.
    law
        "ageing": dθ/dt = 1 - Vθ/D (Dieterich 1979), or "slip": dθ/dt = -(Vθ/D) ln(Vθ/D) (Ruina
        1983).

    Raises
    ------
    InputError
        If a parameter is out of its range.
    """

    reference: Annotated[Positive, "Coefficient of friction at the reference speed."]
    direct: Annotated[Positive, "Direct effect a."]
    evolution: Annotated[NonNegative, "Evolution effect b."]
    distance: Annotated[float, Number("length", above=0.0), "Slip that renews the contacts."]
    reference_speed: Annotated[BeltSpeed, "Reference speed."] = 1e-6
    law: Annotated[Literal["ageing", "slip"], "How the contacts are renewed."] = "ageing"
    name: ClassVar[str] = "rate-and-state friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Dieterich1979", "Ruina1983", "RiceRuina1983")

    def coefficient(self, log_speed: RealArray | float, log_age: RealArray | float) -> RealArray | float:
        """μ for ln(V/V_0) and ln(V_0 θ/D)."""
        return self.reference + self.direct * log_speed + self.evolution * log_age

    def steady(self, speed: float) -> float:
        """Coefficient of steady sliding at ``speed`` > 0 in m/s: μ_0 + (a - b) ln(V/V_0)."""
        return self.reference + (self.direct - self.evolution) * math.log(
            require.positive(speed, "speed (m/s)") / self.reference_speed
        )


BeltFriction: TypeAlias = StaticKinetic | RateState


LONGEST, SHORTEST = 0.3, 0.003
"""Bounds in rad of the longest step of a slip; a lead of the block on the belt that is shorter than
the second is lost."""


@dataclass(frozen=True)
class BeltOscillator(Declared):
    """Block of mass M, pressed with N on a belt of speed U, and held by a spring k and a dashpot c:
    M d²x/dt² = -k x - c dx/dt + T.

    Parameters
    ----------
    friction
        ``StaticKinetic`` or ``RateState``.
    mass
        M in kg, > 0.
    stiffness
        k in N/m, > 0.
    normal_force
        N in N, > 0.
    speed
        U in m/s, > 0.
    damping
        c in N s/m, >= 0.

    Raises
    ------
    InputError
        If a parameter is out of its range.
    """

    friction: BeltFriction
    mass: Annotated[Mass, "Mass."]
    stiffness: Annotated[SpringStiffness, "Stiffness of the spring that holds the block."]
    normal_force: Annotated[float, Number("force", above=0.0), "Normal force."]
    speed: Annotated[BeltSpeed, "Speed of the belt."]
    damping: Annotated[NonNegative, "Dashpot beside the spring, in N s/m."] = 0.0
    name: ClassVar[str] = "block on a belt"

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.friction, StaticKinetic | RateState):
            raise InputError(f"friction must be StaticKinetic(…) or RateState(…), but is {self.friction!r}.")

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the friction."""
        return self.friction.citation_keys

    @property
    def natural_frequency(self) -> float:
        """sqrt(k/M) in rad/s."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def growth_rate(self) -> float:
        """Largest real part in 1/s of the eigenvalues about steady sliding; unstable where it is
        above zero.

        With static and kinetic friction that is -c/2M: steady sliding is stable to small
        disturbances, and only a start from rest, or a large disturbance, leads to stick-slip.
        """
        k, c, M, N, U = self.stiffness, self.damping, self.mass, self.normal_force, self.speed
        law = self.friction
        if isinstance(law, StaticKinetic):
            return float(np.real(np.linalg.eigvals(np.array([[0.0, 1.0], [-k / M, -c / M]]))).max())
        # states: displacement, ln of the sliding speed V = U - dx/dt, ln of the age; both laws of
        # renewal are alike about steady sliding
        rate = U / law.distance
        jacobian = np.array(
            [
                [0.0, -U, 0.0],
                [k / (M * U), -c / M - N * law.direct / (M * U), -N * law.evolution / (M * U)],
                [0.0, -rate, -rate],
            ]
        )
        return float(np.real(np.linalg.eigvals(jacobian)).max())

    @property
    def steady_displacement(self) -> float:
        """Displacement in steady sliding, in m."""
        law = self.friction
        mu = law.kinetic if isinstance(law, StaticKinetic) else law.steady(self.speed)
        return mu * self.normal_force / self.stiffness

    def move(
        self,
        duration: float,
        *,
        start: Sequence[float] | None = None,
        samples: int = 2000,
        tolerance: float = TOLERANCE,
    ) -> Motion:
        """Motion over ``duration`` (s).

        Parameters
        ----------
        duration
            In s, > 0.
        start
            With static and kinetic friction displacement (m) and velocity (m/s); with
            rate-and-state friction displacement, velocity below the speed of the belt, and age of
            the contacts (s). If not given: on the belt with the spring unstretched, or sliding
            steadily but for 1 % in the age. The ``end`` of another motion goes on from there.
        samples
            Number of intervals in which the motion is given.
        tolerance
            Local error of the integration.

        Returns
        -------
        Motion
            With the events "stick" and "slip" under static and kinetic friction.

        Raises
        ------
        InputError
            If a value is out of range.
        ConvergenceError
            If the integration fails.

        Notes
        -----
        Stick and slip are phases that end where the friction needed exceeds the static one, and
        where the sliding speed reaches zero. Rate-and-state friction is stiff; it is integrated in
        the logarithms of sliding speed and age by the implicit Radau method.
        """
        times = sample_times(duration, samples)
        require.between(tolerance, 0.0, 1e-2, "tolerance")
        if isinstance(self.friction, StaticKinetic):
            return self._stick_slip(self.friction, times, (0.0, self.speed) if start is None else start, tolerance)
        # states: displacement, ln(V/V_0) of the sliding speed V, ln(V_0 θ/D), work of the belt,
        # heat
        law = self.friction
        U, V0, D, N, M, c = (
            self.speed,
            law.reference_speed,
            law.distance,
            self.normal_force,
            self.mass,
            self.damping,
        )
        x0, v0, age = (self.steady_displacement, 0.0, 1.01 * D / U) if start is None else start
        sliding = U - require.finite(v0, "velocity at the start (m/s)")
        if sliding <= 0.0 or require.positive(age, "age of the contacts at the start (s)") <= 0.0:
            raise InputError(
                f"velocity at the start must be below the speed of the belt, {U:g} m/s, but is {v0:g} m/s."
            )
        ageing = law.law == "ageing"

        def rates(time: float, s: RealArray) -> RealArray:
            x, log_speed, log_age = float(s[0]), float(s[1]), float(s[2])
            V = V0 * math.exp(log_speed)
            v, friction = U - V, N * float(law.coefficient(log_speed, log_age))
            worn = V / D  # rate of renewal
            aged = V0 / D * math.exp(-log_age) - worn if ageing else -worn * (log_speed + log_age)
            pushed = (self._held(x, v) - friction) / (M * V)
            return np.array([v, pushed, aged, friction * U, friction * V + c * v * v])

        reach = max(abs(self.steady_displacement), D)
        heat = N * law.reference * reach
        course = integrated(
            {"slip": Phase(rates)},
            "slip",
            [x0, math.log(sliding / V0), math.log(V0 * age / D), 0.0, 0.0],
            times,
            method="Radau",
            tolerance=tolerance,
            scales=np.array([1e-3 * reach, 1.0, 1.0, heat, heat]),
        )
        x, log_speed, log_age = course.states[:, 0], course.states[:, 1], course.states[:, 2]
        v = U - V0 * np.exp(log_speed)
        states = np.column_stack([x, v, course.states[:, 3:]])
        friction = N * np.asarray(law.coefficient(log_speed, log_age))
        values = self._values(states, friction) | {"contact_time": D / V0 * np.exp(log_age)}
        end = (float(x[-1]), float(v[-1]), float(values["contact_time"][-1]))
        return Motion(times, values, course.events, end, course.evaluations)

    def _held(self, x: float, v: float) -> float:
        """Force in N of spring and dashpot against the motion of the block."""
        return self.stiffness * x + self.damping * v

    # States: displacement, velocity, work of the belt, heat.

    def _stick_slip(self, law: StaticKinetic, times: RealArray, start: Sequence[float], tolerance: float) -> Motion:
        """Phases stick, and slip behind and ahead of the belt."""
        x0, v0 = started(start)
        bound, kinetic = law.static * self.normal_force, law.kinetic * self.normal_force
        U, M, c = self.speed, self.mass, self.damping
        # the block is ahead of the belt for this long at the end of a slip; a step across it would
        # miss that it sticks
        lead = 2.0 * math.atan((bound - kinetic) / self.stiffness * self.natural_frequency / U)
        longest = min(max(0.25 * lead, SHORTEST), LONGEST) / self.natural_frequency

        def slides(friction: float) -> Phase:
            def rates(time: float, s: RealArray) -> RealArray:
                x, v = float(s[0]), float(s[1])
                return np.array([v, (friction - self._held(x, v)) / M, friction * U, friction * (U - v) + c * v * v])

            stop = Guard(
                lambda time, s: U - float(s[1]),
                -math.copysign(1.0, friction),
                "slip",
                lambda time, s: self._after_stop(float(s[0]), bound),
            )
            return Phase(rates, (stop,), longest)

        def sticks(time: float, s: RealArray) -> RealArray:
            return np.array([U, 0.0, self._held(float(s[0]), U) * U, c * U * U])

        def with_belt(state: RealArray) -> RealArray:
            state[1] = U
            return state

        behind = Guard(lambda time, s: self._held(float(s[0]), U) - bound, 1.0, "slip", lambda time, s: "slip")
        ahead = Guard(lambda time, s: self._held(float(s[0]), U) + bound, -1.0, "slip", lambda time, s: "slip ahead")
        phases = {
            "stick": Phase(sticks, (behind, ahead), on_entry=with_belt),
            "slip": slides(kinetic),
            "slip ahead": slides(-kinetic),
        }
        first = "slip" if v0 < self.speed else "slip ahead" if v0 > self.speed else self._after_stop(x0, bound)
        reach = max(bound / self.stiffness, abs(x0), self.speed / self.natural_frequency)
        swift = max(self.speed, reach * self.natural_frequency)
        scales = np.array([reach, swift, bound * reach, bound * reach])
        course = integrated(
            phases, first, [x0, v0, 0.0, 0.0], times, method="DOP853", tolerance=tolerance, scales=scales
        )
        x, v = course.states[:, 0], course.states[:, 1]
        named = np.array(course.phases)
        friction = np.where(
            named == "stick", self.stiffness * x + self.damping * v, np.where(named == "slip", kinetic, -kinetic)
        )
        values = self._values(course.states, friction)
        return Motion(times, values, course.events, (float(x[-1]), float(v[-1])), course.evaluations)

    def _after_stop(self, x: float, bound: float) -> str:
        """Phase after the block has come to rest on the belt."""
        needed = self._held(x, self.speed)
        if abs(needed) <= bound:
            return "stick"
        return "slip" if needed > 0.0 else "slip ahead"

    def _values(self, states: RealArray, friction: RealArray) -> dict[str, RealArray]:
        x, v, supplied, dissipated = states.T
        return {
            "displacement": x,
            "velocity": v,
            "sliding_speed": v - self.speed,
            "friction_force": friction,
            "spring_force": self.stiffness * x + self.damping * v,
            "kinetic_energy": 0.5 * self.mass * v**2,
            "elastic_energy": 0.5 * self.stiffness * x**2,
            "supplied": supplied,
            "dissipated": dissipated,
        }
