"""The nine fields of a row of a reference table, and of a computed value, in the same order."""

from __future__ import annotations

import numpy as np
from reference_data import Row

from asperity.core.tensor import ElasticFields

COLUMNS = ("ux", "uy", "uz", "sxx", "syy", "szz", "sxy", "sxz", "syz")


def expected(row: Row) -> np.ndarray:
    """Fields (9,) of a row."""
    return np.array([row[name] for name in COLUMNS])


def found(fields: ElasticFields) -> np.ndarray:
    """Fields (9, ...) of a value."""
    return np.array([*vars(fields.displacement).values(), *vars(fields.stress).values()])


def constants(row: Row) -> dict[str, float]:
    """Shear modulus and Poisson's ratio of a homogeneous row."""
    return {"shear": row["E"] / (2.0 * (1.0 + row["nu"])), "nu": row["nu"]}


def label(row: Row) -> str:
    """Name of a row in test reports."""
    return f"case{row['case']:g}"
