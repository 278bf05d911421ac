"""Surfaces beside two other packages, SurfaceTopography and surfalize: 37 kinds of files, six
scans, and the parameters of profiles and maps, each deviation with its cause.

``python validation/surface_packages.py`` computes the numbers of those packages that are installed,
keeps those recorded in ``surface_packages.json`` of the others, and writes the page.
"""

from __future__ import annotations

import json
import math
import tempfile
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import package_files
import package_numbers
import small_files
from package_numbers import Number, Numbers
from page import Claim, Page, Table, write_page

RECORD = Path(__file__).with_suffix(".json")
PACKAGES = ("SurfaceTopography", "surfalize")
EQUAL = 1e-9
"""Relative deviation up to which numbers are equal: their rounding."""

ABOUT = (
    "Two other packages read instrument files and compute parameters of roughness: SurfaceTopography (Röttger et "
    "al. 2022), with whose readers asperity opens instrument files, and surfalize, with classes of surfaces and "
    "profiles. Here the same heights go through all three. Where a number deviates by more than rounding, the rule of "
    "the other package is written again in `package_rules.py` and applied to our heights: if that gives its number to "
    "1e-9, the cause that is stated is the whole cause."
)

FILES = (
    "Each small file holds the same map of 12 × 8 points without any symmetry, made by `small_files.py` from the "
    'description of its format. "Equal": heights and pixel are those of the map to 2e-6, y upwards where a picture '
    "has its top row first."
)

REASONS = {
    ("SurfaceTopography", "NanoFocus"): "takes the spacing, in nm, for mm; mended here",
    (
        "SurfaceTopography",
        "Asylum",
    ): "reads its first channel if none is named, a phase, which the file says is in m; here the "
    "first of heights by name",
    (
        "SurfaceTopography",
        "NT-MDT",
    ): "reads its first frame if none is named, the deflection DFL; here the first of heights by name",
    ("SurfaceTopography", "points x y z"): "puts the least y first, where its readers of pictures put the top row",
    ("surfalize", "Sensofar"): "takes the points per line and column, before each layer, for the first two heights, so "
    "that the map is shifted by two points",
    ("surfalize", "NanoFocus"): "adds the highest height of the range instead of the lowest",
    ("surfalize", "TrueMap"): "takes all lengths, in mm, for µm",
    ("surfalize", "points x y z"): "divides the extent by the number of points instead of the steps between them",
    ("surfalize", "zip archive of a simple field"): "takes any zip archive for .x3p",
}
_ARRAY = "has the same array: its second index counts from the top, ours upwards"
REASONS |= {("SurfaceTopography", name): _ARRAY for name in ("NumPy", "NumPy, archive", "Matlab", "HDF5")}

CAUSES = {
    "new mean": "surfalize subtracts the mean of the evaluation length (of each section for ISO 4287) again. After the "
    "filter that mean is not zero, and heights count from the mean line of the filter. On P and W, whose mean is zero, "
    "nothing deviates.",
    "classes": "surfalize takes the material ratio curve at 10 000 classes from 0 % at the highest point to 100 % at "
    "the lowest, and areas up to the nearest class. Ours has the ratio (k − ½)/N at the k-th point, and exact areas.",
    "points": "surfalize interpolates between classes. Ours is the share of the points at or above the height.",
    "slopes": "surfalize takes forward differences. Ours is the formula of seven points.",
    "rays": "surfalize sends rays to all pixels beside the region of correlation above 0.2 and interpolates by cubic "
    "splines in steps of a thousandth. Ours sends one ray a degree and interpolates linearly.",
    "kernel": "surfalize's Gaussian is cut at four standard deviations (0.75 cut-offs) and mirrors the ends. Ours "
    "reaches to the cut-off and divides by the weights that are there.",
    "nodes": "SurfaceTopography takes the nodes that have differences in both directions. Ours takes all pairs of each "
    "direction.",
    "polygon": "SurfaceTopography takes the share of the polygon through the points. Ours is the share of the points.",
}
"""Causes of deviations, by the word that stands for each in the tables."""


def cause(package: str, name: str) -> str:
    """Why a parameter of a ``package`` deviates, a key of ``CAUSES``."""
    if package == "SurfaceTopography":
        return "polygon" if name == "bearing length" else "nodes"
    if name == "R profile":
        return "kernel"
    if name in ("Sal", "Str"):
        return "rays"
    if name == "Rmr(Rq/2)":
        return "points"
    if name.endswith("dq"):
        return "slopes"
    tail = name.removesuffix(" (ISO 4287)")[1:]
    return "new mean" if name[0] in "RPW" and tail in ("a", "q", "sk", "ku", "p", "v") else "classes"


# Ours, and what is recorded of theirs.


