"""A history of steps on one contact: loading, unloading and loading again; results in order, and where the work goes."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Self, TypeAlias, overload

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.late import Stored
from .adhesive_cycles import adhesion_loop
from .controls import Approach, Control, Force, MeanGap, MeanPressure, Step, Unloaded, as_step
from .result import ContactResult
from .state import InterfaceState
from .tangential import Shift, TangentialForce

Ramped: TypeAlias = type[MeanPressure] | type[Force] | type[Approach] | type[MeanGap]
"""Kind of control that is changed step by step."""


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
    """Steps of a tangential cycle at a constant normal control: to ``amplitude``, to its opposite and back, and so on.

    Parameters
    ----------
    normal
        Control along the normal, held throughout.
    amplitude
        ``Shift`` or ``TangentialForce`` of the first turning point; the others are its opposite and itself.
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
        Values in SI units, >= 0, in order; for example ``[50e6, 0, 80e6]`` to load, unload and load again. Zero is no
        load (``Unloaded``). A path starts at zero, except of ``MeanGap``, which starts at its first value.
    steps
        Number of steps from each turning point to the next. They are equal, but where a load begins or ends at zero they
        grow with the distance from it, load = (k/steps)² of the other end: a light contact changes fastest.

    Raises
    ------
    InputError
        If there is no turning point, two neighbours are equal, one is negative, or a mean gap is zero.
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
    legs = [_leg(start, end, steps, graded=graded) for start, end in itertools.pairwise(points)]
    course = [*(points[:1] if kind is MeanGap else []), *(float(value) for leg in legs for value in leg)]
    return tuple(kind(value) if value > 0.0 or kind is MeanGap else Unloaded() for value in course)


def _leg(start: float, end: float, steps: int, *, graded: bool) -> RealArray:
    """Values after each of the ``steps`` from ``start`` to ``end``; ``graded`` ones are denser towards a zero."""
    share = np.arange(1, steps + 1) / steps
    if graded and start == 0.0:
        share = share**2
    elif graded and end == 0.0:
        share = 1.0 - (1.0 - share) ** 2
    values: RealArray = start + share * (end - start)
    values[-1] = end
    return values


