from ..core.grid import Grid
from .pair import SurfacePair, composite, on_common_grid, turned_over
from .prepare.extent import cropped, periodised, resampled, sliced, tapered
from .prepare.filter import filtered, reliability_cutoff, tip_limited
from .prepare.level import despiked, filled, levelled, line_corrected
from .read import channels, read
from .scans import Scan, Scans
from .scans_two_scales import with_fine_detail, with_registered_detail
from .surface import Surface

__all__ = [
    "Grid",
    "Scan",
    "Scans",
    "Surface",
    "SurfacePair",
    "channels",
    "composite",
    "cropped",
    "despiked",
    "filled",
    "filtered",
    "levelled",
    "line_corrected",
    "on_common_grid",
    "periodised",
    "read",
    "reliability_cutoff",
    "resampled",
    "sliced",
    "tapered",
    "tip_limited",
    "turned_over",
    "with_fine_detail",
    "with_registered_detail",
]
