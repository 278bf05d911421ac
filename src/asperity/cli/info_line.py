"""The command ``info`` on a file with a line scan."""

from __future__ import annotations

import json
import math
from pathlib import Path

from ..core.errors import InputError
from ..core.units import parse
from ..io.atomic import require_new_file
from ..plots.picture import render
from ..plots.profile import PROFILE_PLOTS, profile_figures
from ..plots.together import save_pictures
from ..report.profile import profile_facts, profile_headline, profile_rows, write_profile_report
from ..surfaces.profile import Profile
from ..surfaces.profile_summary import ProfileCharacterisation, characterise_profile
from .declared import Given
from .main import OK
from .show import console, print_files, say, table


def tip_radius(given: Given) -> float | None:
    """Radius of the tip in m, if it is given."""
    tip = given.get("tip_radius")
    return None if tip is None else parse(tip, "length", "--tip-radius")


def require_no_cutoffs(file: Path, given: Given) -> None:
    """Refuse the cut-offs of line scans for the map in ``file``."""
    for key in ("lambda_c", "lambda_s"):
        if given.get(key) is not None:
            name = f"--{key.replace('_', '-')}"
            raise InputError(f"{name} must be left out for the map in {file}: it is of line scans.", subject=name)


def info_line(file: Path, scan: Profile, given: Given, level: str, shown_as: str, *, force: bool) -> int:
    """Print what the line ``scan`` in ``file`` is and how rough, and write its report and pictures
    where they are asked for.

    ``shown_as`` short, full or json. Returns the exit code.
    """
    lengths = {
        key: None
        if given.get(f"lambda_{key}") is None
        else parse(given.get(f"lambda_{key}"), "length", f"--lambda-{key}")
        for key in "cs"
    }
    radius = tip_radius(given)
    if radius is not None:
        scan = scan.of_instrument(tip_radius=radius)
    form: str | int | None = None if level == "auto" else int(level) if level.isdecimal() and len(level) < 10 else level
    found = characterise_profile(scan, long=lengths["c"], short=lengths["s"], form="line" if form == "plane" else form)
    paths = {name: Path(path) for name, path in given.under("output").table().items()}
    if shown_as == "json":
        console().out(json.dumps(_record(file, found), indent=2), highlight=False)
    else:
        console().print(table(str(file), profile_facts(found)))
        if shown_as == "full":
            for heading, rows in profile_rows(found):
                console().print(table(heading, [(name, text) for name, text, _ in rows]))
        else:
            console().print(table("Roughness", profile_headline(found)))
        for remark in found.remarks:
            say(remark, "yellow")
        for finding in scan.origin.findings:
            say(f"{finding.level}: {finding.message}", "yellow" if finding.level == "warning" else "dim")
    written: list[Path] = []
    if "plot" in paths:
        require_new_file(paths["plot"], overwrite=force)
        paths["plot"].write_bytes(render(PROFILE_PLOTS[0], found))
        written.append(paths["plot"])
    figures = profile_figures(found) if {"plots", "report"} & {*paths} else ()
    if "plots" in paths:
        written += save_pictures(figures, paths["plots"], overwrite=force)
    if "report" in paths:
        write_profile_report(found, paths["report"], figures=figures, overwrite=force)
        written.append(paths["report"])
    if written and shown_as != "json":
        print_files(written)
    return OK


def _record(file: Path, found: ProfileCharacterisation) -> dict[str, object]:
    """What is printed as JSON: values in SI, None for what is not defined."""
    values = {q.symbol: value for parameters in found.parameters.values() for q, value in parameters.values()}
    sections = {} if found.sections is None else {q.symbol: value for q, value in found.sections.values()}
    more = {q.name: value for q, value in found.more()}
    profile, parts = found.profile, found.parts
    return {
        "file": str(file),
        "points": profile.n_points,
        "length": profile.length,
        "spacing": profile.spacing,
        "missing": profile.n_missing,
        "lambda_c": None if parts is None else parts.long,
        "lambda_s": None if parts is None or not parts.short else parts.short,
        "sections": 0 if parts is None else parts.sections,
        "ISO 21920-2": _plain(values),
        "ISO 4287": _plain(sections),
        "more": _plain(more),
        "assumption": None if found.converted is None else found.converted.assumption,
        "remarks": list(found.remarks),
        "read": profile.origin.history[0] if profile.origin.history else "",
        "findings": [item.message for item in profile.origin.findings],
        "instrument": dict(profile.origin.instrument),
    }


def _plain(values: dict[str, float]) -> dict[str, float | None]:
    return {key: None if math.isnan(value) else value for key, value in values.items()}