@dataclass(frozen=True, eq=False, repr=False)
class HistoryResult(Stored):
    """Results of the steps of a history, in order: ``len``, iteration, ``history[i]`` and ``history[i:j]`` are those of ``steps``.

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
        """Result of step ``index``, counted from zero or, if negative, from the end; of a slice the tuple of its results.

        Raises
        ------
        IndexError
            If there is no such step.
        """
        return self.steps[index]

    @property
    def last(self) -> ContactResult:
        """Result of the last step."""
        return self.steps[-1]

    @property
    def state(self) -> InterfaceState | None:
        """State to go on from, that of the last step that converged."""
        good = [result for result in self.steps if result.converged]
        return good[-1].state if good else self.start

    @property
    def mean_pressure(self) -> RealArray:
        """Mean pressure (Pa) of every step."""
        return self.scalars("mean_pressure")

    @property
    def area_fraction_corrected(self) -> RealArray:
        """Real over nominal contact area of every step, without pixel bias."""
        return self.scalars("area_fraction_corrected")

    @property
    def approach(self) -> RealArray:
        """Approach (m) from first touch of the virgin surfaces of every step."""
        return self.scalars("approach")

    @property
    def mean_gap(self) -> RealArray:
        """Mean gap (m) of every step."""
        return self.scalars("mean_gap")

    @property
    def force(self) -> RealArray:
        """Force (N) between the solids of every step."""
        return self.scalars("force")

    @property
    def external_force(self) -> RealArray:
        """External force (N) of every step: ``force`` less what menisci pull."""
        return self.scalars("external_force")

    @property
    def elastic_energy(self) -> RealArray:
        """Elastic energy (J) of every step."""
        return self.scalars("elastic_energy")

    @property
    def plastic_work(self) -> RealArray:
        """Plastic work (J) that every step added."""
        return self.scalars("plastic_work")

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
        return _balance(self)

    def scalars(self, name: str) -> RealArray:
        """Attribute ``name`` of every step."""
        return np.array([getattr(result, name) for result in self.steps], dtype=float)


@dataclass(frozen=True, eq=False)
class EnergyBalance:
    """Energies after each step of a history in J, counted from the touching of the unloaded bodies, dented as it found them.

    A history that goes on from a loaded interface, or with adhesion, is counted from its first step instead. Integrals are trapezia through
    the steps. With adhesion F is less the attraction, and the work is that of ``adhesion_loop`` and of the menisci. Where the bodies touch, gap = offset + u - h + w = 0 and dδ = du + dw, so that F dδ = Σ p du + Σ p dw: the
    change of the elastic energy, K being symmetric, the work of the displacement by shear, which is part of u, and the
    plastic work, p being the hardness where dw > 0. F is the external force and that of the menisci. Periodic
    bodies are measured without the mean mode on both sides.

    Along the surface Q dδ = Σ q du + Σ q ds in the same way, s being the slip. Steps with stick and slip are implicit, so that
    their work and dissipation are those of the traction at the end of the step: Q Δδ = Σ q Δu + Σ q Δs, of which half of
    Σ Δq Δu is neither stored nor dissipated by slip; it falls with the length of the steps.

    Parameters
    ----------
    external_work
        ∫ F dδ of the force between the solids over the approach, so of external load and menisci.
    meniscus_work
        The part of it that the menisci do.
    elastic_energy
        Half of pressure times displacement, and of shear traction times tangential displacement, less that at the start; with
        adhesion the energy of the interface too.
    plastic_work
        Sum of the plastic works of the steps, at the surface and in the volume; of the latter stress at the end of each step times plastic strain.
    shear_work
        ∫ Σ p du of the displacement by shear: what gross sliding takes, or gives, by lifting the surfaces.
    tangential_work
        Σ Q·Δδ of tangential force and shift, and of torque and twist, those at the end of each step.
    slip_work
        Energy dissipated by slip.
    step_work
        Σ ½ Σ Δq·Δu of shear traction and tangential displacement: what the length of implicit steps takes.
    viscous_work
        Heat of viscoelastic bodies. Their external work is that of all steps of time, of a step at once what is stored and taken
        (``Creeping.work``), and the elastic energy what their springs store.
    jump_work
        What adhesive contacts lose as they jump: in the steps with a jump all that nothing else takes.
    """

    external_work: RealArray
    meniscus_work: RealArray
    elastic_energy: RealArray
    plastic_work: RealArray
    shear_work: RealArray
    tangential_work: RealArray
    slip_work: RealArray
    step_work: RealArray
    viscous_work: RealArray
    jump_work: RealArray

    @property
    def residual(self) -> RealArray:
        """External and tangential work less all others: the error of the trapezoidal rule, or of the steps of time, of second order."""
        done = self.external_work + self.tangential_work
        return (
            done
            - self.elastic_energy
            - self.plastic_work
            - self.shear_work
            - self.slip_work
            - self.step_work
            - self.viscous_work
            - self.jump_work
        )

    @property
    def relative_error(self) -> float:
        """Largest magnitude of the residual over the largest external and tangential work; zero where no work was done."""
        largest = float(max(np.abs(self.external_work).max(), np.abs(self.tangential_work).max()))
        return float(np.abs(self.residual).max()) / largest if largest > 0.0 else 0.0


def _balance(history: HistoryResult) -> EnergyBalance:
    from scipy.integrate import cumulative_trapezoid

    force, approach, elastic = history.force, history.approach, history.elastic_energy
    adhesive = [0.0 if step.adhesion is None else step.adhesion.interface_energy for step in history.steps]
    force = force - [0.0 if step.adhesion is None else step.adhesion.attractive_force for step in history.steps]
    elastic = elastic + adhesive
    flowed = [step.plastic_flow for step in history.steps if step.plastic_flow is not None]
    elastic = elastic + ([each.residual_energy for each in flowed] or 0.0)
    plastic, pull = (
        np.cumsum(history.plastic_work + ([each.step_work for each in flowed] or 0.0)),
        force - history.external_force,
    )
    shear, along = _shear_works(history), _tangential_works(history)
    elastic = elastic + [  # that stored in viscoelastic bodies has it
        0.0 if step.stick_slip is None or step.creep is not None else step.stick_slip.tangential_energy
        for step in history.steps
    ]
    start = history.start
    adhesion = history.steps[0].adhesion is not None
    if not adhesion and (start is None or not start.pressure.any()):
        virgin = history.steps[0].problem.profile()
        dented = virgin if start is None else virgin - start.permanent_indentation - start.imprint
        approach = np.concatenate([[float(virgin.max() - dented.max())], approach])
        work, pulled = (cumulative_trapezoid(np.concatenate([[0.0], f]), approach) for f in (force, pull))
        shear, along = np.cumsum(shear), np.cumsum(along, axis=1)
    else:
        work, pulled = (cumulative_trapezoid(f, approach, initial=0) for f in (force, pull))
        if adhesion:
            work = adhesion_loop(history.steps).work + pulled
        elastic, plastic = elastic - elastic[0], plastic - plastic[0]
        shear, along = np.cumsum(shear) - shear[0], np.cumsum(along, axis=1) - along[:, :1]
    viscous, moments = np.zeros(elastic.shape), [step.creep for step in history.steps if step.creep is not None]
    if moments:
        work, viscous = np.cumsum([each.work for each in moments]), np.cumsum([each.dissipated for each in moments])
        if adhesion or (start is not None and start.pressure.any()):
            work, viscous = work - work[0], viscous - viscous[0]
    tangential, slip, taken = along
    found = EnergyBalance(work, pulled, elastic, plastic, shear, tangential, slip, taken, viscous, np.zeros(work.shape))
    return replace(found, jump_work=_jump_works(history, found.residual))


def _jump_works(history: HistoryResult, left: RealArray) -> RealArray:
    """Energy (J) lost in jumps up to each step: of what nothing else takes, ``left``, the part of the steps with a jump."""
    jumped = np.array([step.adhesion is not None and step.adhesion.jumped for step in history.steps])
    jumped[0] = False  # from which energies are counted
    lost: RealArray = np.cumsum(np.where(jumped, np.diff(left, prepend=0.0), 0.0))
    return lost


def _shear_works(history: HistoryResult) -> RealArray:
    """Σ p du (J) of the displacement by shear in every step, by the mean of the pressures before and after."""
    pixel, works = history.steps[0].problem.grid.pixel_area, []
    none = np.zeros(history.steps[0].pressure.shape)
    pressure: RealArray = none
    lift: RealArray = none
    for result in history.steps:
        if result.creep is not None:  # through its steps of time
            works.append(result.creep.shear_work)
            continue
        now = none if result.sliding is None else result.sliding.shear_displacement
        works.append(0.5 * float(((result.pressure + pressure) * (now - lift)).sum()) * pixel)
        pressure, lift = result.pressure, now
    return np.array(works)


def _tangential_works(history: HistoryResult) -> RealArray:
    """(3, steps): Q·Δδ, energy dissipated by slip and ½ Σ Δq·Δu (J) of every step; zero without stick and slip."""
    pixel, works = history.steps[0].problem.grid.pixel_area, np.zeros((3, len(history.steps)))
    before = None
    for number, result in enumerate(history.steps):
        now = result.stick_slip
        if now is None:
            continue
        moved = np.array([now.shift_x, now.shift_y, now.twist])
        traction, displacement = now.traction, now.tangential_displacement
        if before is not None:
            moved = moved - [before.shift_x, before.shift_y, before.twist]
            traction, displacement = traction - before.traction, displacement - before.tangential_displacement
        works[1, number], creep = now.dissipated, result.creep
        if creep is None:
            works[0, number] = now.work_by(moved, displacement, pixel)
            works[2, number] = 0.5 * float(np.einsum("kij,kij->", traction, displacement)) * pixel
        else:
            works[0, number], works[2, number] = creep.tangential_work, creep.step_work
        before = now
    return works
