"""From plan and store to one labelled dataset; failed cases and findings grouped by cause."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.words import in_words
from ..io.description import software
from ..io.words import CERTIFICATE
from ..parts.registry import versions
from .axes import Coordinate
from .derived import derived_values
from .evaluate import CHECKS
from .plan import Plan, measures
from .run import stop_quantity, stopping
from .store import Record, records

if TYPE_CHECKING:
    import xarray


DONE, FAILED, MISSING = 0, 1, 2
"""Values of the variable ``outcome``."""

KEPT_CHECKS = ("duality_gap", "iterations", "wall_time")
"""Entries of the certificates in the dataset."""


def placed_records(plan: Plan, path: Path) -> Iterator[tuple[int, Record]]:
    """Number of each finished case of ``plan`` on the flattened axes, and its record in the store
    at ``path``.

    Of a case that was done again also the older records, first.
    """
    keys = np.fromiter((int(case.key[:16], 16) for item in plan.paths() for case in item), np.uint64)
    places = np.fromiter(
        (np.ravel_multi_index(case.index, plan.shape) for item in plan.paths() for case in item), np.int64
    )
    order = np.argsort(keys, kind="stable")
    keys, places = keys[order], places[order]
    for record in records(path):
        key = np.uint64(int(record["key"][:16], 16))
        low, high = np.searchsorted(keys, key, "left"), np.searchsorted(keys, key, "right")
        for place in places[low:high]:
            yield int(place), record


VERDICT = MappingProxyType(
    {
        "trust": "whether the case can be trusted: good, doubtful or not",
        "verdict_result": "what was found",
        "verdict_strength": "whether the bodies hold",
        "verdict_trust": "whether it can be trusted, and why",
    }
)
"""Texts of the verdict on each case."""


def dataset(plan: Plan, path: Path, *, study: str = "") -> xarray.Dataset:
    """Results of ``plan`` from the store at ``path``: quantities on the axes, units and labels, NaN
    where there are none.

    ``outcome`` is the status of each case, ``error`` the cause of its failure. Attributes: the text
    of the ``study``, software, citation keys. Samples beyond those that were enough are left out.
    """
    import xarray

    taken = [name for item in plan.derived for name in item.expression.names if name in measures()]
    taken += [name for name, _ in plan.limits if name in measures()]
    wanted = tuple(dict.fromkeys((*plan.document.quantities, *(q for q in [stop_quantity(plan)] if q), *taken)))
    values = {name: np.full(plan.n_cases, np.nan) for name in (*wanted, *KEPT_CHECKS)}
    outcome = np.full(plan.n_cases, MISSING, np.int8)
    errors, cited = dict[int, str](), dict[str, None]()
    given = {name: np.full(plan.n_cases, "", object) for name in VERDICT}
    for place, record in placed_records(plan, path):
        error = record["error"]
        outcome[place] = DONE if error is None else FAILED
        for name in wanted:
            values[name][place] = record["values"].get(name, np.nan)
        for name in KEPT_CHECKS:
            values[name][place] = record["work"].get(name, np.nan)
        errors.pop(place, None)
        if error is not None:
            errors[place] = f"{error['type']}: {error['message']}"
        for name, text in zip(VERDICT, record.get("verdict", ()), strict=False):
            given[name][place] = in_words(text)
        cited |= dict.fromkeys(record["citations"])
    dims = tuple(item.name for item in plan.axes)
    known = measures() | {item.name: item for item in CERTIFICATE if item.name in CHECKS}
    variables: dict[str, Any] = {
        name: (dims, array.reshape(plan.shape), known[name].attributes) for name, array in values.items()
    }
    if plan.derived:
        shaped = {name: array.reshape(plan.shape) for name, array in values.items()}
        found = derived_values(plan.derived, plan.scalars, shaped)
        variables |= {
            one.quantity.name: (dims, np.array(found[one.quantity.name]), one.quantity.attributes)
            for one in plan.derived
        }
    codes = {"flag_values": np.array([DONE, FAILED, MISSING], np.int8), "flag_meanings": "done failed missing"}
    labels: dict[str, Any] = {"long_name": "what became of the case", **codes}
    variables["outcome"] = (dims, outcome.reshape(plan.shape), labels)
    variables |= {
        name: (dims, texts.reshape(plan.shape), {"long_name": VERDICT[name]}) for name, texts in given.items()
    }
    if errors:
        texts = np.full(plan.n_cases, "", object)
        texts[list(errors)] = list(errors.values())
        variables["error"] = (dims, texts.reshape(plan.shape), {"long_name": "why the case failed"})
    attributes = {
        "title": plan.document.title,
        "kind": plan.document.kind,
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "software": json.dumps(software() | versions()),
        "citation_keys": " ".join(cited),
        "study": study,
    }
    made = xarray.Dataset(variables, _coordinates(plan), attributes)
    end = stopped_at(plan, path)
    return made if end is None else made.isel(sample=slice(end))


def _coordinates(plan: Plan) -> dict[str, Any]:
    """Points of the axes and their columns, with units and words."""
    coordinates: dict[str, Any] = {}
    for item in plan.axes:
        labels = {item.name: {"units": item.unit, "long_name": item.title or item.path or item.name}}
        columns: dict[str, list[Any]] = {item.name: [point.coordinate for point in item.points]}
        for name, unit in item.columns.items():
            labels[name] = {"units": unit} if unit else {}
            columns[name] = [point.columns[name] for point in item.points]
        for name, column in columns.items():
            numbers = all(isinstance(value, float) for value in column)
            array = np.array(column, float) if numbers else np.array([str(value) for value in column], object)
            coordinates[name] = (item.name, array, labels[name])
    return coordinates


def stopped_at(plan: Plan, path: Path) -> int | None:
    """Number of samples after which the rule of ``plan`` ended them; None if it has none or did
    not."""
    stop = stopping(plan)
    if stop is None:
        return None
    found: dict[int, float] = {}
    quantity = str(stop_quantity(plan))
    for place, record in placed_records(plan, path):
        found[place] = record["values"].get(quantity, np.nan)
    points = max(1, plan.n_cases // plan.shape[0])
    for place in sorted(found):
        stop.take(place // points, place % points, found[place])
    return stop.end


@dataclass(frozen=True)
class CampaignState:
    """How far a study is.

    Attributes
    ----------
    done, failed, missing
        Numbers of cases.
    samples
        Number of samples that were enough; None if not so far.
    causes
        Failed cases grouped by cause.
    findings
        Warnings and notes of the cases, counted by their criterion; each with its first case.
    """

    done: int
    failed: int
    missing: int
    samples: int | None = None
    causes: tuple[Cause, ...] = ()
    findings: tuple[Cause, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether nothing is left to be computed."""
        return self.missing == 0


