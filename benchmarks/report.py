"""Tables on the screen and files to keep."""

from __future__ import annotations

import csv
import datetime
import json
import os
import platform
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from measure import Row

HEADER = (
    f"{'n':>5} {'load':>5} {'solver':<17} {'thr':>3} {'runs':>4} {'median/s':>9} {'min–max/s':>17} "
    f"{'cpu/s':>7} {'pairs':>6} {'cost':>5} {'× ours':>7} {'pixels':>8} {'error':>8} {'L2 to ours':>10}"
)


def line(row: Row) -> str:
    """One row of the table."""
    spread = f"{min(row.seconds):.3f}–{max(row.seconds):.3f}" if row.seconds else ""
    text = (
        f"{row.n:>5} {row.load:>5} {row.solver:<17} {row.threads:>3} {len(row.seconds):>4} {row.median:>9.3f} "
        f"{spread:>17} {_number(row.counts.get('cpu_seconds'), 7, 2)} {_number(row.counts.get('pairs'), 6, 0)} "
        f"{_number(row.cost, 5, 2)} {row.ratio_to_ours:>7.1f} {row.pixels:>8} {row.field_error:>8.1e} "
        f"{row.distance:>10.1e}"
    )
    return f"{text}  {row.fault}" if row.fault else text


COLUMNS = (
    "n",
    "load",
    "solver",
    "runs",
    "median (s)",
    "min–max (s)",
    "processor (s)",
    "pairs",
    "in pairs",
    "cost",
    "× ours",
    "error",
    "L2 to ours",
)
"""Of the table in README.md: *in pairs* is the median over the time of a bare pair, *cost* the time
in the solver over that of its pairs."""


def cells(row: Row) -> list[str]:
    """The same as text; empty where there is no number."""
    spread = f"{min(row.seconds):.3f}–{max(row.seconds):.3f}" if row.seconds else ""
    distance = _short(row.distance, ".1e") if row.distance else ""
    return [
        str(row.n),
        str(row.load),
        row.solver,
        str(len(row.seconds)),
        _short(row.median, ".3f"),
        spread,
        _short(row.counts.get("cpu_seconds"), ".3f"),
        _short(row.counts.get("pairs"), ".0f"),
        _short(row.median / row.pair_seconds, ".0f"),
        _short(row.cost, ".2f"),
        _short(row.ratio_to_ours, ".1f"),
        _short(row.field_error, ".1e"),
        distance,
    ]


def _short(value: float | None, form: str) -> str:
    return "" if value is None or np.isnan(value) else format(value, form)


def _number(value: float | None, width: int, digits: int) -> str:
    return " " * width if value is None or np.isnan(value) else f"{value:>{width}.{digits}f}"


def machine() -> dict[str, Any]:
    """Where and when, in words that do not name the computer."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "processor": platform.machine(),
        "usable_cores": usable,
        "load_at_start": round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None,
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def flat(row: Row) -> dict[str, Any]:
    """Row as one record of plain values."""
    record = asdict(row)
    record.update({f"count_{key}": value for key, value in record.pop("counts").items()})
    times = record.pop("seconds")
    spread = {"median_s": row.median, "min_s": min(times, default=None), "max_s": max(times, default=None)}
    return record | spread | {"runs": len(times), "cost": row.cost, "area_fraction": row.pixels / row.n**2}


def write(folder: Path, rows: list[Row], about: dict[str, Any]) -> None:
    """``bench.json`` with everything and ``bench.csv`` with one line a row."""
    folder.mkdir(parents=True, exist_ok=True)
    everything = {"about": about, "rows": [flat(row) | {"seconds": row.seconds} for row in rows]}
    (folder / "bench.json").write_text(json.dumps(everything, indent=1), encoding="utf-8")
    records = [flat(row) for row in rows]
    columns = list(dict.fromkeys(key for record in records for key in record))
    with (folder / "bench.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns)
        writer.writeheader()
        writer.writerows(records)
