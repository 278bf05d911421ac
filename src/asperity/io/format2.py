"""Result files of format 2, which were written until the codec: read to the bit, never written.

What couplings found stood in fields, groups and JSON texts of each kind; displacement and gap of
every step of a load path were whole. Groups of rolling contacts and of states of finite elements
stayed so for a while in files of format 3.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import Any, NamedTuple, get_type_hints

import numpy as np

from ..contact.certificate import Certificate
from ..contact.couplings.protocol import Memory
from ..contact.history import HistoryResult
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..contact.state import InterfaceState
from ..core.registry import OLDER, RESULTS, home
from ..core.status import Outcome, Status
from ..fem.contact import Equilibrium
from ..fem.history import PlasticZone
from ..solids.plasticity import PlasticState
from .contacts import EARLIER, fields_in, problem_in
from .description import rebuild
from .paths import scalars_in, status_in
from .soundness import sound
from .tree import Node
from .words import FIELDS

_CHECKS = ("couplings", "rounds", "complementarity", "pressure_error")
"""Entries of the certificate that older files lack, written as JSON texts."""


class Older(NamedTuple):
    """What a file holds of a contact or of one step of a load path, for those who know what their
    couplings found in it.

    Attributes
    ----------
    problem
        What was solved.
    values
        Fields, numbers and texts by name, those of a group of its own after the name of the group.
    rows
        Rows of a contact or step by the names of their counts and of the variable.
    memory
        What couplings remember, where that is known by their names: of a contact, and of the last
        step.
    past
        What relaxing bodies remember after a step before the last; None if it is not there.
    """

    problem: ContactProblem
    values: Mapping[str, Any]
    rows: Callable[[str, str], Any]
    memory: Mapping[str, Memory]
    past: Memory | None = None


def _found_in(at: Older) -> tuple[dict[str, Any], dict[str, Memory]]:
    """What the couplings found and what follows from it for their memories, by their names."""
    told = {name: found for name, place in OLDER.items() if (found := home(place)(at)) is not None}
    memories = {name: memory for name, (_, memory) in told.items() if memory is not None}
    return {name: answer for name, (answer, _) in told.items()}, memories


def contact_in(groups: Mapping[str, Node]) -> ContactResult:
    """The contact that the ``groups`` of a file hold.

    Raises
    ------
    KeyError, ValueError
        If something is missing, or contradicts itself.
    """
    node, memory = groups["contact"], groups.get("memory")
    attributes, arrays = node.attributes, fields_in(node)
    problem, control = problem_in(node, arrays)
    memories = {} if memory is None else {name: _memory(child) for name, child in memory.children.items()}
    values = {item.quantity.name: item.values for item in node.values} | arrays
    values |= {key: text for key, text in attributes.items() if key.endswith("_found")}
    for name, group in groups.items():
        more = {item.quantity.name: item.values for item in group.values} | dict(group.attributes)
        values |= {f"{name}_{key}": value for key, value in more.items() if group is not node}
    couplings, following = _found_in(Older(problem, values, lambda counts, name: values[name], memories))
    found = ContactResult(
        problem=problem,
        control=control,
        plastic=arrays["plastic"].astype(bool),
        certificate=_certificate(attributes),
        status=status_in(attributes),
        citation_keys=tuple(attributes["citation_keys"].split()),
        couplings=couplings,
        memory=memories | following,
        earlier=arrays.get(EARLIER.name),
        **dict[str, Any]((item.name, arrays[item.name]) for item in FIELDS),
        **scalars_in({item.quantity.name: item.values for item in node.values}),
    )
    return sound(found)


def path_from(node: Node, last: ContactResult) -> HistoryResult:
    """The load path of a group; ``last`` is the contact at its end, whose problem all steps
    share."""
    count, results = len(node["n_spots"]), list[ContactResult]()
    start = None
    if "start_pressure" in node:
        memory = {name: _memory(child) for name, child in node.children["start"].children.items()}
        start = InterfaceState(node["start_pressure"], memory, node.get("start_earlier"))
    before = None if start is None or not start.pressure.any() else start.pressure
    pasts = {name: _memory(child) for name, child in node.children.get("pasts", Node()).children.items()}
    for step in range(count):
        at = {item.quantity.name: item.values[step] for item in node.values if item.quantity.dims[:1] == ("step",)}

        def rows(counts: str, name: str, step: int = step) -> Any:
            end = int(np.asarray(node[counts])[: step + 1].sum())
            return np.asarray(node[name])[end - int(node[counts][step]) : end]

        known = last.memory if step == count - 1 else {}
        couplings, following = _found_in(Older(last.problem, at, rows, known, pasts.get(f"step_{step}")))
        memories = json.loads(at["memory"]).items()  # but for what fields are kept of
        result = replace(
            last,
            control=rebuild(json.loads(at["control"])),
            plastic=np.asarray(at["plastic"]),
            certificate=_certificate(
                {name: (value.item() if isinstance(value, np.generic) else value) for name, value in at.items()}
            ),
            status=status_in(at),
            couplings=couplings,
            memory={name: {key: np.asarray(value) for key, value in each.items()} for name, each in memories}
            | following,
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


def _memory(node: Node) -> dict[str, Any]:
    """Named arrays of a group."""
    return {item.quantity.name: np.asarray(item.values) for item in node.values}


# Rolling contacts and states of finite elements.


def kept_from(node: Node, name: str, contact: ContactResult | None) -> Any:
    """The rolling contact beside a ``contact``, or the state of finite elements, of a group of that
    ``name``.

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
    """Arrays and numbers of the fields of ``kind`` in a group, where empty arrays stood as their
    shapes."""
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
