"""A self-contained HTML page on the roughness of one surface."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from ..core.errors import InputError
from ..core.quantity import Quantity
from ..core.units import percent, show
from ..io.description import software, surface_provenance
from ..io.words import surface_rows
from ..parts.part import Table
from ..plots.picture import Figure
from ..plots.surface import roughness_figures
from ..plots.together import drawing
from ..surfaces.characterise.quantities import GROUPS, QUANTITIES
from ..surfaces.characterise.summary import Characterisation
from ..theories.rough.profile_peaks import SampledPeaks
from ..theories.statistics.nayak import NayakSummits
from .page import shown, software_rows, write_page
from .scene import scene

# The numbers of a characterisation in words for a table.


ABSOLUTE_ERRORS = {
    "spectrum.hurst": "spectrum.hurst_error",
    "spectrum.exponent_1": "spectrum.exponent_1_error",
    "spectrum.exponent_2": "spectrum.exponent_2_error",
    "fractal_x.dimension": "fractal_x.dimension_error",
    "fractal_y.dimension": "fractal_y.dimension_error",
}
"""Standard error, in the unit of the number, by path of the number."""

RELATIVE_ERRORS = {
    "spectrum.plateau": "spectrum.plateau_error",
    "spectrum.rolloff_wavelength": "spectrum.rolloff_error",
    "spectrum.crossover_wavelength": "spectrum.crossover_error",
    "spectrum.floor": "spectrum.floor_error",
    "heights.Sq": "sampling.Sq_error",
}
"""Standard error relative to the number, by path of the number; that of Sq is its scatter from map
to map."""

BOUNDS = {"spatial.Sal": ("≥", "spatial.Sal_least"), "spatial.Str": ("≤", "spatial.Str_most")}
"""Bound of a number that is not known, with its sign, by path of the number."""

SHARES = ("functional.Smr1", "functional.Smr2", "hybrid.Sdr", "sampling.Sq_error")
"""Numbers given in per cent."""

HEADLINE = (
    "heights.Sq",
    "heights.Sa",
    "heights.Sz",
    "heights.Ssk",
    "heights.Sku",
    "hybrid.Sdq",
    "spatial.Sal",
    "spatial.Str",
)
"""Numbers that people look for first."""


NOT_DEFINED = "–"
"""Text of a number that the surface does not have."""


def quantity_text(quantity: Quantity, value: float, digits: int = 4) -> str:
    """Text of ``value`` with its unit; angles in degrees, shares in per cent, what is not defined
    as a dash."""
    if math.isnan(value):
        return NOT_DEFINED
    if quantity.unit == "rad":
        return f"{math.degrees(value):.{digits}g}°"
    if quantity.name in SHARES:
        return percent(value, digits)
    if quantity.unit == "1" and quantity.name.endswith((".count", ".saddles")):
        return f"{value:.0f}"
    return show(value, quantity.unit, digits)


def quantity_rows(found: Characterisation) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """Heading of each group with the name, the text and the definition of its numbers, those along
    x and y in one row.

    What is not defined for the surface is left out.
    """
    values = {quantity.name: value for quantity, value in found.values()}
    beside = {*ABSOLUTE_ERRORS.values(), *RELATIVE_ERRORS.values(), *(path for _, path in BOUNDS.values())}
    along_y: dict[str, Quantity] = {}  # by the path of the number along x
    for quantity in QUANTITIES:
        parts = [part[:-2] + "_x" if part.endswith("_y") else part for part in quantity.name.split(".")]
        if ".".join(parts) != quantity.name:
            along_y[".".join(parts)] = quantity
    groups: dict[str, list[tuple[str, str, str]]] = {}
    for quantity in QUANTITIES:
        if quantity.name in beside or quantity in along_y.values():
            continue
        text = _with_error(quantity, values)
        name = f"{quantity.label} {quantity.symbol}".rstrip()
        if quantity.name in along_y:
            other = _with_error(along_y[quantity.name], values)
            text = NOT_DEFINED if text == other == NOT_DEFINED else f"{text} (x), {other} (y)"
            name = name.replace(" along x", "").replace(",x", "").replace("_x", "")
        if text != NOT_DEFINED:
            heading = GROUPS[quantity.name.split(".")[0]].replace(" along x", "")
            groups.setdefault(heading, []).append((name, text, quantity.description))
    return list(groups.items())


def headline_values(found: Characterisation) -> list[tuple[str, str]]:
    """Name and text of the numbers that people look for first."""
    values = {quantity.name: value for quantity, value in found.values()}
    chosen = {quantity.name: quantity for quantity in QUANTITIES if quantity.name in HEADLINE}
    return [
        (f"{quantity.label} {quantity.symbol}".rstrip(), _bounded(quantity, values, digits=3))
        for quantity in (chosen[path] for path in HEADLINE)
    ]


def _bounded(quantity: Quantity, values: dict[str, float], digits: int = 4) -> str:
    """Text of a number, of a bound if that is all that is known."""
    value = values[quantity.name]
    if math.isnan(value) and quantity.name in BOUNDS:
        sign, path = BOUNDS[quantity.name]
        text = quantity_text(quantity, values[path], digits)
        return text if text == NOT_DEFINED else f"{sign} {text} (bound)"
    return quantity_text(quantity, value, digits)


def _with_error(quantity: Quantity, values: dict[str, float]) -> str:
    path, text = quantity.name, _bounded(quantity, values)
    if text == NOT_DEFINED:
        return text
    if path in ABSOLUTE_ERRORS and math.isfinite(error := values[ABSOLUTE_ERRORS[path]]):
        return f"{text} ± {error:.2g}"
    if path in RELATIVE_ERRORS and math.isfinite(error := values[RELATIVE_ERRORS[path]]):
        return f"{text} ± {percent(error, 2)}"
    return text


# The summits and peaks of a surface beside those of a Gaussian surface with the same moments.


Row = tuple[str, str, str, str]
"""Quantity, measured, from the moments by differences, from the spectral moments."""


def summit_comparison(found: Characterisation) -> list[Row]:
    """Measured summits against Nayak's isotropic Gaussian surface; empty without summits, dashes
    where it has no answer."""
    measured = found.summits.eight
    if measured.count == 0:
        return []
    difference, spectral = found.moments.difference, found.moments.spectral
    theories: list[NayakSummits | None] = []
    for m0, m2, m4 in ((difference.m0, difference.m2, difference.m4), (spectral.m0, spectral.m2, spectral.m4)):
        try:
            theories.append(NayakSummits(m0, m2, m4))
        except InputError:  # undefined moments, or α < 1.5 by differences on a coarse grid
            theories.append(None)
    table = (
        ("density of summits", "m**-2", measured.density, "density"),
        ("mean summit height", "m", measured.mean_height, "mean_height"),
        ("standard deviation of summit heights", "m", measured.height_deviation, "height_deviation"),
        ("mean summit curvature", "m**-1", measured.mean_curvature, "mean_curvature"),
        ("summit radius 1/<κ>", "m", measured.radius, "radius"),
    )
    return [
        (label, show(value, unit), _text(theories[0], name, unit), _text(theories[1], name, unit))
        for label, unit, value, name in table
    ]


def peak_comparison(found: Characterisation) -> list[tuple[str, str, str]]:
    """Measured peaks of profiles against those of a Gaussian profile with the same ρ1 and ρ2, along
    x and y."""
    rows = []
    for axis, peaks, spacing in (("x", found.peaks_x, found.surface.dx), ("y", found.peaks_y, found.surface.dy)):
        try:
            theory = SampledPeaks(peaks.rho_1, peaks.rho_2)
        except InputError:  # no profile, or a smooth one whose correlations are one
            continue
        sigma = found.heights.Sq
        rows += [
            (f"peaks per length along {axis}", show(peaks.density, "m**-1"), show(theory.fraction / spacing, "m**-1")),
            (f"mean peak height along {axis}", show(peaks.mean_height, "m"), show(theory.mean_height * sigma, "m")),
            (
                f"mean peak curvature along {axis}",
                show(peaks.mean_curvature, "m**-1"),
                show(theory.mean_curvature * sigma / spacing**2, "m**-1"),
            ),
        ]
    return rows


def _text(theory: NayakSummits | None, name: str, unit: str) -> str:
    return "–" if theory is None else show(getattr(theory, name), unit)


# A self-contained HTML page on the roughness of one surface.


def write_roughness_report(
    found: Characterisation,
    path: str | Path,
    *,
    figures: Sequence[Figure] | None = None,
    title: str = "",
    overwrite: bool = False,
) -> None:
    """Write a page on a characterised surface to the HTML file ``path``; it needs no network and no
    other file.

    ``found`` is that of ``characterise``, with its ``figures`` if they are drawn already; the
    ``title`` is made from the source of the surface if empty.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    surface, power, missing = found.surface, found.spectra.power, found.surface.n_missing
    row = [("missing points", f"{missing} ({percent(missing / surface.grid.n_points)})")] if missing else []
    source, figures = surface.origin.source, roughness_figures(found) if figures is None else figures
    with drawing(figures):
        maps = scene(figures, surface.grid)
    write_page(
        path,
        "roughness.html",
        title=title or (f"Roughness report: {source}" if source else "Roughness report"),
        summary=summary(found),
        headline=headline_values(found),
        remarks=found.remarks,
        figures=shown(figures),
        scene=maps,
        groups=quantity_rows(found),
        summits=summit_comparison(found),
        peaks=peak_comparison(found),
        facts_rows=[*surface_rows(surface), *row, ("window of the spectra", "–" if power is None else power.window)],
        provenance=software_rows(software(), heights=surface_provenance(surface)["digest"]),
        citation_keys=found.citation_keys,
        overwrite=overwrite,
    )