def state(plan: Plan, path: Path) -> CampaignState:
    """How far ``plan`` is by the store at ``path``; of a case that was done again the last record
    counts."""
    outcome = np.full(plan.n_cases, MISSING, np.int8)
    errors: dict[int, dict[str, str]] = {}
    told: dict[int, dict[tuple[str, str], str]] = {}
    for place, record in placed_records(plan, path):
        outcome[place] = DONE if record["error"] is None else FAILED
        errors.pop(place, None)
        told.pop(place, None)
        if record["error"] is not None:
            errors[place] = record["error"]
        if record.get("findings"):
            told[place] = {}
            for level, criterion, text in record["findings"]:  # a case counts once
                told[place].setdefault((level, criterion), text)

    def at(place: int) -> dict[str, Coordinate]:
        return plan.coordinates(tuple(int(number) for number in np.unravel_index(place, plan.shape)))

    failed = [Failure(at(place), error["type"], error["message"]) for place, error in errors.items()]
    found = [
        Failure(at(place), f"{level} ({criterion})", in_words(text))
        for place, findings in told.items()
        for (level, criterion), text in findings.items()
    ]
    end = stopped_at(plan, path)
    counted = outcome if end is None else outcome[: end * (plan.n_cases // plan.shape[0])]
    done, failures, missing = (int(count) for count in np.bincount(counted, minlength=3))
    return CampaignState(done, failures, missing, end, causes(failed), causes(found, by_kind=True))


_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", re.IGNORECASE)


@dataclass(frozen=True)
class Failure:
    """One failed case: where it lies, and its exception."""

    at: Mapping[str, Coordinate]
    kind: str
    message: str


@dataclass(frozen=True)
class Cause:
    """Failures with the same exception and, but for numbers, the same message: ``count``, and the
    ``first`` of them."""

    kind: str
    count: int
    first: Failure


def causes(failures: Iterable[Failure], *, by_kind: bool = False) -> tuple[Cause, ...]:
    """Causes of ``failures``, the most frequent first; ``by_kind`` whatever their messages."""
    groups: dict[tuple[str, str], list[Failure]] = {}
    for failure in failures:
        text = "" if by_kind else _NUMBER.sub("#", failure.message)
        groups.setdefault((failure.kind, text), []).append(failure)
    found = [Cause(kind, len(group), group[0]) for (kind, _), group in groups.items()]
    return tuple(sorted(found, key=lambda cause: -cause.count))