def inputs() -> Iterator[tuple[str, str, Numbers]]:
    """Package, input and our numbers for every input in the repository."""
    for name, parts in package_numbers.traces().items():
        for letter, part, sections in (
            ("R", parts.roughness, parts.sections),
            ("P", parts.primary, 1),
            ("W", parts.waviness, 1),
        ):
            yield "surfalize", f"{name} {letter}", package_numbers.profile_numbers(part, letter, sections)
        yield "surfalize", f"{name} filter", package_numbers.filter_numbers(name)
    surface = package_numbers.made_map()
    yield "surfalize", "map", package_numbers.map_numbers(surface)
    yield "SurfaceTopography", "map", package_numbers.statistics_numbers(surface)


def theirs(package: str) -> dict[str, dict[str, float]]:
    """Numbers of an installed ``package`` for the same inputs."""
    surface = package_numbers.made_map()
    if package == "SurfaceTopography":
        return {"map": package_numbers.surface_topography(surface)}
    found = {"map": package_numbers.surfalize_map(surface)}
    for name, parts in package_numbers.traces().items():
        for letter, part, sections in (
            ("R", parts.roughness, parts.sections),
            ("P", parts.primary, 1),
            ("W", parts.waviness, 1),
        ):
            found[f"{name} {letter}"] = package_numbers.surfalize_profile(part, letter, sections)
        found[f"{name} filter"] = package_numbers.surfalize_filter(name)
    return found


def _scan(path: Path, record: dict[str, Any]) -> None:
    """Record a measured file and its parameters, ours and those of the packages that are
    installed."""
    part = package_numbers.scan(path)
    known = record["scans"].setdefault(path.name, {})
    known.update(package_files.of_scan(path))
    for package, own, others in (
        ("surfalize", package_numbers.map_numbers, package_numbers.surfalize_map),
        ("SurfaceTopography", package_numbers.statistics_numbers, package_numbers.surface_topography),
    ):
        if package in record["versions"] and _installed(package):
            own_, others_ = own(part), others(part)
            known.setdefault("numbers", {})[package] = {
                name: [number.ours, number.rule, others_[name]] for name, number in own_.items()
            }


