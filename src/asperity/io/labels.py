"""Names, units and labels of everything a result holds beside its scalars; one table for files, plots and reports."""

from __future__ import annotations

from ..contact.result import SCALARS
from ..core.quantity import Quantity

FIELDS = (
    Quantity("pressure", "Pa", "contact pressure"),
    Quantity("displacement", "m", "sum of the normal displacements of both surfaces, into the bodies"),
    Quantity("gap", "m", "gap between the deformed surfaces"),
    Quantity("permanent_indentation", "m", "permanent indentation of the composite profile"),
)
"""Fields (nx, ny) that a result stores."""

OFFSET = Quantity("offset", "m", "rigid-body position: gap = offset + displacement - profile + permanent indentation")
"""The scalar from which fields follow, not in the table for people."""

CERTIFICATE = (
    Quantity("duality_gap", "1", "bound on the relative error of the energy"),
    Quantity("field_error", "1", "relative error of the field"),
    Quantity("penetration", "1", "largest overlap of the bodies / rms height"),
    Quantity("load_imbalance", "1", "relative error of the load"),
    Quantity("tolerance", "1", "tolerance given to the solver"),
    Quantity("iterations", "1", "iterations"),
    Quantity("fft_pairs", "1", "FFT pairs of the size of the grid"),
    Quantity("wall_time", "s", "time to solve"),
    Quantity("peak_memory", "B", "largest memory of the process so far"),
    Quantity("solver", "", "solver"),
)
"""Entries of a certificate in the order of tables."""

ALL_SCALARS = (*SCALARS, OFFSET)
"""Every scalar that a result stores."""
