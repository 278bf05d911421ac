"""Checks of resolution and regime, before and after a solve, each with criterion, numbers and remedy."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator

import numpy as np

from ..core.status import Advice
from ..solids.layers import materials_of, surface_material
from ..surfaces.characterise.slopes import axis_index, rms_profile_curvature, stencil_sums
from ..surfaces.surface import Surface
from .control import Control, Force, MeanPressure, mean_pressure
from .laws import LayeredHardness
from .layer_advice import layer_advice
from .problem import ContactProblem
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
"""Real fields of the grid alive in a solve, result included."""


def advise(problem: ContactProblem, control: Control) -> tuple[Advice, ...]:
    """Findings that can be made before solving: slopes, resolution, edges, load, layers, memory."""
    profile = Surface(problem.profile(), *problem.grid.spacing)
    return (
        *_slope(profile),
        *_resolution(profile),
        *_asperity_radius(profile),
        *_edges(problem, profile),
        *_load(problem, control),
        *layer_advice(problem),
        *_memory(problem),
    )


def review(result: ContactResult) -> tuple[Advice, ...]:
    """Findings that need the solution: resolved contacts, near-full contact, edges reached, hardness exceeded."""
    return (*_contact_pixels(result), *_nearly_full(result), *_room(result), *_plastic(result), *_hardness(result))


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
        found = " and ".join(f"{pixels:.1f} pixels along {name}" for name, pixels in wavelengths.items())
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
                "periodic boundary turns that into a cliff. Periodise or taper it (--periodise, --taper), or use the "
                "free boundary.",
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
    names = getattr(os, "sysconf_names", {})
    if "SC_AVPHYS_PAGES" not in names or "SC_PAGE_SIZE" not in names:
        return
    available = float(os.sysconf("SC_AVPHYS_PAGES")) * float(os.sysconf("SC_PAGE_SIZE"))
    if needed > available:
        yield Advice(
            "warning",
            "memory",
            f"The solve needs about {needed / 2**30:.1f} GiB of memory and {available / 2**30:.1f} GiB are free. "
            "Crop the surface or resample it to fewer points.",
        )


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
    law = result.problem.law
    for body in (result.problem.body, result.problem.counter_body):
        if isinstance(law, LayeredHardness) and law.body == body:
            continue  # pressed through its top layer it bears more or less than that layer's hardness
        solid = surface_material(body)
        hardness = math.nan if solid is None else solid.strength.hardness
        if result.max_pressure > hardness * (1.0 + 1e-9):  # reaching a cap equal to the hardness is as it should be
            yield Advice(
                "warning",
                "hardness",
                f"The maximum pressure is {result.max_pressure / hardness:.2g} times the hardness of "
                f"{(solid and solid.name) or body.name or 'the body'}: it would yield. Use the law Hardness(...) with that hardness "
                "(--hardness body).",
            )


def _mean_square(profile: Surface, axis: str, order: int) -> float:
    """Mean square of the differences of ``order`` along ``axis`` inside the grid; 0 where there are too few points."""
    return stencil_sums(profile, axis, order, 1).square if profile.shape[axis_index(axis)] > order else 0.0
