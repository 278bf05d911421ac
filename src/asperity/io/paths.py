"""Load paths in result files: of every step what cannot be computed again, and back.

A step of an elastic or plastic contact is its pressures on the contact set, its permanent
indentation and its numbers; displacement and gap come back by one transform of the pressures when
they are first read, within ``rounding``, which the file states of every step. Where couplings
displace the surfaces or the bodies relax, both are stored whole. The states of all steps are, to
the bit.
"""

from __future__ import annotations

import json
import math
import weakref
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from ..contact.certificate import Certificate
from ..contact.history import EnergyBalance, HistoryResult
from ..contact.operators import Operator, prepare_operator
from ..contact.problem import ContactProblem
from ..contact.result import OF_EDGES, ContactResult, Later, unindented
from ..contact.state import InterfaceState
from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError
from ..core.grid import Grid
from ..core.quantity import Labelled, Quantity
from ..core.status import Status
from .codec import Steps, made_of, stacked, values_of
from .couplings import answers_group, answers_in, memories_group, memories_in
from .description import describe, rebuild
from .soundness import agrees, sound
from .tree import Node, coordinate
from .words import ALL_SCALARS, CERTIFICATE, FIELDS

BLOCK = 128e6
"""Bytes of fields, packed or not, that are laid together for writing."""

_WHOLE = 5
"""Fields of a step where those that couplings find and remember are whole, about."""

ROUNDING = Quantity("rounding", "m", "bound of the error of displacement and gap that come back")

ENERGIES = (
    Quantity("external_work", "J", "external work along the path"),
    Quantity("meniscus_work", "J", "part of the external work that menisci do"),
    Quantity("elastic_energy", "J", "elastic energy gained along the path"),
    Quantity("plastic_work", "J", "plastic work along the path"),
    Quantity("shear_work", "J", "work of the displacement by the shear of gross sliding along the path"),
    Quantity("tangential_work", "J", "work of the tangential force along the path, those at the ends of the steps"),
    Quantity("slip_work", "J", "energy dissipated by slip along the path"),
    Quantity("viscous_work", "J", "heat of viscoelastic bodies along the path"),
    Quantity("jump_work", "J", "energy lost in jumps of adhesive contacts along the path"),
    Quantity("step_work", "J", "what the length of the implicit steps takes along the path"),
    Quantity("residual", "J", "external and tangential work less all other energies"),
)
"""Entries of an energy balance."""

NEITHER, STORED, AT_START = -1, -2, -3
"""What stands for the number of the step whose pressure is the earlier one of a step: there is
none, it is stored, or it is that of the start."""

_PRESSURE, _DISPLACEMENT, _GAP, _INDENTATION = (replace(item, dims=("x", "y")) for item in FIELDS)
_EARLIER = Quantity("earlier_pressure", "Pa", "pressure of the load before, where that is of no other step", ("x", "y"))
_EARLIER_OF = Quantity(
    "earlier_of",
    "1",
    "number of the step whose pressure is that of the load before; negative: see ``asperity.io.paths``",
)
_WHOLE_HERE = Quantity("whole", "1", "whether displacement and gap of the step are stored")
_INDENTED = Quantity("indented", "1", "whether the step has a permanent indentation that is stored")
_PLASTIC = Quantity("plastic", "1", "whether the pressure is at its limit", ("x", "y"))
_CONTROL = Quantity("control", "", "prescribed load or position, as JSON")
_CONVERGED = Quantity("converged", "1", "whether the step reached its tolerance")
_SPOTS = Quantity("spot_areas", "m**2", "areas of the contact spots, those of one step after the other", ("spot",))
_CHECKS = {f"certificate_{item.name}": item for item in CERTIFICATE}


def path_node(
    steps: HistoryResult | Iterable[ContactResult], start: InterfaceState | None = None, *, streamed: bool = False
) -> Node:
    """Group of a load path with the axis ``step``; where it is ``streamed`` its steps follow in
    blocks, which are made as they are written.

    Of ``steps`` that are still being solved, from the interface ``start``, no more than a block is
    held, and the energies are left out: they follow from all.

    Raises
    ------
    InputError
        If there is no step.
    """
    balance = None
    if isinstance(steps, HistoryResult):
        start, balance = steps.start, steps.energies
    blocks = _blocks(iter(steps), start, balance, BLOCK if streamed else math.inf)
    first, grid, is_all = next(blocks, (None, None, True))
    if first is None or grid is None:
        raise InputError("load path to save must hold at least one step, but holds none.")
    x, y = grid.coordinates()
    lines = coordinate("x", x[:, 0]), coordinate("y", y[0])
    children = dict(first.children)
    if start is not None:
        values = [Labelled(_PRESSURE, start.pressure)]
        values += [] if start.earlier is None else [Labelled(_EARLIER, start.earlier)]
        children["start"] = Node(tuple(values), {}, memories_group([start]).children)
    # axes that may grow cost time for each variable of the group, 0.9 of 1.1 s for 41 steps of 64²
    # points
    following = () if is_all else (node for node, _, _ in blocks)
    lengths = {"step": len(steps)} if isinstance(steps, HistoryResult) else {}
    return replace(first, values=(*lines, *first.values), children=children, rows=following, lengths=lengths)