def write_files_report(table: Table, path: str | Path, summary: str, *, overwrite: bool = False) -> None:
    """Write a page with one ``table`` of many files; the rest as for ``write_roughness_report``."""
    keys = ("ISO25178",)
    title = "Roughness of files"
    write_page(path, "files.html", title=title, summary=summary, table=table, citation_keys=keys, overwrite=overwrite)


def summary(found: Characterisation) -> str:
    """Some sentences on the surface: how rough, how textured, how its spectrum falls."""
    width, height = (show(side, "m", 3) for side in found.surface.size)
    rough = f"Rms height {show(found.heights.Sq, 'm', 3)} on {width} × {height}"
    slope = found.hybrid.Sdq
    sentences = [rough + (f", rms gradient {slope:.3g}." if math.isfinite(slope) else ".")]
    aspect = found.spatial.Str
    if math.isfinite(aspect):
        kind = "isotropic" if aspect > 0.5 else "anisotropic" if aspect > 0.3 else "strongly anisotropic"
        sentences.append(f"The texture is {kind} (Str {aspect:.2f}).")
    elif found.spatial.Str_most <= 0.3:
        sentences.append(f"The texture is strongly anisotropic (Str at most {found.spatial.Str_most:.2g}).")
    if found.spectra.fit is not None:
        spectrum = found.spectrum
        law = f"The spectrum falls as q to the power −{spectrum.exponent_1:.2f}"
        if math.isfinite(spectrum.exponent_2):
            law += f", below {show(spectrum.crossover_wavelength, 'm', 3)} as −{spectrum.exponent_2:.2f}"
        elif math.isfinite(spectrum.hurst):
            law += f" (Hurst exponent {spectrum.hurst:.2f})"
        end = "; the scan shows no roll-off."
        if math.isfinite(spectrum.rolloff_wavelength):
            end = f", with a roll-off at {show(spectrum.rolloff_wavelength, 'm', 3)}."
        sentences.append(law + end)
    return " ".join(sentences)
