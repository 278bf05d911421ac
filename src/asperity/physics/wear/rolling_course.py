"""Contacts that wear as they roll with creepage: their shape follows what is worn off."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...contact.controls import Control
from ...contact.problem import ContactProblem
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.status import Status
from ..rolling.rolling import DIRECTIONS, Creepage, Rolling, RollingContact, roll
from .geometry import Thinned, followed, unevenness, worn_problem
from .history import QUANTITIES, ROLLING, WearHistory
from .law import Sides, WearLaw
from .losses import Doses
from .march import REPEATED, WearSteps, check, too_many
from .rolled import dose_of_passage, require_rolling_law
from .sections import Sections

_FIRST = 1e-2
"""First step over the distance."""

_LEAST = 1e-9
"""Share of the distance below which a step is not shortened, and the end is reached."""


def worn_by_rolling(
    problem: ContactProblem,
    control: Control,
    creepage: Creepage,
    distance: float,
    wear: Sides | WearLaw,
    circumference: float | tuple[float, float],
    *,
    direction: Rolling = "x",
    steps: WearSteps = WearSteps(),
    until_bare: bool = False,
    on_failure: Literal["raise", "return"] = "raise",
) -> WearHistory:
    """Contact that wears as it rolls steadily with a ``creepage``.

    In each passage a point bears the dose ∫ p s dx of ``rolled``, s being the slip over the rolling
    speed, so that a body wears alike all around. After every step the rolling contact of the worn
    shape is solved; half of the difference that its doses make is the error of the step, and says
    how long the next one may be.

    Parameters
    ----------
    problem
        Virgin surfaces, bodies and boundary, with a friction law, as of ``roll``.
    control
        ``MeanPressure``, ``Force`` or ``Approach``, held throughout.
    creepage
        Creepages and spin.
    distance
        Rolled in m, > 0.
    wear
        ``archard(coefficient)`` of the body under the surface, or ``Sides(...)`` for both, each
        with one coefficient a layer and no threshold of the pressure, without tracks and debris.
    circumference
        Of both bodies in m, > 0, or of each: every point runs through the contact once in as many
        metres.
    direction
        ``"x"``, ``"-x"``, ``"y"`` or ``"-y"``: where the contact rolls to.
    steps
        Tolerance of the steps, or their number; ``order`` and ``method`` do not count: they are
        explicit.
    until_bare
        Whether to end with the step in which the first point is without its layers.
    on_failure
        ``"raise"`` a ConvergenceError holding the history so far, or ``"return"`` it with its
        status.

    Returns
    -------
    WearHistory
        With contacts spread evenly over what was rolled in ``kept``; nothing to go on from. The
        ``dose_balance`` compares the worn volume before its law, Σ ∫∫ p s dx dy ds, with the doses
        of both bodies.

    Raises
    ------
    InputError
        If a value is out of range, or a law has a map or a threshold of the pressure.
    ConvergenceError
        If a contact or the steps do not reach their tolerance.
    NoSolutionError
        If shear parts unlike bodies at a prescribed approach.
    """
    sides = check(problem, control, wear)
    for law in sides.laws:
        require_rolling_law(law)
    if sides.body_track is not None or sides.counter_track is not None or sides.debris is not None:
        raise InputError(
            "sides of a contact that rolls must be without tracks and debris, but are not. Give the circumference of "
            "each body instead of a track."
        )
    require.positive(distance, "distance rolled (m)")
    both = (circumference, circumference) if isinstance(circumference, float | int) else circumference
    around = [require.positive(value, "circumference of a rolling body (m)") for value in both]
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    course = RollingCourse(problem, control, creepage, direction, sides, (around[0], around[1]), steps)
    history = course.over(distance, until_bare=until_bare)
    if on_failure == "raise" and not history.converged:
        raise ConvergenceError(f"{history.status.message} {history.status.remedy}", history)
    return history


@dataclass(frozen=True, eq=False)
class Rolled:
    """Where a contact that wears by rolling is: ``distance`` in m, ``doses`` (n,) of each body, the
    contact there, what its compliance has taken off layers, and the volume (m³) misplaced so far.

    ``carried`` is the sum of ∫∫ p s dx dy over the distance, N m.
    """

    distance: float
    doses: Doses
    contact: RollingContact
    taken: Thinned = Thinned()
    misplaced: float = 0.0
    carried: float = 0.0
    breakthrough: float = math.inf


@dataclass(eq=False)
class RollingCourse:
    """Steps of one contact that wears as it rolls, with the number of ``contacts`` that were solved
    and their FFT ``pairs``."""

    problem: ContactProblem
    control: Control
    creepage: Creepage
    direction: Rolling
    sides: Sides
    around: tuple[float, float]
    steps: WearSteps
    contacts: int = 0
    pairs: float = 0.0

    @property
    def laws(self) -> tuple[WearLaw | None, WearLaw | None]:
        """Laws of both bodies."""
        return self.sides.body, self.sides.counter

    @property
    def axis(self) -> int:
        """Axis of the grid along which it rolls."""
        return DIRECTIONS[self.direction].axis

    @property
    def side(self) -> int:
        """The axis across."""
        return 1 - self.axis

    def over(self, distance: float, *, until_bare: bool) -> WearHistory:
        """History over the ``distance`` (m)."""
        across = self.problem.grid.shape[self.side]
        virgin = Doses(*(None if law is None else np.zeros(across) for law in self.laws))
        at, status = Rolled(0.0, virgin, self.rolling(self.problem, None)), None
        values: dict[str, list[float]] = {item.name: [] for item in (*QUANTITIES, *ROLLING)}
        self.record(values, at)
        kept, count = Sections(), 0
        kept.add(0.0, at.contact.normal)
        number = self.steps.number
        length = distance / number if number is not None else _FIRST * distance
        while distance - at.distance > _LEAST * distance and at.contact.converged:
            if count == self.steps.most:
                status = too_many("the distance rolled (m)", at.distance, distance, count)
                break
            at, length = self.advanced(at, length, distance)
            count += 1
            self.record(values, at)
            kept.add(at.distance, at.contact.normal)
            if until_bare and math.isfinite(at.breakthrough):
                break
        return self.history(values, at, kept, status or at.contact.status)

    def advanced(self, at: Rolled, length: float, distance: float) -> tuple[Rolled, float]:
        """After one step of ``length`` (m) at most, and how long the next may be."""
        equal, left = self.steps.number is not None, distance - at.distance
        while True:
            slid = left if length > left * (1.0 - _LEAST) else length
            found = self.stepped(at, slid)
            before, after = self.volume(at.doses), self.volume(found.doses)
            lost = max(after - before, slid / (at.distance + slid) * after)
            error = (found.misplaced - at.misplaced) / lost if lost > 0.0 else 0.0
            factor = self.steps.factor(error)
            if equal or error <= REPEATED * self.steps.tolerance or slid < _LEAST * distance:
                break
            length = factor * slid
        return found, length if equal else max(length, factor * slid) if slid < length else factor * slid

    def stepped(self, at: Rolled, slid: float) -> Rolled:
        """After ``slid`` (m), with the contact of the worn shape."""
        doses, through = self.after(at.doses, at.contact, slid), at.breakthrough
        for law, before, after in zip(self.laws, at.doses, doses, strict=True):
            if law is None or not law.thickness:
                continue
            assert before is not None
            assert after is not None
            bare = after >= law.dose_of_layers
            if bare.any():
                share = (law.dose_of_layers - before[bare]) / (after[bare] - before[bare])
                through = min(through, at.distance + slid * max(0.0, float(share.min())))
        depths = self.maps(doses)
        contact = self.rolling(worn_problem(self.problem, depths, at.taken, None), at.contact)
        taken = followed(self.problem, depths, contact.normal.pressure, at.taken)
        if taken != at.taken:  # from now on the compliance is that of the thickness that is left
            contact = self.rolling(worn_problem(self.problem, depths, taken, None), None)
        apart = self.volume_between(doses, self.after(at.doses, contact, slid))
        return Rolled(
            at.distance + slid,
            doses,
            contact,
            taken,
            at.misplaced + 0.5 * apart,
            at.carried + slid * self.slipped(at.contact),
            through,
        )

    def rolling(self, problem: ContactProblem, start: RollingContact | None) -> RollingContact:
        """The steady contact of ``problem``, from one near by."""
        found = roll(problem, self.control, self.creepage, direction=self.direction, start=start)
        self.contacts, self.pairs = self.contacts + 1, self.pairs + found.normal.certificate.fft_pairs
        return found

    def after(self, doses: Doses, contact: RollingContact, slid: float) -> Doses:
        """``doses`` after ``slid`` (m) of rolling with this ``contact``."""
        dose = dose_of_passage(contact)
        each = zip(doses, self.around, strict=True)
        return Doses(*(None if item is None else item + slid / around * dose for item, around in each))

    def slipped(self, contact: RollingContact) -> float:
        """∫∫ p s dx dy in N."""
        return float((contact.normal.pressure * np.hypot(*contact.slip)).sum()) * self.problem.grid.pixel_area

    def depths(self, doses: Doses) -> tuple[RealArray | None, RealArray | None]:
        """Worn depths (n,) of both bodies."""
        body, counter = (
            None if law is None or dose is None else law.depth(dose) for law, dose in zip(self.laws, doses, strict=True)
        )
        return body, counter

    def maps(self, doses: Doses) -> Doses:
        """Worn depths (nx, ny), alike all along the direction of rolling."""
        shape = self.problem.grid.shape
        each = (None if depth is None else np.expand_dims(depth, self.axis) for depth in self.depths(doses))
        return Doses(*(None if depth is None else np.array(np.broadcast_to(depth, shape)) for depth in each))

    def volumes(self, doses: Doses) -> list[float]:
        """Worn volume (m³) of each body all around."""
        width = self.problem.grid.spacing[self.side]
        each = zip(self.depths(doses), self.around, strict=True)
        return [0.0 if depth is None else float(depth.sum()) * width * around for depth, around in each]

    def volume(self, doses: Doses) -> float:
        """That of both."""
        return sum(self.volumes(doses))

    def volume_between(self, doses: Doses, others: Doses) -> float:
        """Volume (m³) by which the depths after two doses differ, of either sign."""
        width, total = self.problem.grid.spacing[self.side], 0.0
        for one, other, around in zip(self.depths(doses), self.depths(others), self.around, strict=True):
            if one is not None and other is not None:
                total += float(np.abs(one - other).sum()) * width * around
        return total

    def record(self, values: dict[str, list[float]], at: Rolled) -> None:
        """Add the numbers at ``at`` to ``values``."""
        normal, volumes = at.contact.normal, self.volumes(at.doses)
        profile, depths = normal.problem.profile(), self.maps(at.doses)
        bare = np.zeros(normal.pressure.shape, bool)
        for law, depth in zip(self.laws, depths, strict=True):
            if law is not None and law.thickness and depth is not None:
                bare |= depth >= law.thickness * (1.0 - _LEAST)
        pixels = int(np.count_nonzero(normal.contact))
        now = {
            "distance": at.distance,
            "cycles": math.nan,
            "worn_volume": sum(volumes),
            "body_volume": volumes[0],
            "counter_volume": volumes[1],
            "max_depth": max(float(depth.max()) for depth in depths if depth is not None),
            "force": normal.force,
            "area_fraction": normal.area_fraction,
            "max_pressure": normal.max_pressure,
            "approach": normal.approach - float(profile.max()) + float(self.problem.profile().max()),
            "rms_height": float(profile.std()),
            "bare_fraction": int(np.count_nonzero(bare & normal.contact)) / pixels if pixels else 0.0,
            "plastic_area_fraction": normal.plastic_area_fraction,
            "misplaced": at.misplaced / sum(volumes) if sum(volumes) > 0.0 else 0.0,
            "tangential_force": math.hypot(at.contact.force_x, at.contact.force_y),
            "slip_area_fraction": at.contact.slip_area_fraction,
            "rolling_heat": at.contact.dissipated,
        }
        for name, value in now.items():
            values[name].append(value)

    def history(self, values: dict[str, list[float]], at: Rolled, kept: Sections, status: Status) -> WearHistory:
        """History that has come to ``at``."""
        normal, depths = at.contact.normal, self.maps(at.doses)
        none = np.zeros(self.problem.grid.shape)
        uneven = unevenness(self.problem, depths, normal.pressure)
        width = self.problem.grid.spacing[self.side]
        sums = [
            float(dose.sum()) * width * around
            for dose, around in zip(at.doses, self.around, strict=True)
            if dose is not None
        ]
        balance = max(abs(item / at.carried - 1.0) for item in sums) if at.carried > 0.0 else math.nan
        return WearHistory(
            last=normal,
            values={name: np.array(items) for name, items in values.items()},
            body_depth=none if depths.body is None else depths.body,
            counter_depth=none if depths.counter is None else depths.counter,
            breakthrough=at.breakthrough if math.isfinite(at.breakthrough) else math.nan,
            dose_balance=balance,
            error=values["misplaced"][-1],
            unevenness=uneven.variation,
            compliance_error=uneven.error,
            contacts=self.contacts,
            fft_pairs=self.pairs,
            status=status,
            kept=tuple(kept.with_marks([(at.distance, normal)])),
        )
