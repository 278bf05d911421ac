"""The plain contact, the load path that leads to it, and what yields on the way."""

from __future__ import annotations

from dataclasses import replace

from ..core.quantity import Quantity
from .part import Part

STIFFNESS = "normal_stiffness"
"""The quantity that costs about one more solve."""


class Contact(Part):
    """What is known of every contact."""

    name = "contact"
    title = "Contact"
    work = "parts.contact_work:ContactWork"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of a result, and what follows from its fields and problem."""
        from ..contact.result import SCALARS

        return (
            *SCALARS,
            Quantity("peak_pressure", "Pa", "largest pressure between the pixels"),
            Quantity("peak_pressure_error", "Pa", "error of the largest pressure between the pixels"),
            Quantity("peak_pressure_x", "m", "x of the largest pressure"),
            Quantity("peak_pressure_y", "m", "y of the largest pressure"),
            Quantity("max_displacement", "m", "largest displacement"),
            Quantity(
                "interference_area", "m**2", "area in which the undeformed bodies overlap at the approach (pixels)"
            ),
            Quantity("interference_volume", "m**3", "volume in which the undeformed bodies overlap at the approach"),
            Quantity("complementary_energy", "J", "complementary energy"),
            Quantity("rms_height", "m", "rms height of the profile"),
            Quantity("contact_modulus", "Pa", "contact modulus E*"),
        )

    @property
    def fields(self) -> tuple[Quantity, ...]:
        """Fields (nx, ny) of a result."""
        from ..io.words import FIELDS

        return FIELDS


# A load path: the state of the contact at every step, where the load turns, and where its work
# goes.


class LoadPath(Part):
    """Steps of a load path and their energies."""

    name = "path"
    title = "Load path"
    answers = False
    table = "control.path"
    work = "parts.contact_work:LoadPathWork"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars and energies of every step."""
        from ..contact.result import SCALARS
        from ..io.paths import ENERGIES

        names = {item.name: item for item in SCALARS} | {f"path_{item.name}": item for item in ENERGIES}
        return tuple(replace(item, name=name, dims=("step",), costly=False) for name, item in names.items())


# Plastic deformation: what has yielded for good.


class Plasticity(Part):
    """Permanent indentation, where there is any."""

    name = "plasticity"
    title = "Plastic deformation"
    work = "parts.contact_work:PlasticityWork"
