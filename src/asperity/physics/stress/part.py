"""Stresses inside a body: the largest of each layer and interface, sections, profiles and planes; onset of yield."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, groupby
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.units import percent, show
from ...core.values import Choice, Length, NonNegativeLength, Number, Pressure
from ...parts.part import Found, Part, Rows, Solved, Stored, Table, Words
from .peaks import factor_text, peak_text, verdict

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from ..friction.part import FrictionSettings
    from .field import Peak, StressField
    from .regions import Region
    from .survey import Place, StressRequest, StressSurvey, SurveyedSection


PLACES = ("max", "pressure")
"""Words for positions: of the largest stress, and of the highest pressure."""

PlaceOfMaximum: TypeAlias = Annotated[float | str, Number("length", least=0.0, words=PLACES)]


def positions_from_text(text: str) -> dict[str, str]:
    """Positions in text such as ``"y=max"`` or ``"x=30nm, y=max"``, by axis.

    Raises
    ------
    InputError
        If a part is no position; the message lacks the name of the option or key at its beginning.
    """
    found: dict[str, str] = {}
    for part in text.split(","):
        axis, equals, position = (piece.strip() for piece in part.partition("="))
        if axis not in ("x", "y") or not equals or not position or axis in found:
            raise InputError(f' must be a position such as "y=max", "y=pressure" or "x=30nm", but is {text!r}.')
        found[axis] = position
    return found


class Placed(Settings):
    """Positions ``x`` and ``y``, each a length or a word; both together may be text such as ``"y=max"``.

    ``"max"`` is the position of the largest stress, ``"pressure"`` that of the highest pressure.
    """

    x: PlaceOfMaximum | None = None
    y: PlaceOfMaximum | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return positions_from_text(value) if isinstance(value, str) else value


class SectionTable(Placed):
    """Vertical plane through the body: exactly one of ``x`` and ``y``.

    With ``"max"`` each kind of stress is shown on the plane through its own maximum (as by Peng 2001, figs. 3.15 - 3.22).
    """

    @model_validator(mode="after")
    def _one(self) -> SectionTable:
        if (self.x is None) == (self.y is None):
            given = "none" if self.x is None else "both"
            raise InputError(f' must give exactly one of x and y, such as "y=max", but gives {given}.')
        return self


class ProfileTable(Placed):
    """Line into the body; a position that is left out is that of the largest equivalent stress, ``"max"``."""


Body = Annotated[str, Choice({"body": "body", "counter_body": "counter_body", "counter": "counter_body"})]


class StressSettings(Settings):
    """Stresses that are computed after the contact; those on the section y = max if nothing else is asked for.

    The shear traction is that of the table [friction], unless ``shear`` is false. ``depths`` are planes, ``sections`` vertical
    planes and ``profiles`` lines down to the depth ``deepest``. The strengths are compared with the largest tension, and with
    shear and peel of the interfaces.
    """

    shear: bool = setting(True, option="--shear", help="Whether the friction loads the body, too")
    inside: Body = setting("body", option="--stress-in", help="The body whose stresses are computed")
    depths: tuple[NonNegativeLength, ...] = setting((), option="--depths", help="Whole planes: 1nm,5nm,20nm")
    sections: tuple[SectionTable, ...] = setting(
        (),
        option="--section",
        help="Vertical plane through each maximum: y=max; x=30nm, y=pressure. May be repeated",
    )
    profiles: tuple[ProfileTable, ...] = setting(
        (), option="--profile", help="Line into the body: x=max,y=max; x=30nm,y=pressure. May be repeated"
    )
    deepest: Length | None = setting(
        None, option="--deepest", help="End of sections and profiles; suits the contact by default"
    )
    criterion: Literal["von_mises", "tresca"] = setting("von_mises", option="--criterion", help="Of yield")
    tensile_strength: Pressure | None = setting(
        None, option="--tensile-strength", help="To compare the largest tension with"
    )
    interface_shear_strength: Pressure | None = setting(
        None, option="--interface-shear-strength", help="To compare the shear of interfaces with"
    )
    interface_peel_strength: Pressure | None = setting(
        None, option="--interface-peel-strength", help="To compare the peel of interfaces with"
    )
    precision: Literal["double", "single"] = setting(
        "double", option="--stress-precision", help="Arithmetic of the stresses"
    )


@dataclass(frozen=True, eq=False)
class StoredSurvey:
    """Stress fields of a file: what figures show of a ``StressSurvey``."""

    sections: tuple[SurveyedSection, ...]
    profiles: tuple[StressField, ...]
    planes: StressField | None

    def wanted_planes(self) -> Iterator[StressField]:
        """The whole planes one by one."""
        return iter(()) if self.planes is None else (self.planes.only(n) for n in range(len(self.planes.planes)))


_LARGEST = {
    "max_von_mises": "largest von Mises stress",
    "max_tension": "largest tension (σ₁)",
    "max_shear": "largest shear stress",
}
"""Largest stresses that each layer has, and what they are called."""


class Stress(Part):
    """Largest stresses of layers and interfaces."""

    name = "stress"
    title = "Stresses inside the body"
    table = "stress"
    settings = StressSettings
    quantities = (
        *(Quantity(name, "Pa", text) for name, text in _LARGEST.items()),
        *(Quantity(f"{name}_error", "Pa", f"error of the {text}") for name, text in _LARGEST.items()),
        *(
            Quantity(f"{name}_{at}", "m", f"{at} of the {text}")
            for name, text in _LARGEST.items()
            for at in ("x", "y", "depth")
        ),
        Quantity("max_interface_shear", "Pa", "largest shear on an interface"),
        Quantity("max_interface_peel", "Pa", "largest peel of an interface"),
        Quantity("layer", "", "layer, from the surface down", dims=("layer",)),
        Quantity("layer_top", "m", "depth of the top of the layer", dims=("layer",)),
        Quantity("layer_bottom", "m", "depth of the bottom of the layer", dims=("layer",)),
        *(Quantity(f"layer_{name}", "Pa", f"{text} in the layer", dims=("layer",)) for name, text in _LARGEST.items()),
        *(
            Quantity(f"layer_{name}_depth", "m", f"depth of the {text} in the layer", dims=("layer",))
            for name, text in _LARGEST.items()
        ),
        Quantity("interface", "", "materials above and below the interface", dims=("interface",)),
        Quantity("interface_depth", "m", "depth of the interface", dims=("interface",)),
        Quantity("interface_max_shear", "Pa", "largest shear on the interface", dims=("interface",)),
        Quantity("interface_max_peel", "Pa", "largest peel of the interface", dims=("interface",)),
    )

    def asked(self, document: Any, folder: Path) -> StressRequest:
        """The request of the table [stress], with the friction of the table [friction]."""
        return stress_request(document.stress, getattr(document, "friction", None))

    def check(self, ask: StressRequest, problem: ContactProblem) -> None:
        """Refuse what the problem has no stress for, in the words of documents and options."""
        from ...solids.elastic import Rigid

        if isinstance(getattr(problem, ask.of), Rigid):
            asked, other = ("counter body", "body") if ask.of == "counter_body" else ("body", "counter_body")
            raise InputError(
                f"body in which stresses are asked must deform, but the {asked} is rigid; ask for them in the other body "
                f'(inside = "{other}" in a document, or --stress-in {other}).'
            )
        ask.check(problem)

    def compute(self, ask: StressRequest, solved: Solved) -> Found:
        """Largest stresses; the survey with sections and profiles as detail."""
        from .survey import survey

        with solved.stage("stresses") as progress:
            found = survey(ask, solved.result, lines=solved.lines, threads=solved.threads, progress=progress)
        values = {
            **_in_all(found),
            "max_interface_shear": _largest(found, "interfaces", "shear"),
            "max_interface_peel": _largest(found, "interfaces", "peel"),
            **_by_layer(found),
        }
        return Found(values, found, (), found.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Sections, profiles and whole planes."""
        from .figures import line_figures, map_figure

        survey = found.detail
        planes = enumerate(survey.wanted_planes(), start=1)
        return (
            *line_figures(survey, solved.problem.boundary),
            *(map_figure(plane, number, solved.problem.boundary) for number, plane in planes),
        )

    def stored(self, found: Found) -> Stored:
        """Sections, profiles and whole planes."""
        survey = found.detail
        fields = {f"section_{number}": item.field for number, item in enumerate(survey.sections, start=1)}
        fields |= {f"profile_{number}": field for number, field in enumerate(survey.profiles, start=1)}
        planes = survey.wanted_planes()
        if (first := next(planes, None)) is not None:
            fields["planes"] = chain([first], planes)
        return Stored(fields, {"drawn": [list(item.quantities) for item in survey.sections]})

    def restored(self, stored: Stored, solved: Solved) -> StoredSurvey:
        """The same fields."""
        from .survey import SurveyedSection

        drawn = enumerate(stored.facts["drawn"], start=1)
        sections = (SurveyedSection(stored.fields[f"section_{number}"], tuple(names)) for number, names in drawn)
        profiles = (field for name, field in stored.fields.items() if name.startswith("profile_"))
        return StoredSurvey(tuple(sections), tuple(profiles), stored.fields.get("planes"))

    def words(self, found: Found, solved: Solved) -> Words:
        """Largest stresses of layers and interfaces."""
        return stress_words(found.detail)

    def citations(self, ask: StressRequest, problem: ContactProblem) -> tuple[str, ...]:
        """Keys of the papers that the stresses will rest on."""
        from .survey import Planned

        return Planned(ask, problem).citation_keys


