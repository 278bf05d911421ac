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
from ..core.units import parse
from ..core.values import Flag
from ..plots.together import save_pictures
from ..report.scans import ScansInWords, write_page_of_scans
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..surfaces.profile import Profile
from ..surfaces.scans import Scan, Scans
from ..surfaces.surface import Surface
from ..theories.rough.deciding_waves import DecidingWaves
from .declared import Given, Option
from .info_line import tip_radius
from .options import own_option
from .show import console, print_advice, print_files, short_names, table

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
    the scale-dependent parameters, and write the pictures in the folder ``plots`` and the page
    ``report`` of the ``paths``."""
    if full or "plot" in paths:
        raise InputError("--full and --plot must be left out with --one-surface: use --plots, --report or --json.")
    radius, plots, report = tip_radius(given), paths.get("plots"), paths.get("report")
    known: dict[str, Any] = {} if radius is None else {"tip_radius": radius}
    names = short_names([Path(file) for file, _ in read])
    scans = Scans(Scan.of(surface, name=name, **known) for (_, surface), name in zip(read, names, strict=True))
    found = scans.spectrum()
    told = ScansInWords(scans, found, _deciding(found, given))
    if as_json:
        console().out(json.dumps(_record(told), indent=2), highlight=False)
    else:
        console().print(table(found.in_words()[0], told.main_rows()))
        for heading, rows in told.tables():
            console().print(table(heading, rows.cells, rows.headings))
        print_advice(told.findings)
    figures = told.figures() if plots or report else ()
    written = [] if plots is None else list(save_pictures(figures, plots, overwrite=force))
    if report is not None:
        write_page_of_scans(told, report, figures=figures, overwrite=force)
        written.append(report)
    if written and not as_json:
        print_files(written)


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


def _record(told: ScansInWords) -> dict[str, Any]:
    """Spectrum and parameters in SI units."""
    found, waves = told.spectrum, told.waves
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
        "findings": [item.message for item in told.findings],
    }
    if waves is not None:
        table["waves"] = waves.longest
        table["shares"] = {name: _plain(share) for name, share in waves.shares.items()}
        table["needs"] = {name: asdict(need) for name, need in waves.needs.items()}
        table["leak_wavelength"] = waves.leak_wavelength
    for name, curve in told.curves.items():
        table |= {f"{name}_length": curve.length, name: curve.value, f"{name}_error": curve.error}
    return {key: _plain(value) for key, value in table.items()}


def _plain(value: Any) -> Any:
    """Lists for arrays, and None for what is not a number."""
    if hasattr(value, "tolist"):
        return [_plain(item) for item in value.tolist()]
    return None if isinstance(value, float) and not math.isfinite(value) else value
