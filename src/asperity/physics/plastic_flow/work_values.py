"""What the parts on plastic flow share: a cut through the body and a curve of load as values of
quantities, and figures from them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.roughness import roughness_of
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import material_name
from ...parts.part import Table
from ...solids.elastic import Elastic
from ...solids.layers import Body, Layered, materials_of
from ...solids.plasticity import J2, LinearHardening
from ...solids.strength import flow_stress, plastic_parts
from .figures import Cut, PlasticPicture
from .part_quantities import CUT, IMPRINT

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem

LEAST_HARDENING = 1e-4
"""Hardening modulus over Young's modulus that perfectly plastic materials get in finite elements;
it raises forces by some 0.1 % at plastic strains of a per cent."""


@dataclass(frozen=True, eq=False)
class PlasticValues:
    """Cut, curve and imprint of plastic flow, SI; what is not known is empty.

    Attributes
    ----------
    across, depth, strain, residual, stress
        As of ``plots.plastic.Cut``; residual and stress may be empty.
    interfaces
        Depths of the interfaces in m.
    curve
        Columns of ``CURVE`` by name, as far as they are known.
    place, imprint
        (n,) of the residual surface.
    """

    across: RealArray
    depth: RealArray
    strain: RealArray
    interfaces: RealArray
    residual: RealArray = field(default_factory=lambda: np.zeros((0, 0)))
    stress: RealArray = field(default_factory=lambda: np.zeros((0, 0)))
    curve: Mapping[str, RealArray] = field(default_factory=dict)
    place: RealArray = field(default_factory=lambda: np.zeros(0))
    imprint: RealArray = field(default_factory=lambda: np.zeros(0))

    def values(self, prefix: str) -> dict[str, Any]:
        """By names of quantities."""
        own = {name: getattr(self, name) for name, *_ in (*CUT, *IMPRINT)} | dict(self.curve)
        return {f"{prefix}_{name}": value for name, value in own.items() if np.size(value)}


def picture_of(prefix: str, values: Mapping[str, Any], facts: Mapping[str, Any]) -> PlasticPicture:
    """Figures' input from the ``values`` of the quantities and the ``facts`` of a file: names of
    the ``layers``, the ``axis``."""

    def known(name: str) -> RealArray:
        return np.atleast_1d(np.asarray(values.get(f"{prefix}_{name}", np.zeros(0)), dtype=float))

    def on_cut(name: str) -> RealArray | None:
        found = values.get(f"{prefix}_{name}")
        return None if found is None else np.asarray(found, dtype=float)

    strain = on_cut("strain")
    assert strain is not None
    layers = tuple(str(name) for name in facts["layers"])
    interfaces = tuple(float(z) for z in known("interfaces"))
    cut = Cut(
        known("across"), known("depth"), strain, interfaces, layers, facts["axis"], on_cut("residual"), on_cut("stress")
    )
    force, area = known("force"), known("area")
    pressure = np.divide(force, area, out=np.full_like(force, math.nan), where=area > 0.0) if area.size else np.zeros(0)
    hardness = facts.get("oliver_pharr")
    fitted = np.array(facts.get("unloading") or np.zeros((2, 0)), dtype=float)
    return PlasticPicture(
        cut,
        known("approach"),
        force,
        known("elastic_force"),
        known("place"),
        known("imprint"),
        pressure,
        fitted,
        math.nan if hardness is None else float(hardness),
    )


def layer_names(body: Body) -> list[str]:
    """Names of the layers of ``body`` from the surface down, and of its base."""
    if isinstance(body, Layered):
        reduced = body.reduced
        base = material_name(reduced.base) if isinstance(reduced.base, Elastic) else reduced.base.name
        return [*(material_name(layer.material) for layer in reduced.layers), base]
    return [material_name(body)] if isinstance(body, Elastic) else ["rigid"]


def interfaces_of(body: Body) -> RealArray:
    """Depths of the interfaces of ``body`` in m."""
    return np.cumsum([layer.thickness for layer in body.reduced.layers]) if isinstance(body, Layered) else np.zeros(0)


def zone_table(shown: PlasticValues, body: Body) -> Table:
    """Largest plastic strain, its place and the extent of the zone in each layer, from the cut."""
    names, cells = layer_names(body), []
    tops = np.append(0.0, shown.interfaces)
    bottoms = np.append(shown.interfaces, math.inf)
    middle = 0.5 * (shown.depth[1:] + shown.depth[:-1])
    across = 0.5 * (shown.across[1:] + shown.across[:-1])
    for name, top, bottom in zip(names, tops, bottoms, strict=False):
        rows = np.flatnonzero((middle > top) & (middle < bottom))
        strain = shown.strain[:, rows]
        if not strain.size or not strain.max() > 0.0:
            cells.append((name, "elastic", "–", "–", "–"))
            continue
        column, row = np.unravel_index(int(np.argmax(strain)), strain.shape)
        flowed = np.flatnonzero((strain > 0.0).any(axis=0))
        span = (
            f"{show(float(shown.depth[rows[flowed[0]]]), 'm', 3)} to "
            f"{show(float(shown.depth[rows[flowed[-1]] + 1]), 'm', 3)}"
        )
        columns = np.flatnonzero((strain > 0.0).any(axis=1))
        wide = float(shown.across[columns[-1] + 1] - shown.across[columns[0]])
        cells.append(
            (
                name,
                percent(float(strain.max())),
                f"{show(float(across[column]), 'm', 3)}, {show(float(middle[rows[row]]), 'm', 3)}",
                span,
                show(wide, "m", 3),
            )
        )
    return Table(("Layer", "Largest plastic strain", "at (across, depth)", "Depths", "Width"), tuple(cells))


# What is asked of the materials.


def require_flow(body: Body, *, unknown_is_elastic: bool) -> None:
    """Refuse a body none of whose parts can flow, or of which a yield stress is not known.

    Raises
    ------
    InputError
        If there is nothing that could flow.
    """
    if not any(isinstance(part, J2) for part in plastic_parts(body, unknown_is_elastic=unknown_is_elastic)):
        raise InputError(
            "body must have a yield stress somewhere for plastic flow, but has none. Give one, as {yield_stress}.",
            subject="body",
        )


def inferred_strengths(body: Body) -> tuple[Advice, ...]:
    """A note on yield stresses that are taken from the hardness."""
    found = {m.name or "a material": flow_stress(m.strength) for m in materials_of(body)}
    texts = [f"{name}: {show(stress.value, 'Pa', 3)}" for name, stress in found.items() if stress.inferred]
    if not texts:
        return ()
    return (
        Advice(
            "note",
            "yield stress",
            f"The yield stress is the hardness over 2.8 where no other is known ({'; '.join(texts)}).",
            "Give it where it matters, as {yield_stress}.",
            {name: stress.value for name, stress in found.items() if stress.inferred},
            ("flow_", "indent_", "pass_"),
        ),
    )


# What is meshed, and by what it is pressed.


def meshed_body(problem: ContactProblem, inside: str, table: str) -> Elastic | Layered:
    """The body of ``problem`` that a ``table`` of a document names with its key ``inside``.

    Raises
    ------
    InputError
        If it is rigid.
    """
    body: Body = getattr(problem, inside)
    if not materials_of(body) or not isinstance(body, Elastic | Layered):
        other = "counter_body" if inside == "body" else "body"
        raise InputError(
            f"{inside} must be elastic for {table}, but is rigid. Give a material, or {{{table}.inside={other}}}.",
            subject=inside,
        )
    return body


def meshed_laws(body: Body, *, unknown_is_elastic: bool) -> list[J2 | None]:
    """Law of each layer of ``body`` and of its base for finite elements; perfect plasticity with
    the least hardening, which Newton's method needs near collapse.

    Raises
    ------
    InputError
        If a yield stress is not known.
    """
    laws: list[J2 | None] = []
    for part in plastic_parts(body, unknown_is_elastic=unknown_is_elastic):
        law = part if isinstance(part, J2) else None
        if law is not None and isinstance(law.hardening, LinearHardening) and law.hardening.modulus == 0.0:
            least = LEAST_HARDENING * law.elastic.youngs_modulus
            law = replace(law, hardening=LinearHardening(law.hardening.initial, least))
        laws.append(law)
    return laws


def summit_radius(problem: ContactProblem, fix: str) -> float:
    """Mean radius in m of the summits of the surface of ``problem``, for an indenter whose radius
    is not given.

    Raises
    ------
    InputError
        If it has no summits; the ``fix`` says what to give.
    """
    try:
        summits = roughness_of(problem.surface.with_heights(problem.profile(), "composite")).summits
        if summits is None or not 0.0 < summits.mean_radius < math.inf:
            raise InputError("it is flat")
    except InputError as error:
        raise InputError(
            f"radius of the indenter must be given where the surface has no summits ({error}). {fix}",
            subject="radius of the indenter",
        ) from None
    return float(summits.mean_radius)
