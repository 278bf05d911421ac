"""Contacts that wear in gross sliding: implicit steps of the sliding distance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, NamedTuple

import numpy as np

from ...contact.controls import Control, Step
from ...contact.couplings.protocol import Deflections
from ...contact.operators import Operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import Keep, Prepared
from ...contact.state import InterfaceState
from ...core import require
from ...core.errors import ConvergenceError, InputError
from ...core.status import Outcome, Status
from ...solids.layers import relaxes
from .geometry import followed, unevenness, worn_problem
from .history import QUANTITIES, WearHistory, WearState
from .law import Sides, WearLaw
from .losses import Doses, Losses
from .sections import Sections
from .stage import Stage, Stretch, implicit_stage, resumed
from .third_body import ThirdBody

_GAMMA = 1.0 - math.sqrt(0.5)
"""Share of a step that each stretch of the second-order method takes (Alexander 1977): positive
weights, and waves that wear off fast are gone after a step."""

_QUADRATURE = (
    (3.0 * _GAMMA - 1.0) / (6.0 * _GAMMA),
    1.0 / (6.0 * _GAMMA * (1.0 - _GAMMA)),
    (2.0 - 3.0 * _GAMMA) / (6.0 * (1.0 - _GAMMA)),
)
"""Weights of the rule through the pressures at the begin, after the first stretch and at the end of
a step, which is exact for pressures quadratic in the distance."""

_SAFE, _SHORTER, _LONGER = 0.9, 0.2, 2.5
"""Share of the length that the tolerance allows, and the smallest and largest factor from step to
step."""

_LOOSER = 30.0
"""Tolerance of the contact within a step over that of the contact of the worn surfaces, which ends
the step and goes on from it; 10 and 100 take 6 % more FFT pairs and as many."""

REPEATED = 2.0
"""Error over the tolerance from which on a step is repeated with a smaller length."""

_FIRST = 1e-4
"""First step over the distance, where the depth that it wears at the largest pressure is not above
a tenth of the deflection."""

_ROUGH = 0.2
"""Share of the difference from an explicit step that counts as error of a step of second order:
beyond, points at moving edges of the contact ripple."""

_ROUNDING = 1e-12
"""Share of the distance below which the end is reached."""


@dataclass(frozen=True)
class WearSteps:
    """How the sliding distance, or a number of cycles, is divided into steps.

    Parameters
    ----------
    tolerance
        Share of the worn volume that steps may put at the wrong place; lengths follow from it.
    number
        Number of equal steps up to each distance that is asked for instead; None for steps by their
        error.
    order
        1: implicit Euler, one contact a step. 2: two stretches of a diagonally implicit
        Runge-Kutta method (Alexander 1977), for the same error with fewer steps.
    method
        ``"implicit"``; or ``"explicit"``, which wears by the pressure at the begin of a step, for
        comparison: it is unstable above a length of 2 c(q_max)/k, c being the compliance of the
        shortest wave.
    most
        Largest number of steps.

    Raises
    ------
    InputError
        If a value is out of range.
    """

    tolerance: float = 0.05
    number: int | None = None
    order: Literal[1, 2] = 1
    method: Literal["implicit", "explicit"] = "implicit"
    most: int = 5000

    def __post_init__(self) -> None:
        require.between(self.tolerance, 0.0, 1.0, "tolerance of the steps of wear")
        if self.number is not None:
            require.integer(self.number, 1, "number of steps of wear")
        if self.order not in (1, 2):
            raise InputError(f"order of the steps of wear must be 1 or 2, but is {self.order!r}.")
        require.one_of(self.method, ("implicit", "explicit"), "method of the steps of wear")
        require.integer(self.most, 1, "largest number of steps of wear")
        if self.method == "explicit" and (self.order == 2 or self.number is None):
            raise InputError(
                "explicit steps of wear must be of order 1 and of a given number, but are not. Use the implicit method."
            )

    def factor(self, error: float) -> float:
        """Length of the next step, or of the same one again, over the last, after one with this
        ``error``."""
        if error <= 0.0:
            return _LONGER
        return float(np.clip(_SAFE * (self.tolerance / error) ** (1.0 / self.order), _SHORTER, _LONGER))


def check(problem: ContactProblem, control: object, wear: Sides | WearLaw) -> Sides:
    """Laws of both bodies of a ``problem`` that can wear under ``control``; a law alone is that of
    the body.

    Raises
    ------
    InputError
        If it cannot.
    """
    require.instance(problem, ContactProblem, "problem of a contact that wears", "Write ContactProblem(…).")
    sides = Sides(body=wear) if isinstance(wear, WearLaw) else wear
    require.instance(sides, Sides, "wear", "Write archard(1e-15) or Sides(body=…, counter=…).")
    if not isinstance(control, Control):
        raise InputError(
            f"control of a contact that wears must be MeanPressure, Force or Approach, but is {control!r}."
        )
    others = [physics.keyword or type(physics).__name__ for physics in problem.physics if physics.keyword != "friction"]
    if others:
        raise InputError(
            f"physics of a contact that wears must be friction at most, but has {', '.join(others)}: how these go on "
            "as the surfaces change is not solved. Leave them out, and solve them on the worn surface."
        )
    if relaxes(problem.body) or relaxes(problem.counter_body):
        raise InputError(
            "bodies of a contact that wears must be elastic, but one is viscoelastic. Give its relaxed modulus."
        )
    return sides


def worn(
    problem: ContactProblem,
    control: Control,
    distance: float | Sequence[float],
    wear: Sides | WearLaw,
    *,
    steps: WearSteps = WearSteps(),
    state: WearState | None = None,
    until_bare: bool = False,
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> WearHistory:
    """Contact that wears as one body slides over the other.

    Every step is implicit in the pressure: the depth k p ds that it wears stands in the gap, so
    that the contact is that of bodies on a bed of springs (backward Euler). After each the contact
    of the worn surfaces is checked by itself.

    Parameters
    ----------
    problem
        Virgin surfaces, bodies, boundary; a hardness and Coulomb friction may be given.
    control
        ``MeanPressure``, ``Force``, or ``Approach``, held throughout.
    distance
        Sliding distance in m, > 0, counted from the virgin surfaces; or ascending distances at
        which contacts are kept.
    wear
        ``archard(coefficient)`` or another law of the body under the surface; ``Sides(...)`` for
        laws of both bodies and for tracks.
    steps
        How the distance is divided, see ``WearSteps``.
    state
        Where an earlier history of the same problem ended, to go on from.
    until_bare
        Whether to end with the step in which the first point is without its layers. As that end is
        not known before, contacts spread evenly over what was slid are kept, too.
    on_failure
        ``"raise"`` a ConvergenceError holding the history so far, or ``"return"`` it with its
        status.
    options
        Keywords of ``solve``: ``solver``, ``progress``, ``engine``, ``rounds``.

    Raises
    ------
    InputError
        If a value is out of range, or the problem has a physics that cannot wear.
    ConvergenceError
        If a contact or the steps do not reach their tolerance and ``on_failure`` is ``"raise"``.
    NoSolutionError
        If the load cannot be borne.
    """
    sides = check(problem, control, wear)
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    marks = [distance] if isinstance(distance, float | int) else list(distance)
    begin = 0.0 if state is None else state.distance
    for low, high in zip([begin, *marks], marks, strict=False):
        require.finite(high, "sliding distance (m)")
        if not high > low:
            raise InputError(
                f"sliding distances (m) must be ascending, each above the one before and the start {begin:g}, but are "
                f"{marks}."
            )
    if not marks:
        raise InputError("sliding distances must hold at least one, but hold none.")
    march = March(problem, control, sides, steps, options)
    history = march.along(state, [float(mark) for mark in marks], until_bare=until_bare)
    if on_failure == "raise" and not history.converged:
        raise ConvergenceError(f"{history.status.message} {history.status.remedy}", history)
    return history


class At(NamedTuple):
    """Where a contact that wears is: its ``state``, the contact there, with what prepared it, how
    the step to it ended, and the worn ``depths`` (m) of both bodies."""

    state: WearState
    result: ContactResult
    prepared: Prepared
    status: Status
    depths: Doses


class Tried(NamedTuple):
    """A step that was tried: ``doses`` and ``depths`` after it, the contact then with what prepared
    it, the volume (m³) that is ``misplaced``, and how its contacts ended."""

    doses: Doses
    depths: Doses
    result: ContactResult
    prepared: Prepared
    misplaced: float
    status: Status


class March:
    """Steps of one contact that wears under one control."""

    def __init__(
        self, problem: ContactProblem, control: Control, sides: Sides, steps: WearSteps, options: dict[str, Any]
    ) -> None:
        self.problem, self.step, self.sides, self.steps = problem, Step(control), sides, steps
        self.losses, self.options = Losses.of(sides, problem.grid), options
        self.layered = any(len(law.stages) > 1 for law in sides.laws)
        self.virgin_top = float(problem.profile().max())
        self.pairs, self.contacts = 0.0, 0

    def prepared(self, state: WearState, depths: Doses, like: Prepared | None = None) -> Prepared:
        """The contact of the surfaces at ``state``, worn to ``depths``, with the operator of one
        ``like`` it, if its bodies are the same."""
        bare = self.losses.bare(state.doses) if self.layered else None
        left, debris = self.losses.debris(state.doses), self.sides.debris
        layer = None if left is None or debris is None or not left.any() else ThirdBody(left, debris.modulus)
        problem = worn_problem(self.problem, depths, state.taken, bare, layer)
        same = like is not None and like.operator.compliance == problem.compliance
        return self.made(problem, like.operator if like is not None and same else None)

    def made(self, problem: ContactProblem, operator: Operator | None, *, sticks: bool = False) -> Prepared:
        """A contact of ``problem`` with its ``operator``, where that is known."""
        options = self.options if operator is None else {**self.options, "operator": operator}
        return Prepared(problem, keep=Keep(stiffness=False), sticks=sticks, **options)

    def solved(self, prepared: Prepared, interface: InterfaceState) -> ContactResult:
        """Contact of the ``prepared`` surfaces, started from ``interface``."""
        result = prepared.step(self.step, interface)
        self.count(result.certificate.fft_pairs)
        return result

    def count(self, pairs: float, contacts: int = 1) -> None:
        """Add the work of ``contacts``."""
        self.pairs, self.contacts = self.pairs + pairs, self.contacts + contacts

    def begun(self, state: WearState | None) -> At:
        """Where to start from."""
        if state is None:
            none = np.zeros(self.problem.grid.shape)
            state = WearState(0.0, math.nan, self.losses.virgin(), InterfaceState(none))
        state.interface.require_shape(self.problem.grid.shape)
        depths = self.losses.depths(state.doses)
        prepared = self.prepared(state, depths)
        result = state.contact or self.solved(prepared, state.interface)
        going = state.interface.pressure.any()
        return At(state if going else replace(state, interface=result.state), result, prepared, result.status, depths)

    def along(self, state: WearState | None, marks: Sequence[float], *, until_bare: bool) -> WearHistory:
        """History up to all ``marks`` (m)."""
        at, number, taken, ended = self.begun(state), self.steps.number, 0, False
        values: dict[str, list[float]] = {item.name: [] for item in QUANTITIES}
        kept, between = [(at.state.distance, at.result)], Sections()
        self.record(values, at)
        between.add(*kept[0])
        for mark in marks:
            equal = None if number is None else (mark - at.state.distance) / number
            while not ended and at.status.converged and mark - at.state.distance > _ROUNDING * mark:
                if taken == self.steps.most:
                    at = at._replace(status=too_many("the sliding distance (m)", at.state.distance, marks[-1], taken))
                    break
                at, taken = self.advanced(at, mark, equal), taken + 1
                self.record(values, at)
                if until_bare:
                    between.add(at.state.distance, at.result)
                    ended = math.isfinite(at.state.breakthrough)
            kept.append((at.state.distance, at.result))
            if ended or not at.status.converged:
                break
        return self.history(values, at, between.with_marks(kept))

    def advanced(self, at: At, mark: float, equal: float | None) -> At:
        """After one step; one whose error is too large is repeated with a smaller length."""
        left = mark - at.state.distance
        length = at.state.length if equal is None else equal
        if math.isnan(length):
            length = self.first(at.result, mark)
        while True:
            slid = left if length > left * (1.0 - _ROUNDING) else length
            tried = self.tried(at, slid)
            error = self.losses.share(at.state.doses, tried.doses, tried.misplaced, slid / (at.state.distance + slid))
            factor = self.steps.factor(error)
            if equal is not None or not tried.status.converged:
                break
            if error <= REPEATED * self.steps.tolerance or slid < _ROUNDING * mark:
                break
            length = factor * slid
        # a step that was cut to end at the mark does not tell how long the next one may be
        longer = factor * slid if slid == length or factor < 1.0 else max(length, factor * slid)
        return self.after(at, tried, slid, math.nan if equal is not None else longer)

    def first(self, result: ContactResult, mark: float) -> float:
        """Length (m) of the first step."""
        deflection = float(np.ptp(result.displacement)) or float(np.ptp(self.problem.profile()))
        rate = result.max_pressure * max(law.largest for law in self.sides.laws)
        return min(mark, max(_FIRST * mark, self.steps.tolerance * deflection / rate) if rate > 0.0 else mark)

    def tried(self, at: At, slid: float) -> Tried:
        """A step of ``slid`` (m) from ``at``."""
        doses, losses, interface = at.state.doses, self.losses, at.state.interface
        plainly = losses.after(doses, at.result.pressure, slid)
        if self.steps.method == "explicit":
            return self.checked(at, plainly, interface, 0.0, at.status)
        ahead = slid / at.state.last if at.state.last > 0.0 else None
        if self.steps.order == 1:
            stage = self.stage(at.prepared, interface, Stretch(doses, doses, slid), ahead)
            found = losses.after(doses, stage.pressure, slid)
            off = 0.5 * losses.apart(found, plainly)
            return self.checked(at, found, _from(stage, at), off, stage.status)
        part = _GAMMA * slid
        first = self.stage(
            at.prepared, interface, Stretch(doses, doses, part), None if ahead is None else _GAMMA * ahead
        )
        middle = losses.after(doses, first.pressure, slid - part)
        stage = self.stage(at.prepared, _from(first, at), Stretch(doses, middle, part), None)
        found, exact = losses.after(middle, stage.pressure, part), doses
        for weight, pressure in zip(_QUADRATURE, (at.result.pressure, first.pressure, stage.pressure), strict=True):
            exact = losses.after(exact, pressure, weight * slid)
        off = max(losses.apart(found, exact), _ROUGH * losses.apart(found, plainly))
        status = stage.status if first.status.converged else first.status
        return self.checked(at, found, _from(stage, at), off, status)

    def stage(self, prepared: Prepared, interface: InterfaceState, stretch: Stretch, ahead: float | None) -> Stage:
        """Contact at the end of ``stretch``, with its work counted."""
        if self.steps.number is None:  # the error of the step is much larger
            prepared = prepared.loosened(_LOOSER)
        found = implicit_stage(prepared, self.step, interface, self.losses, stretch, ahead)
        self.count(found.pairs, found.contacts)
        return found

    def checked(self, at: At, doses: Doses, interface: InterfaceState, misplaced: float, status: Status) -> Tried:
        """The step to ``doses``, with the contact of the worn surfaces, solved from ``interface``
        on: no wear is in its equations."""
        depths = self.losses.depths(doses)
        prepared = self.prepared(replace(at.state, doses=doses), depths, at.prepared)
        result = self.solved(prepared, interface)
        return Tried(doses, depths, result, prepared, misplaced, result.status if status.converged else status)

    def after(self, at: At, tried: Tried, slid: float, length: float) -> At:
        """After a step that was ``tried`` and stands."""
        losses, state, result = self.losses, at.state, tried.result
        found = replace(
            state,
            distance=state.distance + slid,
            doses=tried.doses,
            interface=InterfaceState.solved(
                result.pressure, result.state.memory, at.result.pressure, _both(at.result, result)
            ),
            length=length,
            misplaced=state.misplaced + tried.misplaced,
            carried=state.carried + result.force * slid,
            breakthrough=min(state.breakthrough, losses.worn_through(state.doses, tried.doses, (state.distance, slid))),
            last=slid,
        )
        taken = followed(self.problem, tried.depths, result.pressure, found.taken)
        if taken == found.taken:
            return At(found, result, tried.prepared, tried.status, tried.depths)
        # from now on the compliance is that of the thickness that is left
        found = replace(found, taken=taken, last=math.nan)
        prepared = self.prepared(found, tried.depths)
        again = self.solved(prepared, InterfaceState(result.pressure, result.state.memory))
        found = replace(found, interface=replace(again.state, earlier=None, deflections=None))
        status = tried.status if again.converged else again.status
        return At(found, again, prepared, status, tried.depths)

    def record(self, values: dict[str, list[float]], at: At) -> None:
        """Add the numbers at ``at`` to ``values``."""
        state, result, losses = at.state, at.result, self.losses
        profile, touching = at.prepared.profile, result.contact
        depths = [depth for depth in at.depths if depth is not None]
        body, counter = losses.volumes(at.depths)
        pixels = int(np.count_nonzero(touching))
        bare = int(np.count_nonzero(touching & losses.bare(state.doses))) if self.layered else 0
        within = sum(float(depth.sum()) for depth in depths) * self.problem.grid.pixel_area
        now = {
            "distance": state.distance,
            "cycles": state.cycles,
            "worn_volume": body + counter,
            "body_volume": body,
            "counter_volume": counter,
            "max_depth": max(float(depth.max()) for depth in depths),
            "force": result.force,
            "area_fraction": result.area_fraction,
            "max_pressure": result.max_pressure,
            "approach": result.approach - float(profile.max()) + self.virgin_top,
            "rms_height": float(profile.std()),
            "bare_fraction": bare / pixels if pixels else 0.0,
            "plastic_area_fraction": result.plastic_area_fraction,
            "misplaced": state.misplaced / within if within > 0.0 else 0.0,
        }
        for name, value in now.items():
            values[name].append(value)

    def history(self, values: dict[str, list[float]], at: At, kept: list[tuple[float, ContactResult]]) -> WearHistory:
        """History that has come to ``at``."""
        state = at.state
        depths = at.depths
        both = [np.zeros(self.problem.grid.shape) if depth is None else np.array(depth) for depth in depths]
        uneven = unevenness(self.problem, depths, at.result.pressure)
        fretting = not math.isnan(state.cycles)
        return WearHistory(
            last=at.result,
            values={name: np.array(items) for name, items in values.items()},
            body_depth=both[0],
            counter_depth=both[1],
            breakthrough=state.breakthrough if math.isfinite(state.breakthrough) else math.nan,
            dose_balance=math.nan if fretting else self.losses.imbalance(state.doses, state.carried),
            error=values["misplaced"][-1],
            unevenness=uneven.variation,
            compliance_error=uneven.error,
            contacts=self.contacts,
            fft_pairs=self.pairs,
            status=at.status,
            kept=tuple(kept),
            state=replace(state, contact=at.result),
        )


def too_many(what: str, reached: float, whole: float, taken: int) -> Status:
    """That ``taken`` steps have only ``reached`` a part of the ``whole``, in m or another unit."""
    message = f"Not converged: {taken} steps of wear have come to {what} {reached:g} of {whole:g}."
    return Status(Outcome.ITERATION_LIMIT, message, "Allow more steps, or a larger tolerance ({wear.tolerance}).")


def _from(stage: Stage, at: At) -> InterfaceState:
    """Interface ``at`` the begin of a step with the pressure of ``stage``, to start from."""
    return resumed(at.state.interface, stage.pressure, stage.deflection, at.prepared.operator)


def _both(before: ContactResult, after: ContactResult) -> Deflections | None:
    """Displacements by the pressures of both contacts, where they are at hand."""
    first, last = before.deflections, after.deflections
    if first is None or last is None or first.compliance != last.compliance:
        return None
    return replace(last, pairs=(*last.pairs[:1], *first.pairs[:1]))
