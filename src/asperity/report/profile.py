"""A self-contained HTML page on one line scan."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from ..core.arrays import array_digest
from ..core.quantity import Quantity
from ..core.units import percent, show
from ..io.description import software
from ..plots.picture import Figure
from ..plots.profile import profile_figures
from ..surfaces.profile_parameters import NAMES
from ..surfaces.profile_summary import ProfileCharacterisation
from .page import shown, software_rows, write_page

HEADLINE = ("q", "a", "z", "t", "sk", "ku", "dq", "Sm")
"""Parameters that people look for first, without their letter."""

_SHARES = ("mrk1", "mrk2", "Mr1", "Mr2", "dr")


def parameter_text(quantity: Quantity, value: float, digits: int = 4) -> str:
    """Text of ``value`` with its unit; ratios of the material in per cent."""
    if quantity.symbol.endswith(_SHARES):
        return percent(value, digits)
    return f"{value:.0f}" if quantity.label == "number of elements" else show(value, quantity.unit, digits)


def profile_rows(found: ProfileCharacterisation) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """Heading of each group with the name, the text and the definition of its numbers; what is not
    defined is left out."""
    groups = [
        (f"{NAMES[letter].capitalize()} (ISO 21920-2)", parameters.values())
        for letter, parameters in found.parameters.items()
    ]
    if found.sections is not None:
        groups.append(("Sampling lengths (ISO 4287, 13565-2)", found.sections.values()))
    groups.append(("Moments, peaks and the isotropic surface", found.more()))
    return [(heading, list(_rows(values))) for heading, values in groups]


def _rows(values: Iterator[tuple[Quantity, float]]) -> Iterator[tuple[str, str, str]]:
    for quantity, value in values:
        if not math.isnan(value):
            name = f"{quantity.label} {quantity.symbol}".rstrip()
            yield name, parameter_text(quantity, value), quantity.description


def profile_headline(found: ProfileCharacterisation) -> list[tuple[str, str]]:
    """Name and text of the parameters that people look for first."""
    by_name = {quantity.symbol[1:]: (quantity, value) for quantity, value in found.main.values()}
    chosen = (by_name[name] for name in HEADLINE)
    return [
        (f"{q.label} {q.symbol}", "–" if math.isnan(value) else parameter_text(q, value, digits=3))
        for q, value in chosen
    ]


def profile_facts(found: ProfileCharacterisation) -> list[tuple[str, str]]:
    """What the line scan is, how it was separated and what was done to it."""
    profile, parts = found.profile, found.parts
    rows = profile.in_words()[1]
    if parts is not None:
        rows += [
            ("cut-offs λc, λs", f"{show(parts.long, 'm')}, {show(parts.short, 'm') if parts.short else 'none'}"),
            ("filter", parts.kind),
            (
                "evaluation length",
                f"{show(parts.evaluation_length, 'm')}, {parts.sections} section{'s' * (parts.sections != 1)}",
            ),
        ]
    if found.converted is not None:
        rows.append(("assumption of the isotropic surface", found.converted.assumption))
    rows += [(f"step {number}", step) for number, step in enumerate(profile.origin.history, start=1)]
    return [*rows, *((str(key), str(value)) for key, value in profile.origin.instrument.items())]


def profile_summary(found: ProfileCharacterisation) -> str:
    """Some sentences on the line scan: how rough, over which length, how its spectrum falls."""
    main, length = found.main, found.profile.length
    sentences = [
        f"{main.letter}a {show(main.a, 'm', 3)}, {main.letter}z {show(main.z, 'm', 3)} on {show(length, 'm', 3)}."
    ]
    if found.parts is not None:
        count = found.parts.sections
        sentences.append(f"Roughness by {count} section{'s' * (count != 1)} of λc {show(found.parts.long, 'm', 3)}.")
    if found.converted is not None:
        sentences.append(f"Its spectrum has the Hurst exponent {found.converted.hurst:.2f}.")
    return " ".join(sentences)


def write_profile_report(
    found: ProfileCharacterisation,
    path: str | Path,
    *,
    figures: Sequence[Figure] | None = None,
    title: str = "",
    overwrite: bool = False,
) -> None:
    """Write a page on a characterised line scan to the HTML file ``path``; it needs no network and
    no other file.

    ``found`` is that of ``characterise_profile``, with its ``figures`` if they are drawn already;
    the ``title`` is made from the source of the scan if empty.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    source = found.profile.origin.source
    write_page(
        path,
        "roughness.html",
        title=title or (f"Line scan: {source}" if source else "Line scan"),
        summary=profile_summary(found),
        headline=profile_headline(found),
        remarks=found.remarks,
        figures=shown(profile_figures(found) if figures is None else figures),
        groups=profile_rows(found),
        summits=[],
        peaks=[],
        facts_rows=profile_facts(found),
        provenance=software_rows(software(), heights=array_digest(found.profile.heights)),
        citation_keys=found.citation_keys,
        overwrite=overwrite,
    )