def _blocks(
    steps: Iterator[ContactResult], start: InterfaceState | None, balance: EnergyBalance | None, most: float
) -> Iterator[tuple[Node, Grid, bool]]:
    """Groups of ``steps``, each of fields of ``most`` bytes, or of one step, and their grid; and
    whether it is known that no other follows."""
    rows, block, size, highest = list[dict[str, Labelled]](), list[ContactResult](), 0.0, math.nan
    pressures = list[weakref.ref[RealArray]]()
    for number, step in enumerate(steps):
        problem = step.problem
        highest = float(np.abs(problem.profile()).max()) if number == 0 else highest
        values = [*_fields(step, highest), *_numbers(step), *_earlier(step, pressures, start)]
        if balance is not None:
            energies = ((q, getattr(balance, q.name)[number]) for q in ENERGIES)
            values += [Labelled(replace(q, name=f"path_{q.name}"), value) for q, value in energies]
        pressures.append(weakref.ref(step.pressure))
        rows.append({item.quantity.name: item for item in values})
        block.append(step)
        size += 8.0 * problem.grid.n_points * (_WHOLE if stored_whole(step) else 1)
        if size >= most:
            yield _block(rows, block), problem.grid, False
            rows, block, size = [], [], 0.0
    if block:
        yield _block(rows, block), block[-1].problem.grid, True


def _block(rows: Sequence[Mapping[str, Labelled]], steps: Sequence[ContactResult]) -> Node:
    """Group of some steps of a path."""
    children = {"couplings": answers_group(steps), "memory": memories_group(steps)}
    return Node(stacked(rows), {}, {name: node for name, node in children.items() if node.children}, packs=True)


def stored_whole(step: ContactResult) -> bool:
    """Whether displacement and gap of ``step`` do not follow from its pressure alone."""
    return any(
        found is not None
        for each in step.answers
        for found in (each.traction_beside(), each.lifted(), each.imprint(), each.retarded())
    )


def _fields(step: ContactResult, highest: float) -> Iterator[Labelled]:
    yield Labelled(_PRESSURE, step.pressure)
    # a map that was never written takes no memory until it is read
    elastic = not np.isfinite(step.problem.law.pressure_cap()).any()
    yield Labelled(_PLASTIC, np.broadcast_to(False, step.plastic.shape) if elastic else step.plastic)
    whole, indented = stored_whole(step), not isinstance(vars(step)["permanent_indentation"], Later)
    yield Labelled(_WHOLE_HERE, whole)
    if whole:
        yield Labelled(_DISPLACEMENT, step.displacement)
        yield Labelled(_GAP, step.gap)
    yield Labelled(ROUNDING, 0.0 if whole else rounding(step, highest))
    yield Labelled(_INDENTED, indented)
    if indented:
        yield Labelled(_INDENTATION, step.permanent_indentation)


def rounding(step: ContactResult, highest: float) -> float:
    """Bound (m) of the errors of displacement and gap that come back by one transform of the
    pressure; ``highest`` is the largest magnitude (m) of the profile.

    The solver adds the displacement up through its iterations, each with the rounding of its
    transforms: at most log2 of the number of points times that of numbers. The gap has the rounding
    of three further sums.
    """
    eps = float(np.finfo(step.pressure.dtype).eps)
    transforms = (step.certificate.iterations + 2.0) * (math.log2(step.problem.grid.n_points) + 1.0)
    largest = float(np.abs(step.displacement).max())
    return eps * (transforms * largest + 3.0 * (largest + abs(step.offset) + highest + step.max_permanent_indentation))


def _numbers(step: ContactResult) -> Iterator[Labelled]:
    for item in ALL_SCALARS:
        yield Labelled(item, getattr(step, item.name))
    for found in values_of(step.certificate, "certificate_"):
        known = _CHECKS.get(found.quantity.name)
        yield found if known is None else Labelled(replace(known, name=found.quantity.name), found.values)
    yield from values_of(step.status, "status_")
    yield Labelled(_CONVERGED, step.converged)
    yield Labelled(_CONTROL, json.dumps(describe(step.control)))
    yield Labelled(_SPOTS, step.spot_areas)


def _earlier(
    step: ContactResult, pressures: Sequence[weakref.ref[RealArray]], start: InterfaceState | None
) -> Iterator[Labelled]:
    """Of which step before, by their ``pressures``, the earlier pressure of ``step`` is, and that
    pressure if it is of none."""
    earlier = step.earlier
    of = NEITHER if earlier is None else STORED
    if earlier is not None and start is not None and earlier is start.pressure:
        of = AT_START
    elif earlier is not None:
        of = next((at for at in reversed(range(len(pressures))) if pressures[at]() is earlier), STORED)
    yield Labelled(_EARLIER_OF, of)
    if of == STORED:
        yield Labelled(_EARLIER, earlier)


# And back.


