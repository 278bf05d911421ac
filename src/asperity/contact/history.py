"""A history of steps on one contact: loading, unloading and loading again; results in order, and
where the work goes."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Self, TypeAlias, overload

import numpy as np

from ..core import require
from ..core.arrays import OfSteps, RealArray
from ..core.errors import InputError
from ..core.late import Advised, Stored
from ..core.registry import ENERGY_TERMS
from .controls import Approach, Control, Force, MeanGap, MeanPressure, Step, Unloaded, as_step
from .known import EnergyNames
from .result import ContactResult
from .state import InterfaceState
from .tangential import Shift, TangentialForce

Ramped: TypeAlias = type[MeanPressure] | type[Force] | type[Approach] | type[MeanGap]
"""Kind of control that is changed step by step."""

SAME_FORCE = 1e-6
"""Relative difference of forces of steps under the same load."""


@dataclass(frozen=True, init=False)
class History:
    """Sequence of steps, each from the interface that the last one left.

    Parameters
    ----------
    steps
        Controls, or ``Step`` of each, in any mixture; at least one. See ``ramps``.

    Raises
    ------
    InputError
        If there is no step, or one is something else.
    """

    steps: tuple[Step, ...]

    def __init__(self, steps: Iterable[Step | Control]) -> None:
        if isinstance(steps, Control | Step):
            raise InputError(f"steps of a history must be a sequence, but are {steps!r}. Write History([{steps!r}]).")
        try:
            ordered = tuple(steps)
        except TypeError:
            raise InputError(
                f"steps of a history must be a sequence of controls, but are {steps!r}. "
                "Write for example History([MeanPressure(50e3), MeanPressure(100e3)])."
            ) from None
        if not ordered:
            raise InputError("steps of a history must hold at least one control, but hold none.")
        for number, step in enumerate(ordered, start=1):
            control = step.normal if isinstance(step, Step) else step
            if not isinstance(control, Control):
                raise InputError(
                    f"step {number} of a history must be a MeanPressure, Force, Approach, MeanGap or Unloaded, "
                    f"but is {control!r}. Write for example MeanPressure(50e3)."
                )
        object.__setattr__(self, "steps", tuple(map(as_step, ordered)))

    @classmethod
    def ramps(cls, kind: Ramped, turning_points: Sequence[float], *, steps: int = 10) -> Self:
        """History that runs through the ``turning_points``, see ``ramps``."""
        return cls(ramps(kind, turning_points, steps=steps))

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)


def shear_cycles(
    normal: Control, amplitude: Shift | TangentialForce, *, cycles: int = 1, steps: int = 8
) -> tuple[Step, ...]:
    """Steps of a tangential cycle at a constant normal control: to ``amplitude``, to its opposite
    and back, and so on.

    Parameters
    ----------
    normal
        Control along the normal, held throughout.
    amplitude
        ``Shift`` or ``TangentialForce`` of the first turning point; the others are its opposite and
        itself.
    cycles
        Number of closed cycles after the first loading.
    steps
        Steps from zero to the amplitude; twice as many from one turning point to the other.

    Raises
    ------
    InputError
        If a number is below one.
    """
    require.integer(cycles, 0, "number of cycles")
    require.integer(steps, 1, "number of steps")
    course = [k / steps for k in range(1, steps + 1)]
    back = [1.0 - k / steps for k in range(1, 2 * steps + 1)]
    for _ in range(cycles):
        course += [*back, *(-share for share in back)]
    kind, values = type(amplitude), [getattr(amplitude, item.name) for item in fields(amplitude)]
    return tuple(Step(normal, kind(*(share * value for value in values))) for share in course)


def ramps(kind: Ramped, turning_points: Sequence[float], *, steps: int = 10) -> tuple[Control, ...]:
    """Controls of a history that runs through the ``turning_points``.

    Parameters
    ----------
    kind
        ``MeanPressure``, ``Force``, ``Approach`` or ``MeanGap``.
    turning_points
        Values in SI units, >= 0, in order; for example ``[50e6, 0, 80e6]`` to load, unload and load
        again. Zero is no load (``Unloaded``). A path starts at zero, except of ``MeanGap``, which
        starts at its first value.
    steps
        Number of steps from each turning point to the next. They are equal, but where a load begins
        or ends at zero they grow with the distance from it, load = (k/steps)² of the other end: a
        light contact changes fastest.

    Raises
    ------
    InputError
        If there is no turning point, two neighbours are equal, one is negative, or a mean gap is
        zero.
    """
    require.integer(steps, 1, "number of steps")
    if not isinstance(kind, type) or kind not in (MeanPressure, Force, Approach, MeanGap):
        raise InputError(f"kind of a ramp must be MeanPressure, Force, Approach or MeanGap, but is {kind!r}.")
    values = [require.not_negative(value, f"turning point of a load path ({kind.unit})") for value in turning_points]
    first = [] if kind is MeanGap else [0.0]
    points = [*first, *(values[1:] if values[:1] == first else values)]
    if len(points) < 2 - (kind is MeanGap):
        raise InputError("turning points of a load path must hold at least one value greater than zero, but hold none.")
    if any(low == high for low, high in itertools.pairwise(points)):
        raise InputError(f"neighbouring turning points of a load path must differ, but are {values}.")
    graded = kind in (MeanPressure, Force)
    course = points[:1] if kind is MeanGap else []
    for start, end in itertools.pairwise(points):
        share = np.arange(1, steps + 1) / steps
        if graded and start == 0.0:
            share = share**2
        elif graded and end == 0.0:
            share = 1.0 - (1.0 - share) ** 2
        course = [*course, *(start + share * (end - start)).tolist()[:-1], end]
    return tuple(kind(value) if value > 0.0 or kind is MeanGap else Unloaded() for value in course)


@dataclass(frozen=True, eq=False, repr=False)
class HistoryResult(Advised, Stored):
    """Results of the steps of a history, in order: ``len``, iteration, ``history[i]`` and
    ``history[i:j]`` are those of ``steps``.

    Parameters
    ----------
    steps
        One for each control. A step that did not converge carries its status; the steps after it
        started from the last one that did.
    start
        Interface before the first step; None for a virgin one.
    """

    steps: tuple[ContactResult, ...]
    start: InterfaceState | None = None

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[ContactResult]:
        return iter(self.steps)

    @overload
    def __getitem__(self, index: int) -> ContactResult: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[ContactResult, ...]: ...

    def __getitem__(self, index: int | slice) -> ContactResult | tuple[ContactResult, ...]:
        """Result of step ``index``, counted from zero or, if negative, from the end; of a slice the
        tuple of its results.

        Raises
        ------
        IndexError
            If there is no such step.
        """
        return self.steps[index]

    @property
    def peak(self) -> int:
        """Number from 0 of the step of the largest force, of the last such step where a load is
        held."""
        force = self.force
        return int(np.flatnonzero(force >= force.max() - SAME_FORCE * abs(force).max())[-1])

    @property
    def last(self) -> ContactResult:
        """Result of the last step."""
        return self.steps[-1]

    @property
    def state(self) -> InterfaceState | None:
        """State to go on from, that of the last step that converged."""
        good = [result for result in self.steps if result.converged]
        return good[-1].state if good else self.start

    mean_pressure = OfSteps("Mean pressure (Pa) of every step.")
    area_fraction_corrected = OfSteps("Real over nominal contact area of every step, without pixel bias.")
    approach = OfSteps("Approach (m) from first touch of the virgin surfaces of every step.")
    mean_gap = OfSteps("Mean gap (m) of every step.")
    force = OfSteps("Force (N) between the solids of every step.")
    external_force = OfSteps("External force (N) of every step: ``force`` less what menisci pull.")
    elastic_energy = OfSteps("Elastic energy (J) of every step.")
    plastic_work = OfSteps("Plastic work (J) that every step added.")

    @property
    def turns(self) -> tuple[int, ...]:
        """Index of every step after which the load changes direction, and of the last step."""
        rises = np.diff(self.mean_pressure) > 0.0
        return (*(int(step) + 1 for step in np.flatnonzero(np.diff(rises.astype(int)))), len(self.steps) - 1)

    @property
    def converged(self) -> bool:
        """Whether every step reached its tolerance."""
        return all(result.converged for result in self.steps)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        return tuple(sorted({key for result in self.steps for key in result.citation_keys}))

    @cached_property
    def energies(self) -> EnergyBalance:
        """Where the work goes, see ``EnergyBalance``."""
        steps, start = self.steps, self.start
        problem, approach = steps[0].problem, self.approach
        attraction = [[each.pulls() for each in step.answers if each.traction_beside() is not None] for step in steps]
        attracted, from_first = np.array([sum(pulls) for pulls in attraction]), bool(attraction[0])
        by_answers = [
            next((w for w in (each.worked() for each in step.answers) if w is not None), None) for step in steps
        ]
        force = self.force - attracted
        pull = force - self.external_force
        elastic = self.elastic_energy + [
            sum(each.stores(relaxing=worked is not None) for each in step.answers)
            for step, worked in zip(steps, by_answers, strict=True)
        ]
        plastic = np.cumsum(self.plastic_work + [sum(each.flows() for each in step.answers) for step in steps])
        terms = {name: np.cumsum(each) for item in problem.physics for name, each in item.works(steps).items()}
        loaded = start is not None and bool(start.pressure.any())
        if not from_first and not loaded:
            virgin = problem.profile()
            dented = virgin if start is None else virgin - start.permanent_indentation - start.imprint
            approach = np.concatenate([[float(virgin.max() - dented.max())], approach])
            work, pulled = (_integrated(np.concatenate([[0.0], f]), approach)[1:] for f in (force, pull))
        else:
            work, pulled = (_integrated(f, approach) for f in (force, pull))
            for known in (item.work(steps) for item in problem.physics):
                work = work if known is None else known + pulled
            elastic, plastic = elastic - elastic[0], plastic - plastic[0]
            terms = {name: each - each[0] for name, each in terms.items()}
        viscous = np.cumsum([sum(each.heat() for each in step.answers) for step in steps])
        if None not in by_answers:
            work = np.cumsum(np.array(by_answers))
            if from_first or loaded:
                work, viscous = work - work[0], viscous - viscous[0]
        supplying = {name for item in problem.physics for name in item.supplies}
        found = EnergyBalance(
            work,
            elastic,
            plastic,
            viscous,
            supplied={name: each for name, each in terms.items() if name in supplying},
            taken={name: each for name, each in terms.items() if name not in supplying},
            included={item.pull_term: pulled for item in problem.physics if item.pull_term},
        )
        for item in problem.physics:
            lost = item.losses(steps, found.residual)
            found = replace(found, taken={**found.taken, **lost}) if lost else found
        return found

    def scalars(self, name: str) -> RealArray:
        """Attribute ``name`` of every step."""
        return np.array([getattr(result, name) for result in self.steps], dtype=float)


def _integrated(y: RealArray, x: RealArray) -> RealArray:
    """Integral of ``y`` over ``x`` from the first point to each, by trapezia."""
    return np.concatenate([[0.0], np.cumsum(np.diff(x) * (y[1:] + y[:-1]) / 2.0)])


@dataclass(frozen=True, eq=False)
class EnergyBalance(EnergyNames):
    """Energies after each step of a history in J, counted from the touching of the unloaded bodies,
    dented as it found them.

    A history that goes on from a loaded interface, or with adhesion, is counted from its first step
    instead. Integrals are trapezia through the steps. With adhesion F is less the attraction, and
    the work is that of ``adhesion_loop`` and of the menisci. Where the bodies touch, gap = offset +
    u - h + w = 0 and dδ = du + dw, so that F dδ = Σ p du + Σ p dw: the change of the elastic
    energy, K being symmetric, the work of the displacement by shear, which is part of u, and the
    plastic work, p being the hardness where dw > 0. F is the external force and that of the
    menisci. Periodic bodies are measured without the mean mode on both sides.

    Along the surface Q dδ = Σ q du + Σ q ds in the same way, s being the slip. Steps with stick and
    slip are implicit, so that their work and dissipation are those of the traction at the end of
    the step: Q Δδ = Σ q Δu + Σ q Δs, of which half of Σ Δq Δu is neither stored nor dissipated by
    slip; it falls with the length of the steps.

    Parameters
    ----------
    external_work
        ∫ F dδ of the force between the solids over the approach, so of external load and menisci.
    elastic_energy
        Half of pressure times displacement, and of shear traction times tangential displacement,
        less that at the start; with adhesion the energy of the interface too.
    plastic_work
        Sum of the plastic works of the steps, at the surface and in the volume; of the latter
        stress at the end of each step times plastic strain.
    shear_work
        ∫ Σ p du of the displacement by shear: what gross sliding takes, or gives, by lifting the
        surfaces.
    tangential_work
        Σ Q·Δδ of tangential force and shift, and of torque and twist, those at the end of each
        step.
    slip_work
        Energy dissipated by slip.
    step_work
        Σ ½ Σ Δq·Δu of shear traction and tangential displacement: what the length of implicit steps
        takes.
    viscous_work
        Heat of viscoelastic bodies. Their external work is that of all steps of time, of a step at
        once what is stored and taken (``Creeping.work``), and the elastic energy what their springs
        store.
    supplied, taken, included
        What the physics of the problem add by name, each an attribute as well, zero where the
        problem has none: works beside the external one, ``tangential_work``; what else is stored or
        lost; and parts of the external work, ``meniscus_work``.
    meniscus_work
        The part of the external work that the menisci do.
    fluid_work
        What a fluid that presses on both bodies does as the gap opens, and on the back of them.
    jump_work
        What adhesive contacts lose as they jump: in the steps with a jump all that nothing else
        takes.
    """

    external_work: RealArray
    elastic_energy: RealArray
    plastic_work: RealArray
    viscous_work: RealArray
    supplied: Mapping[str, RealArray]
    taken: Mapping[str, RealArray]
    included: Mapping[str, RealArray]

    def __getattr__(self, name: str) -> RealArray:
        own = vars(self)
        for terms in ("supplied", "taken", "included"):
            if name in own.get(terms, {}):
                found: RealArray = own[terms][name]
                return found
        if name in ENERGY_TERMS:
            return np.zeros(own["external_work"].shape)
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    @property
    def residual(self) -> RealArray:
        """Works less all that is stored or taken: the error of the trapezoidal rule, or of the
        steps of time, of second order."""
        left = self.external_work + sum(self.supplied.values(), np.zeros(self.external_work.shape))
        return left - sum(self.taken.values(), self.elastic_energy + self.plastic_work + self.viscous_work)

    @property
    def relative_error(self) -> float:
        """Largest magnitude of the residual over the largest external or tangential work; zero
        where no work was done."""
        largest = max(float(np.abs(work).max()) for work in (self.external_work, *self.supplied.values()))
        return float(np.abs(self.residual).max()) / largest if largest > 0.0 else 0.0
