"""A characterisation as plain numbers and lists, fit for JSON."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..core.arrays import RealArray
from ..surfaces.characterise.summary import Characterisation

_RATIOS = 101  # points of the material ratio curve


def roughness_record(found: Characterisation) -> dict[str, Any]:
    """Dictionary of ``quantities`` (value in SI, unit, symbol, label by path), ``curves`` and ``remarks`` of ``found``.

    What is not defined is None. Curves are lists of SI numbers with their units in the names of the keys.
    """
    return {
        "quantities": {
            quantity.name: {
                "value": _number(value),
                "unit": quantity.unit,
                "symbol": quantity.symbol,
                "label": quantity.label,
            }
            for quantity, value in found.values()
        },
        "curves": {name: curve for name, curve in _curves(found).items() if curve is not None},
        "remarks": list(found.remarks),
    }


def _curves(found: Characterisation) -> dict[str, dict[str, Any] | None]:
    curves, spectra = found.curves, found.spectra
    ratios = np.linspace(0.0, 1.0, _RATIOS)
    radial = spectra.radial
    record: dict[str, dict[str, Any] | None] = {
        "material_ratio": {"ratio": ratios.tolist(), "height_m": curves.material_ratio.height(ratios).tolist()},
        "height_distribution": {
            "edges_m": curves.distribution.edges.tolist(),
            "density_per_m": curves.distribution.density.tolist(),
        },
        "spectrum": None
        if radial is None
        else {"q_rad_per_m": radial.q.tolist(), "psd_m4": radial.psd.tolist(), "modes": radial.modes.tolist()},
    }
    for number, axis in enumerate("xy"):
        lag, value = curves.autocovariance.along(axis)
        record[f"autocovariance_{axis}"] = {"lag_m": lag.tolist(), "value_m2": _numbers(value)}
        structure, profile = curves.structure[number], spectra.profiles[number]
        if structure is not None:
            record[f"structure_function_{axis}"] = {
                "lag_m": structure.lag.tolist(),
                "value_m2": structure.value.tolist(),
            }
        if profile is not None:
            record[f"spectrum_{axis}"] = {"q_rad_per_m": profile.q.tolist(), "psd_m3": profile.psd.tolist()}
    return record


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _numbers(values: RealArray) -> list[float | None]:
    return [_number(float(value)) for value in values]
