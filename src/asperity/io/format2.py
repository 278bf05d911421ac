"""Result files of format 2, which were written until the codec: read to the bit, never written.

What couplings found stood in fields, groups and JSON texts of each kind; displacement and gap of every step of a load path were whole. Groups of rolling contacts
and of states of finite elements stayed so for a while in files of format 3.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any, get_type_hints

import numpy as np

from ..contact.certificate import Certificate
from ..contact.history import HistoryResult
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..contact.state import InterfaceState
from ..core.registry import RESULTS, home
from ..core.status import Outcome, Status
from ..fem.contact import Equilibrium
from ..fem.history import PlasticZone
from ..physics.adhesion.answer import AdhesiveContact
from ..physics.adhesion.law import Adhesion
from ..physics.friction.answer import StickSlip
from ..physics.friction.law import Coulomb, FrictionLaw
from ..physics.friction.sliding import GrossSliding
from ..physics.menisci.coupling import Menisci
from ..physics.menisci.film import wetting
from ..physics.plastic_flow.coupling import found_in
from ..physics.viscoelastic.moments import COLUMNS, Creeping
from ..solids.plasticity import PlasticState
from .contacts import EARLIER, fields_in, problem_in
from .description import rebuild
from .paths import scalars_in, status_in
from .soundness import sound
from .tree import Node
from .words import FIELDS

_CHECKS = ("couplings", "rounds", "complementarity", "pressure_error")
"""Entries of the certificate that older files lack, written as JSON texts."""

_STICK_SLIP, _ADHESION, _CREEP, _FLOW = "stick_slip", "adhesion", "creep", "plastic_flow"
"""Couplings."""

_VECTORS = ("traction", "slip_increment", "slip", "tangential_displacement")
"""Fields of stick and slip whose components along x and y stood apart."""

_SHEAR = ("tangential", "status", "law", *_VECTORS)

_LATER = ("shear_work", "missed", "explained", "largest_work")
"""Numbers of viscoelastic steps that older files do not hold."""

_POINTS = ("points", "plastic_strain", "back_stress", "accumulated")
_EACH = ("lift", "first", "work", "step_work", "energy", "iterations")
"""Memory of plastic flow: what is as long as there are points, and what every step has one of."""


def contact_in(groups: Mapping[str, Node]) -> ContactResult:
    """The contact that the ``groups`` of a file hold.

    Raises
    ------
    KeyError, ValueError
        If something is missing, or contradicts itself.
    """
    node, film, memory, shear, creep = (groups.get(n) for n in ("contact", "film", "memory", _STICK_SLIP, _CREEP))
    assert node is not None
    attributes, arrays = node.attributes, fields_in(node)
    problem, control = problem_in(node, arrays)
    numbers = None if film is None or "menisci" not in film.attributes else film.attributes["menisci"]
    couplings = _couplings(problem, arrays, numbers, attributes.get("adhesion_found")) | _creep_in(creep)
    memories = {} if memory is None else {name: _memory(child) for name, child in memory.children.items()}
    if problem.plastic_flow is not None:
        couplings[_FLOW] = found_in(problem, memories.get(_FLOW, {}))
    if shear is not None and problem.friction is not None:
        stored = {**shear.attributes, **{item.quantity.name: item.values for item in shear.values}}
        couplings[_STICK_SLIP] = _shear(stored, problem.friction)
    found = ContactResult(
        problem=problem,
        control=control,
        plastic=arrays["plastic"].astype(bool),
        certificate=_certificate(attributes),
        status=status_in(attributes),
        citation_keys=tuple(attributes["citation_keys"].split()),
        couplings=couplings,
        memory=memories | _following(couplings, arrays["gap"], float(node["approach"])),
        earlier=arrays.get(EARLIER.name),
        **dict[str, Any]((item.name, arrays[item.name]) for item in FIELDS),
        **scalars_in({item.quantity.name: item.values for item in node.values}),
    )
    return sound(found)


def path_from(node: Node, last: ContactResult) -> HistoryResult:
    """The load path of a group; ``last`` is the contact at its end, whose problem all steps share."""
    count, results = len(node["n_spots"]), list[ContactResult]()
    start = None
    if "start_pressure" in node:
        memory = {name: _memory(child) for name, child in node.children["start"].children.items()}
        start = InterfaceState(node["start_pressure"], memory, node.get("start_earlier"))
    before = None if start is None or not start.pressure.any() else start.pressure
    for step in range(count):
        at = {item.quantity.name: item.values[step] for item in node.values if item.quantity.dims[:1] == ("step",)}
        couplings, friction = _couplings(last.problem, at, at.get("menisci"), at.get(_ADHESION)), last.problem.friction
        if "stick_slip_tangential" in at and friction is not None:
            couplings[_STICK_SLIP] = _shear(at, friction, "stick_slip_")
        flow = _flow(node, at, step)
        couplings |= _creep_at(node, at, step)
        if last.problem.plastic_flow is not None:
            couplings[_FLOW] = found_in(last.problem, flow.get(_FLOW, {}))
        result = replace(
            last,
            control=rebuild(json.loads(at["control"])),
            plastic=np.asarray(at["plastic"]),
            certificate=_certificate(
                {name: (value.item() if isinstance(value, np.generic) else value) for name, value in at.items()}
            ),
            status=status_in(at),
            couplings=couplings,
            memory=_memories(at["memory"])
            | flow
            | _following(couplings, at["gap"], float(at["approach"]))
            | ({_CREEP: last.memory[_CREEP]} if _CREEP in couplings and step == count - 1 else _past(node, step)),
            earlier=before,
            **{item.name: at[item.name] for item in FIELDS},
            **scalars_in(at),
        )
        before = (result.pressure if result.pressure.any() else None) if result.converged else before
        results.append(sound(result))
    return HistoryResult(tuple(results), start)


def _certificate(attributes: Mapping[str, Any]) -> Certificate:
    found = {f.name: attributes[f"certificate_{f.name}"] for f in fields(Certificate) if f.name not in _CHECKS}
    for name in _CHECKS:
        if f"certificate_{name}" in attributes:
            found[name] = rebuild(json.loads(attributes[f"certificate_{name}"]))
    return Certificate(**found)


def _couplings(
    problem: ContactProblem, arrays: Mapping[str, Any], numbers: str | None, text: str | None
) -> dict[str, Any]:
    """What the couplings found, from the fields of a contact, the ``numbers`` of its menisci and the ``text`` of its adhesion."""
    law = problem.adhesion
    found: dict[str, Any] = {} if law is None or text is None else {_ADHESION: _adhesion(arrays, law, str(text))}
    if problem.film is not None and numbers is not None:
        contact = arrays["pressure"] > 0.0
        stands = wetting(arrays["gap"], contact, problem.film, wraps=problem.boundary.wraps)
        stored = {name: rebuild(value) for name, value in json.loads(numbers).items()}
        found["menisci"] = Menisci(problem.film, stands, **stored)
    friction = problem.friction
    if isinstance(friction, Coulomb) and "shear_displacement" in arrays:
        found["sliding"] = GrossSliding(friction.coefficient, friction.direction, arrays["shear_displacement"])
    return found


def _adhesion(source: Mapping[str, Any], law: Adhesion, text: str) -> AdhesiveContact:
    """Adhesion of a group or a step, whose variables are ``source``, from its ``text``."""
    numbers = {key: rebuild(value) for key, value in json.loads(text).items()}
    ended = numbers.pop("status")
    status = Status(Outcome(ended[0]), ended[1], ended[2])
    return AdhesiveContact(law=law, attraction=np.asarray(source["attraction"]), status=status, **numbers)


def _following(couplings: Mapping[str, Any], gap: Any, approach: float) -> dict[str, Any]:
    """Memories that follow from what the couplings found, and from the ``gap`` (nx, ny) and the ``approach`` in m."""
    found = {_STICK_SLIP: couplings[_STICK_SLIP].memory} if _STICK_SLIP in couplings else {}
    return found | ({_ADHESION: couplings[_ADHESION].memory(gap, approach)} if _ADHESION in couplings else {})


def _shear(source: Mapping[str, Any], law: FrictionLaw, prefix: str = "") -> StickSlip:
    """Stick and slip from the variables of a group, or of one step of a history, by name."""
    found: dict[str, Any] = {name: np.stack([source[f"{prefix}{name}_{axis}"] for axis in "xy"]) for name in _VECTORS}
    for item in fields(StickSlip):
        if item.name not in _SHEAR:
            value = np.asarray(source[f"{prefix}{item.name}"])
            found[item.name] = value if value.ndim else value.item()
    ended = [str(source[f"{prefix}status_{name}"]) for name in ("outcome", "message", "remedy")]
    tangential = rebuild(json.loads(str(source[f"{prefix}tangential"])))
    return StickSlip(law=law, tangential=tangential, status=Status(Outcome(ended[0]), ended[1], ended[2]), **found)


def _creep_in(node: Node | None) -> dict[str, Any]:
    """What happened in time, by the name of the coupling, from its group."""
    if node is None:
        return {}
    values = {item.quantity.name: item.values for item in node.values}
    records = np.stack([np.asarray(values[item.name]) for item in COLUMNS], axis=1)
    return {_CREEP: _creeping(records, values, "")}


def _creep_at(node: Node, at: Mapping[str, Any], step: int) -> dict[str, Any]:
    """The same of one ``step`` of a history, from its group and what it holds ``at`` that step."""
    if "creep_moments" not in at:
        return {}
    ends = np.cumsum(node["creep_moments"])
    rows = slice(int(ends[step] - at["creep_moments"]), int(ends[step]))
    records = np.stack([np.asarray(node[f"creep_{item.name}"])[rows] for item in COLUMNS], axis=1)
    return {_CREEP: _creeping(records, at, "creep_")}


def _creeping(records: Any, values: Mapping[str, Any], prefix: str) -> Creeping:
    names = [item.name for item in fields(Creeping) if item.name not in ("records", "retarded_displacement")]
    there = [name for name in names if name not in _LATER or f"{prefix}step_{name}" in values]
    numbers: dict[str, Any] = {name: np.asarray(values[f"{prefix}step_{name}"]).item() for name in there}
    return Creeping(records, np.asarray(values[f"{prefix}retarded_displacement"]), **numbers)


def _past(node: Node, step: int) -> dict[str, Any]:
    """What relaxing bodies remember after one ``step`` of the history in a group, by the name of the coupling; nothing if it is not there."""
    pasts = node.children.get("pasts", Node()).children
    name = f"step_{step}"
    return {_CREEP: _memory(pasts[name])} if name in pasts else {}


def _flow(node: Node, at: Mapping[str, Any], step: int) -> dict[str, Any]:
    """Memory of plastic flow, by the name of the coupling, after one ``step`` of a history, from its group and what it holds ``at`` that step."""
    if not at.get("plastic_flow_points_count"):
        return {}
    found: dict[str, Any] = {name: np.asarray(at[f"plastic_flow_{name}"]) for name in _EACH}
    for name in (*_POINTS, "edges"):
        counts = np.asarray(node[f"plastic_flow_{'edges' if name == 'edges' else 'points'}_count"])
        end = int(counts[: step + 1].sum())
        found[name] = np.asarray(node[f"plastic_flow_{name}"])[end - int(counts[step]) : end]
    return {_FLOW: found}


def _memory(node: Node) -> dict[str, Any]:
    """Named arrays of a group."""
    return {item.quantity.name: np.asarray(item.values) for item in node.values}


def _memories(text: str) -> dict[str, Any]:
    """Memories of the couplings, but for what fields are kept of, from JSON."""
    return {key: {name: np.asarray(value) for name, value in item.items()} for key, item in json.loads(text).items()}


# Rolling contacts and states of finite elements.


def kept_from(node: Node, name: str, contact: ContactResult | None) -> Any:
    """The rolling contact beside a ``contact``, or the state of finite elements, of a group of that ``name``.

    Raises
    ------
    KeyError, ValueError
        If something is missing, or contradicts itself.
    """
    kind = home(RESULTS[name].home)
    if name == "rolling_contact":
        return _rolling(kind, node, contact)
    if name == "pass_state":
        made = kind(plastic=PlasticState(*_arrays(node, PlasticState)), **_named(node, kind, "plastic"))
    else:
        place, zones = node.children["equilibrium"], node.children["zones"]
        balance = _named(place, Equilibrium, "state")
        balance |= {key: np.asarray(balance[key]).astype(bool) for key in ("touching", "slipping")}
        balance |= {"residuals": tuple(balance["residuals"].tolist()), "cuts": int(balance["cuts"])}
        columns = [np.atleast_1d(column) for column in _arrays(zones, PlasticZone)]
        rows = [[tuple(map(float, v)) if np.ndim(v) else float(v) for v in row] for row in zip(*columns, strict=True)]
        flowed = tuple(PlasticZone(int(first), *rest) for first, *rest in rows)  # type: ignore[arg-type]
        now = Equilibrium(state=PlasticState(*_arrays(place, PlasticState)), **balance)
        made = kind(now, zones=flowed, **_named(node, kind, "equilibrium", "zones"))
    made.require_sound()
    return made


def _rolling(kind: Any, node: Node, normal: ContactResult | None) -> Any:
    assert normal is not None
    attributes, arrays = node.attributes, {item.quantity.name: np.asarray(item.values) for item in node.values}
    values: dict[str, Any] = {key: np.stack([arrays[f"{key}_{axis}"] for axis in "xy"]) for key in ("traction", "slip")}
    numbers = ("force_x", "force_y", "torque", "friction_limit", "dissipated", "steadiness", "steps")
    values |= {key: arrays[key].item() for key in numbers}
    ended = [str(attributes[f"status_{part}"]) for part in ("outcome", "message", "remedy")]
    made = kind(
        normal=normal,
        creepage=get_type_hints(kind)["creepage"](**json.loads(attributes["creepage"])),
        power_density=arrays["power_density"],
        status=Status(Outcome(ended[0]), ended[1], ended[2]),
        law=rebuild(json.loads(attributes["law"]), arrays),
        direction=attributes["direction"],
        **values,
    )
    made.require_sound()
    return made


def _arrays(node: Node, kind: type) -> list[Any]:
    """Arrays and numbers of the fields of ``kind`` in a group, where empty arrays stood as their shapes."""
    return list(_named(node, kind).values())


def _named(node: Node, kind: type, *but: str) -> dict[str, Any]:
    """The same by name, ``but`` for some."""
    empty, found = json.loads(node.attributes["empty"]), dict[str, Any]()
    for item in fields(kind):
        if item.name not in but:
            value = np.zeros(empty[item.name]) if item.name in empty else np.asarray(node[item.name])
            if value.dtype.kind not in "fbiu":
                raise ValueError(f"{item.name}: it is no number")
            found[item.name] = value if value.ndim else value.item()
    return found
