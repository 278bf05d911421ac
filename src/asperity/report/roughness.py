"""A self-contained HTML page on the roughness of one surface."""

from __future__ import annotations

import base64
import math
from pathlib import Path

from ..core.citations import REFERENCES
from ..core.units import percent, show
from ..io.atomic import atomic_file
from ..io.provenance import software, surface_provenance
from ..io.words import surface_rows
from ..plots.surface_figures import SURFACE_PLOTS, render_surface_plot
from ..surfaces.characterise.summary import Characterisation, SpectralParameters
from .gaussian import peak_comparison, summit_comparison
from .page import rendered
from .quantities import headline_values, quantity_rows

TEMPLATE = "roughness.html"
"""Template in the folder ``templates``."""


def write_roughness_report(
    found: Characterisation, path: str | Path, *, title: str = "", overwrite: bool = False
) -> None:
    """Write a page on a characterised surface to the HTML file ``path``; it needs no network and no other file.

    Parameters
    ----------
    found
        What ``characterise`` found.
    path
        HTML file to write.
    title
        Heading; made from the source of the surface if empty.
    overwrite
        Whether an existing file is replaced.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_text(_html(found, title or _title(found)), encoding="utf-8")


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
    if found.spectra.fit is not None:
        sentences.append(_spectrum_sentence(found.spectrum))
    return " ".join(sentences)


def _spectrum_sentence(spectrum: SpectralParameters) -> str:
    law = f"The spectrum falls as q to the power −{spectrum.exponent_1:.2f}"
    if math.isfinite(spectrum.exponent_2):
        law += f", below {show(spectrum.crossover_wavelength, 'm', 3)} as −{spectrum.exponent_2:.2f}"
    elif math.isfinite(spectrum.hurst):
        law += f" (Hurst exponent {spectrum.hurst:.2f})"
    if math.isfinite(spectrum.rolloff_wavelength):
        return f"{law}, with a roll-off at {show(spectrum.rolloff_wavelength, 'm', 3)}."
    return f"{law}; the scan shows no roll-off."


def _html(found: Characterisation, title: str) -> str:
    return rendered(
        TEMPLATE,
        title=title,
        summary=summary(found),
        headline=headline_values(found),
        remarks=found.remarks,
        figures=[
            {
                "title": plot.title,
                "caption": plot.caption,
                "picture": base64.b64encode(render_surface_plot(plot, found)).decode("ascii"),
            }
            for plot in SURFACE_PLOTS
        ],
        groups=quantity_rows(found),
        summits=summit_comparison(found),
        peaks=peak_comparison(found),
        facts_rows=_facts(found),
        provenance=_provenance(found),
        references=[(key, REFERENCES.get(key, "unknown reference")) for key in found.citation_keys],
    )


def _title(found: Characterisation) -> str:
    source = found.surface.origin.source
    return f"Roughness report: {source}" if source else "Roughness report"


def _facts(found: Characterisation) -> list[tuple[str, str]]:
    missing, points = found.surface.n_missing, found.surface.grid.n_points
    row = [("missing points", f"{missing} ({percent(missing / points)})")] if missing else []
    power = found.spectra.power
    return [*surface_rows(found.surface), *row, ("window of the spectra", "–" if power is None else power.window)]


def _provenance(found: Characterisation) -> list[tuple[str, str]]:
    return [
        *((name.replace("_", " "), text) for name, text in software().items()),
        ("SHA-256 of the heights", surface_provenance(found.surface)["digest"]),
    ]
