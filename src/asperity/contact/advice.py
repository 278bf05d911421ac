"""Checks of resolution and regime, before and after a solve, each with criterion, numbers and remedy."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.status import Advice, free_memory, room_text
from ..core.units import percent, show
from ..solids.elastic import Elastic
from ..solids.layers import Layered, RigidBase, materials_of, surface_material
from ..surfaces.characterise.slopes import axis_index, rms_profile_curvature, stencil_sums
from ..surfaces.surface import Surface
from ..theories.wet.meniscus import wetting_factor
from .certificate import LARGEST_DUALITY_GAP, LARGEST_IMBALANCE
from .couplings.menisci import Menisci
from .couplings.plastic_flow import NAME as PLASTIC_FLOW
from .couplings.plastic_flow import SMALL_STRAIN, PlasticBody, PlasticFlowCoupling
from .couplings.stick_slip import slides_freely
from .laws import LayeredHardness, LimitByDepth
from .problem import ContactProblem, Control, Force, MeanPressure, mean_pressure
from .result import ContactResult

LARGEST_SLOPE = 0.3
"""Half-space theory neglects slopes squared: 9 % at 0.3."""

PIXELS_PER_WAVE = 6.0
"""Finite differences of a sine of 6 pixels err by 9 % in curvature, of 4 pixels by 19 %."""

PIXELS_PER_RADIUS = 2.0
"""An asperity of this radius rises over neighbouring pixels with a slope of one half."""

LARGEST_EDGE_JUMP = 3.0
"""Rms step across the border in rms steps inside: beyond it the border is a ridge the surface does not have."""

LARGEST_LOAD_RATIO = 0.1
"""Mean pressure over contact modulus, about the mean strain; linear elasticity neglects its square."""

NEARLY_FULL = 0.95
"""Area fraction above which the open area is a few per cent and of the order of the pixel correction."""

LARGEST_AREA_CORRECTION = 0.15
"""Share of the pixel area that the perimeter correction takes, at spots of about ten pixels."""

FEWEST_CONTACT_PIXELS = 10
"""Number of contact pixels below which their count is inaccurate."""

LARGEST_PATCH = 1.0 / 8.0
"""Contact diameter over period at which images bend the surface by 0.9 % of P/(pi E* L) (see the analytic tests)."""

FIELDS_OF_A_SOLVE = 16
"""Real fields of the grid in memory during a solve, result included."""


PIXELS_PER_LAYER = 1.0
"""A pressure that varies from pixel to pixel (wavelength 2 pixels) reaches exp(-pi) = 4 % deep into a layer of one pixel."""

LARGEST_THICKNESS = 0.5
"""Thickness over period at which the longest wave has decayed to (1 + pi) exp(-pi) = 18 % of its pressure below the layers."""

FEWEST_MENISCUS_PIXELS = 5.0
"""Radius of an island in pixels below which counting errs by more than about 2 %; 10 pixels give 1 %."""

CONTINUUM = 1e-9
"""Radius in m below which a meniscus of water is a few molecules across: 50 % relative humidity."""

MOLECULE = 0.28e-9
"""Diameter of a molecule of water in m; other liquids have larger ones."""

LEAST_ENERGY_ERROR = 5e-3
"""Energy in time that is missed over the largest work and does not count: the estimate of what steps explain is too small for a ramp of few steps from
first touch. One such ramp in some 70 random histories, with menisci, missed 3.8e-3 where 1.0e-3 was explained."""

DOUBT = "duality gap"
"""Criterion of the warning that stands above all others."""


def advise(problem: ContactProblem, control: Control) -> tuple[Advice, ...]:
    """Findings that can be made before solving: slopes, resolution, edges, load, layers, memory."""
    profile = Surface(problem.profile(), *problem.grid.spacing)
    return (
        *_slope(profile),
        *_resolution(profile),
        *_asperity_radius(profile),
        *_edges(problem, profile),
        *_load(problem, control),
        *_layers(problem),
        *_memory(problem),
    )


def review(result: ContactResult) -> tuple[Advice, ...]:
    """Findings that need the solution: resolved contacts, near-full contact, edges reached, hardness exceeded, plastic flow, energies in time, menisci."""
    liquid = result.menisci
    wet = () if liquid is None else (*_meniscus_pixels(liquid), *_molecules(liquid), *_in_jump(liquid, result))
    return (
        *doubts(result),
        *_contact_pixels(result),
        *_nearly_full(result),
        *_room(result),
        *_seam(result),
        *_plastic(result),
        *_hardness(result),
        *_shift(result),
        *_flow_settled(result),
        *_energies_in_time(result),
        *(() if result.plastic_flow is None else _flow(result.plastic_flow)),
        *wet,
    )


def _slope(profile: Surface) -> Iterator[Advice]:
    slope = math.sqrt(
        sum(_mean_square(profile, axis, 1) / d**2 for axis, d in zip("xy", profile.grid.spacing, strict=True))
    )
    if slope > LARGEST_SLOPE:
        yield Advice(
            "warning",
            "slope",
            f"The rms slope is {slope:.2g}; half-space theory assumes small slopes (up to about {LARGEST_SLOPE:g}). "
            "Treat areas and pressures as qualitative, or smooth the surface to the scale of interest.",
        )


def _resolution(profile: Surface) -> Iterator[Advice]:
    """Shortest effective wavelength 2 pi sqrt(m2/m4), of a sine exactly its wavelength, against the pixel."""
    wavelengths = {axis: pixels for axis in "xy" if (pixels := _shortest_wavelength(profile, axis)) < PIXELS_PER_WAVE}
    if wavelengths:
        shown = {axis: math.floor(10.0 * pixels) / 10.0 for axis, pixels in wavelengths.items()}  # 5.97 is not 6.0
        found = " and ".join(f"{pixels:.1f} pixels along {axis}" for axis, pixels in shown.items())
        yield Advice(
            "warning",
            "resolution",
            f"The shortest effective wavelength 2π√(m2/m4) is {found} (at least {PIXELS_PER_WAVE:g} wanted): asperities "
            "are not resolved, so contact area and peak pressure depend on the pixel size. Resample to a finer grid or "
            "give the surface a short-wavelength cut-off.",
        )


def _asperity_radius(profile: Surface) -> Iterator[Advice]:
    """Mean summit radius 3/8 sqrt(pi/m4) of a Gaussian surface (Nayak 1971) against the pixel."""
    if min(profile.shape) < 3:
        return
    m4 = 0.5 * sum(rms_profile_curvature(profile, axis=axis) ** 2 for axis in "xy")
    radius, pixel = 0.375 * math.sqrt(math.pi / m4) if m4 > 0.0 else math.inf, max(profile.grid.spacing)
    if radius < PIXELS_PER_RADIUS * pixel:
        yield Advice(
            "warning",
            "asperity radius",
            f"The mean asperity radius 3/8 √(π/m4) is {radius / pixel:.2g} pixels (at least {PIXELS_PER_RADIUS:g} "
            "wanted): asperities are spikes of single pixels. Check the height unit, refine the grid or smooth the surface.",
        )


def _shortest_wavelength(profile: Surface, axis: str) -> float:
    """Effective wavelength along ``axis`` in pixels; infinite where differences vanish or there are too few points."""
    m2, m4 = (_mean_square(profile, axis, order) for order in (1, 2))
    return 2.0 * math.pi * math.sqrt(m2 / m4) if m4 > 0.0 else math.inf


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
                "periodic boundary turns that into a cliff. Periodise it (--periodise, periodised()), taper it (--taper), "
                "or use the free boundary.",
            )


def _load(problem: ContactProblem, control: Control) -> Iterator[Advice]:
    if not isinstance(control, MeanPressure | Force):
        return
    ratio = mean_pressure(control, problem.grid) / _softest_contact_modulus(problem)
    if ratio > LARGEST_LOAD_RATIO:
        yield Advice(
            "warning",
            "load",
            f"The mean pressure is {ratio:.2g} of the contact modulus E* of the softest materials; linear elasticity holds up to about "
            f"{LARGEST_LOAD_RATIO:g}. Check unit and value of the load.",
        )


def _softest_contact_modulus(problem: ContactProblem) -> float:
    """E* (Pa) as if each body consisted of its softest material, layers and base included."""
    bodies = (materials_of(body) for body in (problem.body, problem.counter_body))
    return 1.0 / sum(max((1.0 / solid.plane_strain_modulus for solid in solids), default=0.0) for solids in bodies)


def _memory(problem: ContactProblem) -> Iterator[Advice]:
    padding = 1 if all(problem.boundary.wraps) else 4
    needed = 8.0 * FIELDS_OF_A_SOLVE * padding * problem.grid.n_points
    if needed > free_memory():
        text = f"The solve needs about {room_text(needed)}. Crop the surface or resample it to fewer points."
        yield Advice("warning", "memory", text)


def doubts(*results: ContactResult) -> tuple[Advice, ...]:
    """Warning that the elastic energy is hardly known in one of the ``results``; it stands above all other words on them."""
    gap = max(result.certificate.duality_gap for result in results)
    if gap <= LARGEST_DUALITY_GAP:
        return ()
    text = (
        f"The elastic energy is known to {gap:.1e} of itself only (duality gap, at most {LARGEST_DUALITY_GAP:g} wanted): pressures "
        "may be wrong. Use a smaller tolerance or another solver."
    )
    return (Advice("warning", DOUBT, text),)


def _contact_pixels(result: ContactResult) -> Iterator[Advice]:
    pixels = int(np.count_nonzero(result.contact))
    if 0 < pixels < FEWEST_CONTACT_PIXELS:
        yield Advice(
            "warning",
            "contact pixels",
            f"The contact has {pixels} pixel{'s' if pixels > 1 else ''} (at least {FEWEST_CONTACT_PIXELS} wanted): area "
            "and peak pressure are set by the pixel size. Raise the load or refine the grid.",
        )
        return
    correction = 1.0 - result.area_fraction_corrected / result.area_fraction if pixels else 0.0
    if correction > LARGEST_AREA_CORRECTION:
        yield Advice(
            "warning",
            "contact pixels",
            f"The perimeter correction takes {100 * correction:.0f} % off the pixel area (more than "
            f"{100 * LARGEST_AREA_CORRECTION:.0f} %): contact spots are only a few pixels wide. Refine the grid.",
        )


def _nearly_full(result: ContactResult) -> Iterator[Advice]:
    if result.area_fraction > NEARLY_FULL:
        yield Advice(
            "note",
            "near-full contact",
            f"The contact is {100 * result.area_fraction:.1f} % of the nominal area; what remains open is set by the "
            "shortest waves and the numerical tolerance.",
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
                "Contact reaches the border of the grid, beyond which the free boundary has nothing to touch: the map acts "
                "as a punch of its own outline. For a nominally flat surface the periodic boundary is the usual choice.",
            )
    elif not problem.surface.periodic and result.n_spots == 1:
        widths = [np.ptp(np.flatnonzero(contact.any(axis=1 - axis))) / contact.shape[axis] for axis in (0, 1)]
        if max(widths) > LARGEST_PATCH:
            yield Advice(
                "warning",
                "patch against period",
                f"The single contact spot is {max(widths):.2f} of the period wide (at most {LARGEST_PATCH:g} wanted): it "
                "interacts with its periodic images. Use the free boundary or a larger grid.",
            )


def _seam(result: ContactResult) -> Iterator[Advice]:
    """Whether the highest pressure lies where opposite borders of a map meet that does not repeat."""
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
            f"The maximum pressure, {show(highest, 'Pa')}, lies at the seam where opposite borders of the map meet, which does "
            f"not repeat; elsewhere it is at most {show(inside, 'Pa')}. These border pixels are {percent(float(seam.mean()), 2)} "
            f"of the area and carry {percent(share, 2)} of the load. Periodise the map (--periodise, periodised()).",
        )


def _plastic(result: ContactResult) -> Iterator[Advice]:
    if result.plastic_area_fraction > NEARLY_FULL and result.area_fraction > NEARLY_FULL:
        yield Advice(
            "warning",
            "yield everywhere",
            f"The pressure is at the hardness on {100 * result.plastic_area_fraction:.0f} % of a contact that covers "
            f"{100 * result.area_fraction:.0f} % of the nominal area: the pressure distribution hardly depends on position or load. "
            "Check load, position and hardness.",
        )


def _hardness(result: ContactResult) -> Iterator[Advice]:
    law, flow = result.problem.law, result.plastic_flow
    for name_of in ("body", "counter_body"):
        body = getattr(result.problem, name_of)
        if flow is not None and flow.of == name_of:
            continue  # its flow is solved
        if isinstance(law, LayeredHardness) and law.body == body:
            continue  # pressed through its top layer it bears more or less than that layer's hardness
        solid = surface_material(body)
        hardness = math.nan if solid is None else solid.strength.hardness
        if result.max_pressure > hardness * (1.0 + 1e-9):  # reaching a cap equal to the hardness is as it should be
            times, name = result.max_pressure / hardness, (solid and solid.name) or body.name or "the body"
            above = f"is {times:.2g} times" if times >= 1.05 else f"is {percent(times - 1.0, 2)} above"
            yield Advice(
                "warning",
                "hardness",
                f"The maximum pressure {above} the hardness of {name}: it would yield. Use the law Hardness(...) with that hardness "
                "(--hardness body).",
            )


def _energies_in_time(result: ContactResult) -> Iterator[Advice]:
    """Whether works and what is stored or taken differ by more than the steps of time explain."""
    found = result.creep
    if found is None or found.energy_error <= max(found.explained_error, LEAST_ENERGY_ERROR):
        return
    yield Advice(
        "warning",
        "energy balance",
        f"The energies of the viscoelastic contact miss by {percent(found.energy_error, 2)} of the largest work, where its steps of time explain "
        f"{percent(found.explained_error, 2)}: heat and force may be wrong. Take a smaller tolerance (--time-tolerance) or more steps of time "
        "(--time-steps).",
    )


def _shift(result: ContactResult) -> Iterator[Advice]:
    """Whether how far the counter body slid is not determined."""
    found = result.stick_slip
    if found is None or not math.isnan(found.shift_x):
        return
    if slides_freely(found.tangential, found.friction_limit):
        why = f"The tangential force is all that friction bears, {show(found.friction_limit, 'N')}: every point slides, and the shift is not determined"
    else:
        why = "In an earlier step the tangential force was all that friction bears: the shift is not determined since"
    yield Advice(
        "warning",
        "shift not determined",
        f"{why}. Slip and heat stated are those of the least shift that slides every point. Prescribe a shift (Shift(...), --shift), or a smaller force.",
    )


def _flow_settled(result: ContactResult) -> Iterator[Advice]:
    for check in result.certificate.couplings:
        if check.name == PLASTIC_FLOW and check.residual > check.tolerance:
            yield Advice(
                "warning",
                "plastic flow",
                f"The plastic strain is not settled: the return mapping still changes it by {check.residual:.1e} of itself (at most "
                f"{check.tolerance:g} wanted). {PlasticFlowCoupling.remedy}",
            )


def _flow(flow: PlasticBody) -> Iterator[Advice]:
    """Strains that are not small, and zones deeper than the cells."""
    if not flow.small_strain:
        zone = max(flow.zones, key=lambda item: item.largest_strain)
        yield Advice(
            "warning",
            "small strain",
            f"The plastic strain reaches {percent(zone.largest_strain)}, {show(zone.place[2], 'm')} deep in {_part(zone.name)}; above "
            f"{percent(SMALL_STRAIN)} small strains are no longer a good description. Lower the load or smooth sharp summits, or take "
            "imprint and pressures as qualitative there.",
        )
    body = flow.problem.body if flow.of == "body" else flow.problem.counter_body
    end = float(flow.flowed.edges[-1]) if flow.reaches_end else math.inf
    on_rigid = isinstance(body, Layered) and isinstance(body.base, RigidBase) and end > (1.0 - 1e-9) * body.thickness
    if flow.reaches_end and not on_rigid:
        yield Advice(
            "warning",
            "depth of the cells",
            f"Points in the deepest cell flow, at {show(end, 'm', 3)}, and what lies below is held elastic: plastic "
            "strain and imprint are too small. Give a larger depth, or none (--plastic-depth).",
        )

    if flow.reaches_edge:
        yield Advice(
            "warning",
            "edge of the grid",
            "Points under the edge of the grid flow, and what lies beside the grid is held elastic: loads are too large, and plastic strain "
            "and imprint too small. Give a grid with a wider margin around the contact: on one of five contact radii loads are within 0.2 %.",
        )


def _part(name: str) -> str:
    return "the base" if name == "base" else name


def _mean_square(profile: Surface, axis: str, order: int) -> float:
    """Mean square of the differences of ``order`` along ``axis`` inside the grid; 0 where there are too few points."""
    return stencil_sums(profile, axis, order, 1).square if profile.shape[axis_index(axis)] > order else 0.0


def _layers(problem: ContactProblem) -> Iterator[Advice]:
    """Layers thinner than a pixel, or so thick that what lies below hardly matters in a periodic cell; softer ones below."""
    for body in (problem.body, problem.counter_body):
        if isinstance(body, Layered):
            yield from _against_pixel(problem, body.reduced)
            yield from _against_period(problem, body.reduced)
            yield from _softer_below(problem, body.reduced)


def _against_pixel(problem: ContactProblem, body: Layered) -> Iterator[Advice]:
    pixel = max(problem.grid.pixels)
    thin = [layer for layer in body.layers if layer.thickness < PIXELS_PER_LAYER * pixel]
    if thin:
        least = min(layer.thickness for layer in thin)
        count = f"{len(thin)} layers are" if len(thin) > 1 else "A layer is"
        yield Advice(
            "note",
            "layer against pixel",
            f"{count} thinner than a pixel (the thinnest {least / pixel:.2g} pixels, at least {PIXELS_PER_LAYER:g} wanted): "
            "deflections of resolved waves are right, but peak pressures and stresses on the scale of the layer are not "
            "resolved. Refine the grid to the scale of the layer.",
        )


def _against_period(problem: ContactProblem, body: Layered) -> Iterator[Advice]:
    """The longest wave along an axis that wraps; no finding for a base as soft as the layers, which makes no difference."""
    lengths = [
        problem.grid.size[axis] for axis in (0, 1) if problem.boundary.wraps[axis] and problem.grid.shape[axis] > 1
    ]
    if not lengths or not body.layers:
        return
    share = body.thickness / max(lengths)
    if share > LARGEST_THICKNESS and _differs(body):
        yield Advice(
            "note",
            "layer against period",
            f"The layers are {share:.2g} of the period thick (more than {LARGEST_THICKNESS:g}): even the longest wave hardly "
            "reaches the base, whose material then makes little difference. Use a larger map, or the free boundary for a "
            "single contact.",
        )


def _softer_below(problem: ContactProblem, body: Layered) -> Iterator[Advice]:
    """A pressure limit does not concern what lies below the surface, where a softer material may yield first."""
    if isinstance(problem.law, LimitByDepth):
        return
    limit = float(np.max(problem.law.pressure_cap()))
    surface, *below = (part.strength.hardness for part in materials_of(body))
    if math.isfinite(limit) and any(hardness < min(limit, surface) for hardness in below):
        yield Advice(
            "note",
            "softer layers below",
            f"The pressure is limited to {show(limit, 'Pa')} at the surface, but a material below it has a hardness of only "
            f"{show(min(h for h in below if h == h), 'Pa')}: under contacts wide against the layers it yields first, at a "
            "lower pressure. Limit the pressure by the effective hardness, LayeredHardness(body) (--hardness effective), or compute "
            "the stresses, which tell the load factor of each layer.",
        )


def _differs(body: Layered) -> bool:
    """Whether the base is of another plane-strain modulus than the lowest layer."""
    base = body.base.plane_strain_modulus if isinstance(body.base, Elastic) else math.inf
    return base != body.layers[-1].material.plane_strain_modulus


def _meniscus_pixels(found: Menisci) -> Iterator[Advice]:
    if found.wetting.regime == "dry":
        return
    # the mean over the area: many islands of a pixel or two hardly pull
    pixels = np.bincount(found.wetting.labels.ravel())[1:].astype(float)
    radius = math.sqrt(float((pixels**2).sum() / pixels.sum()) / math.pi)
    if radius < FEWEST_MENISCUS_PIXELS:
        yield Advice(
            "warning",
            "meniscus pixels",
            f"Menisci are counted in pixels, but have a radius of {radius:.2g} pixels (less than {FEWEST_MENISCUS_PIXELS:g}): the force "
            "may be off by several per cent. Refine the grid, or generate the surface with more points.",
        )


def _in_jump(found: Menisci, result: ContactResult) -> Iterator[Advice]:
    pixels = found.wetting.partly
    count, area = int(np.count_nonzero(pixels)), result.problem.grid.pixel_area
    jump = found.suction * count * area
    if count and jump > LARGEST_IMBALANCE * result.force:
        held = show(found.suction * float(found.wetting.filled[pixels].sum()) * area, "N")
        yield Advice(
            "note",
            "jump of the meniscus force",
            f"The forces balance where the meniscus force jumps: {count} pixel{'' if count == 1 else 's'} that touch or come to the height of the menisci "
            f"there hold{'s' if count == 1 else ''} liquid in part, which pulls with {held} of {show(jump, 'N')}. Refine the grid for smaller jumps.",
        )


def _molecules(found: Menisci) -> Iterator[Advice]:
    film = found.film
    radius = film.meniscus_height / wetting_factor(*film.contact_angles)
    remarks = []
    if radius < CONTINUUM:
        remarks.append(
            f"The menisci have a radius of {1e9 * radius:.2g} nm: below about 1 nm Laplace's equation is a formality."
        )
    if film.thickness < MOLECULE:
        remarks.append(
            f"The film is {1e9 * film.thickness:.2g} nm thick, less than a molecule of water ({1e9 * MOLECULE:.2g} nm): it "
            "covers the surface in part only."
        )
    if remarks:
        yield Advice("note", "molecules", " ".join(remarks))
