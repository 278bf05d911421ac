"""Stresses asked for by a document: the largest of each layer and interface and the onset of yield
in numbers, figures and words."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import chain, groupby
from typing import Any

import numpy as np

from ...contact.controls import Control, Step
from ...contact.problem import ContactProblem
from ...core.errors import InputError
from ...core.units import percent, show, times
from ...parts.part import Found, Rows, Solved, Stored, Table, Words, Work, require_step
from ...plots.picture import Figure
from ...solids.elastic import TABOR, Rigid, yield_pressure
from ...solids.layers import Layered, materials_of
from .figures import line_figures, map_figure, view_figure
from .part import _LARGEST, StoredSurvey, StressSettings
from .peaks import FAILS, Peak, peak_text, verdict
from .regions import Region
from .survey import Planned, StressRequest, StressSurvey, SurveyedSection, survey
from .tractions import LoadedBody
from .yielding import factor_text


class StressWork(Work):
    """Largest stresses of layers and interfaces: what is done for it."""

    def check(self, ask: StressRequest, problem: ContactProblem) -> None:
        """Refuse what the problem has no stress for, in the words of documents and options."""
        if isinstance(getattr(problem, ask.of), Rigid):
            asked, other = ("counter body", "body") if ask.of == "counter_body" else ("body", "counter_body")
            raise InputError(
                f"body in which stresses are asked must deform, but the {asked} is rigid; ask for them in the "
                f"other body ({{stress.inside={other}}})."
            )
        ask.check(problem)

    def unknown(self, ask: StressRequest, problem: ContactProblem) -> Mapping[str, str]:
        """Stresses of interfaces of a body that has none."""
        body = getattr(problem, ask.of)
        if isinstance(body, Layered) and body.reduced.layers:
            return {}
        return dict.fromkeys(
            ("max_interface_shear", "max_interface_peel"),
            "a layer is missing. Give the body one, such as DLC:5nm/steel",
        )

    def course(self, ask: StressRequest, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The same steps; InputError if the one that is asked for is not among them."""
        require_step(ask.step, controls, "step of the stresses", "{stress.step=last}")
        return controls

    def compute(self, ask: StressRequest, solved: Solved) -> Found:
        """Largest stresses; the survey with sections and profiles as detail."""
        reached = solved.at(ask.step)
        with solved.stage("stresses") as progress:
            found = survey(ask, reached.result, lines=solved.lines, threads=solved.threads, progress=progress)
        values: dict[str, Any] = {}
        attributes = ("von_mises", "tension", "shear")
        for name, attribute in zip(_LARGEST, attributes, strict=True):
            peak: Peak = max((getattr(part, attribute) for part in found.maxima), key=_value)
            # x and y in the middle of a pixel, as in figures
            spacing = solved.result.problem.grid.spacing
            x, y = (at + 0.5 * step for at, step in zip((peak.x, peak.y), spacing, strict=True))
            values |= {name: peak.value, f"{name}_error": peak.error}
            values |= {f"{name}_x": x, f"{name}_y": y, f"{name}_depth": peak.depth}
        regions, interfaces = [part.region for part in found.maxima], found.interfaces
        values |= {
            "max_interface_shear": max((item.shear.value for item in interfaces), default=math.nan),
            "max_interface_peel": max((item.peel.value for item in interfaces), default=math.nan),
            "layer": np.array([region.name for region in regions], object),
            "layer_top": np.array([region.top for region in regions]),
            "layer_bottom": np.array([region.bottom for region in regions]),
        }
        for name, attribute in zip(_LARGEST, attributes, strict=True):
            peaks = [getattr(part, attribute) for part in found.maxima]
            values[f"layer_{name}"] = np.array([peak.value for peak in peaks])
            values[f"layer_{name}_depth"] = np.array([peak.depth for peak in peaks])
        if interfaces:
            values["interface"] = np.array([f"{item.above} / {item.below}" for item in interfaces], object)
            values["interface_depth"] = np.array([item.shear.depth for item in interfaces])
            values["interface_max_shear"] = np.array([item.shear.value for item in interfaces])
            values["interface_max_peel"] = np.array([item.peel.value for item in interfaces])
        return Found(values, replace(found, where=reached.where, step=reached.number), (), found.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Sections, profiles and whole planes."""
        survey = found.detail
        planes = tuple(survey.wanted_planes())
        view = view_figure(planes, step=survey.step)
        return (
            *line_figures(survey, solved.problem.boundary),
            *(
                map_figure(plane, number, solved.problem.boundary, step=survey.step)
                for number, plane in enumerate(planes, start=1)
            ),
            *(() if view is None else (view,)),
        )

    def stored(self, found: Found) -> Stored:
        """Sections, profiles and whole planes."""
        survey = found.detail
        fields = {f"section_{number}": item.field for number, item in enumerate(survey.sections, start=1)}
        fields |= {f"profile_{number}": field for number, field in enumerate(survey.profiles, start=1)}
        planes = survey.wanted_planes()
        if (first := next(planes, None)) is not None:
            fields["planes"] = chain([first], planes)
        return Stored(fields, {"drawn": [list(item.quantities) for item in survey.sections], "step": survey.step})

    def restored(self, stored: Stored, solved: Solved) -> StoredSurvey:
        """The same fields."""
        drawn = enumerate(stored.facts["drawn"], start=1)
        sections = (SurveyedSection(stored.fields[f"section_{number}"], tuple(names)) for number, names in drawn)
        profiles = (field for name, field in stored.fields.items() if name.startswith("profile_"))
        return StoredSurvey(
            tuple(sections), tuple(profiles), stored.fields.get("planes"), int(stored.facts.get("step", 0))
        )

    def step(self, found: Found, solved: Solved) -> int | None:
        """The step whose stresses are computed."""
        return solved.step_of(found.detail.step)

    def words(self, found: Found, solved: Solved) -> Words:
        """Largest stresses of layers and interfaces."""
        survey = found.detail
        strengths = strength_table(survey)
        tables = (
            ("Largest stresses inside each layer", maxima_table(survey)),
            ("Interfaces", interface_table(survey)),
            ("Given strengths", strengths),
        )
        shown = tuple((heading, table) for heading, table in tables if table.cells)
        worst = [
            f"the {name} of {value} is {text.partition(': ')[0]} of the strength ({text.partition(': ')[2]})"
            for name, value, _, text, _ in strengths.cells
        ]
        return Words(
            rows=setting_rows(survey),
            tables=shown,
            remarks=tuple(remarks(survey)),
            holds=f"Cracking: {'; '.join(worst)}." if worst else "",
            alarming=any(cells[3].endswith(FAILS) for cells in strengths.cells),
        )

    def citations(self, ask: StressRequest, problem: ContactProblem) -> tuple[str, ...]:
        """Keys of the papers that the stresses will rest on."""
        return Planned(ask, problem).citation_keys


class YieldingWork(Work):
    """Onset of yield under the stresses: what is done for it."""

    def unknown(self, ask: StressSettings, problem: ContactProblem) -> Mapping[str, str]:
        """Onset of yield where the strength of a layer or of the base is not known."""
        solids = materials_of(getattr(problem, ask.inside))
        names = dict.fromkeys(
            part.name or "a material" for part in solids if yield_pressure(part.strength).value is None
        )
        if not names:
            return {}
        return {
            "yield_load_factor": f"yield stress and hardness of {' and '.join(names)} are not known. Give one of them, "
            "as {yield_stress}"
        }

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Load factor of the survey. InputError if that failed."""
        if "stress" not in solved.found:
            raise InputError("stresses inside the body must be known, but could not be computed.")
        survey = solved.found["stress"].detail
        factor = math.nan if has_flowed(survey) else survey.yielding.load_factor
        return Found({"yield_load_factor": factor}, survey)

    def words(self, found: Found, solved: Solved) -> Words:
        """Which part of the body yields first, and when; of a body whose plastic flow is solved,
        what has flowed."""
        return yield_words(found.detail)

    def step(self, found: Found, solved: Solved) -> int | None:
        """The step whose stresses are computed."""
        return solved.step_of(solved.found["stress"].detail.step)


def yield_words(survey: StressSurvey) -> Words:
    """Which part of the body yields first, and when; of a body whose plastic flow is solved, what
    has flowed."""
    if not has_flowed(survey):
        table, yields = yield_table(survey), survey.yielding.yields
        sentence = yield_sentence(survey)
        return Words(sentence, tables=(("", table),) if table.cells else (), alarming=yields, holds=sentence)
    zones = [zone for zone in survey.result.plastic_flow.zones if zone.volume > 0.0]  # type: ignore[attr-defined]
    parts = " and ".join(
        (
            f"{zone.name} ({show(zone.top, 'm', 3)} to {show(zone.bottom, 'm', 3)} deep, strain up to "
            f"{percent(zone.largest_strain)})"
        )
        for zone in zones
    )
    known = [zone.first_yield for zone in zones if math.isfinite(zone.first_yield)]
    first = f" First yield is found in the step to a mean pressure of {show(min(known), 'Pa', 3)}." if known else ""
    sentence = f"The body has flowed plastically in {parts}; the stresses hold that plastic strain.{first}"
    return Words(sentence, holds=sentence)


def setting_rows(survey: StressSurvey) -> Rows:
    """What the stresses are those of, and where they were computed."""
    request, depths = survey.request, survey.depths
    rows = [("inside", "the body" if request.of == "body" else "the counter body")]
    if survey.where:
        rows.append(("at", survey.where))
    own = request.sheared and getattr(survey.result, "stick_slip", None) is not None
    if own:
        rows.append(("shear traction", "that found with stick and slip"))
    elif not isinstance(survey.result, LoadedBody):
        rows.append(("friction coefficient", f"{request.friction:g}"))
    if request.friction and not own:
        rows.append(
            ("direction of the shear traction on the body", f"{math.degrees(request.direction):g}° from x towards y")
        )
        effect = "changes the pressure (coupled)" if request.coupled else "does not change the pressure (uncoupled)"
        rows.append(("shear traction", effect))
    top, bottom = _length(float(depths[0])), _length(float(depths[-1]))
    rows.append(("planes", f"{depths.size} from {top} to {bottom}" if depths.size > 1 else f"1 at a depth of {top}"))
    return rows


def maxima_table(survey: StressSurvey) -> Table:
    """Largest stresses of each region, with their places; layers of one name are one."""
    cells: list[tuple[str, ...]] = []
    for regions, parts in _together(survey.maxima):
        von_mises, tension, shear = (
            max((getattr(part, name) for part in parts), key=_value) for name in ("von_mises", "tension", "shear")
        )
        rows = [
            ("von Mises", 1.0, von_mises),
            ("√J2", math.sqrt(1.0 / 3.0), von_mises),
            ("tension σ1", 1.0, tension),
            ("shear (σ1 − σ3)/2", 1.0, shear),
        ]
        label = region_text(regions)
        cells += [(label, name, peak_text(peak, factor), *_place_text(survey, peak)) for name, factor, peak in rows]
    names = {"principal_tensile": "σ_t in the plane", "shear_xz": "|σxz|", "shear_yz": "|σyz|"}
    whole = survey.whole.items()
    cells += [("whole body", names[name], peak_text(peak), *_place_text(survey, peak)) for name, peak in whole]
    return Table(("Layer", "Largest stress", "Value", "x", "y", "Depth"), tuple(cells))


def interface_table(survey: StressSurvey) -> Table:
    """Largest shear and peel of each interface, with their places; those within a graded coating
    are left out."""
    cells: list[tuple[str, ...]] = []
    for item in survey.interfaces:
        if item.above == item.below:
            continue
        label = f"{item.above} / {item.below}, {show(item.shear.depth, 'm')}"
        peel = show(item.peel.value, "Pa") if item.peel.value > 0.0 else "none"
        cells.append((label, "shear", show(item.shear.value, "Pa"), *_place_text(survey, item.shear)[:2]))
        cells.append((label, "peel (tension)", peel, *_place_text(survey, item.peel)[:2]))
    return Table(("Interface, depth", "Largest stress", "Value", "x", "y"), tuple(cells))


def yield_table(survey: StressSurvey) -> Table:
    """Strength and load factor to first yield of each region."""
    cells = []
    for regions, parts in _together(survey.yielding.regions):
        known = [part for part in parts if not math.isnan(part.load_factor)]
        worst = min(known, key=lambda part: part.load_factor) if known else max(parts, key=lambda part: part.peak.value)
        strength = show(worst.limit.value, "Pa") + (f" (H/{TABOR:g})" if worst.limit.inferred else "")
        cells.append(
            (
                region_text(regions),
                peak_text(worst.peak),
                strength if known else "not known",
                factor_text(worst) if known else "not known",
                _depth_text(worst.peak),
            )
        )
    largest = f"Largest {survey.yielding.criterion.name} stress"
    return Table(("Layer", largest, "Yield stress", "Load factor", "Depth"), tuple(cells))


def strength_table(survey: StressSurvey) -> Table:
    """Largest tension, shear and peel over the strengths that were given for them."""
    given = survey.request.strengths
    wanted = [
        ("tension", given.tensile, [part.tension for part in survey.maxima]),
        ("shear of an interface", given.interface_shear, [item.shear for item in survey.interfaces]),
        ("peel of an interface", given.interface_peel, [item.peel for item in survey.interfaces]),
    ]
    cells = []
    for name, strength, peaks in wanted:
        if not math.isnan(strength) and peaks:
            worst = max(peaks, key=_value)
            text = f"{max(worst.value, 0.0) / strength:.3g}: {verdict(worst, strength)}"
            value = peak_text(worst) if worst.value > 0.0 else show(0.0, "Pa")
            cells.append((name, value, show(strength, "Pa"), text, _depth_text(worst)))
    return Table(("Largest", "Value", "Strength", "Value / strength", "Depth"), tuple(cells))


def has_flowed(survey: StressSurvey) -> bool:
    """Whether plastic flow of the body in the volume was solved, and some of it has flowed: its
    stresses are no elastic ones."""
    flow = getattr(survey.result, "plastic_flow", None)
    return flow is not None and flow.of == survey.request.of and bool(flow.flowed.points.size)


def yield_sentence(survey: StressSurvey) -> str:
    """Which part of the body yields first, and when."""
    report, first = survey.yielding, survey.yielding.first
    if first is None:
        return (
            "No strength of any part of the body is known, so yield cannot be assessed; give a hardness "
            "or yield stress."
        )
    unknown = list(dict.fromkeys(part.region.name for part in report.regions if math.isnan(part.load_factor)))
    beside = f" The strength of {' and '.join(unknown)} is not known." if unknown else ""
    face = {"above": " (its lower face)", "below": " (its upper face)"}.get(first.peak.side, "")
    deep = f"in {first.peak.region.name} at a depth of {show(first.peak.depth, 'm')}{face}"
    where = f"at the surface of {first.peak.region.name}" if first.peak.side == "surface" else deep
    at = f"At {survey.where}: " if survey.where else ""
    if report.yields:
        return (
            f"{at}{'t' if at else 'T'}he body yields: {where}, the {report.criterion.name} stress is "
            f"{times(1.0 / report.load_factor, 3)} times the yield stress (load factor "
            f"{report.load_factor:.3g}).{beside}"
        )
    return (
        f"{at}{'n' if at else 'N'}o part of known strength yields. First would be {where}, at "
        f"{times(report.load_factor, 3)} times these stresses ({report.criterion.name}).{beside}"
    )


def remarks(survey: StressSurvey) -> list[str]:
    """What to know about these stresses before using them."""
    found = [
        "The load factor multiplies the prescribed tractions."
        if isinstance(survey.result, LoadedBody)
        else "The load factor multiplies the stresses of this contact. A rough contact grows with its "
        "load, so that its stresses rise more slowly than the load.",
        (
            "Largest values are those on the planes that were computed; at the surface those of a contact are "
            "taken at its edges, between the pixels, with their error."
        ),
    ]
    peaks = [peak for part in survey.maxima for peak in (part.von_mises, part.tension, part.shear)]
    doubts = dict.fromkeys(peak.doubt for peak in peaks if peak.doubt)
    found += [f"A largest stress at the surface is but a lower bound (>): {doubt}." for doubt in doubts]
    if has_flowed(survey):
        first_cell = float(survey.result.plastic_flow.flowed.edges[1])  # type: ignore[attr-defined]
        found[0] = (
            "The stresses are those by the tractions and by the plastic strain. In layers that may flow they "
            "are means over the depth cells, which keep to the yield stress after hardening; the first cell "
            f"is {show(first_cell, 'm', 3)} thick, and what changes within it at the surface is not resolved."
        )
    if survey.result.plastic.any():
        found.append(
            "Pressures are limited by the hardness here, but the stresses are those of an elastic body under these "
            "pressures: where they pass the yield stress they say that it yields, not how large they really are."
        )
    return found


def region_text(regions: Sequence[Region]) -> str:
    """Name and depths of a region, or of several of one name."""
    first, last = regions[0], regions[-1]
    count = f" ({len(regions)} layers)" if len(regions) > 1 else ""
    if math.isinf(last.bottom):
        return f"{first.name}{count}, below {show(first.top, 'm')}" if first.top > 0.0 else f"{first.name}{count}"
    return f"{first.name}{count}, {_length(first.top)} to {_length(last.bottom)}"


def _together(parts: Iterable[Any]) -> list[tuple[list[Region], list[Any]]]:
    """Regions and what is known of them; neighbours of one name, as of a graded coating,
    together."""
    runs = groupby(parts, key=lambda part: part.region.name)
    lists = [list(run) for _, run in runs]
    return [([part.region for part in run], run) for run in lists]


def _length(value: float) -> str:
    return show(value, "m") if value > 0.0 else "0"


def _value(peak: Any) -> float:
    return float(peak.value)


def _place_text(survey: StressSurvey, peak: Peak) -> tuple[str, str, str]:
    """x and y as in figures, in the middle of a pixel, but on a grid of one row; depth."""
    grid = survey.result.problem.grid
    x, y = (
        show(at + 0.5 * step, "m") if n > 1 else "–"
        for at, step, n in zip((peak.x, peak.y), grid.spacing, grid.shape, strict=True)
    )
    return x, y, _depth_text(peak)


def _depth_text(peak: Peak) -> str:
    if peak.side == "surface":
        return "at the surface"
    face = {"above": ", lower face", "below": ", upper face"}.get(peak.side, "")
    return f"{show(peak.depth, 'm')}{face}"
