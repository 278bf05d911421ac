"""Many scans of one surface in words, tables and a self-contained HTML page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..core.arrays import array_digest
from ..core.status import Advice
from ..core.units import percent, show
from ..io.description import software
from ..parts.part import Table
from ..parts.waves_work import leak_text, wave_tables
from ..plots.picture import Figure, figures_by
from ..plots.scans import SCALES_PLOTS, SCANS_PLOTS, WAVES_PLOTS
from ..surfaces.characterise.scans_scales import ScaleCurve
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..surfaces.scans import Scans
from ..theories.rough.deciding_waves import POINTS_PER_WAVE, DecidingWaves
from .page import shown, software_rows, write_page

_COLUMNS = (("height", "m"), ("slope", "1"), ("curvature", "1/m"))
_ROWS_PER_DECADE = 3.0  # of the scale-dependent parameters


@dataclass(frozen=True, eq=False)
class ScansInWords:
    """What is told of ``scans`` of one surface with their ``spectrum``, and of the ``waves`` that
    decide a contact, if one is asked for."""

    scans: Scans
    spectrum: ScansSpectrum
    waves: DecidingWaves | None = None

    @cached_property
    def curves(self) -> Mapping[str, ScaleCurve]:
        """Scale-dependent parameters by quantity."""
        return self.scans.scale_curves(self.spectrum)

    @property
    def findings(self) -> tuple[Advice, ...]:
        """Those of the spectrum, and what the scans leave open of the contact: its largest scan and
        the interval of its shortest reliable wave count."""
        if self.waves is None:
            return self.spectrum.findings
        longest = max(scan.length for scan in self.scans.scans)
        return (
            *self.spectrum.findings,
            *self.waves.findings(longest, self.spectrum.shortest_wavelength / POINTS_PER_WAVE),
        )

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the numbers."""
        more = () if self.waves is None else self.waves.citation_keys
        keys = (*self.spectrum.citation_keys, *ScaleCurve.citation_keys, *more)
        return tuple(dict.fromkeys(keys))

    def main_rows(self) -> list[tuple[str, str]]:
        """Name and text of the main numbers of the spectrum, and which waves decide a leak."""
        rows = self.spectrum.in_words()[1][1:]
        if self.waves is None:
            return rows
        return [*rows, ("waves of the throats of a leak", leak_text(self.waves))]

    def bands(self) -> Table:
        """Reliable waves of each scan, and what limits them."""
        rows = (
            (name, show(band.longest, "m", 3), show(band.shortest, "m", 3), band.by, "yes" if band.usable else "no")
            for name, band in self.scans.limits().items()
        )
        return Table(("scan", "longest", "shortest", "limited by", "used"), tuple(rows))

    def scales(self) -> Table:
        """Scale-dependent parameters, a row for each length of three a factor of ten."""
        headings = ("length", "rms height", "±", "rms slope", "±", "rms curvature", "±")
        by_band: dict[int, list[str]] = {}
        for column, (name, unit) in enumerate(_COLUMNS):
            curve = self.curves[name]
            for length, value, error in zip(curve.length, curve.value, curve.error, strict=True):
                band = math.floor(_ROWS_PER_DECADE * math.log10(length) + 1e-9)
                row = by_band.setdefault(band, ["–"] * len(headings))
                if row[2 * column + 1] == "–":
                    row[2 * column + 1] = show(float(value), unit, 3)
                    row[2 * column + 2] = "–" if math.isnan(error) else percent(float(error), 2)
                    row[0] = show(float(length), "m", 3) if row[0] == "–" else row[0]
        return Table(headings, tuple(tuple(by_band[band]) for band in sorted(by_band)))

    def tables(self) -> list[tuple[str, Table]]:
        """All tables with their headings."""
        found = [("Reliable waves", self.bands()), ("Scale-dependent parameters", self.scales())]
        return found if self.waves is None else [*found, *wave_tables(self.waves)]

    def figures(self) -> tuple[Figure, ...]:
        """Spectrum, scale-dependent parameters, and the waves that decide the contact."""
        found = (*figures_by(SCANS_PLOTS, self.spectrum), *figures_by(SCALES_PLOTS, self.curves))
        return found if self.waves is None else (*found, *figures_by(WAVES_PLOTS, self.waves))


def write_scans_report(
    scans: Scans,
    path: str | Path,
    *,
    spectrum: ScansSpectrum | None = None,
    waves: DecidingWaves | None = None,
    title: str = "",
    overwrite: bool = False,
) -> None:
    """Write a page on many scans of one surface to the HTML file ``path``; it needs no network and
    no other file.

    Parameters
    ----------
    scans
        Scans of one surface.
    path
        File, ending in .html.
    spectrum
        That of the scans, if it is known already.
    waves
        Those that decide a contact of the surface, by ``asperity.roughness.deciding_waves_of``.
    title
        Title; that of many scans if empty.
    overwrite
        Whether a file that exists is replaced.

    Raises
    ------
    InputError
        If no scan has eight reliable modes.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    write_page_of_scans(
        ScansInWords(scans, scans.spectrum() if spectrum is None else spectrum, waves),
        path,
        title=title,
        overwrite=overwrite,
    )


def write_page_of_scans(
    told: ScansInWords,
    path: str | Path,
    *,
    figures: tuple[Figure, ...] | None = None,
    title: str = "",
    overwrite: bool = False,
) -> None:
    """Write the page with what is ``told``, with its ``figures`` if they are drawn already."""
    scans = told.scans.scans
    write_page(
        path,
        "scans.html",
        title=title or f"{len(scans)} scans of one surface",
        summary=scans_summary(told),
        advice=told.findings,
        headline=told.main_rows(),
        figures=shown(told.figures() if figures is None else figures),
        tables=[(f"table-{n}", heading, table) for n, (heading, table) in enumerate(told.tables(), 1)],
        facts_rows=[(scan.name, _scan_text(scan.in_words()[1])) for scan in scans],
        provenance=software_rows(software(), **{scan.name: array_digest(scan.heights) for scan in scans}),
        citation_keys=told.citation_keys,
        overwrite=overwrite,
    )


def _scan_text(rows: list[tuple[str, str]]) -> str:
    return "; ".join(f"{name} {text}" for name, text in rows)


def scans_summary(told: ScansInWords) -> str:
    """Some sentences on the scans: how many, over which waves, how their spectrum falls."""
    found = told.spectrum
    longest = show(max(long for _, long in found.bands), "m", 3)
    waves = f"waves from {longest} to {show(found.measured_to, 'm', 3)}"
    many = len(told.scans.scans)
    sentences = [
        f"{len(found.scans)} of {many} scans show {waves}."
        if len(found.scans) < many
        else f"{many} scans show {waves}."
    ]
    law = f"Their one spectrum has the Hurst exponent {found.hurst:.3g} ± {found.hurst_error:.2g}"
    end = "; no roll-off is seen."
    if found.rolloff_seen:
        end = f" and a roll-off at {show(found.rolloff_wavelength, 'm', 3)}."
    return " ".join([*sentences, law + end])
