from ..core.grid import Grid
from .pair import SurfacePair, composite, on_common_grid, turned_over
from .prepare.extent import cropped, periodised, resampled, sliced, tapered
from .prepare.filter import filtered, reliability_cutoff, tip_limited
from .prepare.level import despiked, filled, levelled, line_corrected
from .prepare.regions import Ellipse, Polygon, Rectangle, masked
from .prepare.tip import (
    ConicalTip,
    MeasuredTip,
    ParabolicTip,
    SphericalTip,
    certain_points,
    estimated_tip,
    reconstructed,
    scanned,
)
from .profile import Instrument, Profile
from .read import channels, read
from .scans import Scan, Scans
from .scans_two_scales import with_fine_detail, with_registered_detail
from .surface import Surface, strip

__all__ = [
    "ConicalTip",
    "Ellipse",
    "Grid",
    "Instrument",
    "MeasuredTip",
    "ParabolicTip",
    "Polygon",
    "Profile",
    "Rectangle",
    "Scan",
    "Scans",
    "SphericalTip",
    "Surface",
    "SurfacePair",
    "certain_points",
    "channels",
    "composite",
    "cropped",
    "despiked",
    "estimated_tip",
    "filled",
    "filtered",
    "levelled",
    "line_corrected",
    "masked",
    "on_common_grid",
    "periodised",
    "read",
    "reconstructed",
    "reliability_cutoff",
    "resampled",
    "scanned",
    "sliced",
    "strip",
    "tapered",
    "tip_limited",
    "turned_over",
    "with_fine_detail",
    "with_registered_detail",
]
