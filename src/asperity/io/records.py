"""Answers of theories and characterisations as plain records for JSON and tables."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from ..core.citations import reference
from ..core.parameters import Parameter, parameters
from ..core.quantity import Quantity
from ..surfaces.characterise.summary import Characterisation
from ..theories.ask import Evaluation, ways_of
from ..theories.protocol import Described
from .tables import write_table

# Answers of theories for other programs: a record for JSON, a table as CSV; and the catalogue as
# records.


def answer_record(found: Evaluation) -> dict[str, Any]:
    """``found`` as plain values in SI; None stands for what is undefined or infinite."""
    theory = found.theory
    return {
        "theory": theory.name,
        "title": theory.title,
        "inputs": {
            item.name: {"value": _input(item, getattr(theory, item.name)), "unit": item.unit}
            for item in parameters(type(theory))
        },
        "numbers": {column.name: {"value": _plain(value), "unit": _unit(column)} for column, value in found.numbers},
        "columns": {
            column.name: {"unit": _unit(column), "meaning": column.label, "values": [_plain(v) for v in values]}
            for column, values in found.columns
        },
        "limits": [
            {
                "criterion": limit.criterion,
                "low": _plain(limit.low),
                "high": _plain(limit.high),
                "values": [_plain(v) for v in limit.value],
                "holds": [bool(v) for v in limit.holds],
                "of": list(limit.of),
                "message": limit.message,
                "source": reference(limit.citation),
            }
            for limit in found.limits
        ],
        "sources": [reference(key) for key in theory.citation_keys],
    }


def catalogue_record(kind: type[Described]) -> dict[str, Any]:
    """Entry of the catalogue for a theory."""
    return {
        "name": kind.name,
        "title": kind.title,
        "inputs": [
            {
                "name": item.name,
                "unit": item.unit,
                "meaning": item.help,
                "of": item.of or "surface",
                "required": item.required,
                "choices": list(item.words),
                "many": item.many,
            }
            for item in parameters(kind)
        ],
        "ways": [
            {"along": way.axis.name, "unit": way.axis.unit, "given": [item.name for item in way.given]}
            for way in ways_of(kind)
        ],
        "numbers": [column.name for column in kind.numbers],
        "from_surface": hasattr(kind, "from_roughness") or hasattr(kind, "of_roughness"),
        "sources": [reference(key) for key in kind.citation_keys],
    }


def save_table(found: Evaluation, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the columns of ``found`` as CSV with a heading of names and units, and whether the
    limits hold that concern all; SI, exact.

    Without columns the numbers are written: name, value, unit, meaning.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    rows: list[tuple[Any, ...]]
    if not found.columns:
        rows = [("name", "value", "unit", "meaning")]
        rows += [(column.name, value, _unit(column), column.label) for column, value in found.numbers]
    else:
        units = [f"{column.name} ({column.unit})" if _unit(column) else column.name for column, _ in found.columns]
        rows = [(*units, "valid")]
        rows += zip(*(values.tolist() for _, values in found.columns), found.holds().tolist(), strict=True)
    write_table(rows, path, overwrite=overwrite)


def _unit(quantity: Quantity) -> str:
    return "" if quantity.unit == "1" else quantity.unit


def _plain(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def named(value: Any) -> str:
    """What a command calls a ``value``: its label or name, else its text."""
    return str(getattr(value, "label", getattr(value, "name", value)))


def _input(item: Parameter, value: Any) -> Any:
    """Value of an input: its word where it has one, a list of many."""
    for word, choice in item.words.items():
        if choice == value:
            return word
    if item.many:
        return [_plain(number) for number in np.asarray(value, dtype=float)]
    if isinstance(value, int | float):
        return _plain(float(value))
    return None if value is None else named(value)


# A characterisation as plain numbers and lists, fit for JSON.


_RATIOS = 101  # points of the material ratio curve


def roughness_record(found: Characterisation) -> dict[str, Any]:
    """Dictionary of ``quantities`` (value in SI, unit, symbol, label by path), ``curves`` and
    ``remarks`` of ``found``.

    What is not defined is None. Curves are lists of SI numbers with their units in the names of the
    keys.
    """
    return {
        "quantities": {
            quantity.name: {
                "value": _plain(value),
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
        record[f"autocovariance_{axis}"] = {"lag_m": lag.tolist(), "value_m2": [_plain(v) for v in value]}
        structure, profile = curves.structure[number], spectra.profiles[number]
        if structure is not None:
            record[f"structure_function_{axis}"] = {
                "lag_m": structure.lag.tolist(),
                "value_m2": structure.value.tolist(),
            }
        if profile is not None:
            record[f"spectrum_{axis}"] = {"q_rad_per_m": profile.q.tolist(), "psd_m3": profile.psd.tolist()}
    return record
