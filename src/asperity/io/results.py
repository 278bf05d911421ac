"""Results as one labelled file: contacts with all their physics, and load paths, written whole, read back exactly."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, fields, replace
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..contact.certificate import Certificate
from ..contact.history import HistoryResult
from ..contact.problem import ContactProblem
from ..contact.result import OF_EDGES, ContactResult
from ..contact.state import InterfaceState
from ..core.arrays import RealArray, array_digest
from ..core.errors import FileFormatError, InputError
from ..core.quantity import Labelled, Quantity
from ..core.registry import PHYSICS
from ..core.status import Outcome, Status
from ..core.text import require_file
from ..physics.friction.law import Coulomb
from ..physics.friction.sliding import GrossSliding
from ..physics.menisci.coupling import Menisci
from ..physics.menisci.film import LiquidFilm, wetting
from ..physics.rolling.rolling import RollingContact
from ..physics.stress.field import StressField
from ..surfaces.surface import Origin, Surface
from .adhesion_files import (
    ADHESION,
    ATTRACTION,
    FOLLOWING,
    STICK_SLIP,
    adhesion_columns,
    adhesion_from,
    adhesion_text,
    following,
)
from .creep_files import CREEP, creep_columns, creep_from, creep_group, creep_in, creep_pasts, past_from
from .description import describe, provenance, rebuild, software, surface_provenance
from .flow_files import FLOW, flow_columns, flow_found, flow_from
from .memory_files import memories_of, memory_in, memory_node
from .menisci_files import NUMBERS, menisci_columns, menisci_from, menisci_group
from .old_files import grouped
from .rolling_files import ROLLING, rolling_in, rolling_node
from .shear_files import PREFIX, shear_columns, shear_from, shear_in, shear_node
from .soundness import sound
from .stress_files import field_from, field_node
from .tree import Node, coordinate, datatree, read_tree, require_sound_heaps, write_tree
from .words import ALL_SCALARS, CERTIFICATE, FIELDS

if TYPE_CHECKING:
    import xarray

    from ..fem.history import IndentationState
    from ..fem.passes import PassState

_STORED = tuple(item for item in ALL_SCALARS if item.name not in OF_EDGES)
"""Scalars that are read from files."""

Result: TypeAlias = "ContactResult | HistoryResult | RollingContact | StressField | IndentationState | PassState"
"""What result files hold."""

PARTS = ("body", "counter_body", "boundary", "law", "control")
"""Attributes that describe problem and control, each a JSON text."""

_CHECKS = ("couplings", "rounds", "complementarity", "pressure_error")
"""Entries of the certificate that older files lack, written as JSON texts."""


LIFT = Quantity("shear_displacement", "m", "normal displacement by shear")
"""Field of a sliding contact."""

EARLIER = Quantity("earlier_pressure", "Pa", "pressure of the load before")
"""Field from which the pressure of the next load is extrapolated."""

MARKS = (
    Quantity("contact", "1", "whether the bodies touch"),
    Quantity("plastic", "1", "whether the pressure is at its limit"),
)
"""Fields of true and false."""

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

SPOTS = Quantity("spot_areas", "m**2", "areas of the contact spots", dims=("spot",))
"""Areas of contact spots, largest first; of a load path those of one step after the other."""

MAPS = {
    item.name: item
    for item in (
        Quantity("Coulomb_coefficient", "1", "friction coefficient"),
        Quantity("TrescaFriction_strength", "Pa", "shear strength of the interface"),
    )
}
"""Maps of the laws of friction; any other map of a law is one of the hardness."""


def save(result: Result, path: str | Path, *, document: str | None = None, overwrite: bool = False) -> None:
    """Write ``result``, and the text of the problem ``document`` it came from, to the NetCDF-4 file ``path``.

    The file has one group for each part of the result, units and long names on every variable; ``load`` gives an equal result.

    Raises
    ------
    OutputError
        If the file does not end in .nc, exists and ``overwrite`` is false, or cannot be written.
    InputError
        If the problem holds a type that files cannot hold.
    """
    write_tree(result_tree(result, document=document), path, overwrite=overwrite)


def load(path: str | Path) -> Any:
    """The result in the file ``path``, equal to the one that was saved: same fields to the bit, same problem.

    A ``ContactResult``, ``HistoryResult``, ``RollingContact`` or ``StressField``, or a state of finite elements from which a history goes on; of the
    outcome of a document the contact.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, not NetCDF-4, not a result of asperity, or of a newer format.
    """
    return result_in(stored_tree(path, without=("planes", "stress")), path)


def open_tree(path: str | Path) -> xarray.DataTree:
    """The result file ``path`` as ``xarray.DataTree`` in memory, for analysis; the same as ``to_xarray`` of what it holds.

    Raises
    ------
    FileFormatError
        As for ``load``.
    """
    return datatree(stored_tree(path))


def to_xarray(result: Result, *, document: str | None = None) -> xarray.DataTree:
    """``result`` as ``xarray.DataTree``: one group for each part, units and long names on every variable.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    return datatree(result_tree(result, document=document))


