"""Checks of resolution and regime, before and after a solve, each with criterion, numbers and
remedy."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..contact.certificate import LARGEST_DUALITY_GAP
from ..contact.controls import Control, Force, MeanPressure, mean_pressure
from ..contact.history import HistoryResult
from ..contact.law import InterfaceLaw, LimitByDepth
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..core.status import Advice, free_memory, room_text
from ..core.units import percent, show, times
from ..solids.elastic import TABOR, Elastic, yield_pressure
from ..solids.layers import Layered, RigidBase, materials_of, strength_of, unknown_strengths
from ..surfaces.characterise.heights import rms_height
from ..surfaces.characterise.slopes import axis_index, rms_profile_curvature, stencil_sums
from ..surfaces.prepare.level import SPIKES
from ..surfaces.surface import Surface

LARGEST_SLOPE = 0.3
"""Half-space theory neglects slopes squared: 9 % at 0.3."""

PIXELS_PER_WAVE = 6.0
"""Finite differences of a sine of 6 pixels err by 9 % in curvature, of 4 pixels by 19 %."""

PIXELS_PER_RADIUS = 2.0
"""An asperity of this radius rises over neighbouring pixels with a slope of one half."""

LARGEST_EDGE_JUMP = 3.0
"""Rms step across the border in rms steps inside: beyond it the border is a ridge the surface does
not have."""

LARGEST_LOAD_RATIO = 0.1
"""Mean pressure over contact modulus, about the mean strain; linear elasticity neglects its
square."""

NEARLY_FULL = 0.95
"""Area fraction above which the open area is a few per cent and of the order of the pixel
correction."""

LARGEST_AREA_CORRECTION = 0.15
"""Share of the pixel area that the place of the edges between pixels takes, at spots of about ten
pixels."""

FEWEST_CONTACT_PIXELS = 10
"""Number of contact pixels below which their count is inaccurate."""

LEAST_HEIGHT, LARGEST_HEIGHT = 1e-12, 1e-2
"""Rms heights in m between a hundredth of an atom and what stands on a bench."""

LARGEST_PATCH = 1.0 / 8.0
"""Contact diameter over period at which images bend the surface by 0.9 % of P/(pi E* L) (see the
analytic tests)."""

FIELDS_OF_A_SOLVE = 16
"""Real fields of the grid in memory during a solve, result included."""


PIXELS_PER_LAYER = 1.0
"""A pressure that varies from pixel to pixel (wavelength 2 pixels) reaches exp(-pi) = 4 % deep into
a layer of one pixel."""

LARGEST_THICKNESS = 0.5
"""Thickness over period at which the longest wave has decayed to (1 + pi) exp(-pi) = 18 % of its
pressure below the layers."""

AREAS = ("area_fraction", "contact_area", "mean_real_pressure", "n_spots", "mean_spot_area", "contact_perimeter")
"""Numbers of a result that follow from what touches."""

PRESSURES = ("max_pressure",)
"""Numbers of a result that follow from the pressure of single pixels."""

STRESSES = (
    *("max_von_mises", "max_tension", "max_shear", "max_interface", "layer_max", "interface_max"),
    "yield_load_factor",
)
"""Numbers of the stresses under those pressures, or their beginnings."""

DOUBT = "duality gap"
"""Criterion of the warning that stands above all others."""


def advise(problem: ContactProblem, control: Control) -> tuple[Advice, ...]:
    """Findings that can be made before solving: slopes, resolution, edges, load, layers, memory."""
    profile = Surface(problem.profile(), *problem.grid.spacing)
    return (
        *_slope(profile),
        *_resolution(profile),
        *_edges(problem, profile),
        *_load(problem, control),
        *_layers(problem),
        *_memory(problem),
        *_units(problem),
        *_of_files(problem),
        *(found for physics in problem.physics for found in physics.advice()),
    )


def _of_files(problem: ContactProblem) -> Iterator[Advice]:
    """What was doubtful in the files of the surfaces and has not been dealt with since."""
    for surface in (problem.surface, problem.counter_surface):
        if isinstance(surface, Surface):
            masked = any(step.startswith("despiked") for step in surface.origin.history)
            for finding in surface.origin.findings:
                if finding.level == "warning" and not (masked and finding.criterion == SPIKES):
                    yield finding


def findings(solved: ContactResult | HistoryResult) -> tuple[Advice, ...]:
    """Everything that should be known before the numbers of what was ``solved`` are used:
    ``advise`` on it and ``review`` of it."""
    peak = solved.steps[solved.peak] if isinstance(solved, HistoryResult) else solved
    found = (*advise(peak.problem, peak.control), *review(solved))
    return tuple(sorted(found, key=lambda item: item.criterion != DOUBT))


def review(solved: ContactResult | HistoryResult) -> tuple[Advice, ...]:
    """Findings that need the solution: resolved contacts, near-full contact, edges reached,
    hardness exceeded, and those of each physics.

    Of a history they are those of its step of the largest force, and those that its last step has
    beside these.
    """
    if not isinstance(solved, HistoryResult):
        return _review(solved)
    steps, number = solved.steps, solved.peak
    found = [item for item in _review(steps[number]) if item.criterion != DOUBT]
    if number < len(steps) - 1:
        known = {DOUBT, *(item.criterion for item in found)}
        end = [item for item in _review(solved.last) if item.criterion not in known]
        found = [
            *(replace(item, fact=f"At the largest force (step {number + 1}): {item.fact}") for item in found),
            *(replace(item, fact=f"At the end: {item.fact}") for item in end),
        ]
    return (*doubts(*steps), *found)


def _review(result: ContactResult) -> tuple[Advice, ...]:
    return (
        *doubts(result),
        *_contact_pixels(result),
        *_room(result),
        *_seam(result),
        *_plastic(result),
        *_hardness(result),
        *(found for answer in result.answers for found in answer.findings(result.certificate)),
    )


def _slope(profile: Surface) -> Iterator[Advice]:
    slope = math.sqrt(
        sum(_mean_square(profile, axis, 1) / d**2 for axis, d in zip("xy", profile.grid.spacing, strict=True))
    )
    if slope > LARGEST_SLOPE:
        yield Advice(
            "warning",
            "slope",
            f"The rms slope is {slope:.2g}; half-space theory assumes small slopes (up to about {LARGEST_SLOPE:g}).",
            "Treat areas and pressures as qualitative, or smooth the surface to the scale of interest: {smooth}.",
            {"rms_slope": slope, "largest": LARGEST_SLOPE},
            (*AREAS, *PRESSURES, *STRESSES),
        )


def _resolution(profile: Surface) -> Iterator[Advice]:
    """Shortest effective wavelength 2 pi sqrt(m2/m4), of a sine exactly its wavelength, and mean
    summit radius 3/8 sqrt(pi/m4) of a Gaussian surface (Nayak 1971), against the pixel."""
    wavelengths = {}
    for axis in "xy":
        m2, m4 = (_mean_square(profile, axis, order) for order in (1, 2))
        if m4 > 0.0 and (pixels := 2.0 * math.pi * math.sqrt(m2 / m4)) < PIXELS_PER_WAVE:
            wavelengths[axis] = pixels
    if wavelengths:
        shown = {axis: math.floor(10.0 * pixels) / 10.0 for axis, pixels in wavelengths.items()}  # 5.97 is not 6.0
        found = " and ".join(f"{pixels:.1f} pixels along {axis}" for axis, pixels in shown.items())
        yield Advice(
            "warning",
            "resolution",
            f"The shortest effective wavelength 2π√(m2/m4) is {found} (at least {PIXELS_PER_WAVE:g} wanted): "
            "asperities are not resolved, so contact area and peak pressure depend on the pixel size.",
            "Resample to a finer grid ({resample}) or give the surface a short-wavelength cut-off ({smooth}).",
            {f"pixels_{axis}": pixels for axis, pixels in wavelengths.items()} | {"least": PIXELS_PER_WAVE},
            (*AREAS, *PRESSURES, *STRESSES),
        )
    if min(profile.shape) < 3:
        return
    m4 = 0.5 * sum(rms_profile_curvature(profile, axis=axis) ** 2 for axis in "xy")
    radius, pixel = 0.375 * math.sqrt(math.pi / m4) if m4 > 0.0 else math.inf, max(profile.grid.spacing)
    if radius < PIXELS_PER_RADIUS * pixel:
        yield Advice(
            "warning",
            "asperity radius",
            f"The mean asperity radius 3/8 √(π/m4) is {radius / pixel:.2g} pixels (at least {PIXELS_PER_RADIUS:g} "
            "wanted): asperities are spikes of single pixels.",
            "Check the height unit ({height_unit}), refine the grid ({resample}), or smooth the surface ({smooth}).",
            {"pixels": radius / pixel, "radius": radius, "least": PIXELS_PER_RADIUS},
            (*AREAS, *PRESSURES, *STRESSES),
        )


def _edges(problem: ContactProblem, profile: Surface) -> Iterator[Advice]:
    for axis, name in enumerate("xy"):
        if profile.shape[axis] < 2 or not problem.boundary.wraps[axis]:
            continue
        inside = _mean_square(profile, name, 1)
        across = float(((profile.heights.take(0, axis=axis) - profile.heights.take(-1, axis=axis)) ** 2).mean())
        if across > LARGEST_EDGE_JUMP**2 * inside:
            jump = (
                f"{math.sqrt(across / inside):.1f} times the rms step between neighbours" if inside > 0.0 else "a jump"
            )
            yield Advice(
                "warning",
                "periodic edges",
                f"The surface does not repeat along {name}: across the border its rms step is {jump}, and the "
                "periodic boundary turns that into a cliff.",
                "Periodise it ({periodise}), taper it ({taper}), or use the free boundary ({free}).",
                {"jump": math.sqrt(across), "rms_step": math.sqrt(inside), "largest_ratio": LARGEST_EDGE_JUMP},
                (*AREAS, *PRESSURES, *STRESSES),
            )


def _load(problem: ContactProblem, control: Control) -> Iterator[Advice]:
    if not isinstance(control, MeanPressure | Force):
        return
    # E* as if each body consisted of its softest material, layers and base included
    bodies = (materials_of(body) for body in (problem.body, problem.counter_body))
    softest = (max((1.0 / solid.plane_strain_modulus for solid in solids), default=0.0) for solids in bodies)
    ratio = mean_pressure(control, problem.grid) / (1.0 / sum(softest))
    if ratio > LARGEST_LOAD_RATIO:
        yield Advice(
            "warning",
            "load",
            f"The mean pressure is {times(ratio)} of the contact modulus E* of the softest materials; linear "
            f"elasticity holds up to about {LARGEST_LOAD_RATIO:g}.",
            "Check unit and value of the load ({load}).",
            {"ratio": ratio, "largest": LARGEST_LOAD_RATIO},
        )


def _memory(problem: ContactProblem) -> Iterator[Advice]:
    padding = 1 if all(problem.boundary.wraps) else 4
    needed = 8.0 * FIELDS_OF_A_SOLVE * padding * problem.grid.n_points
    if needed > free_memory():
        yield Advice(
            "warning",
            "memory",
            f"The solve needs about {room_text(needed)}.",
            "Crop the surface ({crop}) or resample it to fewer points ({resample}).",
            {"needed": needed, "free": free_memory()},
        )


def doubts(*results: ContactResult) -> tuple[Advice, ...]:
    """Warning that the elastic energy is hardly known in one of the ``results``; it stands above
    all other words on them."""
    gap = max(result.certificate.duality_gap for result in results)
    if gap <= LARGEST_DUALITY_GAP:
        return ()
    fact = (
        f"The elastic energy is known to {gap:.1e} of itself only (duality gap, at most "
        f"{LARGEST_DUALITY_GAP:g} wanted): pressures may be wrong."
    )
    remedy = "Use a smaller tolerance ({tolerance}) or another solver ({solver})."
    return (Advice("warning", DOUBT, fact, remedy, {"duality_gap": gap, "largest": LARGEST_DUALITY_GAP}),)


def _contact_pixels(result: ContactResult) -> Iterator[Advice]:
    pixels = int(np.count_nonzero(result.contact))
    if 0 < pixels < FEWEST_CONTACT_PIXELS:
        yield Advice(
            "warning",
            "contact pixels",
            f"The contact has {pixels} pixel{'s' if pixels > 1 else ''} (at least {FEWEST_CONTACT_PIXELS} "
            "wanted): area and peak pressure are set by the pixel size.",
            "Raise the load ({load}) or refine the grid ({resample}).",
            {"pixels": float(pixels), "least": float(FEWEST_CONTACT_PIXELS)},
            (*AREAS, *PRESSURES, *STRESSES),
        )
    elif (
        pixels and (correction := 1.0 - result.area_fraction_corrected / result.area_fraction) > LARGEST_AREA_CORRECTION
    ):
        yield Advice(
            "warning",
            "contact pixels",
            f"The real contact area is {100 * correction:.0f} % less than that of the pixels in contact (more than "
            f"{100 * LARGEST_AREA_CORRECTION:.0f} %): contact spots are only a few pixels wide.",
            "Refine the grid ({resample}).",
            {"correction": correction, "largest": LARGEST_AREA_CORRECTION},
            (*AREAS, *PRESSURES, *STRESSES),
        )
    if result.area_fraction > NEARLY_FULL:
        yield Advice(
            "note",
            "near-full contact",
            f"The contact is {100 * result.area_fraction:.1f} % of the nominal area; what remains open is set by the "
            "shortest waves and the numerical tolerance.",
            numbers={"area_fraction": result.area_fraction, "largest": NEARLY_FULL},
            concerns=("mean_gap",),
        )


def _room(result: ContactResult) -> Iterator[Advice]:
    contact, problem = result.contact, result.problem
    if not contact.any():
        return
    open_axes = [axis for axis in (0, 1) if not problem.boundary.wraps[axis]]
    if open_axes:
        if any(contact.take([0, -1], axis).any() for axis in open_axes):
            yield Advice(
                "note",
                "contact at the border",
                "Contact reaches the border of the grid, beyond which the free boundary has nothing to touch: "
                "the map acts as a punch of its own outline.",
                "For a nominally flat surface the periodic boundary ({periodic}) is the usual choice.",
                concerns=PRESSURES,
            )
    elif not problem.surface.periodic and result.n_spots == 1:
        widths = [np.ptp(np.flatnonzero(contact.any(axis=1 - axis))) / contact.shape[axis] for axis in (0, 1)]
        if max(widths) > LARGEST_PATCH:
            yield Advice(
                "warning",
                "patch against period",
                f"The single contact spot is {max(widths):.2f} of the period wide (at most {LARGEST_PATCH:g} "
                "wanted): it interacts with its periodic images.",
                "Use the free boundary ({free}) or a larger grid.",
                {"width": float(max(widths)), "largest": LARGEST_PATCH},
                ("approach", "mean_gap", "elastic_energy", *AREAS, *PRESSURES),
            )


def _seam(result: ContactResult) -> Iterator[Advice]:
    """Whether the highest pressure lies where opposite borders of a map meet that does not
    repeat."""
    problem, pressure = result.problem, result.pressure
    wrapped = [axis for axis in (0, 1) if problem.boundary.wraps[axis] and pressure.shape[axis] > 2]
    if not wrapped or all(getattr(s, "periodic", True) for s in (problem.surface, problem.counter_surface)):
        return
    seam = np.zeros(pressure.shape, dtype=bool)
    for axis in wrapped:
        np.moveaxis(seam, axis, 0)[[0, -1]] = True
    highest, inside = float(pressure[seam].max()), float(pressure[~seam].max())
    if highest > inside * (1.0 + 1e-6):
        share = float(pressure[seam].sum() / pressure.sum())
        yield Advice(
            "warning",
            "pressure at the seam",
            f"The maximum pressure, {show(highest, 'Pa')}, lies at the seam where opposite borders of the map "
            f"meet, which does not repeat; elsewhere it is at most {show(inside, 'Pa')}. These border pixels "
            f"are {percent(float(seam.mean()), 2)} of the area and carry {percent(share, 2)} of the load.",
            "Periodise the map ({periodise}).",
            {"seam": highest, "elsewhere": inside, "load_share": share},
            (*PRESSURES, *STRESSES),
        )


def _plastic(result: ContactResult) -> Iterator[Advice]:
    if result.plastic_area_fraction > NEARLY_FULL and result.area_fraction > NEARLY_FULL:
        yield Advice(
            "warning",
            "yield everywhere",
            f"The pressure is at the hardness on {100 * result.plastic_area_fraction:.0f} % of a contact that "
            f"covers {100 * result.area_fraction:.0f} % of the nominal area: the pressure distribution hardly "
            "depends on position or load.",
            "Check load or position ({load}) and hardness.",
            {
                "plastic_area_fraction": result.plastic_area_fraction,
                "area_fraction": result.area_fraction,
                "largest": NEARLY_FULL,
            },
            PRESSURES,
        )


def _hardness(result: ContactResult) -> Iterator[Advice]:
    problem, unknown = result.problem, []
    surfaces = strength_of(problem.body, problem.counter_body)
    for surface in surfaces:
        if any(answer.imprint(surface.body) is not None for answer in result.answers):
            continue  # its flow is solved
        body = getattr(problem, surface.body)
        if getattr(problem.law, "body", None) == body:
            continue  # pressed through its top layer it bears more or less than that layer's hardness
        if surface.pressure is None:
            unknown.append(surface.material)
        elif result.max_pressure > surface.pressure * (
            1.0 + 1e-9
        ):  # reaching a cap equal to the hardness is as it should be
            ratio = result.max_pressure / surface.pressure
            above = f"is {times(ratio)} times" if ratio >= 1.05 else f"is {percent(ratio - 1.0, 2)} above"
            limit = (
                "the hardness"
                if surface.by_hardness
                else f"{show(surface.pressure, 'Pa')}, {TABOR:g} times the yield stress"
            )
            by_depth = isinstance(body, Layered) and body.reduced.layers and not unknown_strengths(body)
            law = "hardness by depth ({effective_hardness})" if by_depth else "hardness ({hardness})"
            yield Advice(
                "warning",
                "hardness",
                f"The maximum pressure {above} {limit} of {surface.material}: it would yield.",
                f"Limit the pressure by the {law}.",
                {"max_pressure": result.max_pressure, "hardness": surface.pressure},
                (*AREAS, *PRESSURES, *STRESSES),
            )
    cap = np.max(problem.law.pressure_cap())
    taken = any(surface.pressure is not None and math.isclose(surface.pressure, cap) for surface in surfaces)
    if (
        unknown
        and result.max_pressure > 0.0
        and (taken or not np.isfinite(cap) or isinstance(problem.law, LimitByDepth))
    ):
        yield Advice(
            "note",
            "yielding",
            f"Yielding of {' and '.join(unknown)} is not checked: neither hardness nor yield stress is known.",
            f"Give H or Y ({{yield_stress}}), with which the maximum pressure, "
            f"{show(result.max_pressure, 'Pa')}, is compared.",
            {"max_pressure": result.max_pressure},
        )


def _mean_square(profile: Surface, axis: str, order: int) -> float:
    """Mean square of the differences of ``order`` along ``axis`` inside the grid; 0 where there are
    too few points."""
    return stencil_sums(profile, axis, order, 1).square if profile.shape[axis_index(axis)] > order else 0.0


def _layers(problem: ContactProblem) -> Iterator[Advice]:
    """Layers thinner than a pixel, or so thick that what lies below hardly matters in a periodic
    cell; softer, harder and unknown ones below."""
    pixel = max(problem.grid.pixels)
    periods = [
        L
        for L, n, wraps in zip(problem.grid.size, problem.grid.shape, problem.boundary.wraps, strict=True)
        if wraps and n > 1
    ]
    for given in (problem.body, problem.counter_body):
        if not isinstance(given, Layered):
            continue
        body = given.reduced
        thin = [layer.thickness for layer in body.layers if layer.thickness < PIXELS_PER_LAYER * pixel]
        if thin:
            count = f"{len(thin)} layers are" if len(thin) > 1 else "A layer is"
            yield Advice(
                "note",
                "layer against pixel",
                f"{count} thinner than a pixel (the thinnest {min(thin) / pixel:.2g} pixels, at least "
                f"{PIXELS_PER_LAYER:g} wanted): deflections of resolved waves are right, but peak pressures "
                "and stresses on the scale of the layer are not resolved.",
                "Refine the grid to the scale of the layer ({resample}).",
                {"thickness": min(thin), "pixel": pixel, "least_pixels": PIXELS_PER_LAYER},
                (*PRESSURES, *STRESSES),
            )
        # the longest wave along an axis that wraps; a base as soft as the lowest layer makes no
        # difference
        share = body.thickness / max(periods) if periods and body.layers else 0.0
        base = body.base.plane_strain_modulus if isinstance(body.base, Elastic) else math.inf
        if share > LARGEST_THICKNESS and base != body.layers[-1].material.plane_strain_modulus:
            yield Advice(
                "note",
                "layer against period",
                f"The layers are {share:.2g} of the period thick (more than {LARGEST_THICKNESS:g}): even the "
                "longest wave hardly reaches the base, whose material then makes little difference.",
                "Use a larger map, or the free boundary ({free}) for a single contact.",
                {"share": share, "largest": LARGEST_THICKNESS},
                ("approach", "elastic_energy"),
            )
        yield from _below(problem.law, body)


def _below(law: InterfaceLaw, body: Layered) -> Iterator[Advice]:
    """Materials under the surface of the layered ``body`` that bear less or more than the limit of
    the pressure, or of which it is not known."""
    # a limit does not concern what lies below the surface, where a softer material may yield first
    # and a harder one supports the layer
    limit = math.inf if isinstance(law, LimitByDepth) else float(np.max(law.pressure_cap()))
    surface, *below = (yield_pressure(part.strength).value for part in materials_of(body))
    known = [strength for strength in below if strength is not None]
    if not body.layers or not math.isfinite(limit):
        return
    softer = [strength for strength in known if strength < min(limit, limit if surface is None else surface)]
    if softer:
        yield Advice(
            "note",
            "softer layers below",
            f"The pressure is limited to {show(limit, 'Pa')} at the surface, but a material below it has a "
            f"hardness of only {show(min(softer), 'Pa')}: under contacts wide against the layers it yields "
            "first, at a lower pressure.",
            "Limit the pressure by the effective hardness ({effective_hardness}), or compute the stresses "
            "({stresses}), which tell the load factor of each layer.",
            {"limit": limit, "hardness": min(softer)},
            (*AREAS, *PRESSURES, "plastic_"),
        )
    if surface is None or not math.isclose(limit, surface):
        return  # another limit than the strength of the top layer
    missing = unknown_strengths(body)
    given = f", once H or Y is given instead of {' and '.join(missing)}" if missing else ""
    if any(strength > limit * (1.0 + 1e-9) for strength in known) or isinstance(body.base, RigidBase):
        most = (
            "the base is rigid"
            if isinstance(body.base, RigidBase)
            else f"a material below it bears {show(max(known), 'Pa')}"
        )
        yield Advice(
            "note",
            "harder layers below",
            f"The pressure is limited to {show(limit, 'Pa')}, the hardness of the top layer, but {most}: where "
            "the indentation is not small against the layer, the contact bears more, and the layers below "
            "make no difference to this limit.",
            f"Limit the pressure by the effective hardness ({{effective_hardness}}){given}.",
            {"limit": limit, "hardness": max(known, default=math.inf)},
            (*AREAS, *PRESSURES, "plastic_"),
        )
    elif missing and not softer:
        yield Advice(
            "note",
            "layers below",
            f"The pressure is limited to {show(limit, 'Pa')}, the hardness of the top layer; the strength of "
            f"{' and '.join(missing)} below it is not known, and with it not whether contacts that press "
            "through the layer yield at more or at less.",
            "Give H or Y of it ({yield_stress}).",
            {"limit": limit},
            (*AREAS, *PRESSURES, "plastic_"),
        )


def _units(problem: ContactProblem) -> Iterator[Advice]:
    """Values that no surface or material has, as where a unit was mistaken."""
    for name, surface in (("surface", problem.surface), ("counter surface", problem.counter_surface)):
        height = rms_height(surface) if isinstance(surface, Surface) else 0.0
        if height and not LEAST_HEIGHT <= height <= LARGEST_HEIGHT:
            yield Advice(
                "note",
                f"height of the {name}",
                f"The rms height of the {name} is {show(height, 'm', 3)}, outside of {show(LEAST_HEIGHT, 'm')} "
                f"to {show(LARGEST_HEIGHT, 'm')}.",
                "Check the unit of the heights ({height_unit}).",
                {"rms_height": height, "least": LEAST_HEIGHT, "largest": LARGEST_HEIGHT},
            )
    for body in (problem.body, problem.counter_body):
        for solid in materials_of(body):
            modulus = solid.youngs_modulus
            strengths = {"yield stress": solid.strength.yield_stress, "hardness": solid.strength.hardness}
            for name, value in strengths.items():
                if value > modulus:
                    yield Advice(
                        "warning",
                        name,
                        f"The {name} of {solid.name or 'a material'}, {show(value, 'Pa')}, is above its "
                        f"Young's modulus, {show(modulus, 'Pa')}; solids yield at a tenth of it or less.",
                        "Check the units of both.",
                        {"strength": value, "youngs_modulus": modulus},
                    )
