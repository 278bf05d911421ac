"""Checks of menisci: pixels in them, and molecules."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...contact.certificate import LARGEST_IMBALANCE
from ...core.status import Advice
from ...core.units import show
from ...theories.wet.meniscus import wetting_factor
from .film import LiquidFilm, Wetting

FEWEST_MENISCUS_PIXELS = 5.0
"""Radius of an island in pixels below which counting errs by more than about 2 %; 10 pixels give
1 %."""

CONTINUUM = 1e-9
"""Radius in m below which a meniscus of water is a few molecules across: 50 % relative humidity."""

UNFED = 0.02
"""Meniscus force over the external force from which it matters that it is not fed back."""

MOLECULE = 0.28e-9
"""Diameter of a molecule of water in m; other liquids have larger ones."""


def findings(film: LiquidFilm, wetting: Wetting, pull: float, external: float) -> Iterator[Advice]:
    """What should be known of menisci of ``film`` that stand as ``wetting`` says and ``pull`` (N),
    beside an ``external`` force (N)."""
    force = external + pull if film.feedback else external
    if not film.feedback and pull > UNFED * external:
        yield Advice(
            "warning" if pull > external else "note",
            "menisci without feedback",
            f"The menisci pull with {show(pull, 'N')} in the gap of the load alone, {show(external, 'N')}, and are not "
            "fed back: they would press the surfaces together, make more menisci"
            + (", and may run away." if pull > external else "."),
            "Feed them back, {film.feedback=true}, or state with the force that it is not fed back.",
            {"pull": pull, "external": external, "share": UNFED},
            ("meniscus_force", "relative_meniscus_force", "static_friction", "friction_force"),
        )
    if wetting.regime != "dry":
        # the mean over the area: many islands of a pixel or two hardly pull
        pixels = np.bincount(wetting.labels.ravel())[1:].astype(float)
        across = math.sqrt(float((pixels**2).sum() / pixels.sum()) / math.pi)
        if across < FEWEST_MENISCUS_PIXELS:
            yield Advice(
                "warning",
                "meniscus pixels",
                f"Menisci are counted in pixels, but have a radius of {across:.2g} pixels (less than "
                f"{FEWEST_MENISCUS_PIXELS:g}): the force may be off by several per cent.",
                "Refine the grid ({resample}), or generate the surface with more points.",
                {"pixels": across, "least": FEWEST_MENISCUS_PIXELS},
                ("meniscus_force", "relative_meniscus_force", "external_force", "meniscus_area_fraction", "n_menisci"),
            )
    radius = film.meniscus_height / wetting_factor(*film.contact_angles)
    remarks = []
    if radius < CONTINUUM:
        remarks.append(
            f"The menisci have a radius of {1e9 * radius:.2g} nm: below about 1 nm Laplace's equation is a formality."
        )
    if film.thickness < MOLECULE:
        remarks.append(
            f"The film is {1e9 * film.thickness:.2g} nm thick, less than a molecule of water "
            f"({1e9 * MOLECULE:.2g} nm): it covers the surface in part only."
        )
    if remarks:
        numbers = {"radius": radius, "least_radius": CONTINUUM, "thickness": film.thickness, "molecule": MOLECULE}
        yield Advice("note", "molecules", " ".join(remarks), numbers=numbers, concerns=("meniscus_", "suction"))
    partly = wetting.partly
    count, whole = int(np.count_nonzero(partly)), float(wetting.filled.sum())
    jump = pull * count / whole if whole else 0.0
    if count and whole and jump > LARGEST_IMBALANCE * force:
        held = pull * float(wetting.filled[partly].sum()) / whole
        yield Advice(
            "note",
            "jump of the meniscus force",
            f"The forces balance where the meniscus force jumps: {count} pixel{'' if count == 1 else 's'} that "
            f"touch or come to the height of the menisci there hold{'s' if count == 1 else ''} liquid in part, "
            f"which pulls with {show(held, 'N')} of {show(jump, 'N')}.",
            "Refine the grid ({resample}) for smaller jumps.",
            {"jump": jump, "force": force, "pixels": float(count)},
            ("meniscus_force", "external_force"),
        )