def stored_tree(path: str | Path, *, without: tuple[str, ...] = ()) -> Node:
    """The tree in the result file ``path``, also of one written before files had groups.

    Raises
    ------
    FileFormatError
        As for ``load``.
    """
    tree = read_tree(path, without=without)
    return grouped(tree) if tree.attributes["asperity_format"] == 1 else tree


def document_in(path: str | Path) -> str | None:
    """Text of the problem document in the result file ``path``, None if it was saved without one.

    Raises
    ------
    FileFormatError
        If the file is missing or no NetCDF-4 file.
    """
    import h5py

    try:
        require_sound_heaps(require_file(path, "result file"))
        with h5py.File(path, "r") as file:
            text = file.attrs.get("document")
    except FileFormatError:
        raise
    except Exception as error:  # the library raises many types on foreign or damaged bytes
        raise FileFormatError(f"result file must be a whole NetCDF-4 file, but {path} is not ({error}).") from error
    return None if text is None else str(text)


def contact_of(result: Any) -> ContactResult:
    """The contact of a ``result``: of a load path that at its end, of a rolling contact the normal one.

    Raises
    ------
    InputError
        If it is a stress field or a state of finite elements.
    """
    found = result.last if isinstance(result, HistoryResult) else result
    found = found.normal if isinstance(found, RollingContact) else found
    if not isinstance(found, ContactResult):
        raise InputError(f"result file must hold a contact for this, but holds a {type(result).__name__}.")
    return found


def result_in(tree: Node, path: str | Path) -> Any:
    """The result that the ``tree`` of the file ``path`` holds.

    Raises
    ------
    FileFormatError
        If it holds none, or not the whole of one.
    """
    groups = tree.children
    with whole(path):
        if "tractions" in groups:
            raise FileFormatError(
                f"result file must hold a contact or a stress field, but {path} holds stresses under prescribed tractions; read it with open_tree."
            )
        if "contact" not in groups and "field" in groups:
            return field_from(groups["field"])
        if any(name.endswith("_state") for name in groups):
            from .fem_files import state_in

            return state_in(groups)
        if "path" in groups and "control" not in groups["path"]:
            raise FileFormatError(
                f"load path in {path} must be read with open_tree: files of format 1 hold no whole results."
            )
        result = contact_from(groups["contact"], *map(groups.get, ("film", "memory", STICK_SLIP, CREEP)))
        if "path" in groups and "of_outcome" not in tree.attributes:
            return path_from(groups["path"], result)
        if ROLLING in groups:
            return rolling_in(groups[ROLLING], result)
        if "film" in groups and "stored_rounds" in groups["film"].attributes:
            return _with_film(groups["film"], result)
        return result


