"""Run the program on damaged input, in this process, within limits of time and memory, and count
how it ends.

``python -m hostile.attack 100000 --until 22:55`` (in ``tests/``) runs many, each kind of input in
processes of its own, so that a crash is counted, too, and prints the table of
``docs/develop/tests.md``.
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import astuple, dataclass
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any
from unittest import mock

from hostile.targets import TARGETS, Target
from study_cases import InProcess
from typer.testing import CliRunner

from asperity.cli import declared
from asperity.cli.main import app
from asperity.studies import local
from asperity.studies.executors import Task

SECONDS, MEMORY = 20, 3 * 2**30
"""Processor time and memory that a mutant may take beside what the process has."""

ENDS = {0: "done", 1: "not converged", 2: "refused", 130: "done"}
"""Exit codes that are in order, and what they mean; studies are interrupted after ``CASES``."""

CASES = 3

ORIGINAL, BUILD = declared.built, functools.cache(declared.built)


def built_once(command: Callable[..., None], name: str, *options: Any) -> Any:
    """The ``command``, made of the options that it declares once in a process: for all mutants they
    are the same, and making them took a third of the time."""
    return ORIGINAL(command, name, *options) if options else BUILD(command, name)


class OutOfTimeError(BaseException):
    """Passes through every handler of exceptions."""


@dataclass(frozen=True)
class End:
    """How the mutant ``seed`` of a target ended: one word, for a failure what happened, and its
    output."""

    seed: int
    word: str
    failure: str = ""
    said: str = ""


class Begun(InProcess):
    """Begins a study in this process, and is interrupted."""

    def __init__(self, *_: object) -> None: ...

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any]]:
        yield from super().run(function, islice(tasks, CASES))
        raise KeyboardInterrupt


@contextlib.contextmanager
def limits(folder: Path) -> Iterator[None]:
    """Little time and memory, and ``folder`` to work in."""

    def stop(*_: object) -> None:
        raise OutOfTimeError

    before, place = resource.getrlimit(resource.RLIMIT_AS), Path.cwd()
    size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    timer = signal.signal(signal.SIGPROF, stop)
    try:
        os.chdir(folder)
        resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, before[1]))
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        begun, built = (
            mock.patch.object(local, "LocalProcesses", Begun),
            mock.patch.object(declared, "built", built_once),
        )
        with warnings.catch_warnings(), begun, built:
            warnings.simplefilter("ignore")
            yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, timer)
        resource.setrlimit(resource.RLIMIT_AS, before)
        os.chdir(place)


def attacked(name: str, target: Target, seed: int, folder: Path) -> End:
    """How the program ends on the mutant ``seed`` of ``target``, in a new folder below
    ``folder``."""
    random, place = Random(f"{name} {seed}"), folder / "work"
    place.mkdir()
    command: tuple[str, ...] = ()
    try:
        command = target.mutant(place, random)
        with limits(place):
            ended = CliRunner().invoke(app, list(command))
    except OutOfTimeError:
        return End(seed, "out of time", " ".join(command)[:300])
    finally:
        shutil.rmtree(place, ignore_errors=True)
    if ended.exception is not None and not isinstance(ended.exception, SystemExit):
        return End(seed, "exception", f"{command!r:.300}: {ended.exception!r:.300}")
    if ended.exit_code not in ENDS:
        return End(seed, f"exit code {ended.exit_code}", f"{command!r:.300}: {ended.stderr[-1500:]}")
    said = ended.stderr.replace("\n", "")
    if ended.exit_code and not (said or ended.stdout):
        return End(seed, "silent", repr(command)[:300])
    if any(not character.isprintable() for character in said):
        return End(seed, "control characters", f"{command!r:.300}: {said!r:.500}")
    return End(seed, ENDS[ended.exit_code], said=said)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int, help="mutants in all")
    parser.add_argument("--until", help="time of the day to stop at, 22:55")
    parser.add_argument("--only", help="attack this kind alone, in this process")
    parser.add_argument("--first", type=int, default=0, help="seed of the first mutant")
    asked = parser.parse_args()
    if asked.only:
        _alone(asked.only, asked.first, asked.count)
    else:
        _all(asked.count, asked.until)


def _alone(name: str, first: int, count: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        target = TARGETS[name](Path(folder))
        for seed in range(first, first + count):
            say(json.dumps([seed]))
            say(json.dumps(astuple(attacked(name, target, seed, Path(folder)))))


def tally(name: str, first: int, count: int) -> Iterator[End]:
    """Ends of ``count`` mutants of ``name`` in a process of its own; one that dies is counted as a
    crash."""
    command = [sys.executable, "-m", "hostile.attack", str(count), "--only", name, "--first", str(first)]
    paths = os.pathsep.join(filter(None, sys.path))
    ended = subprocess.run(
        command, capture_output=True, text=True, check=False, env={**os.environ, "PYTHONPATH": paths}
    )
    under_way = first
    for line in ended.stdout.splitlines():
        under_way, *end = json.loads(line)
        if end:
            yield End(under_way, *end)
            under_way += 1
    if ended.returncode:
        yield End(under_way, f"process ended with {ended.returncode}", ended.stderr[-1500:])
        if under_way + 1 < first + count:
            yield from tally(name, under_way + 1, first + count - under_way - 1)


BATCH = 200


def _all(count: int, until: str | None) -> None:
    found = {name: Counter[str]() for name in TARGETS}
    for first in range(0, count // len(TARGETS), BATCH):
        for name in TARGETS:
            if until and time.strftime("%H:%M") >= until:
                break
            for end in tally(name, first, BATCH):
                found[name][end.word] += 1
                if end.failure:
                    say(f"{name}, seed {end.seed}, {end.word}: {end.failure}")
            say(table(found))


def say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def table(found: dict[str, Counter[str]]) -> str:
    """Rows of kinds of input, columns of ends, as Markdown."""
    words = [
        *dict.fromkeys(ENDS.values()),
        *sorted({word for counts in found.values() for word in counts} - set(ENDS.values())),
    ]
    rows = [("input", "mutants", *words)]
    rows += [(name, str(c.total()), *(str(c[word]) for word in words)) for name, c in found.items()]
    return "\n".join(f"| {' | '.join(row)} |" for row in (rows[0], ("---",) * len(rows[0]), *rows[1:]))


if __name__ == "__main__":
    main()