class Yielding(Part):
    """Onset of yield under the stresses."""

    name = "yielding"
    title = "Onset of yield"
    table = "stress"
    quantities = (Quantity("yield_load_factor", "1", "factor on the stresses at yield"),)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Load factor of the survey. InputError if that failed."""
        if "stress" not in solved.found:
            raise InputError("stresses inside the body must be known, but could not be computed.")
        survey = solved.found["stress"].detail
        factor = math.nan if has_flowed(survey) else survey.yielding.load_factor
        return Found({"yield_load_factor": factor}, survey)

    def words(self, found: Found, solved: Solved) -> Words:
        """Which part of the body yields first, and when."""
        return yield_words(found.detail)


def _by_layer(survey: StressSurvey) -> dict[str, Any]:
    """Largest stresses of each layer with their depths, and of each interface, by the names of their quantities."""
    import numpy as np

    regions, interfaces = [part.region for part in survey.maxima], survey.interfaces
    made: dict[str, Any] = {
        "layer": np.array([region.name for region in regions], object),
        "layer_top": np.array([region.top for region in regions]),
        "layer_bottom": np.array([region.bottom for region in regions]),
    }
    for name, attribute in zip(_LARGEST, ("von_mises", "tension", "shear"), strict=True):
        peaks = [getattr(part, attribute) for part in survey.maxima]
        made[f"layer_{name}"] = np.array([peak.value for peak in peaks])
        made[f"layer_{name}_depth"] = np.array([peak.depth for peak in peaks])
    if interfaces:
        made["interface"] = np.array([f"{item.above} / {item.below}" for item in interfaces], object)
        made["interface_depth"] = np.array([item.shear.depth for item in interfaces])
        made["interface_max_shear"] = np.array([item.shear.value for item in interfaces])
        made["interface_max_peel"] = np.array([item.peel.value for item in interfaces])
    return made


def _in_all(survey: StressSurvey) -> dict[str, float]:
    """Largest stresses of all layers with their errors and places, x and y in the middle of a pixel, as in figures."""
    found: dict[str, float] = {}
    for name, attribute in zip(_LARGEST, ("von_mises", "tension", "shear"), strict=True):
        peak: Peak = max((getattr(part, attribute) for part in survey.maxima), key=_value)
        x, y = (at + 0.5 * step for at, step in zip((peak.x, peak.y), survey.result.problem.grid.spacing, strict=True))
        found |= {name: peak.value, f"{name}_error": peak.error}
        found |= {f"{name}_x": x, f"{name}_y": y, f"{name}_depth": peak.depth}
    return found


def _largest(survey: StressSurvey, parts: str, peak: str) -> float:
    """Largest value of the ``peak`` in all ``parts`` of the ``survey``; NaN where there are none."""
    return max((getattr(part, peak).value for part in attrgetter(parts)(survey)), default=math.nan)


def stress_request(table: StressSettings, friction: FrictionSettings | None = None) -> StressRequest:
    """Stresses that ``table`` requests, under ``friction``; the section through the maximum where it requests none."""
    from .criteria import Tresca, VonMises
    from .survey import Strengths, StressRequest, WantedProfile, WantedSection

    given = table.given("sections", "profiles")
    sections = tuple(
        WantedSection("y", _place(wanted.y)) if wanted.x is None else WantedSection("x", _place(wanted.x))
        for wanted in table.sections
    )
    profiles = tuple(WantedProfile(_place(wanted.x), _place(wanted.y)) for wanted in table.profiles)
    strengths = {name: given[f"{name}_strength"] for name in vars(Strengths()) if f"{name}_strength" in given}
    return StressRequest(
        friction=friction.coefficient if friction is not None and table.shear else 0.0,
        direction=0.0 if friction is None else friction.direction,
        coupled=friction is not None and bool(friction.coupled),
        sheared=table.shear,
        of="counter_body" if table.inside == "counter_body" else "body",
        depths=table.depths,
        sections=sections if sections or profiles or table.depths else StressRequest().sections,
        profiles=profiles,
        deepest=table.deepest,
        criterion=Tresca() if table.criterion == "tresca" else VonMises(),
        strengths=Strengths(**strengths),
        dtype="float32" if table.precision == "single" else "float64",
    )


def _place(value: float | str | None) -> Place:
    if value is None or value == PLACES[0]:
        return "max"
    return "pressure" if isinstance(value, str) else float(value)


# In words and tables.


def stress_words(survey: StressSurvey) -> Words:
    """Settings, and the largest stresses of layers and interfaces."""
    tables = (
        ("Largest stresses inside each layer", maxima_table(survey)),
        ("Interfaces", interface_table(survey)),
        ("Given strengths", strength_table(survey)),
    )
    shown = tuple((heading, table) for heading, table in tables if table.cells)
    return Words(rows=setting_rows(survey), tables=shown, remarks=tuple(remarks(survey)))


def yield_words(survey: StressSurvey) -> Words:
    """Which part of the body yields first, and when; of a body whose plastic flow is solved, what has flowed."""
    if has_flowed(survey):
        return Words(flow_sentence(survey))
    table = yield_table(survey)
    return Words(yield_sentence(survey), tables=(("", table),) if table.cells else (), alarming=survey.yielding.yields)


def setting_rows(survey: StressSurvey) -> Rows:
    """What the stresses are those of, and where they were computed."""
    request, depths = survey.request, survey.depths
    rows = [("inside", "the body" if request.of == "body" else "the counter body")]
    own = request.sheared and getattr(survey.result, "stick_slip", None) is not None
    if own:
        rows.append(("shear traction", "that found with stick and slip"))
    elif not _prescribed(survey):
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
    """Largest shear and peel of each interface, with their places; those within a graded coating are left out."""
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
    from ...solids.elastic import TABOR

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
    """Whether plastic flow of the body in the volume was solved, and some of it has flowed: its stresses are no elastic ones."""
    flow = getattr(survey.result, "plastic_flow", None)
    return flow is not None and flow.of == survey.request.of and bool(flow.flowed.points.size)


def flow_sentence(survey: StressSurvey) -> str:
    """Which parts have flowed, and from which load on."""
    zones = [zone for zone in survey.result.plastic_flow.zones if zone.volume > 0.0]  # type: ignore[attr-defined]
    parts = " and ".join(
        f"{zone.name} ({show(zone.top, 'm', 3)} to {show(zone.bottom, 'm', 3)} deep, strain up to {percent(zone.largest_strain)})"
        for zone in zones
    )
    known = [zone.first_yield for zone in zones if math.isfinite(zone.first_yield)]
    first = f" First yield is found in the step to a mean pressure of {show(min(known), 'Pa', 3)}." if known else ""
    return f"The body has flowed plastically in {parts}; the stresses hold that plastic strain.{first}"


def yield_sentence(survey: StressSurvey) -> str:
    """Which part of the body yields first, and when."""
    report, first = survey.yielding, survey.yielding.first
    if first is None:
        return "No strength of any part of the body is known, so yield cannot be assessed; give a hardness or yield stress."
    unknown = list(dict.fromkeys(part.region.name for part in report.regions if math.isnan(part.load_factor)))
    beside = f" The strength of {' and '.join(unknown)} is not known." if unknown else ""
    where = _where(first.peak)
    if report.yields:
        return (
            f"The body yields: {where}, the {report.criterion.name} stress is {1.0 / report.load_factor:.3g} times the "
            f"yield stress (load factor {report.load_factor:.3g}).{beside}"
        )
    return (
        f"No part of known strength yields. First would be {where}, at {report.load_factor:.3g} times these stresses "
        f"({report.criterion.name}).{beside}"
    )


def remarks(survey: StressSurvey) -> list[str]:
    """What to know about these stresses before using them."""
    found = [
        "The load factor multiplies the prescribed tractions."
        if _prescribed(survey)
        else "The load factor multiplies the stresses of this contact. A rough contact grows with its load, so that its "
        "stresses rise more slowly than the load.",
        "Largest values are those on the planes that were computed; at the surface those of a contact are taken at its edges, between the pixels, with their error.",
    ]
    peaks = [peak for part in survey.maxima for peak in (part.von_mises, part.tension, part.shear)]
    doubts = dict.fromkeys(peak.doubt for peak in peaks if peak.doubt)
    found += [f"A largest stress at the surface is but a lower bound (>): {doubt}." for doubt in doubts]
    if has_flowed(survey):
        found[0] = (
            "The stresses are those by the tractions and by the plastic strain. In layers that may flow they are means over the depth cells, which keep to the "
            f"yield stress after hardening; the first cell is {show(_first_cell(survey), 'm', 3)} thick, and what changes within it at the surface is not resolved."
        )
    if survey.result.plastic.any():
        found.append(
            "Pressures are limited by the hardness here, but the stresses are those of an elastic body under these "
            "pressures: where they pass the yield stress they say that it yields, not how large they really are."
        )
    return found


def _first_cell(survey: StressSurvey) -> float:
    """Thickness (m) of the depth cell at the surface of a body that has flowed."""
    return float(survey.result.plastic_flow.flowed.edges[1])  # type: ignore[attr-defined]


def _prescribed(survey: StressSurvey) -> bool:
    """Whether the tractions were given, and no contact was solved."""
    from .tractions import LoadedBody

    return isinstance(survey.result, LoadedBody)


def region_text(regions: Sequence[Region]) -> str:
    """Name and depths of a region, or of several of one name."""
    first, last = regions[0], regions[-1]
    count = f" ({len(regions)} layers)" if len(regions) > 1 else ""
    if math.isinf(last.bottom):
        return f"{first.name}{count}, below {show(first.top, 'm')}" if first.top > 0.0 else f"{first.name}{count}"
    return f"{first.name}{count}, {_length(first.top)} to {_length(last.bottom)}"


def _together(parts: Iterable[Any]) -> list[tuple[list[Region], list[Any]]]:
    """Regions and what is known of them; neighbours of one name, as of a graded coating, together."""
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


def _where(peak: Peak) -> str:
    """Place of a ``peak`` within a sentence."""
    name = peak.region.name
    if peak.side == "surface":
        return f"at the surface of {name}"
    face = {"above": " (its lower face)", "below": " (its upper face)"}.get(peak.side, "")
    return f"in {name} at a depth of {show(peak.depth, 'm')}{face}"


def _depth_text(peak: Peak) -> str:
    if peak.side == "surface":
        return "at the surface"
    face = {"above": ", lower face", "below": ", upper face"}.get(peak.side, "")
    return f"{show(peak.depth, 'm')}{face}"
