"""What a comparison holds: the curves of the theories and of the numerical solution on the same
loads; and its files."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..contact.problem import ContactProblem
from ..core.arrays import BoolArray, RealArray
from ..core.late import Drawn
from ..core.status import Advice
from ..core.units import percent, show
from ..io.description import software, surface_provenance
from ..io.tables import write_table
from ..io.tree import FORMAT_VERSION, node_of, write_tree
from ..surfaces.surface import Surface
from ..theories.protocol import QUANTITIES, Prediction
from ..theories.statistics.roughness import Roughness
from .comparison_theories import LeftOut

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, eq=False)
class TheoryCurve:
    """One theory along the loads of a comparison.

    Parameters
    ----------
    name, title, family
        Name in the comparison, title, and ``elastic``, ``elastic-plastic`` or ``adhesive``.
    prediction
        Its prediction at every load, NaN where it has none.
    valid_for
        (n,) where the limits hold that concern ``area_fraction``, ``contact_density`` and ``gap``.
    notes
        Where it leaves its limits, and by which numbers.
    comparable_gap
        Whether its separation means the same as the mean gap of the numerical solution.
    citation_keys
        The papers behind it.
    """

    name: str
    title: str
    family: str
    prediction: Prediction
    valid_for: Mapping[str, BoolArray]
    notes: tuple[str, ...]
    comparable_gap: bool
    citation_keys: tuple[str, ...]

    @property
    def valid(self) -> BoolArray:
        """(n,) where all limits hold that concern the area."""
        return self.valid_for["area_fraction"]

    @property
    def gap(self) -> RealArray:
        """(n,) mean gap in m, or the separation of the mean planes where the theory defines no gap;
        NaN if neither."""
        own = self.prediction
        if not self.comparable_gap:
            return np.full_like(own.mean_gap, np.nan)
        found: RealArray = np.where(np.isfinite(own.mean_gap), own.mean_gap, own.separation)
        return found


@dataclass(frozen=True, eq=False)
class NumericalCurve:
    """The boundary-element solution along the loads of a comparison; every field (n,), NaN where it
    did not converge.

    ``area_fraction`` counts pixels, ``area_fraction_corrected`` is that by the edges between them
    and is what theories are compared with; ``contact_density`` spots per nominal area in 1/m²,
    ``mean_gap`` in m, ``seconds`` of the whole path, ``solver`` its method.
    """

    area_fraction: RealArray
    area_fraction_corrected: RealArray
    contact_density: RealArray
    mean_gap: RealArray
    seconds: float
    solver: str
    notes: tuple[str, ...]
    citation_keys: tuple[str, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Drawn):
    """Theories of rough contact beside the numerical solution, on one surface.

    Parameters
    ----------
    problem
        The contact that was solved.
    surface
        The surface that the theories describe: that of the problem, or the sum of both.
    roughness
        What was measured on it for the theories.
    pressures
        (n,) nominal pressures in Pa, rising.
    curves
        The theories.
    left_out
        Theories without a curve, each with its reason.
    numerical
        The boundary-element solution, None if it was not asked for.
    remarks
        What bodies, law and boundary mean for the comparison.
    findings
        Checks of resolution and regime at the lowest and the highest load.
    """

    problem: ContactProblem
    surface: Surface
    roughness: Roughness
    pressures: RealArray
    curves: tuple[TheoryCurve, ...]
    left_out: tuple[LeftOut, ...]
    numerical: NumericalCurve | None
    remarks: tuple[str, ...]
    findings: tuple[Advice, ...]

    @property
    def E_star(self) -> float:
        """Contact modulus in Pa of the materials at the surfaces, that of all theories."""
        return self.problem.contact_modulus

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """The papers behind all curves."""
        parts = [self.surface.origin.citation_keys, *(curve.citation_keys for curve in self.curves)]
        if self.numerical is not None:
            parts.append(self.numerical.citation_keys)
        return tuple(dict.fromkeys(key for keys in parts for key in keys))

    def curve(self, name: str) -> TheoryCurve:
        """Curve of the theory called ``name``; KeyError if there is none."""
        return {curve.name: curve for curve in self.curves}[name]

    def kappa(self, area_fraction: RealArray) -> RealArray:
        """κ = (A/A_n) E* h'_rms/p (n,) of ``area_fraction`` (n,) at the pressures of the
        comparison."""
        scaled: RealArray = area_fraction * (self.E_star * self.roughness.rms_gradient) / self.pressures
        return scaled

    def slope(self, area_fraction: RealArray) -> RealArray:
        """Local slope d(A/A_n)/d(p/(E* h'_rms)) (n,) by differences of the logarithms; NaN beside
        loads without area."""
        if area_fraction.size < 2:
            return np.full_like(area_fraction, np.nan)
        with np.errstate(divide="ignore", invalid="ignore"):
            exponent = np.gradient(np.log(area_fraction), np.log(self.pressures))
            steep: RealArray = self.kappa(area_fraction) * exponent
        return np.where(np.isfinite(steep), steep, np.nan)

    def deviation(self, name: str, quantity: str = "area_fraction") -> RealArray:
        """Deviation (n,) of the theory ``name`` from the numerical solution; NaN where one of them
        has no value.

        ``quantity``: ``area_fraction`` (from the corrected area) and ``contact_density`` relative,
        ``gap`` in rms heights.
        """
        curve = self.curve(name)
        if self.numerical is None:
            return np.full_like(self.pressures, np.nan)
        found = curve.gap if quantity == "gap" else getattr(curve.prediction, quantity)
        exact = getattr(self.numerical, _EXACT[quantity])
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = self.roughness.rms_height if quantity == "gap" else exact
            apart: RealArray = (found - exact) / scale
        return np.where(np.isfinite(apart), apart, np.nan)

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and main numbers."""
        low, high = (show(float(self.pressures[end]), "Pa", 3) for end in (0, -1))
        rows = [("loads", f"{self.pressures.size} from {low} to {high}")]
        if self.numerical is not None:
            low, high = (percent(float(self.numerical.area_fraction_corrected[end])) for end in (0, -1))
            rows.append(("area", f"{low} to {high} of the nominal area"))
        beside = "the numerical solution" if self.numerical is not None else "no numerical solution"
        return f"Comparison of {len(self.curves)} theories with {beside}", rows

    @property
    def dataset(self) -> xarray.Dataset:
        """All of it as a labelled dataset with dimensions ``theory`` and ``pressure``, units and
        provenance."""
        import xarray

        curves = self.curves
        variables: dict[str, Any] = {}
        for quantity in QUANTITIES[1:]:
            values = [getattr(curve.prediction, quantity.name) for curve in curves]
            variables[quantity.name] = _of_theories(self, values, quantity.unit, quantity.label)
        gaps = [curve.gap for curve in curves]
        variables["gap"] = _of_theories(self, gaps, "m", "mean gap, or separation where the theory defines no gap")
        for name, meaning in _DERIVED.items():
            values = [getattr(self, name)(curve.prediction.area_fraction) for curve in curves]
            variables[name] = _of_theories(self, values, "1", meaning)
        for name in _EXACT:
            valid = np.array([curve.valid_for[name] for curve in curves]).reshape(len(curves), self.pressures.size)
            label = f"whether all limits of the theory hold that concern {name}"
            variables[f"{name}_valid"] = (("theory", "pressure"), valid, _labels("1", label))
        numerical = self.numerical
        if numerical is not None:
            area = numerical.area_fraction_corrected
            columns = {
                "area_fraction": (numerical.area_fraction, "1", "real area per nominal area, pixels counted"),
                "area_fraction_corrected": (area, "1", "real area per nominal area, by edges between pixels"),
                "contact_density": (numerical.contact_density, "1/m^2", "contact spots per nominal area"),
                "mean_gap": (numerical.mean_gap, "m", "mean distance of the deformed surfaces"),
                **{name: (getattr(self, name)(area), "1", meaning) for name, meaning in _DERIVED.items()},
            }
            for name, (column, unit, meaning) in columns.items():
                variables[f"numerical_{name}"] = ("pressure", column, _labels(unit, f"boundary elements: {meaning}"))
            for name, exact in _EXACT.items():
                rows = [self.deviation(curve.name, name) for curve in curves]
                scale = "rms height" if name == "gap" else f"numerical_{exact}"
                label = f"({name} of the theory - numerical_{exact}) / {scale}"
                variables[f"{name}_deviation"] = _of_theories(self, rows, "1", label)
        pressures = self.pressures
        coordinates = {
            "theory": ("theory", np.array([curve.name for curve in curves], dtype=object)),
            "title": ("theory", np.array([curve.title for curve in curves], dtype=object)),
            "family": ("theory", np.array([curve.family for curve in curves], dtype=object)),
            "pressure": ("pressure", pressures, _labels("Pa", "nominal pressure")),
            "relative_pressure": ("pressure", pressures / self.E_star, _labels("1", "nominal pressure / E*")),
        }
        return xarray.Dataset(variables, coordinates, _attributes(self))


_EXACT = {"area_fraction": "area_fraction_corrected", "contact_density": "contact_density", "gap": "mean_gap"}
"""Field of the numerical solution that stands for the truth of a quantity."""

_DERIVED = {
    "kappa": "slope from the origin, area fraction x E* h'_rms / p",
    "slope": "local slope, d(area fraction) / d(p / (E* h'_rms))",
}


def _attributes(comparison: Comparison) -> dict[str, Any]:
    roughness = comparison.roughness
    described = {
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "software": software(),
        "surface": surface_provenance(comparison.surface),
    }
    notes = {curve.name: list(curve.notes) for curve in comparison.curves}
    if comparison.numerical is not None:
        notes["numerical"] = list(comparison.numerical.notes)
    return {
        "title": "theories of rough contact beside the numerical solution",
        "asperity_format": FORMAT_VERSION,
        "contact_modulus_Pa": comparison.E_star,
        "rms_gradient": roughness.rms_gradient,
        "rms_height_m": roughness.rms_height,
        "nayak_parameter": roughness.alpha,
        "notes": json.dumps(notes),
        "left_out": json.dumps({item.name: item.reason for item in comparison.left_out}),
        "remarks": json.dumps(list(comparison.remarks)),
        "provenance": json.dumps(described),
        "citation_keys": " ".join(comparison.citation_keys),
    }


def _of_theories(comparison: Comparison, rows: list[RealArray], unit: str, label: str) -> Any:
    values = np.array(rows, dtype=float).reshape(len(rows), comparison.pressures.size)
    return ("theory", "pressure"), values, _labels(unit, label)


def _labels(unit: str, label: str) -> dict[str, str]:
    return {"units": unit, "long_name": label}


# As files: the labelled dataset as NetCDF-4, and a table with a row for every curve and load as
# CSV.


NUMERICAL = "numerical"
"""Name of the numerical solution among the curves."""

COLUMNS = (
    "curve",
    "pressure (Pa)",
    "relative_pressure",
    "area_fraction",
    "area_fraction_pixels",
    "kappa",
    "slope",
    "gap (m)",
    "contact_density (1/m^2)",
    "valid",
    "area_fraction_deviation",
    "contact_density_deviation",
    "gap_deviation (rms heights)",
    "gap_valid",
    "contact_density_valid",
)
"""Head of the table."""


def save_comparison(comparison: Comparison, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the dataset of ``comparison`` to the NetCDF-4 file ``path``, which ``open_tree`` reads.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    write_tree(node_of(comparison.dataset), path, overwrite=overwrite)


def export_comparison_csv(comparison: Comparison, path: str | Path, *, overwrite: bool = False) -> None:
    """Write one row for every curve and load of ``comparison`` to ``path``, SI, exact; what is not
    defined is empty.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    write_table([COLUMNS, *_rows(comparison)], path, overwrite=overwrite)


def _rows(comparison: Comparison) -> Iterator[tuple[object, ...]]:
    p = comparison.pressures
    nothing: RealArray = np.full_like(p, np.nan)
    found: list[tuple[str, tuple[RealArray, RealArray], tuple[RealArray | BoolArray, ...]]] = []
    if comparison.numerical is not None:
        solved = comparison.numerical
        rest: tuple[RealArray | BoolArray, ...] = (
            solved.mean_gap,
            solved.contact_density,
            np.isfinite(solved.mean_gap),
            *(3 * [nothing]),
            *(2 * [np.isfinite(solved.mean_gap)]),
        )
        found.append((NUMERICAL, (solved.area_fraction_corrected, solved.area_fraction), rest))
    for curve in comparison.curves:
        deviations = [comparison.deviation(curve.name, name) for name in ("area_fraction", "contact_density", "gap")]
        rest = (
            curve.gap,
            curve.prediction.contact_density,
            curve.valid,
            *deviations,
            curve.valid_for["gap"],
            curve.valid_for["contact_density"],
        )
        found.append((curve.name, (curve.prediction.area_fraction, nothing), rest))
    for name, areas, rest in found:
        area = areas[0]
        columns = (p, p / comparison.E_star, *areas, comparison.kappa(area), comparison.slope(area), *rest)
        for row in zip(*columns, strict=True):
            values = [value.item() for value in row]
            yield (name, *("" if isinstance(value, float) and math.isnan(value) else value for value in values))
