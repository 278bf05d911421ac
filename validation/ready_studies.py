"""The ready studies of examples/campaigns on several surfaces: the pages that compare them with
what is published."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from asperity.studies.campaign import prepare_study
from asperity.studies.executors import Task, call
from asperity.studies.run import carry_out

if TYPE_CHECKING:
    import xarray

FOLDER = Path(__file__).parents[1] / "examples" / "campaigns"
PIXEL = 10e-6 / 128
"""Side of a pixel in the ready studies, m: that of Peng (2001)."""


def ready(name: str, *, points: int, seeds: int) -> dict[str, Any]:
    """Content of the study ``name`` on ``points`` a side at the same pixel, for the surfaces of the
    seeds 1, 2, …"""
    table = tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    surface = table["problem"]["surface"]
    surface["points"], surface["size"] = [points, points], f"{points * PIXEL!r} m"
    seen = {"name": "surface", "path": "surface.seed", "values": list(range(1, seeds + 1))}
    return {**table, "axes": [seen, *table["axes"]]}


def without(table: Mapping[str, Any], key: str) -> dict[str, Any]:
    """``table`` without the table ``key`` of its problem; quantities of menisci go with the
    film."""
    problem = {name: value for name, value in table["problem"].items() if name != key}
    kept = [
        name for name in table["quantities"] if key != "film" or name not in ("relative_meniscus_force", "feedback")
    ]
    return {**table, "problem": problem, "quantities": kept}


def axis(table: Mapping[str, Any], name: str) -> dict[str, Any]:
    """The axis ``name`` of ``table``, to be changed."""
    found: dict[str, Any] = next(item for item in table["axes"] if item["name"] == name)
    return found


class _Here:
    """Executor that does everything in this process."""

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any]]:
        for task in tasks:
            yield task, call(function, task)


def results(table: Mapping[str, Any]) -> xarray.Dataset:
    """Results of the study ``table``, by the names of its axes."""
    with TemporaryDirectory() as folder:
        campaign = prepare_study(table, Path(folder) / "study")
        carry_out(campaign.plan, campaign.records, _Here())
        return campaign.dataset().load()