@contextmanager
def whole(path: str | Path) -> Iterator[None]:
    """Within it, whatever is missing or wrong in what the file ``path`` holds is a ``FileFormatError``."""
    try:
        yield
    except FileFormatError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, AssertionError, RuntimeError) as error:
        reason = " ".join(f"{type(error).__name__} {error}".split())[:200]
        raise FileFormatError(
            f"result file must hold a whole result, but {path} lacks or garbles something ({reason})."
        ) from error


def result_tree(result: Result, *, document: str | None = None) -> Node:
    """Tree of ``result``: what files hold and ``to_xarray`` gives.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    if isinstance(result, StressField):
        described = {"created": datetime.now(UTC).isoformat(timespec="seconds"), "software": software()}
        return Node(
            (), {"title": "stress inside a body", "provenance": json.dumps(described)}, {"field": field_node(result)}
        )
    if isinstance(result, HistoryResult):
        groups = result_tree(result.last).children
        return Node((), root_attributes(result.last, document), {**groups, "path": path_node(result)})
    if isinstance(result, ContactResult):
        groups = {"contact": contact_node(result)}
        groups |= {} if result.menisci is None else {"film": film_node(result, result.menisci)}
        shear = result.stick_slip
        groups |= {} if shear is None else {STICK_SLIP: shear_node(shear, grid_lines(result))}
        groups |= creep_group(result, grid_lines(result))
        memories = {name: memory_node(memory) for name, memory in result.memory.items() if name not in FOLLOWING}
        groups |= {"memory": Node((), {}, memories)} if memories else {}
        return Node((), root_attributes(result, document), groups)
    if isinstance(result, RollingContact):
        groups = result_tree(result.normal).children
        own = {ROLLING: rolling_node(result, grid_lines(result.normal))}
        return Node((), root_attributes(result.normal, document), {**groups, **own})
    from .fem_files import FemState, state_tree

    if isinstance(result, FemState):
        return state_tree(result)
    raise InputError(
        f"result to save must be a result of solve or roll, a load path, a stress field or a state of finite elements, but is {type(result).__name__}."
    )


def root_attributes(
    result: ContactResult, document: str | None, packages: Mapping[str, str] = MappingProxyType({})
) -> dict[str, Any]:
    """What describes a whole file: title, provenance (with ``packages``), citation keys, and the text of the ``document``."""
    attributes = {
        "title": "contact of rough surfaces",
        "provenance": json.dumps(provenance(result, packages)),
        "citation_keys": " ".join(result.citation_keys),
    }
    return attributes if document is None else attributes | {"document": document}


def contact_node(result: ContactResult) -> Node:
    """Group of a contact: heights, fields and scalars; problem, control, certificate and status as attributes."""
    problem, arrays = result.problem, dict[str, RealArray]()
    owners: dict[str, Any] = {"control": result} | dict.fromkeys(PARTS[:4], problem)
    attributes = {part: json.dumps(describe(getattr(owners[part], part), arrays, part)) for part in PARTS}
    values = [*grid_lines(result), _field(Quantity("heights", "m", "heights of the surface"), problem.surface.heights)]
    attributes |= {item.keyword: json.dumps(describe(item.given, arrays, item.keyword)) for item in problem.physics}
    attributes["surface"] = _surface_text(problem.surface)
    if isinstance(problem.counter_surface, Surface):
        quantity = Quantity("counter_heights", "m", "heights of the counter surface")
        values.append(_field(quantity, problem.counter_surface.heights))
        attributes["counter_surface"] = _surface_text(problem.counter_surface)
    values += [_field(item, getattr(result, item.name)) for item in (*FIELDS, *MARKS)]
    values += [] if result.sliding is None else [_field(LIFT, result.sliding.shear_displacement)]
    if result.adhesion is not None:
        values.append(_field(ATTRACTION, result.adhesion.attraction))
        attributes["adhesion_found"] = adhesion_text(result.adhesion)
    values += [] if result.earlier is None else [_field(EARLIER, result.earlier)]
    values += [_field(MAPS.get(name, Quantity(name, "Pa", "hardness")), array) for name, array in arrays.items()]
    values += [Labelled(SPOTS, result.spot_areas)]
    values += [Labelled(item, getattr(result, item.name)) for item in ALL_SCALARS]
    attributes["citation_keys"] = " ".join(result.citation_keys)
    return Node(tuple(values), attributes | _checks(result.certificate) | status_attributes(result.status))


def contact_from(
    node: Node,
    film: Node | None = None,
    memory: Node | None = None,
    shear: Node | None = None,
    creep: Node | None = None,
) -> ContactResult:
    """The contact of a group, and of those of its film, of the memories of its couplings, of stick and slip, and of creep; equal to the one it was made of."""
    attributes = node.attributes
    arrays = {item.quantity.name: np.asarray(item.values) for item in node.values if np.ndim(item.values) == 2}
    parts: dict[str, Any] = {part: rebuild(json.loads(attributes[part]), arrays) for part in PARTS}
    control = parts.pop("control")
    for item in (*FIELDS, *MARKS):
        if arrays[item.name].shape != arrays["heights"].shape or arrays[item.name].dtype.kind not in "fbiu":
            raise ValueError(f"{item.name}: it is no field like the heights")
    surface = _surface(arrays["heights"], attributes["surface"])
    if "counter_heights" in arrays:
        parts["counter_surface"] = _surface(arrays["counter_heights"], attributes["counter_surface"])
    parts |= {part: rebuild(json.loads(attributes[part]), arrays) for part in PHYSICS if part in attributes}
    problem = ContactProblem(surface=surface, **parts)
    numbers = None if film is None or "menisci" not in film.attributes else film.attributes["menisci"]
    couplings = _couplings(problem, arrays, numbers, attributes.get("adhesion_found")) | creep_in(creep)
    memories = {} if memory is None else {name: memory_in(child) for name, child in memory.children.items()}
    couplings |= flow_found(problem, memories.get(FLOW, {}))
    if shear is not None and problem.friction is not None:
        couplings[STICK_SLIP] = shear_in(shear, problem.friction)
    found = ContactResult(
        problem=problem,
        control=control,
        plastic=arrays["plastic"].astype(bool),
        certificate=_certificate(attributes),
        status=status_from(attributes),
        citation_keys=tuple(attributes["citation_keys"].split()),
        couplings=couplings,
        memory=memories | following(couplings, arrays["gap"], float(node["approach"])),
        earlier=arrays.get(EARLIER.name),
        **_values(arrays, FIELDS),
        **_values(node, _STORED),
    )
    return sound(found)


def film_node(result: ContactResult, menisci: Menisci) -> Node:
    """Group of the liquid film of a contact: where menisci stand, and scalars."""
    values, texts = menisci_group(menisci)
    return Node((*grid_lines(result), *values), texts)


def _with_film(node: Node, contact: ContactResult) -> ContactResult:
    """The ``contact`` of a file in which wet contacts were results of their own, with what its group of the film holds."""
    film = rebuild(json.loads((attributes := node.attributes)["film"]))
    if not isinstance(film, LiquidFilm):
        raise ValueError("film")
    stored: dict[str, Any] = {name: float(attributes[f"stored_{name}"]) for name in NUMBERS}
    friction = Coulomb(stored["dry_friction"], coupled=False)
    stands = wetting(contact.gap, contact.contact, film, wraps=contact.problem.boundary.wraps)
    return replace(
        contact,
        problem=contact.problem.with_physics(film=film, friction=friction),
        control=rebuild(json.loads(attributes["control"])),
        status=status_from(attributes),
        certificate=replace(contact.certificate, rounds=int(attributes["stored_rounds"])),
        couplings={"menisci": Menisci(film, stands, **stored)},
        memory={"menisci": {"force": np.asarray(stored["meniscus_force"])}},
    )


def path_node(path: HistoryResult) -> Node:
    """Group of a load path with the axis ``step``: fields, scalars, energies, control, certificate and status of every step."""
    steps, balance = path.steps, path.energies
    values = [*grid_lines(steps[-1])]
    values += [_column(item, [getattr(step, item.name) for step in steps]) for item in ALL_SCALARS]
    for item in (*FIELDS, MARKS[1]):
        values.append(_column(item, np.stack([getattr(step, item.name) for step in steps]), "x", "y"))
    for item in ENERGIES:
        values.append(_column(replace(item, name=f"path_{item.name}"), getattr(balance, item.name)))
    for item in CERTIFICATE:
        checks = [getattr(step.certificate, item.name) for step in steps]
        values.append(_column(replace(item, name=f"certificate_{item.name}"), checks))
    ended = Quantity("converged", "1", "whether the step reached its tolerance")
    values.append(_column(ended, [step.converged for step in steps]))
    for name in ("outcome", "message", "remedy"):
        texts = [str(getattr(step.status, name)) for step in steps]
        values.append(_column(Quantity(f"status_{name}", "", f"{name} of the step"), texts))
    controls = [json.dumps(describe(step.control)) for step in steps]
    values.append(_column(Quantity("control", "", "prescribed load or position, as JSON"), controls))
    values += [*_coupling_columns(steps), Labelled(SPOTS, np.concatenate([step.spot_areas for step in steps]))]
    pasts = creep_pasts(steps)
    if path.start is None:
        return Node(tuple(values), {}, pasts)
    started = path.start
    values.append(_field(Quantity("start_pressure", "Pa", "pressure before the first step"), started.pressure))
    if started.earlier is not None:
        quantity = Quantity("start_earlier", "Pa", "pressure of the load before that")
        values.append(_field(quantity, started.earlier))
    memory = Node((), {}, {name: memory_node(memory) for name, memory in started.memory.items()})
    return Node(tuple(values), {}, {"start": memory, **pasts})


def _coupling_columns(steps: Sequence[ContactResult]) -> Iterator[Labelled]:
    """Results, memories and checks of the couplings in each step."""
    if steps[0].sliding is not None:
        lifts = [step.sliding.shear_displacement for step in steps if step.sliding is not None]
        yield _column(LIFT, np.stack(lifts), "x", "y")
    yield from menisci_columns([step.menisci for step in steps if step.menisci is not None])
    yield from adhesion_columns([step.adhesion for step in steps if step.adhesion is not None])
    yield from shear_columns([step.stick_slip for step in steps if step.stick_slip is not None])
    yield from creep_columns(steps)
    yield from flow_columns(steps)
    for name in _CHECKS:
        texts = [json.dumps(describe(getattr(step.certificate, name))) for step in steps]
        yield _column(Quantity(f"certificate_{name}", "", f"{name} of the couplings, as JSON"), texts)
    memories = [
        json.dumps(
            {
                key: {name: np.asarray(a).tolist() for name, a in memory.items()}
                for key, memory in step.memory.items()
                if key not in (*FOLLOWING, CREEP, FLOW)
            }
        )
        for step in steps
    ]
    yield _column(Quantity("memory", "", "what the couplings remember, as JSON"), memories)


def _column(item: Quantity, values: Any, *dims: str) -> Labelled:
    """Values of every step."""
    return Labelled(replace(item, dims=("step", *dims)), np.asarray(values))


def path_from(node: Node, last: ContactResult) -> HistoryResult:
    """The load path of a group; ``last`` is the contact at its end, whose problem all steps share."""
    count, results = len(node["n_spots"]), list[ContactResult]()
    start = None
    if "start_pressure" in node:
        memory = {name: memory_in(child) for name, child in node.children["start"].children.items()}
        start = InterfaceState(node["start_pressure"], memory, node.get("start_earlier"))
    before = None if start is None or not start.pressure.any() else start.pressure
    for step in range(count):
        at = {item.quantity.name: item.values[step] for item in node.values if item.quantity.dims[:1] == ("step",)}
        couplings, friction = _couplings(last.problem, at, at.get("menisci"), at.get(ADHESION)), last.problem.friction
        if f"{PREFIX}tangential" in at and friction is not None:
            couplings[STICK_SLIP] = shear_from(at, friction, PREFIX)
        flow = flow_from(node, at, step)
        couplings |= creep_from(node, at, step) | flow_found(last.problem, flow.get(FLOW, {}))
        result = replace(
            last,
            control=rebuild(json.loads(at["control"])),
            plastic=np.asarray(at["plastic"]),
            certificate=_certificate({name: _plain(value) for name, value in at.items()}),
            status=status_from(at),
            couplings=couplings,
            memory=memories_of(at["memory"])
            | flow
            | following(couplings, at["gap"], float(at["approach"]))
            | ({CREEP: last.memory[CREEP]} if CREEP in couplings and step == count - 1 else past_from(node, step)),
            earlier=before,
            **_values(at, (*FIELDS, *_STORED)),
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
    found: dict[str, Any] = {} if law is None or text is None else {ADHESION: adhesion_from(arrays, law, str(text))}
    if problem.film is not None and numbers is not None:
        wraps = problem.boundary.wraps
        found["menisci"] = menisci_from(str(numbers), problem.film, arrays["gap"], arrays["pressure"], wraps)
    friction = problem.friction
    if isinstance(friction, Coulomb) and LIFT.name in arrays:
        found["sliding"] = GrossSliding(friction.coefficient, friction.direction, arrays[LIFT.name])
    return found


def grid_lines(result: ContactResult) -> tuple[Labelled, Labelled]:
    """Coordinates x and y of the grid of ``result``."""
    x, y = result.problem.grid.coordinates()
    return coordinate("x", x[:, 0]), coordinate("y", y[0])


def status_attributes(status: Status) -> dict[str, str]:
    """``status`` as attributes of a group."""
    return {f"status_{name}": str(text) for name, text in asdict(status).items()}


def status_from(attributes: Mapping[str, Any]) -> Status:
    """The status that ``attributes`` of a group hold."""
    return Status(Outcome(attributes["status_outcome"]), attributes["status_message"], attributes["status_remedy"])


def _checks(certificate: Certificate) -> dict[str, Any]:
    checks = {f"certificate_{f.name}": getattr(certificate, f.name) for f in fields(Certificate)}
    return checks | {f"certificate_{name}": json.dumps(describe(getattr(certificate, name))) for name in _CHECKS}


def _surface_text(surface: Surface) -> str:
    grid = {"dx": surface.dx, "dy": surface.dy, "periodic": surface.periodic}
    return json.dumps(grid | surface_provenance(surface))


def _surface(heights: np.ndarray[Any, Any], text: str) -> Surface:
    described = json.loads(text)
    if array_digest(heights) != described["digest"]:
        raise ValueError("heights: they do not match their digest")
    history, keys = tuple(described["history"]), tuple(described["citation_keys"])
    origin = Origin(described["source"], described["channel"], described["instrument"], history, keys)
    return Surface(heights, described["dx"], described["dy"], periodic=described["periodic"], origin=origin)


def _field(quantity: Quantity, values: np.ndarray[Any, Any]) -> Labelled:
    return Labelled(replace(quantity, dims=("x", "y")), values)


def _values(source: Any, wanted: Iterable[Quantity]) -> dict[str, Any]:
    """Values of the ``wanted`` quantities in ``source`` by name."""
    found = {item.name: _plain(source[item.name]) for item in wanted}
    for name, value in found.items():
        if isinstance(value, str):
            raise ValueError(f"{name}: it is no number")
    return found


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value
