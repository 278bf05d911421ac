"""What ``info --one-surface`` tells: the one spectrum of many files with scans of one surface."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..core.units import percent, show
from ..plots.picture import figures_by
from ..plots.scans import SCANS_PLOTS
from ..plots.together import save_pictures
from ..surfaces.characterise.scans_scales import ScaleCurve
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..surfaces.scans import Scan, Scans
from .declared import Given
from .options import read_surface
from .show import console, print_advice, print_files, short_names, table

SCALES = ("length", "rms height", "±", "rms slope", "±", "rms curvature", "±")
"""Headings of the scale-dependent parameters."""


def one_surface(
    files: Sequence[Path],
    given: Given,
    tip_radius: float | None,
    plots: Path | None,
    *,
    as_json: bool,
    force: bool,
) -> None:
    """Print one spectrum of all ``files`` and the scale-dependent parameters, and save its
    picture."""
    known = {} if tip_radius is None else {"tip_radius": tip_radius}
    read = [
        Scan.of(read_surface(file, given), name=name, **known)
        for file, name in zip(files, short_names(files), strict=True)
    ]
    scans = Scans(read)
    found = scans.spectrum()
    curves = scans.scale_curves(found)
    if as_json:
        console().out(json.dumps(_record(found, curves), indent=2), highlight=False)
    else:
        heading, rows = found.in_words()
        console().print(table(heading, rows[1:]))
        bands = [
            (name, show(band.longest, "m", 3), show(band.shortest, "m", 3), band.by, "yes" if band.usable else "no")
            for name, band in scans.limits().items()
        ]
        console().print(table("Reliable waves", bands, ("scan", "longest", "shortest", "limited by", "used")))
        console().print(table("Scale-dependent parameters", _scale_rows(curves), SCALES))
        print_advice(found.findings)
    if plots is not None:
        written = save_pictures(figures_by(SCANS_PLOTS, found), plots, overwrite=force)
        if not as_json:
            print_files(list(written))


def _scale_rows(curves: dict[str, ScaleCurve]) -> list[tuple[str, ...]]:
    """A row for each length of three a factor of ten."""
    by_band: dict[int, list[str]] = {}
    for column, (name, unit) in enumerate((("height", "m"), ("slope", "1"), ("curvature", "1/m"))):
        curve = curves[name]
        for length, value, error in zip(curve.length, curve.value, curve.error, strict=True):
            row = by_band.setdefault(math.floor(3.0 * math.log10(length) + 1e-9), ["–"] * len(SCALES))
            if row[2 * column + 1] == "–":
                row[2 * column + 1] = show(float(value), unit, 3)
                row[2 * column + 2] = "–" if math.isnan(error) else percent(float(error), 2)
                row[0] = show(float(length), "m", 3) if row[0] == "–" else row[0]
    return [tuple(by_band[band]) for band in sorted(by_band)]


def _record(found: ScansSpectrum, curves: dict[str, ScaleCurve]) -> dict[str, Any]:
    """Spectrum and parameters in SI units."""
    m0, m2, m4 = found.moments()
    table = {
        "scans": found.scans,
        "bands": found.bands,
        "corner": found.model.name,
        "hurst": found.hurst,
        "hurst_error": found.hurst_error,
        "rolloff_seen": found.rolloff_seen,
        "rolloff_wavelength": found.rolloff_wavelength if found.rolloff_seen else None,
        "shortest_wavelength": found.shortest_wavelength,
        "m0": m0,
        "m2": m2,
        "m4": m4,
        "q": found.curve.q,
        "profile_psd": found.curve.profile_psd,
        "profile_psd_error": found.curve.error,
        "findings": [item.message for item in found.findings],
    }
    for name, curve in curves.items():
        table |= {f"{name}_length": curve.length, name: curve.value, f"{name}_error": curve.error}
    return {key: _plain(value) for key, value in table.items()}


def _plain(value: Any) -> Any:
    """Lists for arrays, and None for what is not a number."""
    if hasattr(value, "tolist"):
        return [_plain(item) for item in value.tolist()]
    return None if isinstance(value, float) and not math.isfinite(value) else value
