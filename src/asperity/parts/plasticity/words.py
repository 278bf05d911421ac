"""Plastic deformation in words."""

from __future__ import annotations

from ...contact.plastic_load import PlasticLoad
from ...contact.result import PLASTIC_FRACTION, ContactResult
from ...core.units import percent, show
from ..part import Rows


def plastic_rows(result: ContactResult) -> Rows:
    """What has yielded in ``result``, and the energies."""
    share = result.indented_area / result.problem.grid.area
    limit = percent(PLASTIC_FRACTION)
    verdict = f"plastic: more than {limit}" if result.is_plastic else f"elastic: at most {limit}"
    return [
        ("plastic area under this load / real area", f"{percent(result.plastic_area_fraction)} ({verdict})"),
        ("area ever plastic", f"{show(result.indented_area, 'm**2')} ({percent(share)} of the nominal area)"),
        ("volume of the permanent indentation", show(result.plastic_volume, "m**3")),
        ("deepest permanent indentation", show(result.max_permanent_indentation, "m")),
        ("plastic work since the virgin surface", show(result.total_plastic_work, "J")),
        ("elastic energy under this load", show(result.elastic_energy, "J")),
    ]


def plastic_load_row(found: PlasticLoad) -> tuple[str, str]:
    """Label and text of the load at which a share of the real area is plastic."""
    load, force = show(found.mean_pressure, "Pa"), show(found.force, "N")
    share = percent(found.fraction)
    pixels = int(found.below.contact.sum())
    return (
        f"first load at which {share} of the real area is plastic",
        f"mean pressure {load}, force {force}, at {percent(found.below.area_fraction)} area ({pixels} pixels)",
    )
