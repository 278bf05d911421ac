"""The one fixed-point iteration between the normal contact and the couplings of a problem,
extrapolated (Anderson 1965)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Any

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.status import NoProgress, Outcome, Progress, Status
from ..controls import Approach
from ..solvers.active_set.solver import ActiveSet, Loaded
from ..solvers.protocol import (
    Constraint,
    ContactQP,
    FixedMean,
    FixedOffset,
    Solution,
    Solver,
    SolverState,
    error_for_pressure,
    run,
)
from .position import Position, without_bracket
from .protocol import Contact, Coupling, Exchange, Foreseeing, Memory, Posed

REMEMBERED = 3
"""Rounds before the last that an extrapolation uses. Three take as few rounds as six (sliding,
layered hardness)."""

_RCOND = 1e-8


@dataclass
class Mixing:
    """The last unknowns and steps, each of them a tuple with one array for every coupling."""

    places: list[tuple[RealArray, ...]] = field(default_factory=list)
    moves: list[tuple[RealArray, ...]] = field(default_factory=list)

    def ahead(
        self, place: tuple[RealArray, ...], move: tuple[RealArray, ...], scales: tuple[float, ...]
    ) -> tuple[RealArray, ...]:
        """Where the iteration that steps from ``place`` by ``move`` would come to rest if it were
        linear.

        ``scales`` are the sizes of a step of each unknown by which steps are compared.
        """
        self.places = [*self.places[-REMEMBERED:], place]
        self.moves = [*self.moves[-REMEMBERED:], move]
        used = min(len(self.places) - 1, sum(part.size for part in place))
        if used == 0:
            return tuple(at + by for at, by in zip(place, move, strict=True))

        def scaled(parts: tuple[RealArray, ...]) -> RealArray:
            return np.concatenate([np.ravel(part) / scale for part, scale in zip(parts, scales, strict=True)])

        latest = scaled(move)
        changes = np.stack([latest - scaled(earlier) for earlier in self.moves[-1 - used : -1]], axis=1)
        weights, *_ = np.linalg.lstsq(changes, latest, rcond=_RCOND)
        found = []
        for number, (at, by) in enumerate(zip(place, move, strict=True)):
            total = at + by
            for weight, x, f in zip(weights, self.places[-1 - used : -1], self.moves[-1 - used : -1], strict=True):
                total = total - weight * (at + by - x[number] - f[number])
            found.append(total)
        return tuple(found)

    def forget(self) -> None:
        """Begin anew: earlier rounds do not show where the iteration leads."""
        self.places.clear()
        self.moves.clear()


_LOOSEST = 1e-3
"""Error of the first normal solve where more will follow."""

_FINER = 0.01
"""Error of the last normal solve over the largest at which a reply still means something."""

_SHARE = 0.01
"""Error of a normal solve over the square of the largest residual: the error of the pressure goes
with its root, so that it is a tenth of the residual."""

_NEAR = 3.0
"""Largest residual over tolerance at which the next solve is the last if the estimate holds."""

_PROGRESS = 0.95
"""Share of the smallest residual so far below which one counts as progress."""

_FARTHEST = 2.0
"""Largest ratio of a step of load to the one before at which pressures are extrapolated."""

_SLOWEST = 0.99

_TIGHTER = 0.03
"""Factor to the error of the next solve for every round without progress: contacts of thin films
differ by little energy. The search for a position alone has a bracket instead, and rounding may not
allow every load to be solved that finely."""

_RESCUES = 1000
"""Changes of couplings at most for a load that they cannot bear; each halves a distance, so that
some tens suffice."""

_INNER = 0.01
"""Miss of a position over the residual of the others at which, when nested, these move again."""

_JOINT_PATIENCE = 12
"""Rounds without progress after which a position is searched for around the other couplings instead
of together with them."""


@dataclass(frozen=True)
class Rounds:
    """When the iteration between the contact and its couplings ends.

    Parameters
    ----------
    most
        Largest number of rounds, each one normal solve.
    patience
        Rounds without progress after which it counts as stagnated.
    tolerances
        Residuals by name of a coupling at which it is settled, in place of its own: ``menisci``
        force by which contact, load and menisci miss their balance over that of the contact (1e-4),
        ``sliding`` relative change of the displacement by shear (1e-6), ``hardness`` relative
        change of the hardness (1e-5), ``fluid`` change of the pressure of a fluid over the traction
        (1e-6).

    Raises
    ------
    InputError
        If a number is out of range.
    """

    most: int = 1000
    patience: int = 40
    tolerances: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        require.integer(self.most, 1, "number of rounds")
        require.integer(self.patience, 1, "number of rounds without progress")
        for name, value in self.tolerances.items():
            require.positive(value, f"tolerance of {name}")


@dataclass(frozen=True)
class CouplingCheck:
    """How well one coupling agrees with the contact.

    Attributes
    ----------
    name
        The coupling.
    residual
        Target of the last contact less what it was posed with, relative.
    rate
        Factor by which the residual fell from round to round, on average of the last three; zero if
        it was one round.
    tolerance
        Residual at which it counts as settled.
    """

    name: str
    residual: float
    rate: float
    tolerance: float

    @property
    def distance(self) -> float:
        """residual/(1 - rate): estimate of the relative distance from the balance, by the geometric
        series of further rounds."""
        return self.residual / (1.0 - self.rate)


@dataclass(frozen=True, eq=False)
class Settled:
    """The last contact with the work of all rounds, what each coupling carries, how it ended."""

    contact: Contact
    exchanges: Mapping[str, Exchange]
    checks: tuple[CouplingCheck, ...]
    rounds: int
    tolerance: float
    status: Status


def settle(
    posed: Posed,
    couplings: Sequence[Coupling],
    memories: Mapping[str, Memory],
    solver: Solver,
    *,
    rounds: Rounds = Rounds(),
    progress: Progress | None = None,
) -> Settled:
    """Contact that agrees with all ``couplings`` (each with a name of its own, in any order), with
    their ``memories`` of the step before.

    The tolerance of ``solver`` is that of the last normal solve; those before are looser.

    Raises
    ------
    NoSolutionError
        If the load cannot be borne, runs away, or the position has no solution.
    """
    return _Iteration(posed, couplings, memories, solver, rounds, progress or NoProgress()).settled()


class _Iteration:
    """Rounds of one step."""

    def __init__(
        self,
        posed: Posed,
        couplings: Sequence[Coupling],
        memories: Mapping[str, Memory],
        solver: Solver,
        rounds: Rounds,
        progress: Progress,
    ) -> None:
        self.posed, self.solver, self.rounds = posed, solver, rounds
        self.couplings = {coupling.name: coupling for coupling in couplings}
        self.exchanges = {name: c.begin(posed, memories.get(name, {})) for name, c in self.couplings.items()}
        # as the solver can hold it
        by_offset = posed.held or (isinstance(posed.control, Approach) and not posed.operator.zero_mean_mode)
        if posed.external_force is None and not by_offset and not any(coupling.positions for coupling in couplings):
            alone = not any(coupling.feedback for coupling in couplings)
            caps = [coupling.share(self.exchanges[name]).cap for name, coupling in self.couplings.items()]
            elastic = all(isinstance(cap, float) and cap == np.inf for cap in caps)
            position = Position(alone, elastic, solver.tolerance)
            self.couplings[position.name], self.exchanges[position.name] = position, position.begin(posed, {})
        self.active = [name for name, coupling in self.couplings.items() if coupling.feedback]
        self.reached, self.for_pressure = 0.0, np.inf
        self._need()
        self.pressures = [p for p in (posed.earlier, posed.start) if p is not None and p.any()]
        self.residuals: dict[str, list[float]] = {name: [] for name in self.active}
        self.mixing, self.directions = Mixing(), dict[str, float]()
        self.watched = _Told(progress, self.finest, lone=not self.active)
        self.last: Contact | None = None
        self.memories, self.nested = memories, False
        self.indentation: RealArray | float = 0.0
        self.attraction: RealArray | float = 0.0
        self.spent = 0, 0.0
        self.foreseen: Loaded | None = None

    def settled(self) -> Settled:
        """Rounds until all couplings are settled by a solve to the full tolerance, or it must be
        given up."""
        tolerance, lowest, progressed = self._next_tolerance(np.inf, self.active), np.inf, 0
        status: Status | None = None
        joint = Position.name in self.active and len(self.active) > 1  # the position is one of several unknowns
        if self._foreseen():
            tolerance = self.finest
        for count in range(1, self.rounds.most + 1):
            tolerance = self.finest if count == self.rounds.most else tolerance
            contact = self._solved(self._posed(), tolerance)
            if not contact.solution.status.converged:
                status = contact.solution.status
                break
            moves = self._reply(contact)
            if tolerance <= self.finest:
                state, asked = contact.solution.state, self.solver.tolerance
                wanted = error_for_pressure(contact.qp, state, contact.totals, asked)
                self.for_pressure = min(self.for_pressure, wanted)
            self._need()
            concerned = [name for name in self.active if not self.nested or (name == Position.name) == moves]
            worst = max((self._ratio(name) for name in concerned), default=0.0)
            self.watched.round(worst)
            if worst <= 1.0:
                if tolerance <= self.finest:
                    rounds = f"after {count} {'rounds' if count > 1 else 'round'}."
                    settled = [self.couplings[name].settled(self.exchanges[name]) for name in self.active]
                    message = contact.solution.status.message
                    message = " ".join([message, *(f"{text} {rounds}" for text in settled)])
                    status = Status(Outcome.CONVERGED, message)
                    break
                tolerance = self.finest
                continue
            if self.nested and moves:
                progressed += 1  # a search along one bracket, which comes to an end
                if self.exchanges[Position.name].stuck:
                    break
            elif worst < _PROGRESS * lowest or self._goes_on():
                lowest, progressed = min(worst, lowest), count
            elif count - progressed >= self.rounds.patience or any(self.exchanges[name].stuck for name in concerned):
                break
            elif count - progressed >= _JOINT_PATIENCE and not self.nested and joint:
                lowest, progressed, moves = np.inf, count, True
                self._nest()
            idle = 0 if self.active == [Position.name] else count - progressed
            tolerance = max(self.finest, self._next_tolerance(worst, concerned) * _TIGHTER**idle)
            self._advance(moves)
        if status is None:
            farthest = max(self.active, key=self._ratio)
            coupling, stagnated = self.couplings[farthest], count < self.rounds.most
            message = f"{coupling.unsettled(self.exchanges[farthest])} after {count} rounds."
            status = Status(Outcome.STAGNATED if stagnated else Outcome.ITERATION_LIMIT, message, coupling.remedy)
        checks = []
        for name in self.active:
            rate = min(self._rate(name), _SLOWEST) if count > 1 else 0.0
            checks.append(CouplingCheck(name, self.exchanges[name].residual, rate, self.exchanges[name].tolerance))
        return Settled(contact, self.exchanges, tuple(checks), count, self.finest, status)

    def _foreseen(self) -> bool:
        """Whether a coupling that feeds back alone finds the contact by a method of its own, from
        which rounds then start."""
        alone = self.couplings[self.active[0]] if len(self.active) == 1 else None
        if not isinstance(alone, Foreseeing):
            return False
        qp = self._posed()
        found = alone.ahead(self.exchanges[alone.name], qp, self._start(qp), self._to(self.finest), self.watched)
        self.spent = found.iterations, found.pairs
        if found.exchange is None:
            return False
        self.exchanges[alone.name] = found.exchange
        if found.exchange.pressure is not None and found.deflection is not None:
            self.foreseen = Loaded(found.exchange.pressure, found.deflection)
        return True

    def _reply(self, contact: Contact) -> bool:
        """Replies of the couplings to ``contact``; whether the position moves, for which when
        nested all others wait."""
        exchanges, moves = self.exchanges, Position.name in self.couplings
        if moves:
            exchanges[Position.name] = self.couplings[Position.name].reply(exchanges[Position.name], contact)
            if self.nested:
                others = max(self.exchanges[name].residual for name in self.active if name != Position.name)
                moves = exchanges[Position.name].residual > max(exchanges[Position.name].tolerance, _INNER * others)
        waiting = [] if not self.nested or not moves else [name for name in self.couplings if name != Position.name]
        for name, coupling in self.couplings.items():
            if name != Position.name and name not in waiting:
                exchanges[name] = coupling.reply(exchanges[name], contact)
        for name in (name for name in self.active if name not in waiting):
            exchange, found = exchanges[name], self.residuals[name]
            if exchange.smooth or not exchange.settled or (found and found[-1] > exchange.tolerance):
                found.append(exchange.residual)
        return moves

    def _need(self) -> None:
        """The largest and the smallest error of the normal solves that the couplings allow."""
        needed = min(exchange.accuracy for exchange in self.exchanges.values())
        final = min(exchange.final for exchange in self.exchanges.values())
        self.loosest = min(_LOOSEST, needed)
        finest = min(self.solver.tolerance, _FINER * needed, final, self.for_pressure)
        self.finest = max(finest, self.reached)

    def _nest(self) -> None:
        """From now on search for the position anew whenever the others have moved.

        Joint rounds take a third of the solves, but near full contact of yielding surfaces they may
        not come to rest. What is not smooth starts again from the interface before the step, to
        which loads on the way may have been too large.
        """
        position = self.couplings[Position.name]
        assert isinstance(position, Position)
        self.couplings[Position.name], self.nested = replace(position, alone=True, nested=True), True
        self.exchanges[Position.name] = without_bracket(self.exchanges[Position.name])
        self.mixing.forget()
        for name, exchange in self.exchanges.items():
            if not exchange.smooth:
                self.exchanges[name] = self.couplings[name].begin(self.posed, self.memories.get(name, {}))

    def _posed(self) -> ContactQP:
        """Discrete problem with the shares of all couplings; those that cannot bear the load are
        raised."""
        posed, external = self.posed, self.posed.external_force
        for _ in range(_RESCUES):
            shares = [coupling.share(self.exchanges[name]) for name, coupling in self.couplings.items()]
            profile, self.indentation = posed.profile, sum(share.indentation for share in shares)
            cap: float | RealArray = np.inf
            self.attraction = sum(share.attraction for share in shares)
            for lift in (*(share.lift for share in shares), self.indentation):
                if isinstance(lift, np.ndarray):
                    profile = profile - lift
            for share in shares:
                unlimited = isinstance(cap, float) and cap == np.inf
                cap = share.cap if unlimited else np.minimum(cap, share.cap)
            given = [share.constraint for share in shares if share.constraint is not None]
            constraint: Constraint
            if given:
                constraint = given[0]
            elif external is None and Position.name in self.exchanges:
                constraint = FixedMean(float(np.exp(self.exchanges[Position.name].x)))
            elif external is None:
                constraint = FixedOffset(posed.top - posed.control.value)
            else:
                mean = (external + sum(share.load for share in shares)) / posed.operator.grid.area
                # without any load the bodies touch at the highest point
                constraint = FixedMean(mean) if mean > 0.0 else FixedOffset(float(profile.max()))
            if isinstance(constraint, FixedOffset):
                return ContactQP(posed.operator, profile, cap, constraint, posed.height_scale)
            if isinstance(cap, float) and cap >= constraint.mean_pressure * profile.size:
                cap = np.inf  # no point bears more than the whole load; a huge limit would hide the error in rounding
            if constraint.mean_pressure <= float(np.mean(cap)):
                return ContactQP(posed.operator, profile, cap, constraint, posed.height_scale)
            self._rescue(constraint.mean_pressure, float(np.mean(cap)))
        raise NoSolutionError("hardness and load must agree, but do not. Lower the load or raise the hardness.")

    def _rescue(self, mean: float, bearable: float) -> None:
        """Ask the couplings to bear ``mean`` (Pa), first those that limit the pressure.

        Raises
        ------
        NoSolutionError
            If none can.
        """
        self.mixing.forget()
        for name in sorted(self.couplings, key=lambda name: name == Position.name):
            if Position.name in self.couplings and not self.exchanges[name].smooth:
                continue  # a hardness that has fallen is not to rise again: the load falls
            rescued = self.couplings[name].rescued(self.exchanges[name], mean)
            if rescued is not None:
                self.exchanges[name] = rescued
                if name == Position.name and not self.nested and len(self.active) > 1:
                    self._nest()
                return
        error = NoSolutionError(
            f"mean pressure must be at most the mean hardness {bearable:.6g} Pa (force: hardness times nominal area), "
            f"but is {mean:.6g} Pa. Lower the load or raise the hardness."
        )
        for name, coupling in self.couplings.items():
            explained = coupling.unbearable(self.exchanges[name], error)
            if explained is not None:
                raise explained from error
        raise error

    def _solved(self, qp: ContactQP, tolerance: float) -> Contact:
        """Contact of ``qp`` started from the last pressures."""
        if isinstance(qp.constraint, FixedOffset) and float(qp.resident_profile.max()) <= qp.constraint.offset:
            none = np.zeros_like(qp.profile)
            status = Status(Outcome.CONVERGED, "Unloaded: nothing to solve.")
            solution = Solution(SolverState(none, none, 0.0), status, (0.0,))
        else:
            solver, begun = self._to(tolerance), None
            posed = self.posed
            before = [pressure for pressure in (posed.start, posed.earlier) if pressure is not None]
            if isinstance(solver, ActiveSet) and self.last is None and not self.active:
                known = [None if posed.deflections is None else posed.deflections.by(p, qp.operator) for p in before]
                loads = [Loaded(*load) for load in zip(before, known, strict=True)]
                ratio = None if isinstance(posed.retarded, np.ndarray) else self._ahead(qp)
                if len(loads) == 2 and ratio is not None:
                    begun = solver.extrapolated(qp, loads[0], loads[1], ratio)  # with its deflection
                elif posed.deflections is not None and posed.deflections.within and len(loads) == 1:
                    begun = solver.resumed(qp, loads[0])
            elif isinstance(solver, ActiveSet) and self.foreseen is not None:
                begun, self.foreseen = solver.resumed(qp, self.foreseen), None
            solution = run(solver, qp, None if begun is not None else self._start(qp), self.watched, begun)
            error, asked = solution.state.error, self.solver.tolerance
            if solution.status.outcome is Outcome.STAGNATED and tolerance < error <= asked:
                # rounding keeps it from a tolerance below that of the solver, which couplings ask
                # for: a strong attraction of short range is many times the pressure without it.
                # Whether the error is small enough then the couplings say by their residuals
                self.reached = error
                text = (
                    f"Converged: relative error {error:.2e} by {self.solver.name}, as far as the "
                    f"arithmetic reaches, tolerance {asked:.0e}."
                )
                solution = replace(solution, status=Status(Outcome.CONVERGED, text))
        contact = Contact(self.posed, qp, solution, self.indentation, self.attraction)
        contact, self.spent = contact.with_work_of(self.last, *self.spent), (0, 0.0)
        if contact.pressure.any():
            self.pressures = [*self.pressures[-1:], contact.pressure]
        self.last = contact
        return contact

    def _to(self, tolerance: float) -> Solver:
        """The solver, to this ``tolerance`` where it can be set."""
        solver = self.solver
        if solver.tolerance == tolerance or not is_dataclass(solver):
            return solver
        settable: Any = {item.name for item in fields(solver) if item.init}
        return replace(solver, tolerance=tolerance) if "tolerance" in settable else solver

    def _start(self, qp: ContactQP) -> RealArray | None:
        """Pressure that a coupling knows, else the last one, extrapolated in the load where that
        goes on in one direction.

        Measured on self-affine surfaces, 20 steps: about a sixth fewer FFT pairs than from the last
        pressure itself. Points at their cap go along with it: below a cap that has risen a little
        all would be free, and have to be found to yield again.
        """
        known = next((e.pressure for e in self.exchanges.values() if e.pressure is not None), None)
        if known is not None:
            return known
        if not self.pressures:
            return None
        latest, last = self.pressures[-1], self.last
        caps = qp.cap, None if last is None else last.qp.cap
        if last is not None and last.pressure is latest and all(isinstance(cap, np.ndarray) for cap in caps):
            return np.where((latest > 0.0) & (latest >= last.qp.cap), qp.cap, latest)
        ratio = self._ahead(qp)
        if ratio is None:
            return latest
        return np.clip(latest + ratio * (latest - self.pressures[-2]), 0.0, qp.cap)

    def _ahead(self, qp: ContactQP) -> float | None:
        """Step to the load of ``qp``, or in time, over that between the last two, where it goes on
        in one direction."""
        if len(self.pressures) >= 2 and self.posed.ahead is not None and self.last is None:
            return min(self.posed.ahead, _FARTHEST)
        if len(self.pressures) < 2 or not isinstance(qp.constraint, FixedMean):
            return None
        before, latest = self.pressures[-2:]
        mean = float(latest.mean(dtype=np.float64))
        step = mean - float(before.mean(dtype=np.float64))
        ratio = (qp.constraint.mean_pressure - mean) / step if abs(step) > 1e-12 * mean else 0.0
        return ratio if 0.0 < ratio <= _FARTHEST else None

    def _goes_on(self) -> bool:
        """Whether an unknown that is not smooth still moves and has never turned back: it is
        bounded, and so comes to rest."""
        on = False
        for name, exchange in self.exchanges.items():
            if exchange.smooth:
                continue
            step = float((exchange.target - exchange.x).sum())
            self.directions.setdefault(name, step)
            if step * self.directions[name] < 0.0:
                self.directions[name] = 0.0
            on = on or (step * self.directions[name] > 0.0 and not exchange.settled)
        return on

    def _ratio(self, name: str) -> float:
        exchange = self.exchanges[name]
        return 0.0 if exchange.settled else max(exchange.residual / (exchange.tolerance or np.inf), 1.0 + 1e-9)

    def _next_tolerance(self, worst: float, names: Sequence[str]) -> float:
        """Error of the next solve that is small against the residuals of ``names`` then expected,
        if they go on falling as they do."""
        if not self.active or any(exchange.exact for exchange in self.exchanges.values()):
            return self.finest
        rates = {name: max(self._rate(name), self.exchanges[name].slowest) for name in names}
        expected = 0.0
        for name, rate in rates.items():
            if not self.exchanges[name].settled:
                expected = max(expected, self.exchanges[name].residual * max(min(rate, 1.0), 0.1))
        near = worst < np.inf and worst * max(rates.values()) <= _NEAR
        return self.finest if near else max(self.finest, min(self.loosest, _SHARE * expected**2))

    def _rate(self, name: str) -> float:
        """Factor by which the residual falls from round to round."""
        found = [value for value in self.residuals[name][-4:] if 0.0 < value < np.inf]
        if len(found) < 2:
            return 0.0 if len(self.residuals[name]) < 2 else 1.0
        return float((found[-1] / found[0]) ** (1.0 / (len(found) - 1)))

    def _advance(self, moves: bool) -> None:
        """Next unknowns: targets, extrapolated together where they are smooth; settled ones that
        are not stay.

        When nested either the position ``moves``, along its secant, or all others do.
        """
        active = [name for name in self.active if not self.nested or (name == Position.name) == moves]
        known = [name for name in active if self.exchanges[name].pressure is not None]
        if known:
            self.mixing.forget()  # rounds before a contact that is known do not lead to it
        smooth = [name for name in active if self.exchanges[name].smooth and not (self.nested and moves)]
        smooth = [name for name in smooth if name not in known]
        moved = {name: self.exchanges[name].target for name in active}
        if smooth:
            at = tuple(self.exchanges[name].x for name in smooth)
            move = tuple(self.exchanges[name].target - x for name, x in zip(smooth, at, strict=True))
            scales = tuple(self.exchanges[name].scale for name in smooth)
            if self.mixing.places and len(self.mixing.places[-1]) != len(smooth):
                self.mixing.forget()  # one of them has turned out not to be smooth
            moved |= dict(zip(smooth, self.mixing.ahead(at, move, scales), strict=True))
        if self.nested and not moves:
            self.exchanges[Position.name] = without_bracket(self.exchanges[Position.name])
        for name, x in moved.items():
            exchange = self.exchanges[name]
            if exchange.smooth or not exchange.settled:
                self.exchanges[name] = replace(exchange, x=np.clip(x, exchange.lowest, exchange.highest))


class _Told:
    """Progress of all rounds together: one count of iterations, and an error that ends at the
    tolerance of the solver."""

    def __init__(self, progress: Progress, tolerance: float, *, lone: bool) -> None:
        self._progress, self._tolerance, self._lone = progress, tolerance, lone
        self._before, self._latest, self._worst = 0, 0, np.inf

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """An iteration of a round."""
        self._latest = iteration
        shown = error if self._lone else max(error, min(self._worst * self._tolerance, 1.0))
        self._progress.update(self._before + iteration, shown, self._tolerance)

    def round(self, worst: float) -> None:
        """The end of a round, with the largest residual over its tolerance."""
        self._before, self._latest, self._worst = self._before + self._latest, 0, worst
        if not self._lone:
            self._progress.update(self._before, min(worst * self._tolerance, 1.0), self._tolerance)
