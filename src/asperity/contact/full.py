"""Full contact of a rough surface: its pressure is linear in the heights, and may be tensile."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.spectral import RealTransform, thread_count
from ..solids.compliance.halfspace import contact_compliance
from ..solids.elastic import Rigid
from ..solids.layers import Body
from ..surfaces.prepare.level import require_complete
from ..surfaces.surface import Surface
from ..theories.rough.full_contact import tension_share


@dataclass(frozen=True, eq=False)
class FullContactField:
    """Pressure of full contact, at which a surface is pressed flat everywhere.

    Attributes
    ----------
    pressure
        (nx, ny) in Pa, negative where the bodies pull on each other.
    mean_pressure
        Its mean in Pa.
    energy_per_area
        Elastic energy of the waves over nominal area in J/m².
    """

    pressure: RealArray
    mean_pressure: float
    energy_per_area: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "PerssonTosatti2001")

    @property
    def spread(self) -> float:
        """Standard deviation s of the pressure in Pa."""
        return float(self.pressure.std())

    @property
    def tension_share(self) -> float:
        """Share of the pixels under tension; Q(p/s) of a Gaussian surface."""
        return float(np.mean(self.pressure < 0.0))

    @property
    def mean_tension(self) -> float:
        """Tension over the whole area in Pa."""
        return float(np.mean(np.maximum(-self.pressure, 0.0)))

    @property
    def area_fraction_persson(self) -> float:
        """Area in contact where tension parts the bodies, by Persson's theory with the same s:
        erf[p/(sqrt(2) s)]."""
        if self.spread == 0.0:
            return 1.0 if self.mean_pressure > 0.0 else 0.0
        return float(1.0 - 2.0 * tension_share(max(self.mean_pressure, 0.0), self.spread))

    def holds(self, work: float = 0.0) -> bool:
        """Whether the bodies stay in full contact: without tension, or with a ``work`` of adhesion
        in J/m², >= 0, above the energy (Persson & Tosatti 2001)."""
        gained = require.not_negative(work, "work of adhesion (J/m^2)")
        return bool(self.pressure.min() >= 0.0) or gained > self.energy_per_area


def full_contact(
    surface: Surface, body: Body, mean_pressure: float, *, counter_body: Body = Rigid()
) -> FullContactField:
    """Pressure that presses a periodic ``surface`` flat, on homogeneous or layered bodies.

    With the transform of the heights and the compliance ĉ(q) of both bodies p = p̄ + F⁻¹[ĥ/ĉ]: one
    pair of transforms. Where it is negative the contact holds only by adhesion; ``holds`` tells.

    Parameters
    ----------
    surface
        Periodic and complete; of two rough surfaces their ``composite``.
    body, counter_body
        Elastic bodies; the second is rigid by default.
    mean_pressure
        p̄ in Pa, of either sign.

    Raises
    ------
    InputError
        If the surface does not repeat or lacks points, or the pressure is not finite.

    Examples
    --------
    A wave of amplitude A and wavelength L is pressed flat by the mean pressure π E* A/L:

    >>> import asperity as asp
    >>> grid = asp.Grid((64, 4), (1e-7, 1e-7))
    >>> wave = asp.generate.sinusoid(grid, amplitude=1e-9, wavelength=6.4e-6)
    >>> found = asp.contact.full_contact(wave, asp.Elastic(91e9, 0.3), 49.0e6)
    >>> f"{found.pressure.min() / 1e6:.2f} MPa", found.holds()
    ('-0.09 MPa', False)
    """
    require.instance(surface, Surface, "surface of a full contact")
    mean = require.finite(mean_pressure, "mean pressure (Pa)")
    require_complete(surface, "pressed flat")
    if not surface.periodic:
        raise InputError(
            "surface of a full contact must be periodic, but is not: level a measured map and make it periodic, or "
            "take its spectrum to the theory full-contact."
        )
    q = surface.grid.wavenumber()
    q[0, 0] = q[-1, -1] if q.size > 1 else 1.0  # any: the mean has no share
    heights = surface.heights.astype(float) - float(surface.heights.mean())
    transform = RealTransform(surface.shape, thread_count())
    waves = transform.forward(heights) / contact_compliance(body, counter_body).spectral(q)
    waves[0, 0] = 0.0
    pressure = transform.backward(waves)
    energy = 0.5 * float(np.mean(pressure * heights))
    return FullContactField(pressure + mean, mean, energy)
