"""Wear asked for by a document: volumes, depths and life in numbers, figures and words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from ...contact.controls import Control, MeanPressure, Step
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.tangential import Shift
from ...core.errors import InputError
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words, require_step
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Elastic
from ...solids.layers import Body, Layered, materials_of
from ...surfaces.characterise.heights import core, material_ratio_curve
from .figures import (
    BARE_PLOT,
    BEARING_PLOT,
    COURSE_PLOT,
    DEPTH_PLOT,
    SECTION_PLOTS,
    STRESS_PLOT,
    WORN_PLOT,
    WearPicture,
)
from .fretting import fretted
from .history import WearHistory
from .law import Sides, WearLaw, of_layers
from .march import WearSteps, check, worn
from .part import SCALARS, Wears
from .rolling_course import worn_by_rolling
from .third_body import Debris
from .work_stresses import EVEN, stress_rows, stress_table, stress_values, yielding_text

KEPT_WAYS = (0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0)
"""Shares of the way at which the section is kept, beside that at the start, where its end is known
before."""

ROWS = 9
"""Rows of the table of the course."""


class WearWork(WithFacts):
    """What the bodies lose as they slide: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Archard1953",)

    def check(self, ask: Wears, problem: ContactProblem) -> None:
        """Refuse what cannot wear, and bodies none of which is known to."""
        sides = check(problem, MeanPressure(1.0), sides_of(ask, problem))
        if ask.rolls is not None:
            _around(ask, sides)

    def course(self, ask: Wears, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The same steps; refuses one that is not among them."""
        require_step(ask.settings.step, controls, "wear.step", "{wear.step=last}")
        return controls

    def compute(self, ask: Wears, solved: Solved) -> Found:
        """Wear under the load that is asked for, from the surfaces as they are given."""
        table = ask.settings
        reached = solved.at(table.step if ask.rolls is None else "last")
        sides = sides_of(ask, solved.problem)
        with solved.stage("wear") as progress:
            history = _worn(ask, solved, sides, reached.result.control, progress)
        allowed = None if table.allowed_depth is None else float(table.allowed_depth)
        across = _across(ask, sides, solved.problem.grid.shape)
        values: dict[str, Any] = {**_numbers(history, allowed), **_fields(history, sides)}
        values |= _section(history, across=across)
        values |= stress_values(ask, solved, history)
        beyond = ask.rolls is not None or sides.body_track is not None or sides.counter_track is not None
        values |= {"wear_mean_depth": math.nan} if beyond else {}  # the volume is that of a whole track or wheel
        values |= {f"course_{name}": column for name, column in history.values.items()}
        facts = {
            "where": reached.where,
            "fretting": ask.fretting,
            "rolls": ask.rolls is not None,
            "around": [] if ask.rolls is None else list(_around(ask, sides).values()),
            "debris": float(table.debris or 0.0),
            "shift": None if table.shift is None else float(table.shift),
            "law": table.law,
            "wears": [name for name in ("body", "counter") if getattr(sides, name) is not None],
            "tracks": [name for name in ("body", "counter") if getattr(sides, f"{name}_track") is not None],
            "thickness": [law.thickness for law in sides.laws if law.thickness > 0.0],
            "allowed": allowed,
            "across": across,
            "criterion": "" if ask.stresses is None else ask.stresses.criterion.name,
            "stopped": table.until_bare and math.isfinite(history.breakthrough),
        }
        keys = tuple(dict.fromkeys((*self.citation_keys, *sides.citation_keys)))
        return Found(values, facts, tuple(history.findings()), keys, history.status)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Maps of what is gone, the section as it wears, the course, the bearing curve."""
        shown = WearPicture(solved.problem, found.values, found.detail)
        plots = [WORN_PLOT] if min(solved.problem.grid.shape) > 1 else []
        plots += [BARE_PLOT] if shown.array("worn_bare").any() and plots else []
        plots += [*SECTION_PLOTS, DEPTH_PLOT, COURSE_PLOT, BEARING_PLOT]
        plots += [STRESS_PLOT] if "wear_layer" in found.values else []
        return figures_by(plots, shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """How much is gone, what that makes of the contact, and whether a coating is worn
        through."""
        values, facts = found.values, found.detail
        volume, depth = float(values["wear_volume"]), float(values["wear_depth"])
        area = [float(values[f"wear_area_fraction_{when}"]) for when in ("first", "last")]
        peak = [show(float(values[f"wear_max_pressure_{when}"]), "Pa", 3) for when in ("first", "last")]
        where = f" at the load of {facts['where']}" if facts["where"] else ""
        sentence = (
            f"In {way_text(values, facts)}{where} {show(volume, 'm**3', 3)} are worn away, up to {show(depth, 'm', 3)} "
            f"deep; the real contact area goes from {percent(area[0])} to {percent(area[1])} of the nominal area, the "
            f"largest pressure from {peak[0]} to {peak[1]}."
        )
        if not volume:
            sentence = f"In {way_text(values, facts)}{where} nothing is worn away."
        names = {"body": "body", "counter": "counter body"}
        rows: Rows = [
            ("wears", " and ".join(names[name] for name in facts["wears"])),
            ("law of wear", "dissipated energy" if facts["law"] == "energy" else "Archard"),
        ]
        rows += [("runs along a track", names[name]) for name in facts["tracks"]]
        for name, around in zip(facts["wears"], facts.get("around", ()), strict=False):
            passages = float(values["wear_distance"]) / around
            rows.append((f"points of the {names[name]} pass", f"{passages:.4g} times, once every {show(around, 'm')}"))
        rows += [("moves to and fro by", show(facts["shift"], "m"))] if facts["fretting"] else []
        rows += [("debris that stays", percent(facts["debris"]))] if facts["debris"] else []
        rows += _number_rows(values, facts)
        rows += stress_rows(values, facts)
        holds, alarming = _holds(values, facts)
        yielding, yields = yielding_text(values, facts)
        headline = [("worn volume", show(volume, "m**3", 3)), ("largest worn depth", show(depth, "m", 3))]
        stressed = stress_table(values, facts)
        tables = [("Course of the wear", _course_table(values, facts))]
        tables += [("Stresses and yielding as it wears", stressed)] if stressed.cells else []
        remarks = (REMARK, *(() if facts["debris"] else (GONE,)), *((EVEN,) if stressed.cells else ()))
        holds = " ".join(text for text in (holds, yielding) if text)
        return Words(sentence, headline, rows, tuple(tables), remarks, alarming or yields, holds)


# Who wears, and by which law.


def sides_of(ask: Wears, problem: ContactProblem) -> Sides:
    """The laws of the bodies that wear.

    Raises
    ------
    InputError
        If no coefficient is known of a body that is asked for, or of any.
    """
    table = ask.settings
    laws = {}
    for name, body in (("body", problem.body), ("counter_body", problem.counter_body)):
        given = getattr(table, f"coefficient_{name}")
        named = table.wears in (name, "both")
        wanted = named or (table.wears == "known" and (given is not None or _some_known(body)))
        if given is not None and not wanted:
            raise InputError(
                f"wear.coefficient_{name} must be left out where the {name.replace('_', ' ')} does not wear, but is "
                "given; let both wear ({wear.wears=both})."
            )
        laws[name] = _law(ask, body, given) if wanted else None
    if not any(laws.values()):
        raise InputError(
            "wear coefficient of a body must be known, but is not: none is that of a material alone. Give that of the "
            "pair, as measured ({wear.coefficient_body=1e-6mm^3/Nm}), or those of its materials ({wear_coefficient}).",
            subject="wear coefficient",
        )
    if table.until_bare and not any(law is not None and law.thickness > 0.0 for law in laws.values()):
        raise InputError(
            "wear.until_bare must be left out where no body that wears is coated, but is given. Take layers, or "
            "{wear.allowed_depth=100nm}."
        )
    tracks = [None if value is None else float(value) for value in (table.track_body, table.track_counter_body)]
    for name, track in zip(laws, tracks, strict=True):
        if track is not None and laws[name] is None:
            raise InputError(
                f"wear.track_{name} must be left out where the {name.replace('_', ' ')} does not wear, but is given. "
                f"Give its coefficient ({{wear.coefficient_{name}=1e-6mm^3/Nm}})."
            )
    if ask.rolls is not None:
        return Sides(laws["body"], laws["counter_body"])
    left = None if not table.debris else Debris(float(table.debris), float(table.debris_modulus or 0.0))
    return Sides(laws["body"], laws["counter_body"], tracks[0], tracks[1], left)


def _around(ask: Wears, sides: Sides) -> dict[str, float]:
    """Circumference in m of each body that wears as it rolls.

    Raises
    ------
    InputError
        If one is not known.
    """
    found = {}
    for name, key in (("body", "body"), ("counter", "counter_body")):
        if getattr(sides, name) is None:
            continue
        around = getattr(ask.settings, f"track_{key}")
        if around is None:
            raise InputError(
                f"wear.track_{key} must be given where the {key.replace('_', ' ')} wears as it rolls, but is not: its "
                f"points wear once in this length, the circumference of a wheel ({{wear.track_{key}=3m}})."
            )
        found[name] = float(around)
    return found


def _some_known(body: Body) -> bool:
    materials = materials_of(body) if isinstance(body, Elastic | Layered) else ()
    return any(not math.isnan(material.strength.wear_coefficient) for material in materials)


def _law(ask: Wears, body: Body, given: float | None) -> WearLaw:
    """The law of ``body``, whose coefficient may be ``given``."""
    table = ask.settings
    if given is None:
        stages = of_layers(body).stages
    else:
        coefficient = float(given) * (ask.coefficient if table.law == "energy" else 1.0)
        layers = body.reduced.layers if isinstance(body, Layered) else ()
        above = tuple((layer.thickness, coefficient) for layer in layers) if coefficient else ()
        stages = (*above, (math.inf, coefficient))
    dose = float(table.threshold_energy) / ask.coefficient if table.law == "energy" else 0.0
    return WearLaw(stages, threshold_pressure=float(table.threshold_pressure), threshold_dose=dose)


def _worn(ask: Wears, solved: Solved, sides: Sides, control: Control, progress: Any) -> WearHistory:
    """The wear of both ``sides`` that is asked for under ``control``."""
    table, problem = ask.settings, solved.problem
    options: dict[str, Any] = {"progress": progress, "on_failure": "return"}
    if solved.solver is not None:
        options["solver"] = solved.solver
    given: dict[str, Any] = {"order": table.order}
    if table.tolerance is not None:
        given["tolerance"] = float(table.tolerance)
    shares: tuple[float, ...] = (1.0,) if table.until_bare else KEPT_WAYS
    if table.steps is not None:
        equal = max(number for number in range(1, len(shares) + 1) if table.steps % number == 0)
        shares, given["number"] = tuple((n + 1) / equal for n in range(equal)), table.steps // equal
    options["steps"] = WearSteps(**given)
    if ask.fretting:
        size = float(table.shift or 0.0)
        shift = Shift(size * math.cos(ask.direction), size * math.sin(ask.direction))
        options |= {} if table.quarter is None else {"quarter": table.quarter}
        cycles = sorted({max(1, round(share * (table.cycles or 1))) for share in shares})
        return fretted(problem.with_physics(friction=ask.friction), control, shift, cycles, sides, **options)
    if ask.rolls is not None:
        around = _around(ask, sides)
        return worn_by_rolling(
            problem.with_physics(friction=ask.rolls.law),
            control,
            ask.rolls.creepage,
            float(table.distance or 0.0),
            sides,
            (around.get("body", 1.0), around.get("counter", 1.0)),
            direction=ask.rolls.settings.direction,  # type: ignore[arg-type]
            steps=replace(options["steps"], number=table.steps),
            until_bare=table.until_bare,
            on_failure="return",
        )
    marks = [share * float(table.distance or 0.0) for share in shares]
    return worn(problem, control, marks, sides, until_bare=table.until_bare, **options)


# What is found, as values.


def _numbers(history: WearHistory, allowed: float | None) -> dict[str, float]:
    """``SCALARS``."""
    grid, values = history.last.problem.grid, history.values
    distance, force, volume = values["distance"], values["force"], history.worn_volume
    work = float(np.trapezoid(force, distance))
    life = math.nan if allowed is None else history.life(allowed)
    ends = {"wear_breakthrough": history.breakthrough, "wear_life": life if math.isfinite(life) else math.nan}
    numbers = {
        "wear_distance": float(distance[-1]),
        "wear_cycles": float(values["cycles"][-1]),
        "wear_volume": volume,
        "wear_body_volume": float(values["body_volume"][-1]),
        "wear_counter_body_volume": float(values["counter_volume"][-1]),
        "wear_depth": float(values["max_depth"][-1]),
        "wear_body_depth": float(history.body_depth.max()),
        "wear_counter_body_depth": float(history.counter_depth.max()),
        "wear_mean_depth": volume / grid.area,
        "wear_rate": volume / work if work > 0.0 else math.nan,
        "wear_bare_fraction": float(values["bare_fraction"][-1]),
        "wear_error": history.error,
        "wear_balance": history.dose_balance,
        "wear_unevenness": history.unevenness,
        "wear_compliance_error": history.compliance_error,
        "wear_steps": float(len(distance) - 1),
    }
    for name, way in ends.items():
        numbers |= {
            name: math.nan if history.fretting else way,
            f"{name}_cycles": way if history.fretting else math.nan,
        }
    for when, at, result in (("first", 0, history.kept[0][1]), ("last", -1, history.last)):
        for name in ("area_fraction", "max_pressure", "rms_height"):
            numbers[f"wear_{name}_{when}"] = float(values[name][at])
        numbers |= _bearing(result, when)
    return numbers


def _bearing(result: ContactResult, when: str) -> dict[str, float]:
    """Core height, reduced peak height and valley depth of the composite surface; NaN of a flat
    one."""
    problem = result.problem
    try:
        found = core(material_ratio_curve(problem.surface.with_heights(problem.profile(), "composite")))
        numbers = (found.top - found.bottom, found.reduced_peak, found.reduced_valley)
    except InputError:
        numbers = (math.nan, math.nan, math.nan)
    names = ("core_height", "peak_height", "valley_depth")
    return {f"wear_{name}_{when}": float(number) for name, number in zip(names, numbers, strict=True)}


def _fields(history: WearHistory, sides: Sides) -> dict[str, Any]:
    """``FIELDS``."""
    bare = np.zeros(history.last.problem.grid.shape)
    for law, depth in ((sides.body, history.body_depth), (sides.counter, history.counter_depth)):
        if law is not None and law.thickness > 0.0:
            bare = np.maximum(bare, np.where(depth >= law.thickness * (1.0 - 1e-12), 1.0, 0.0))
    return {
        "worn_body": np.asarray(history.body_depth),
        "worn_counter_body": np.asarray(history.counter_depth),
        "worn_heights": np.asarray(history.last.problem.profile()),
        "worn_pressure": np.asarray(history.last.pressure),
        "worn_bare": bare,
    }


def _across(ask: Wears, sides: Sides, shape: tuple[int, int]) -> bool:
    """Whether the section is along y: across a track or the direction of rolling, and where there
    is one point along x."""
    if ask.rolls is not None:
        return ask.rolls.settings.direction.endswith("x")
    return shape[0] == 1 or not (sides.body_track is None and sides.counter_track is None)


def _section(history: WearHistory, *, across: bool) -> dict[str, Any]:
    """``SECTION``: along x or ``across``, through the point that is pressed most at the start, at
    the states that were kept."""
    pressed = history.kept[0][1].pressure
    x, y = np.unravel_index(int(np.argmax(pressed)), pressed.shape)
    row = (int(x), slice(None)) if across else (slice(None), int(y))
    ways, states = zip(*history.kept, strict=True)
    return {
        "section_way": np.array(ways, float),
        "section_heights": np.array([state.problem.profile()[row] for state in states]),
        "section_pressure": np.array([state.pressure[row] for state in states]),
    }


# In words and tables.

REMARK = (
    "Wear coefficients hold for the pair, the lubrication and the severity of the test that they come from; they "
    "scatter by factors."
)
"""What the numbers are."""

GONE = "Debris leaves the contact."
"""What becomes of it where none is asked for."""


def way_text(values: Mapping[str, Any], facts: Mapping[str, Any]) -> str:
    """How far it has slid, or how many cycles it has fretted."""
    if facts["fretting"]:
        return f"{float(values['wear_cycles']):.4g} cycles of ±{show(facts['shift'], 'm', 3)}"
    motion = "rolling" if facts.get("rolls") else "sliding"
    return f"{show(float(values['wear_distance']), 'm', 3)} of {motion}"


def _after(values: Mapping[str, Any], facts: Mapping[str, Any], name: str) -> str:
    """When something is reached; empty where it is not."""
    value = float(values[f"{name}_cycles" if facts["fretting"] else name])
    if math.isnan(value):
        return ""
    return f"{value:.3g} cycles" if facts["fretting"] else show(value, "m", 3)


def _holds(values: Mapping[str, Any], facts: Mapping[str, Any]) -> tuple[str, bool]:
    """Whether coatings and allowed depth hold, and whether something does not."""
    texts, alarming = [], False
    depth = show(float(values["wear_depth"]), "m", 3)
    if facts["thickness"]:
        through = _after(values, facts, "wear_breakthrough")
        alarming = bool(through)
        thickness = " and ".join(show(value, "m", 3) for value in facts["thickness"])
        share = percent(float(values["wear_bare_fraction"]))
        bare = "" if facts["stopped"] else f"; in the end {share} of the contact is without"
        texts.append(
            f"Wears through: a coating is first gone after {through}{bare}."
            if through
            else f"Does not wear through in {way_text(values, facts)}: at most {depth} of {thickness} are gone."
        )
    if facts["allowed"] is not None:
        allowed, reached = show(facts["allowed"], "m", 3), _after(values, facts, "wear_life")
        alarming |= bool(reached)
        texts.append(
            f"Worn too deep: {allowed}, which are allowed, are reached after {reached}."
            if reached
            else f"Stays within the allowed depth: {depth} of {allowed} are gone after {way_text(values, facts)}."
        )
    return " ".join(texts), alarming


def _number_rows(values: Mapping[str, Any], facts: Mapping[str, Any]) -> Rows:
    """``SCALARS`` that are known, those before and after wear in one row."""
    rows: Rows = []
    for item in SCALARS:
        value = float(values.get(item.name, math.nan))
        if not math.isfinite(value) or _idle(item.name, facts) or item.name.endswith("_last"):
            continue
        text = value_text(item, value)
        if item.name.endswith("_first"):
            last = float(values.get(item.name.replace("_first", "_last"), math.nan))
            text = f"{text} → {value_text(item, last)}" if math.isfinite(last) else text
        rows.append((item.label.replace(" before wear", ", before → after wear"), text))
    return rows


def _idle(name: str, facts: Mapping[str, Any]) -> bool:
    """Whether the number of that ``name`` is of a body that does not wear, or of a coating that is
    not there."""
    alone = len(facts["wears"]) == 1
    coating = ("wear_bare_fraction", "wear_unevenness", "wear_compliance_error")
    return (alone and name.startswith(("wear_body_", "wear_counter_body_"))) or (
        not facts["thickness"] and name in coating
    )


def _course_table(values: Mapping[str, Any], facts: Mapping[str, Any]) -> Table:
    """Some of the states, from the first contact on."""
    way = "cycles" if facts["fretting"] else "distance"
    names: tuple[str, ...] = (way, "worn_volume", "max_depth", "area_fraction", "max_pressure", "bare_fraction")
    rolls = bool(facts.get("rolls"))
    names = (*names, "tangential_force", "rolling_heat") if rolls else names
    columns = [np.atleast_1d(np.asarray(values[f"course_{name}"], float)) for name in names]
    cells = []
    for at in np.unique(np.linspace(0, len(columns[0]) - 1, ROWS).round().astype(int)):
        along, volume, depth, area, peak, bare, *rolling = (float(column[at]) for column in columns)
        row: tuple[str, ...]
        first = f"{along:.4g}" if facts["fretting"] else show(along, "m", 3)
        row = (first, show(volume, "m**3", 3), show(depth, "m", 3), percent(area), show(peak, "Pa", 3))
        row = (*row, percent(bare)) if facts["thickness"] else row
        cells.append((*row, *(show(value, unit, 3) for value, unit in zip(rolling, ("N", "J/m"), strict=False))))
    head: tuple[str, ...] = (way.capitalize(), "Worn volume", "Largest depth", "Real area", "Maximum pressure")
    head = (*head, "Of it without coating") if facts["thickness"] else head
    return Table((*head, "Tangential force", "Heat") if rolls else head, tuple(cells))
