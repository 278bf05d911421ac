from ..core.grid import Grid
from .pair import SurfacePair, composite, on_common_grid, turned_over
from .prepare.extent import cropped, periodised, resampled, sliced, tapered
from .prepare.filter import filtered, reliability_cutoff, tip_limited
from .prepare.level import despiked, filled, levelled, line_corrected
from .profile import Instrument, Profile
from .read import channels, read
from .surface import Surface, strip

__all__ = [
    "Grid",
    "Instrument",
    "Profile",
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
    "strip",
    "tapered",
    "tip_limited",
    "turned_over",
]