def _installed(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def refreshed(record: dict[str, Any]) -> dict[str, Any]:
    """The ``record`` with the numbers of the packages and of the scans that are there; says what is
    not."""
    for package in PACKAGES:
        found = _installed(package)
        if not found:
            print(f"{package} is not installed: its numbers stay as recorded")
            continue
        record["versions"][package] = found
        record["numbers"][package] = theirs(package)
        with tempfile.TemporaryDirectory() as folder:
            record["files"][package] = package_files.outcomes(package, Path(folder))
    if not package_numbers.SCANS.is_dir():
        print(f"the scans are not at {package_numbers.SCANS}: their numbers stay as recorded")
        return record
    for path in sorted(package_numbers.SCANS.iterdir()):
        if path.suffix != ".md":
            _scan(path, record)
    return record


def recorded() -> dict[str, Any]:
    """What is recorded of the other packages and of the scans."""
    if not RECORD.exists():
        return {"versions": {}, "numbers": {}, "files": {}, "scans": {}}
    found: dict[str, Any] = json.loads(RECORD.read_text(encoding="utf-8"))
    return found


# The page.


def deviation(ours: float, other: float) -> float:
    """Relative to the other; absolute where one of them is zero; none where neither is defined."""
    if math.isnan(ours) and math.isnan(other):
        return 0.0
    scale = abs(other) if ours else 1.0
    found = abs(ours - other) / scale if scale else abs(ours)
    return math.inf if math.isnan(found) else found


Compared = dict[tuple[str, str], list[tuple[str, Number, float]]]
"""By package and parameter: input, our number and theirs."""


def compared(record: dict[str, Any]) -> Compared:
    """Every number of the inputs in the repository and of the recorded scans."""
    found: Compared = {}
    for package, name, numbers in inputs():
        for parameter, number in numbers.items():
            other = record["numbers"][package][name][parameter]
            found.setdefault((package, parameter), []).append((name, number, other))
    for name, known in record["scans"].items():
        for package, numbers in known["numbers"].items():
            for parameter, (own, rule, other) in numbers.items():
                found.setdefault((package, parameter), []).append((name, Number(own, rule), other))
    return found


def _least(number: Number, other: float) -> float:
    """Deviation with the rule of the other package, or without if that is ours."""
    plain = deviation(number.ours, other)
    return plain if number.rule is None else min(plain, abs(number.rule - other) / (abs(other) or 1.0))


def parameter_table(package: str, found: Compared) -> Table:
    """Largest deviations of the parameters of a ``package``."""
    rows = []
    for (of, parameter), cases in found.items():
        if of != package:
            continue
        plain = max(deviation(number.ours, other) for _, number, other in cases)
        ruled = max(_least(number, other) for _, number, other in cases)
        equal = plain <= EQUAL
        rows.append(
            (
                parameter,
                f"{len(cases)}",
                "–" if equal else f"{100.0 * plain:.2g} %",
                f"{ruled:.0e}",
                "equal" if equal else cause(package, parameter),
            )
        )
    head = ("parameter", "inputs", "largest deviation", "left with their rule", "cause")
    return Table(f"### {package}, parameters", head, tuple(rows))


def example_table(found: Compared) -> Table:
    """Numbers of one trace and of the map."""
    rows = [
        (parameter, case, f"{number.ours:.6g}", f"{other:.6g}", package)
        for (package, parameter), cases in found.items()
        for case, number, other in cases
        if case in ("ground R", "map")
    ]
    about = "### Numbers of one trace and one map\n\nLengths in m, ratios and Sdr in %."
    return Table(about, ("parameter", "input", "asperity", "other package", "which"), tuple(rows))


def file_table(record: dict[str, Any], errors: dict[str, float]) -> Table:
    """What the packages make of each kind of file."""
    rows = []
    for kind in small_files.KINDS:
        words = [package_files.in_words(record["files"][package][kind.name]) for package in PACKAGES]
        reasons = [
            f"{package} {REASONS[package, kind.name]}" for package in PACKAGES if (package, kind.name) in REASONS
        ]
        rows.append((kind.name, f".{kind.ending}", f"{errors[kind.name]:.0e}", *words, "; ".join(reasons)))
    head = ("kind", "ending", "asperity: error", *PACKAGES, "reason")
    return Table("## Files\n\n" + FILES, head, tuple(rows))


def scan_table(record: dict[str, Any]) -> Table:
    """The measured files."""
    rows = []
    for name, known in record["scans"].items():
        cells = [one if isinstance(one := known.get(package), str) else _share(one) for package in PACKAGES]
        size = " × ".join(f"{1e6 * side:.4g}" for side in known["size"])
        rows.append((name, " × ".join(map(str, known["shape"])), size, f"{known['missing']}", *cells))
    about = (
        "Six measured files, which are not part of the repository; largest difference of the heights of the other "
        "package over ours from peak to valley, or of the pixel. Surfalize has no readers of scanning probe "
        "microscopes, and its reader of .opd knows no blocks of type 15."
    )
    return Table(about, ("file", "points", "sides (µm)", "missing", *PACKAGES), tuple(rows))


def _share(value: float | None) -> str:
    return "not recorded" if value is None else "equal" if value <= package_files.ALIKE else f"{value:.1e}"


def claims(record: dict[str, Any], found: Compared, errors: dict[str, float]) -> tuple[Claim, ...]:
    """What must hold."""
    digits = {kind.name: max(kind.digits, 1e-9) for kind in small_files.KINDS}
    wrong = sum(error > digits[name] for name, error in errors.items())
    words = {
        (package, name): package_files.in_words(one)
        for package in PACKAGES
        for name, one in record["files"][package].items()
    }
    unexplained = [key for key, text in words.items() if text not in ("equal", "no reader") and key not in REASONS]
    same = ("equal", "turned over in y")
    alike = [key for key, text in words.items() if key[0] == "SurfaceTopography" and text in same]
    left = max(_least(number, other) for cases in found.values() for _, number, other in cases)
    scans = [known.get("SurfaceTopography", math.inf) for known in record["scans"].values()]
    return (
        Claim("kinds of files that asperity reads wrongly", float(wrong), 0.0, 0.0),
        Claim("kinds of files in all", float(len(errors)), 20.0),
        Claim(
            "kinds of files of which SurfaceTopography has the same heights, but for the direction of y",
            float(len(alike)),
            20.0,
        ),
        Claim("outcomes of other packages that differ without a reason", float(len(unexplained)), 0.0, 0.0),
        Claim("reasons that no file shows", float(sum(words[key] == "equal" for key in REASONS)), 0.0, 0.0),
        Claim("largest difference of the scans from SurfaceTopography", max(scans), 0.0, package_files.ALIKE),
        Claim("parameters", float(len(found)), 60.0),
        Claim("largest deviation of a parameter that its cause does not explain", left, 0.0, EQUAL),
    )


def page() -> Page:
    """The page from ours and what is recorded."""
    record = recorded()
    found = compared(record)
    with tempfile.TemporaryDirectory() as folder:
        errors = package_files.ours(Path(folder))
    versions = ", ".join(f"{package} {record['versions'][package]}" for package in PACKAGES)
    return Page(
        title="Surfaces beside two other packages",
        about=ABOUT,
        parts=(
            f"Compared with {versions}; where one is not installed its recorded numbers (`surface_packages.json`) are "
            "used, and likewise for the scans where they are not at hand.",
            file_table(record, errors),
            scan_table(record),
            "## Parameters\n\nInputs: four reference traces filtered to R, P and W profiles, a made map of 120 × 90 "
            f"points, and the first {package_numbers.POINTS} × {package_numbers.POINTS} points of each scan without "
            "their plane. A deviation of 230 % is one of a skewness near zero. R profile: the rms difference of the "
            "profiles that both filter from the raw trace, over Rq.",
            Table("Causes of the deviations:", ("cause", "what differs"), tuple(CAUSES.items())),
            parameter_table("surfalize", found),
            parameter_table("SurfaceTopography", found),
            example_table(found),
        ),
        claims=claims(record, found, errors),
    )


if __name__ == "__main__":
    RECORD.write_text(json.dumps(refreshed(recorded()), indent=1) + "\n", encoding="utf-8")
    write_page(page(), __file__)
