"""What ``info --one-surface`` tells: the one spectrum of many files with scans of one surface."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ..contact.scan_ensemble import deciding_waves_of
from ..core.errors import InputError
from ..core.status import Advice
from ..core.units import parse, percent, show
from ..core.values import Flag
from ..plots.picture import figures_by
from ..plots.scans import SCANS_PLOTS
from ..plots.together import save_pictures
from ..surfaces.characterise.scans_scales import ScaleCurve
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..surfaces.profile import Profile
from ..surfaces.scans import Scan, Scans
from ..surfaces.surface import Surface
from ..theories.rough.deciding_waves import POINTS_PER_WAVE, DecidingWaves
from .declared import Given, Option
from .info_line import tip_radius
from .options import own_option
from .show import console, print_advice, print_files, short_names, table

SCALES = ("length", "rms height", "±", "rms slope", "±", "rms curvature", "±")
"""Headings of the scale-dependent parameters."""


CONTACT = {
    "E_star": ("--E-star", "pressure", "contact modulus E*, to ask which waves decide the contact"),
    "pressure": ("--pressure", "pressure", "nominal pressure of that contact"),
    "hardness": ("--hardness", "pressure", "hardness in that contact; elastic without"),
}
"""Options of the contact whose deciding waves are asked for: name, dimension, help."""

PANEL = "Many scans, one surface"


def one_surface_options() -> list[Option]:
    """Options of many scans of one surface."""
    text = "all files are scans of one surface: one spectrum with errors"
    together = own_option("--one-surface", ("one_surface",), text, PANEL, values=Flag())
    contact = [
        own_option(name, ("contact", key), text, PANEL, kind.upper()) for key, (name, kind, text) in CONTACT.items()
    ]
    return [together, *contact]


def require_one_surface(given: Given) -> None:
    """Raise InputError if the waves of a contact are asked for without ``--one-surface``."""
    if any(given.get("contact", key) for key in CONTACT):
        raise InputError(
            "--E-star, --pressure and --hardness must be given with --one-surface: they ask for its waves."
        )


def one_surface(
    read: Sequence[tuple[str, Surface | Profile]],
    given: Given,
    paths: Mapping[str, Path],
    *,
    full: bool,
    as_json: bool,
    force: bool,
) -> None:
    """Print one spectrum of all maps and line scans ``read``, with the names of their files, and
    the scale-dependent parameters, and save its picture in the folder ``plots`` of the
    ``paths``."""
    if full or "plot" in paths or "report" in paths:
        raise InputError("--full, --plot and --report must be left out with --one-surface: use --plots or --json.")
    radius, plots = tip_radius(given), paths.get("plots")
    known: dict[str, Any] = {} if radius is None else {"tip_radius": radius}
    names = short_names([Path(file) for file, _ in read])
    scans = Scans(Scan.of(surface, name=name, **known) for (_, surface), name in zip(read, names, strict=True))
    found = scans.spectrum()
    curves = scans.scale_curves(found)
    waves = _deciding(found, given)
    advice = found.findings
    if waves is not None:
        longest = max(scan.length for scan in scans.scans)
        advice += waves.findings(longest, found.shortest_wavelength / POINTS_PER_WAVE)
    if as_json:
        console().out(json.dumps(_record(found, curves, waves, advice), indent=2), highlight=False)
    else:
        heading, rows = found.in_words()
        console().print(table(heading, rows[1:]))
        bands = [
            (name, show(band.longest, "m", 3), show(band.shortest, "m", 3), band.by, "yes" if band.usable else "no")
            for name, band in scans.limits().items()
        ]
        console().print(table("Reliable waves", bands, ("scan", "longest", "shortest", "limited by", "used")))
        console().print(table("Scale-dependent parameters", _scale_rows(curves), SCALES))
        if waves is not None:
            _print_waves(waves)
        print_advice(advice)
    if plots is not None:
        written = save_pictures(figures_by(SCANS_PLOTS, found), plots, overwrite=force)
        if not as_json:
            print_files(list(written))


def _deciding(found: ScansSpectrum, given: Given) -> DecidingWaves | None:
    """Waves that decide the contact that is asked for; None if none is."""
    texts = {key: given.get("contact", key) for key in CONTACT}
    if not any(texts.values()):
        return None
    for key in ("E_star", "pressure"):
        if texts[key] is None:
            raise InputError(f"{CONTACT[key][0]} must be given to tell which waves decide a contact, but is not.")
    values = {key: parse(text, CONTACT[key][1], CONTACT[key][0]) for key, text in texts.items() if text is not None}
    return deciding_waves_of(found, values["E_star"], values["pressure"], hardness=values.get("hardness", math.inf))


_SETTLED = {
    (True, True): "yes",
    (True, False): "no: the shortest wave decides",
    (False, True): "no: the longest wave decides",
    (False, False): "no: both ends decide",
}
"""Whether the waves of a spectrum settle an answer, by its long and its short end."""


def _print_waves(waves: DecidingWaves) -> None:
    """Print the share of every octave, and what scan each question needs."""
    names = list(waves.shares)
    octaves = [
        (show(float(long), "m", 3), *(percent(float(waves.shares[name][number]), 2) for name in names))
        for number, long in enumerate(waves.longest)
    ]
    labels = [name.replace("_", " ") for name in names]
    console().print(table("Share of each octave", octaves, ("waves below", *labels)))
    needs = [
        (
            label,
            show(need.size, "m", 3) if need.bounded else "no roll-off seen",
            show(need.interval, "m", 3),
            _SETTLED[need.bounded, need.settled],
        )
        for label, need in zip(labels, (waves.needs[name] for name in names), strict=True)
    ]
    console().print(table("Scans that suffice", needs, ("question", "size", "interval", "settled")))


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


def _record(
    found: ScansSpectrum, curves: dict[str, ScaleCurve], waves: DecidingWaves | None, advice: Sequence[Advice]
) -> dict[str, Any]:
    """Spectrum and parameters in SI units."""
    m0, m2, m4 = found.moments()
    table: dict[str, Any] = {
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
        "findings": [item.message for item in advice],
    }
    if waves is not None:
        table["waves"] = waves.longest
        table["shares"] = dict(waves.shares)
        table["needs"] = {name: asdict(need) for name, need in waves.needs.items()}
        table["leak_wavelength"] = waves.leak_wavelength
    for name, curve in curves.items():
        table |= {f"{name}_length": curve.length, name: curve.value, f"{name}_error": curve.error}
    return {key: _plain(value) for key, value in table.items()}


def _plain(value: Any) -> Any:
    """Lists for arrays, and None for what is not a finite number."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return [_plain(item) for item in value.tolist()]
    return None if isinstance(value, float) and not math.isfinite(value) else value
