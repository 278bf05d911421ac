"""Numbers and fields of menisci, in the order of tables."""

from __future__ import annotations

from ...core.quantity import Quantity

WET_SCALARS = (
    Quantity("external_force", "N", "external force"),
    Quantity("meniscus_force", "N", "meniscus force"),
    Quantity("relative_meniscus_force", "1", "meniscus force / external force"),
    Quantity("unfed_meniscus_force", "N", "meniscus force in the gap of the external force alone"),
    Quantity("suction", "Pa", "pressure deficit in the menisci"),
    Quantity("meniscus_height", "m", "meniscus height"),
    Quantity("film_thickness", "m", "film thickness"),
    Quantity("meniscus_area_fraction", "1", "area of the menisci / nominal area"),
    Quantity("wetted_area_fraction", "1", "wetted area with contact / nominal area"),
    Quantity("cut_area_fraction", "1", "cross-cut area at the meniscus height / nominal area"),
    Quantity("n_menisci", "1", "number of menisci"),
    Quantity("friction_force", "N", "static friction force"),
    Quantity("viscous_force", "N", "viscous part of the friction force"),
    Quantity("static_friction", "1", "static friction coefficient, friction / external force"),
    Quantity("feedback", "1", "share of the meniscus force that the menisci themselves cause"),
)
"""Every scalar of the menisci, in the order of tables."""
