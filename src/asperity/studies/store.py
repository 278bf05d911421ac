"""Append-only store of finished cases: one line each, found again by content digest, whole even
after a kill."""

from __future__ import annotations

import importlib.util
import json
import math
import os
import re
import time
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import TracebackType
from typing import IO, Any, TypeAlias

import numpy as np

from ..core.errors import OutputError

Record: TypeAlias = dict[str, Any]
"""One finished case: ``key``, ``values``, ``work``, ``citations``, and ``error`` (None, or its type
and message)."""

DONE, FAILED = b"done", b"fail"
"""Second word of a line."""

LONGEST = 2**20
"""Bytes of a line; records have some thousand at most."""

_KEY = re.compile("[0-9a-f]{16,64}")

BETWEEN_SYNCS = 1.0
"""Seconds after which appended lines are forced to the disk; a kill of the process loses none, a
power cut these."""


def records(path: Path) -> Iterator[Record]:
    """Whole records in the file at ``path``, in the order of writing; of a case that was done again
    all of them."""
    for *_, record in _lines(path):
        yield record


class Finished:
    """Which cases a store holds, in 8 bytes for each; failed ones too unless they are to be done
    again (``retry``).

    With the name of a ``quantity`` its values are held, too.
    """

    def __init__(self, path: Path, *, retry: bool = False, quantity: str | None = None) -> None:
        # the first 8 bytes of a digest: two of 10⁶ cases share them with a probability of 3e-8
        kinds = np.dtype([("key", np.uint64), ("value", float)])
        found = np.fromiter(
            (
                (
                    int(record["key"][:16], 16),
                    math.nan if quantity is None else record["values"].get(quantity, math.nan),
                )
                for _, state, record in _lines(path)
                if not (retry and state == FAILED)
            ),
            kinds,
        )
        _, last = np.unique(found["key"][::-1], return_index=True)  # of a case that was done again the last record
        chosen = found[::-1][last]
        self._keys, self._values = chosen["key"].copy(), None if quantity is None else chosen["value"].copy()

    def __len__(self) -> int:
        return int(self._keys.size)

    def __contains__(self, key: str) -> bool:
        return self._at(key) is not None

    def value(self, key: str) -> float:
        """Value of the quantity in the case ``key``; NaN where it failed or is not there."""
        at = self._at(key)
        return math.nan if at is None or self._values is None else float(self._values[at])

    def _at(self, key: str) -> int | None:
        short = np.uint64(int(key[:16], 16))
        at = int(np.searchsorted(self._keys, short))
        return at if at < self._keys.size and self._keys[at] == short else None


class Store:
    """The file at ``path``, open for appending by one process; what a kill has left half-written at
    its end is dropped.

    Raises
    ------
    OutputError
        If another process has it open, or it cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._synced = time.monotonic()
        if path.exists() and not path.is_file():
            raise OutputError(f"results {path} cannot be written: it is no ordinary file.", subject=f"results {path}")
        try:
            self._file: IO[bytes] = path.open("ab")
        except OSError as error:
            raise OutputError(
                f"results {path} cannot be written: {error.strerror}; check rights and space.",
                subject=f"results {path}",
            ) from error
        try:
            if importlib.util.find_spec("fcntl") is not None:  # Windows: opening is not exclusive there
                import fcntl

                try:  # the lock ends with the process however it ends
                    fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except OSError:
                    raise OutputError(
                        f"results {path} are being written by another process; wait for it, or give {{folder}}.",
                        subject=f"results {path}",
                    ) from None
            self._file.truncate(max((end for end, *_ in _lines(path)), default=0))
        except BaseException:
            self._file.close()
            raise

    def append(self, finished: Iterable[Record]) -> None:
        """Write all records at once."""
        lines = []
        for record in finished:  # ``key state checksum json`` and the end of the line; the checksum is of the json
            payload = json.dumps(record, separators=(",", ":")).encode()
            state = DONE if record["error"] is None else FAILED
            lines.append(b"%s %s %08x %s\n" % (record["key"].encode(), state, zlib.crc32(payload), payload))
        try:
            self._file.write(b"".join(lines))
            self._file.flush()
            if time.monotonic() - self._synced > BETWEEN_SYNCS:
                os.fsync(self._file.fileno())
                self._synced = time.monotonic()
        except OSError as error:
            raise OutputError(
                f"results {self.path} cannot be written: {error.strerror}; free some space.",
                subject=f"results {self.path}",
            ) from error

    def __enter__(self) -> Store:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._file.close()


def _lines(path: Path) -> Iterator[tuple[int, bytes, Record]]:
    """End in the file, state and record of every whole line; any other is left out, and its case
    done again."""
    if not path.is_file():
        return
    end = 0
    with path.open("rb") as file:
        for line in iter(lambda: file.readline(LONGEST), b""):
            end += len(line)
            parts = line.split(b" ", 3)
            if line.endswith(b"\n") and len(parts) == 4 and b"%08x" % zlib.crc32(parts[3][:-1]) == parts[2]:
                record = _record(parts[3])
                if record is not None and record["key"].encode() == parts[0]:
                    state = DONE if record["error"] is None else FAILED
                    if parts[1] == state:
                        yield end, state, record


def _record(payload: bytes) -> Record | None:
    """The record in ``payload``; None if it is none, whatever its checksum."""

    def numbers(found: Any) -> bool:
        return isinstance(found, dict) and all(
            isinstance(item, float) or (type(item) is int and abs(item) < 2**63) for item in found.values()
        )

    def texts(found: Any) -> bool:
        return isinstance(found, list) and all(isinstance(text, str) for text in found)

    try:
        record = json.loads(payload)
        error, findings = record["error"], record.get("findings", [])
        good = (
            _KEY.fullmatch(record["key"]) is not None
            and numbers(record["values"])
            and numbers(record["work"])
            and texts(record["citations"])
            and (error is None or texts([error["type"], error["message"]]))
            and isinstance(findings, list)
            and all(texts(finding) and len(finding) == 3 for finding in findings)
            and texts(record.get("verdict", []))
        )
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return None
    return record if good else None
