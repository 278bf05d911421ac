"""The answer to a contact problem: fields, scalars, certificate and status."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.arrays import BoolArray, RealArray
from ..core.status import Status
from .certificate import Certificate
from .control import Control
from .problem import ContactProblem
from .state import InterfaceState

PLASTIC_FRACTION = 0.02
"""Share of plastic in real area above which a contact is called plastic (Greenwood & Williamson 1966)."""


@dataclass(frozen=True)
class Quantity:
    """A scalar of a result: attribute name, SI unit ("1" for numbers) and label for people."""

    attribute: str
    unit: str
    label: str


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
    Quantity("plastic_area_fraction", "1", "plastic area / real contact area"),
    Quantity("max_permanent_indentation", "m", "maximum permanent indentation"),
    Quantity("normal_stiffness", "Pa/m", "normal stiffness per nominal area"),
    Quantity("n_spots", "1", "number of contact spots"),
    Quantity("mean_spot_area", "m**2", "mean area of a contact spot"),
    Quantity("contact_perimeter", "m", "contact perimeter (pixel edges)"),
)
"""Every scalar of a result in the order of tables."""


@dataclass(frozen=True, eq=False)
class ContactResult:
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
    plastic_work
        Hardness times indentation volume added by this load, J.
    plastic_area_fraction
        Area at the pressure cap over real contact area.
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
    plastic_area_fraction: float
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
    def plastic(self) -> BoolArray:
        """(nx, ny), True where the pressure is at its cap."""
        return self.contact & (self.pressure >= self.problem.law.pressure_cap())

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
        """State to continue from: permanent indentation and pressure."""
        return InterfaceState(self.permanent_indentation, self.pressure)
