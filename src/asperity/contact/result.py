"""The answer to a contact problem: fields, scalars, certificate and status."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.late import Drawn
from ..core.quantity import Quantity
from ..core.status import Status
from ..surfaces.pair import composite
from ..surfaces.surface import Surface
from .certificate import Certificate
from .control import Control
from .problem import ContactProblem
from .state import InterfaceState

PLASTIC_FRACTION = 0.02
"""Share of plastic in real area above which a contact is called plastic (Greenwood & Williamson 1966)."""


SCALARS = (
    Quantity("mean_pressure", "Pa", "mean (nominal) pressure"),
    Quantity("force", "N", "force"),
    Quantity("area_fraction", "1", "real contact area / nominal area (pixels)"),
    Quantity("area_fraction_corrected", "1", "real contact area / nominal area (perimeter-corrected)"),
    Quantity("contact_area", "m**2", "real contact area (perimeter-corrected)"),
    Quantity("mean_real_pressure", "Pa", "mean real pressure"),
    Quantity("max_pressure", "Pa", "maximum pressure"),
    Quantity("approach", "m", "approach from first touch"),
    Quantity("mean_gap", "m", "mean gap"),
    Quantity("elastic_energy", "J", "elastic energy"),
    Quantity("plastic_work", "J", "plastic work of this load"),
    Quantity("total_plastic_work", "J", "plastic work since the virgin surface"),
    Quantity("plastic_area_fraction", "1", "plastic area / real contact area"),
    Quantity("indented_area", "m**2", "area ever at the hardness (pixels)"),
    Quantity("plastic_volume", "m**3", "volume of the permanent indentation"),
    Quantity("max_permanent_indentation", "m", "maximum permanent indentation"),
    Quantity("normal_stiffness", "Pa/m", "normal stiffness per nominal area", costly=True),
    Quantity("n_spots", "1", "number of contact spots"),
    Quantity("mean_spot_area", "m**2", "mean area of a contact spot"),
    Quantity("contact_perimeter", "m", "contact perimeter (pixel edges)"),
)
"""Every scalar of a result in the order of tables."""


@dataclass(frozen=True, eq=False, repr=False)
class ContactResult(Drawn):
    """Solution of a contact problem. Fields are (nx, ny) arrays, all values SI.

    Attributes
    ----------
    problem, control
        What was solved.
    pressure
        Contact pressure in Pa, >= 0.
    displacement
        Sum of the normal displacements of both surfaces in m; relative to its mean for periodic half-spaces.
    gap
        Distance of the deformed surfaces in m, >= 0, zero in contact.
    permanent_indentation
        Plastic change of the composite profile in m since the virgin surface, >= 0.
    plastic
        True where the pressure is at its limit.
    offset
        Rigid-body position in m: gap = offset + displacement - profile + permanent_indentation.
    mean_pressure, force
        Load per nominal area (Pa) and load (N) reached.
    area_fraction, area_fraction_corrected, contact_area
        Real over nominal area by counting pixels; the same without pixel bias (Yastrebov et al. 2017); that area in m².
    mean_real_pressure, max_pressure
        Force over pixel contact area; largest pressure; Pa.
    approach, mean_gap
        Approach from first touch of the virgin surfaces (see ``Approach``); mean of the gap; m.
    elastic_energy
        Half of pressure times displacement, J; periodic: without the (unbounded) part of the mean mode.
    plastic_work, total_plastic_work
        Integral of the hardness over the volume of the indentation: of what this load added, and since the virgin surface, J.
    plastic_area_fraction
        Area at the pressure cap over real contact area.
    indented_area, plastic_volume
        Area (m²) of the pixels with permanent indentation, so ever at the cap, and volume (m³) of the indentation.
    max_permanent_indentation
        Maximum of ``permanent_indentation``, m.
    normal_stiffness
        d(mean pressure)/d(approach), Pa/m; NaN where not asked for; infinite in periodic full contact.
    n_spots, spot_areas, mean_spot_area, contact_perimeter
        Number of contact spots, their areas (m², largest first) and mean, perimeter along pixel edges (m).
    certificate, status
        Error bounds and work; how the solver ended.
    """

    problem: ContactProblem
    control: Control
    pressure: RealArray
    displacement: RealArray
    gap: RealArray
    permanent_indentation: RealArray
    plastic: BoolArray
    offset: float
    mean_pressure: float
    force: float
    area_fraction: float
    area_fraction_corrected: float
    contact_area: float
    mean_real_pressure: float
    max_pressure: float
    approach: float
    mean_gap: float
    elastic_energy: float
    plastic_work: float
    total_plastic_work: float
    plastic_area_fraction: float
    indented_area: float
    plastic_volume: float
    max_permanent_indentation: float
    normal_stiffness: float
    n_spots: int
    spot_areas: RealArray
    mean_spot_area: float
    contact_perimeter: float
    certificate: Certificate
    status: Status
    citation_keys: tuple[str, ...]

    @property
    def contact(self) -> BoolArray:
        """(nx, ny), True where the bodies touch (pressure > 0)."""
        return self.pressure > 0.0

    @property
    def indented(self) -> BoolArray:
        """(nx, ny), True where the surface was ever indented for good."""
        return self.permanent_indentation > 0.0

    @property
    def is_plastic(self) -> bool:
        """Whether more than 2 % of the real area is plastic."""
        return self.plastic_area_fraction > PLASTIC_FRACTION

    @property
    def converged(self) -> bool:
        """Whether the solver reached its tolerance."""
        return self.status.converged

    @property
    def state(self) -> InterfaceState:
        """State to continue from: permanent indentation, pressure and plastic work."""
        return InterfaceState(self.permanent_indentation, self.pressure, self.total_plastic_work)

    def residual_surface(self, part: Literal["composite", "body", "counter_body"] = "composite") -> Surface:
        """Surface that is left when the load is taken away: the one before less the permanent indentation.

        Parameters
        ----------
        part
            ``"composite"``, the sum of both surfaces, which holds whichever body yields; or the surface of the
            ``"body"`` or ``"counter_body"`` if that is the softer one, which takes all of the indentation.

        Raises
        ------
        InputError
            If ``part`` is none of these.
        """
        require.one_of(part, ("composite", "body", "counter_body"), "part of a residual surface")
        problem = self.problem
        surface, counter = problem.surface, problem.counter_surface
        if part == "counter_body":
            before = counter if isinstance(counter, Surface) else surface.with_heights(0.0 * surface.heights, "flat")
        else:
            pair = part == "composite" and isinstance(counter, Surface)
            before = composite(surface, counter) if pair else surface  # type: ignore[arg-type]
        load = f"{self.mean_pressure:.6g} Pa"
        return before.with_heights(before.heights - self.permanent_indentation, f"indented for good, last load {load}")
