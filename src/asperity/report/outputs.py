"""Results and their certificate in words for a table."""

from __future__ import annotations

import math

from ..contact.result import SCALARS, ContactResult
from ..core.quantity import Quantity
from ..core.units import percent, show
from ..io.labels import CERTIFICATE
from .inputs import Rows

MEANINGS = {
    "duality_gap": "The total energy of this answer differs from the exact one on this grid by at most this fraction.",
    "field_error": "How far pressure and gap are from excluding each other, relative to load and rms height.",
    "penetration": "The deepest point at which the bodies still overlap, as a fraction of the rms height.",
    "load_imbalance": "How far the load reached is from the load asked for; zero where a position was asked for.",
    "tolerance": "The relative error at which the solver was told to stop.",
    "iterations": "Steps of the solver.",
    "fft_pairs": "Work in forward and backward transforms, the unit of cost.",
    "wall_time": "From the prepared problem to the solution.",
    "peak_memory": "The largest memory the program has held so far, everything included.",
    "solver": "The numerical method.",
}
"""What each entry of a certificate says, in plain words."""

HEADLINE = {
    "area_fraction_corrected": "real contact area",
    "mean_pressure": "mean pressure",
    "max_pressure": "maximum pressure",
    "mean_gap": "mean gap",
    "approach": "approach",
    "n_spots": "contact spots",
}
"""Scalars at the top of a report, with short labels."""


def value_text(quantity: Quantity, value: float | int | str) -> str:
    """Text of ``value`` with the unit of ``quantity``; whole numbers in full, shares also in percent."""
    if isinstance(value, str | int):
        return str(value)
    if math.isnan(value):
        return "not computed"
    text = show(value, quantity.unit)
    if quantity.name.endswith(("fraction", "fraction_corrected")):
        return f"{text} ({percent(value)})"
    return text


def result_rows(result: ContactResult) -> Rows:
    """Every scalar of ``result``."""
    return [(q.label, value_text(q, getattr(result, q.name))) for q in SCALARS]


def headline_rows(result: ContactResult) -> Rows:
    """The scalars that people look for first; the real contact area in percent of the nominal area."""
    chosen = {q.name: value_text(q, getattr(result, q.name)) for q in SCALARS}
    chosen["area_fraction_corrected"] = percent(result.area_fraction_corrected)
    return [(label, chosen[name]) for name, label in HEADLINE.items()]


def certificate_rows(result: ContactResult) -> list[tuple[str, str, str]]:
    """Label, value and meaning of every entry of the certificate."""
    return [(q.label, value_text(q, getattr(result.certificate, q.name)), MEANINGS[q.name]) for q in CERTIFICATE]


def summary(result: ContactResult) -> str:
    """One sentence on the state of the contact."""
    share = f"{percent(result.area_fraction_corrected)} of the nominal area"
    dents = f" {percent(float(result.indented.mean()))} of the nominal area is indented for good."
    dents = dents if result.indented.any() else ""
    if not result.contact.any():
        return "The bodies do not touch." + dents
    if result.is_plastic:
        plastic = f"{percent(result.plastic_area_fraction)} of the real contact area is at the hardness"
        return f"The bodies touch on {share}. The contact is plastic: {plastic}."
    return f"The bodies touch on {share}. The contact is elastic.{dents}"
