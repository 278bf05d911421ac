"""Surfaces, bodies, problems and results as text: rows of tables, one line, or one screen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from itertools import groupby
from textwrap import wrap
from typing import Protocol, TypeAlias, runtime_checkable

import numpy as np

from ..contact.history import HistoryResult
from ..contact.problem import ContactProblem
from ..contact.result import SCALARS, ContactResult
from ..core.errors import InputError
from ..core.late import Judged, Stored
from ..core.quantity import Quantity
from ..core.status import SENTENCES, Verdict
from ..core.units import percent, show
from ..core.words import printable
from ..solids.elastic import Conduction, Elastic, Strength, yield_pressure
from ..solids.layers import Frictionless, Layer, Layered, materials_of
from ..solids.viscoelastic import Viscoelastic
from ..surfaces.characterise.heights import peak_to_valley, rms_height
from ..surfaces.surface import Surface

LINE = 100
"""Letters of a value in a ``repr``."""

FIELDS = (
    Quantity("pressure", "Pa", "contact pressure"),
    Quantity("displacement", "m", "sum of the normal displacements of both surfaces, into the bodies"),
    Quantity("gap", "m", "gap between the deformed surfaces"),
    Quantity("permanent_indentation", "m", "permanent indentation of the composite profile"),
)
"""Fields (nx, ny) that a result stores."""

OFFSET = Quantity("offset", "m", "rigid-body position: gap = offset + displacement - profile + permanent indentation")
"""The scalar from which fields follow, not in the table for people."""

CERTIFICATE = (
    Quantity(
        "duality_gap",
        "1",
        "bound on the relative error of the energy",
        description="The total energy of this answer differs from the exact one on this grid by at most this fraction.",
    ),
    Quantity(
        "field_error",
        "1",
        "relative error of the field",
        description="How far pressure and gap are from excluding each other, relative to load and rms height.",
    ),
    Quantity(
        "penetration",
        "1",
        "largest overlap of the bodies / rms height",
        description="The deepest point at which the bodies still overlap, as a fraction of the rms height.",
    ),
    Quantity(
        "load_imbalance",
        "1",
        "imbalance of the forces",
        description="How far load, menisci and adhesion are from the force of the contact, over their sum; zero "
        "where a position was asked for.",
    ),
    Quantity(
        "tolerance",
        "1",
        "tolerance given to the solver",
        description="The relative error at which the solver stops.",
    ),
    Quantity("iterations", "1", "iterations", description="Steps of the solver."),
    Quantity(
        "fft_pairs",
        "1",
        "FFT pairs of the size of the grid",
        description="Work in forward and backward transforms, the unit of cost.",
    ),
    Quantity("wall_time", "s", "time to solve", description="From the prepared problem to the solution."),
    Quantity(
        "peak_memory",
        "B",
        "largest memory of the process so far",
        description="The largest memory the program has held so far, everything included.",
    ),
    Quantity("solver", "", "solver", description="The numerical method."),
)
"""Entries of a certificate in the order of tables."""

ALL_SCALARS = (*SCALARS, OFFSET)
"""Every scalar of a result in files."""

Rows: TypeAlias = list[tuple[str, str]]
"""Label and text of each row of a table."""


def surface_rows(surface: object) -> Rows:
    """What the ``surface`` is, where it comes from and what was done to it."""
    if not isinstance(surface, Surface):
        return [("shape", "perfectly flat")]
    origin, (nx, ny), (width, height) = surface.origin, surface.shape, surface.size
    rows = [
        ("source", origin.source or "given as an array"),
        ("channel", origin.channel),
        ("size", f"{show(width, 'm')} × {show(height, 'm')}"),
        ("points", f"{nx} × {ny}"),
        ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
        ("rms height", show(rms_height(surface), "m")),
        ("peak to valley", show(peak_to_valley(surface), "m")),
        ("periodic", "yes" if surface.periodic else "no"),
        *((f"step {number}", step) for number, step in enumerate(origin.history, start=1)),
        *((str(key), str(value)) for key, value in origin.instrument.items()),
    ]
    return [row for row in rows if row[1]]


TERMS = {
    item.name: item
    for item in (
        Quantity("youngs_modulus", "Pa", "Young's modulus E"),
        Quantity("poisson_ratio", "1", "Poisson's ratio ν"),
        Quantity("hardness", "Pa", "hardness H"),
        Quantity("yield_stress", "Pa", "yield stress"),
        Quantity("kinematic", "Pa", "kinematic hardening"),
        Quantity("recall", "1", "recall of the back stress"),
        Quantity("wear_coefficient", "m**2/N", "wear coefficient k_w"),
        Quantity("initial", "Pa", "yield stress"),
        Quantity("modulus", "Pa", "hardening modulus"),
        Quantity("gain", "Pa", "largest growth of the yield stress"),
        Quantity("rate", "1", "rate of its growth"),
        Quantity("reference_strain", "1", "reference strain"),
        Quantity("exponent", "1", "hardening exponent"),
        Quantity("thickness", "m", "thickness"),
        Quantity("thermal_conductivity", "W/(m*K)", "thermal conductivity k"),
        Quantity("electrical_resistivity", "ohm*m", "electrical resistivity ρ"),
        Quantity("volumetric_heat_capacity", "J/(m**3*K)", "volumetric heat capacity ρc"),
        Quantity("thermal_expansion", "1/K", "thermal expansion α"),
    )
}
"""Fields of bodies by name; one that is not listed is shown by its name."""


def body_text(body: object) -> str:
    """What ``body`` is in one line: its layers from the surface down, or its name and constants."""
    if isinstance(body, Layered):
        parts = list[str]()
        for group in _alike(body.layers):
            thickness = show(sum(layer.thickness for layer in group), "m")
            count = f" in {len(group)} layers" if len(group) > 1 else ""
            slips = " (slips)" if isinstance(group[-1].interface, Frictionless) else ""
            parts.append(f"{material_name(group[0].material)} {thickness}{count}{slips}")
        return " / ".join([*parts, material_name(body.base) if isinstance(body.base, Elastic) else body.base.name])
    return _material_text(body) if isinstance(body, Elastic) else "rigid"


def body_rows(body: object) -> Rows:
    """Elastic constants and strength of ``body``, with the sources of the values; layers one after
    another."""
    return _layered_rows(body) if isinstance(body, Layered) else _rows(body)


def _layered_rows(body: Layered) -> Rows:
    rows: Rows = [("name", body.name)] if body.name else []
    first = 1
    for group in _alike(body.layers):
        thickness, (top, bottom) = (
            show(sum(layer.thickness for layer in group), "m"),
            (group[0].material, group[-1].material),
        )
        slips = isinstance(group[-1].interface, Frictionless)
        joined = "slips without friction on what is below" if slips else "bonded to what is below"
        if len(group) == 1:
            rows.append((f"layer {first}", f"{thickness} of {_material_text(top)}; {joined}"))
        else:
            moduli = f"E = {show(top.youngs_modulus, 'Pa')} … {show(bottom.youngs_modulus, 'Pa')}"
            what = f"{thickness} of {top.name} in {len(group)} layers: {moduli}; {joined}"
            rows.append((f"layers {first} to {first + len(group) - 1}", what))
        first += len(group)
    rows.append(("base", _material_text(body.base) if isinstance(body.base, Elastic) else body.base.name))
    seen = dict.fromkeys((material.name, source) for material in materials_of(body) for source in material.sources)
    return rows + [
        (f"{label} ({name})" if name else label, text)
        for name, source in seen
        for label, text in [_source_row(source)]
        if name or text != "user"
    ]


def _alike(layers: Sequence[Layer]) -> list[list[Layer]]:
    """Runs of layers of one name, as those of a graded coating are; any other layer is alone."""
    numbered = enumerate(layers)
    runs = groupby(numbered, key=lambda item: item[1].material.name or item[0])
    return [[layer for _, layer in run] for _, run in runs]


def material_name(material: Elastic) -> str:
    """Name of ``material``, or its constants where it has none."""
    return material.name or f"({_material_text(material)})"


def _material_text(material: Elastic) -> str:
    strength = material.strength
    values = [("E", material.youngs_modulus), ("H", strength.hardness), ("Y", strength.yield_stress)]
    texts = [f"{symbol} = {show(value, 'Pa')}" for symbol, value in values if not math.isnan(value)]
    texts.insert(1, f"ν = {material.poisson_ratio:g}")
    if strength.hardening is not None:
        texts.append(str(getattr(strength.hardening, "name", "hardening")))
    if strength.kinematic:
        texts.append(f"kinematic hardening {show(strength.kinematic, 'Pa')}")
    if not math.isnan(strength.wear_coefficient):
        texts.append(f"k_w = {show(strength.wear_coefficient, 'm**2/N')}")
    if isinstance(material, Viscoelastic):
        texts.append(_relaxation_text(material))
    constants = ", ".join(texts)
    return f"{material.name}: {constants}" if material.name else constants


def _relaxation_text(material: Viscoelastic) -> str:
    """How far and between which times the ``material`` relaxes."""
    if not material.spectrum:
        return "does not relax"
    first, last = (show(material.spectrum[end][1], "s") for end in (0, -1))
    when = f"in {first}" if first == last else f"between {first} and {last}"
    return f"{'G' if material.elastic_bulk else 'E'} relaxes to {percent(material.relaxed_share)} {when}"


def _rows(body: object) -> Rows:
    kind, name = type(body).__name__.lower(), str(getattr(body, "name", ""))
    rows: Rows = [("material" if name not in ("", kind) else "kind", name or kind)]
    sources: Rows = []
    for field in fields(body) if is_dataclass(body) else ():
        value = getattr(body, field.name)
        if field.name == "name":
            continue
        if field.name == "spectrum":
            rows.append(("relaxation", _relaxation_text(body)))  # type: ignore[arg-type]
        elif field.name == "sources":
            sources += [_source_row(str(source)) for source in value]
        elif isinstance(value, tuple):
            for number, part in enumerate(value, start=1):
                rows += _prefixed(f"{field.name} {number}", part)
        elif isinstance(value, Conduction):
            rows += [row for known in fields(value) for row in _value_row(known.name, getattr(value, known.name))]
        elif is_dataclass(value):
            rows += _strength_rows(value) if isinstance(value, Strength) else _prefixed(field.name, value)
        else:
            rows += _value_row(field.name, value)
    return rows + sources


def _strength_rows(strength: Strength) -> Rows:
    """What is known of a strength; hardening in one row a value."""
    rows = _value_row("hardness", strength.hardness) + _value_row("yield_stress", strength.yield_stress)
    if strength.hardening is not None:
        rows.append(("hardening", str(getattr(strength.hardening, "name", type(strength.hardening).__name__))))
        rows += [row for row in _rows(strength.hardening)[1:] if row[0] != TERMS["initial"].label]
    rows += _value_row("wear_coefficient", strength.wear_coefficient)
    return rows + [
        row
        for key in ("kinematic", "recall")
        if getattr(strength, key)
        for row in _value_row(key, getattr(strength, key))
    ]


def _prefixed(prefix: str, part: object) -> Rows:
    return [(f"{prefix}: {label}", text) for label, text in _rows(part)]


def _source_row(source: str) -> tuple[str, str]:
    """``"youngs_modulus: handbook"`` names the value that it is the source of; any other text
    stands alone."""
    key, _, text = source.partition(": ")
    return (f"source of {TERMS[key].label}", text) if key in TERMS else ("source", source)


def _value_row(name: str, value: object) -> Rows:
    """The row of a number or text; nothing where it is empty or not known."""
    term = TERMS.get(name, Quantity(name, "1", name.replace("_", " ")))
    if isinstance(value, float | int) and not isinstance(value, bool):
        return [] if math.isnan(value) else [(term.label, show(float(value), term.unit))]
    return [(term.label, str(value))] if str(value) else []


def setting_rows(result: ContactResult) -> Rows:
    """Boundary, law and load of ``result``."""
    problem = result.problem
    rows = [("boundary", problem.boundary.name), ("interface law", problem.law.name)]
    limit = limit_text(problem)
    if limit:
        rows.append(("pressure limit", limit))
    rows.append((modulus_label(problem), show(problem.contact_modulus, "Pa")))
    rows.append((f"prescribed {result.control.name}", show(result.control.value, result.control.unit)))
    return rows


def limit_text(problem: ContactProblem) -> str:
    """Pressure limit of the law of ``problem``, and whose hardness it is; empty without a limit."""
    if isinstance(said := getattr(problem.law, "limit_text", None), str):
        return said
    cap = np.asarray(problem.law.pressure_cap())
    if not np.isfinite(cap).all():
        return ""
    low, high = show(float(cap.min()), "Pa"), show(float(cap.max()), "Pa")
    if low != high:
        return f"{low} to {high}, by point"
    owners = [name for body in (problem.body, problem.counter_body) for name in _owner(body, float(cap.min()))]
    return f"{low} ({' and '.join(owners)})" if owners else low


def modulus_label(problem: ContactProblem) -> str:
    """What to call the contact modulus of ``problem``: that of a coated body is of its top layer
    alone."""
    coated = any(isinstance(body, Layered) for body in (problem.body, problem.counter_body))
    return "contact modulus E* of the materials at the surfaces" if coated else "contact modulus E*"


def _owner(body: object, limit: float) -> list[str]:
    """The material at the surface of ``body`` if the ``limit`` is its hardness."""
    material = body.surface_material if isinstance(body, Layered) else body
    found = yield_pressure(material.strength) if isinstance(material, Elastic) else None
    if not isinstance(material, Elastic) or found is None or found.value != limit:
        return []
    of = "of" if found.symbol == "H" else f"{found.symbol} of"
    if isinstance(body, Layered):
        return [f"{of} {material_name(material)}, the top layer"]
    return [f"{of} {material.name}"] if material.name else []


HEADLINE = {
    "area_fraction_corrected": "real contact area",
    "mean_pressure": "mean pressure",
    "max_pressure": "maximum pressure",
    "mean_gap": "mean gap",
    "approach": "approach",
    "n_spots": "contact spots",
}
"""Scalars at the top of a report, with short labels."""


def value_text(quantity: Quantity, value: float | int | str) -> str:
    """Text of ``value`` with the unit of ``quantity``; whole numbers in full, shares also in
    percent."""
    if isinstance(value, str | int):
        return str(value)
    if math.isnan(value):
        return "not computed"
    text = show(value, quantity.unit)
    if quantity.name.endswith(("fraction", "fraction_corrected")):
        return f"{text} ({percent(value)})"
    return text


PLASTIC = (
    "plastic_work",
    "total_plastic_work",
    "plastic_area_fraction",
    "indented_area",
    "plastic_volume",
    "max_permanent_indentation",
)
"""Scalars of a contact whose pressure is limited, or was before."""


def result_rows(result: ContactResult, doubted: tuple[str, ...] = ()) -> Rows:
    """Every scalar of ``result`` that was asked for, but for those that what its couplings found
    contradicts.

    Names that begin with one of ``doubted`` are marked.
    """
    skipped = {name for answer in result.answers for name in answer.contradicted()}
    if not result.indented.any() and np.isinf(result.problem.law.pressure_cap()).all():
        skipped.update(PLASTIC)
    rows = []
    for quantity in SCALARS:
        if quantity.name not in skipped:
            rows.append((quantity.label, marked(quantity.name, scalar_text(quantity, result), doubted)))
        if quantity.name == "max_pressure" and result.contact.any():
            rows.append(("maximum pressure between the pixels", marked(quantity.name, peak_text(result), doubted)))
    return rows


def peak_text(result: ContactResult) -> str:
    """Largest pressure between the pixels with its error and place; a lower bound where it is in
    doubt."""
    peak, (dx, dy) = result.peak_pressure, result.problem.grid.spacing
    at = f"at x = {show(peak.x + 0.5 * dx, 'm')}, y = {show(peak.y + 0.5 * dy, 'm')}"
    if peak.doubt:
        return f"> {show(peak.value, 'Pa')} {at}: {peak.doubt}"
    error = f" ± {show(peak.error, 'Pa', 2)}" if peak.error else ""
    return f"{show(peak.value, 'Pa')}{error} {at}"


def marked(name: str, text: str, doubted: tuple[str, ...]) -> str:
    """``text`` of the quantity ``name``, with a mark where it begins with one of ``doubted``."""
    return f"{text} (doubtful)" if doubted and name.startswith(doubted) else text


def scalar_text(quantity: Quantity, result: ContactResult) -> str:
    """Text of a scalar of ``result``, of the corrected area with its error."""
    value = getattr(result, quantity.name)
    if quantity.name == "area_fraction_corrected":
        return f"{with_error(value, result.area_fraction_error)} ({area_text(result)})"
    return value_text(quantity, value)


def area_text(result: ContactResult) -> str:
    """Real contact area in percent of the nominal area, with its error."""
    return f"{with_error(100.0 * result.area_fraction_corrected, 100.0 * result.area_fraction_error)} %"


def with_error(value: float, error: float) -> str:
    """``value`` and its ``error`` with one digit, or two below 3:
    ``with_error(0.03123, 0.00042)`` → ``"0.0312 ± 0.0004"``."""
    if not error > 0.0 or not math.isfinite(error):
        return f"{value:.4g}"
    place = math.floor(math.log10(error))
    places = max(0, (error < 2.95 * 10.0**place) - place)
    return f"{value:.{places}f} ± {error:.{places}f}"


def headline_rows(result: ContactResult, doubted: tuple[str, ...] = ()) -> Rows:
    """The scalars that people look for first; the real contact area in percent of the nominal area;
    ``doubted`` as in ``result_rows``."""
    chosen = {q.name: scalar_text(q, result) for q in SCALARS}
    chosen["area_fraction_corrected"] = area_text(result)
    return [(label, marked(name, chosen[name], doubted)) for name, label in HEADLINE.items()]


def certificate_rows(result: ContactResult) -> list[tuple[str, str, str]]:
    """Label, value and meaning of every entry of the certificate."""
    return [(q.label, value_text(q, getattr(result.certificate, q.name)), q.description) for q in CERTIFICATE]


def problem_rows(problem: ContactProblem) -> Rows:
    """What ``problem`` is, in short: surfaces, bodies, modulus, boundary and law."""
    rows = [("surface", f"{problem.surface.origin.source or 'unnamed'}: {surface_text(problem.surface)}")]
    if isinstance(problem.counter_surface, Surface):
        rows.append(("counter surface", problem.counter_surface.origin.source or "unnamed"))
    rows += [("body", body_text(problem.body)), ("counter body", body_text(problem.counter_body))]
    rows.append((modulus_label(problem), show(problem.contact_modulus, "Pa")))
    law = f"{problem.law.name} {limit_text(problem)}".rstrip()
    rows.append(("boundary, interface law", f"{problem.boundary.name}, {law}"))
    return [*rows, *(row for item in problem.physics for row in item.rows())]


def surface_text(surface: Surface) -> str:
    """Points and size of ``surface``."""
    (nx, ny), (width, height) = surface.shape, surface.size
    return f"{nx} × {ny} points, {show(width, 'm')} × {show(height, 'm')}"


@runtime_checkable
class Worded(Protocol):
    """What a higher layer defines, such as a comparison, and tells of itself."""

    def in_words(self) -> tuple[str, Rows]:
        """Heading and main numbers."""


@runtime_checkable
class InOneLine(Protocol):
    """What says itself what it is in one line, such as what a coupling has found."""

    def line(self) -> str:
        """What it is; empty for heading and numbers."""


ROUGHNESS = ("heights.Sq", "hybrid.Sdq", "heights.Ssk", "heights.Sku", "moments.difference.alpha")
"""Numbers of a characterisation that are shown first."""


def heading_and_rows(thing: object) -> tuple[str, Rows]:
    """Heading of a ``thing`` and its main numbers.

    Raises
    ------
    InputError
        If nothing is known of such a thing.
    """
    from ..surfaces.characterise.summary import Characterisation

    if isinstance(thing, Surface):
        steps = len(thing.origin.history)
        rows = [row for row in surface_rows(thing)[:8] if not row[0].startswith("step ")]
        missing = [("missing points", str(thing.n_missing))] if thing.n_missing else []
        return "Surface", [*rows, *missing, *([("steps of preparation", str(steps))] if steps else [])]
    if isinstance(thing, ContactProblem):
        return "Contact problem", problem_rows(thing)
    if isinstance(thing, ContactResult):
        state, given = "converged" if thing.converged else "NOT CONVERGED", thing.verdict
        rows = [
            *given.rows,
            *finding_rows(given),
            *problem_rows(thing.problem),
            (f"prescribed {thing.control.name}", show(thing.control.value, thing.control.unit)),
        ]
        return f"Contact, {state}", [*rows, *given.headline, ("status", thing.status.message)]
    if isinstance(thing, HistoryResult):
        failed = sum(not step.converged for step in thing.steps)
        ended = "all converged" if not failed else f"{failed} NOT CONVERGED"
        given = thing.verdict
        rows = [
            *given.rows,
            *finding_rows(given),
            *problem_rows(thing.last.problem),
            ("steps", f"{len(thing.steps)}, {ended}"),
        ]
        loads = " → ".join(show(float(thing.mean_pressure[turn]), "Pa") for turn in thing.turns)
        return "Load history", [*rows, ("mean pressure where it turns", loads), *given.headline]
    if isinstance(thing, Characterisation):
        numbers = [(q.symbol, show(value, q.unit, 3)) for q, value in thing.values() if q.name in ROUGHNESS]
        return f"Characterisation of {surface_text(thing.surface)}", numbers
    if isinstance(thing, Worded):
        return thing.in_words()
    raise InputError(f"thing to put in words must be a surface, problem, result or stress field, but is {type(thing)}.")


def finding_rows(given: Verdict) -> Rows:
    """Warnings and notes that the sentences of the verdict ``given`` do not tell, the warnings
    first."""
    made = sorted(given.others, key=lambda item: item.level != "warning")
    return [("WARNING" if item.level == "warning" else "note", item.message) for item in made]


def text(thing: object) -> str:
    """The ``repr`` of a ``thing``: at most a screen of a surface, problem, result or stress field,
    one line of anything else."""
    if not isinstance(thing, Surface | ContactProblem | Stored | Judged):
        return printable(f"<{_line(thing)}>")
    heading, rows = heading_and_rows(thing)
    wide, lines = max(len(label) for label, _ in rows), [heading]
    for label, said in rows:
        line = printable(" ".join(said.split()))
        cut = line if len(line) <= LINE else f"{line[: LINE - 1]}…"
        shown = wrap(printable(said), LINE) if label in SENTENCES else [cut]
        lines += [f"  {'' if number else label:<{wide}}  {part}" for number, part in enumerate(shown)]
    return "\n".join(lines)


def _line(thing: object) -> str:
    if isinstance(thing, Elastic):
        return f"{type(thing).__name__} {body_text(thing)}"
    if isinstance(thing, Layered):
        return f"Layered {thing.name + ': ' if thing.name else ''}{body_text(thing)}"
    if isinstance(thing, InOneLine) and (line := thing.line()):
        return line
    heading, rows = heading_and_rows(thing)
    return f"{heading}: {', '.join(' '.join(row) for row in rows)}"