def path_from(node: Node, last: ContactResult) -> HistoryResult:
    """The load path of a group; ``last`` is the contact at its end, whose problem all steps share.

    Raises
    ------
    KeyError, ValueError
        If something is missing, or contradicts itself.
    """
    problem, rows = last.problem, Steps(node)
    start = None
    if (begun := node.children.get("start")) is not None:
        memory = memories_in(Node((), {}, begun.children))(0, {}, last.approach)
        start = InterfaceState(np.asarray(begun[_PRESSURE.name]), memory, begun.get(_EARLIER.name))
    answers = answers_in(node.children.get("couplings", Node()), problem)
    memories = memories_in(node.children.get("memory", Node()))
    back = ComesBack(problem)
    steps = list[ContactResult]()
    for number in range(len(node["control"])):
        at = rows.at(number)
        couplings = answers(number)
        made = partial(_step, at, last, back, couplings, memories(number, couplings, float(at["approach"])))
        of = int(at["earlier_of"])
        if of in (NEITHER, STORED):
            earlier = None if of == NEITHER else np.asarray(at[_EARLIER.name])
        elif of == AT_START:
            earlier = None if start is None else start.pressure
        else:
            earlier = steps[of].pressure
        steps.append(sound(made(earlier)))
    return HistoryResult((*steps[:-1], last), start)


def _step(
    at: Mapping[str, Any],
    last: ContactResult,
    back: ComesBack,
    couplings: Mapping[str, Any],
    memory: Mapping[str, Any],
    earlier: RealArray | None,
) -> ContactResult:
    """The result of one step from its values ``at`` hand."""
    shape = last.problem.grid.shape
    for item in (_PRESSURE, _PLASTIC, _DISPLACEMENT, _GAP, _INDENTATION):
        if item.name in at and (np.shape(at[item.name]) != shape or np.asarray(at[item.name]).dtype.kind not in "fbiu"):
            raise ValueError(f"{item.name}: it is no field like the heights")
    whole = bool(at[_WHOLE_HERE.name])
    if not math.isfinite(float(at[ROUNDING.name])):
        raise ValueError("rounding: it is not finite")
    stated = scalars_in(at)
    gap = at[_GAP.name] if whole else Later(partial(back.gap, float(stated["mean_gap"]), float(at[ROUNDING.name])))
    return ContactResult(
        problem=last.problem,
        control=rebuild(json.loads(at["control"])),
        pressure=np.asarray(at[_PRESSURE.name]),
        plastic=np.asarray(at[_PLASTIC.name]).astype(bool),
        displacement=at[_DISPLACEMENT.name] if whole else Later(back.displacement),
        gap=gap,
        permanent_indentation=at[_INDENTATION.name] if at[_INDENTED.name] else Later(unindented),
        certificate=certificate_in(at),
        status=status_in(at),
        citation_keys=last.citation_keys,
        couplings=couplings,
        memory=memory,
        earlier=earlier,
        **stated,
    )


@dataclass(frozen=True, eq=False)
class ComesBack:
    """Displacement and gap of contacts of one problem from their pressures."""

    problem: ContactProblem

    @cached_property
    def _operator(self) -> Operator:
        return prepare_operator(self.problem.compliance, self.problem.grid, self.problem.boundary)

    def displacement(self, result: ContactResult) -> RealArray:
        """(nx, ny) in m under the pressure of ``result``."""
        return np.asarray(self._operator.apply(np.asarray(result.pressure, dtype=float)), dtype=result.pressure.dtype)

    def gap(self, stated: float, rounding: float, result: ContactResult) -> RealArray:
        """(nx, ny) in m of the deformed surfaces of ``result``, whose mean is ``stated`` (m) to
        ``rounding`` (m).

        Raises
        ------
        FileFormatError
            If it is not.
        """
        gap = result.displacement + result.offset - self.problem.profile()
        if not isinstance(vars(result)["permanent_indentation"], Later):
            gap += result.permanent_indentation
        found: RealArray = np.maximum(gap, 0.0, out=gap)
        if not agrees(stated, mean := float(found.mean(dtype=np.float64)), result.pressure.dtype, rounding):
            raise FileFormatError(
                f"mean gap of a step in a result file must be that of its pressures, {mean:g} m, but is stated "
                f"as {stated:g} m."
            )
        return found


def scalars_in(source: Mapping[str, Any]) -> dict[str, Any]:
    """Scalars of a result by name, but for those that follow from its fields."""
    found = {}
    for item in ALL_SCALARS:
        if item.name not in OF_EDGES:
            value = source[item.name]
            found[item.name] = value.item() if isinstance(value, np.generic) else value
            if isinstance(value, str):
                raise ValueError(f"{item.name}: it is no number")
    return found


def certificate_in(source: Mapping[str, Any]) -> Certificate:
    """The certificate of values by name."""
    found: Certificate = made_of(Certificate, source, {}, "certificate_")
    return found


def status_in(source: Mapping[str, Any]) -> Status:
    """The status of values by name."""
    found: Status = made_of(Status, source, {}, "status_")
    return found
