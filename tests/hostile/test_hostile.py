"""Damaged files, documents, stores and options end in an answer or in one clear sentence, never in
a traceback, hang or crash."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import tomli_w
from hostile.attack import ENDS, attacked, tally
from hostile.targets import TARGETS, Target

EACH, MANY = 4, 154
"""Mutants of every kind in the quick test, and in the slow one: 2 000 in all."""


OF_TABLES = (
    "problem documents (TOML)",
    "documents of adhesion",
    "documents of sliding",
    "study documents",
    "material files",
)


@pytest.fixture(scope="module")
def everything(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Target]:
    return {name: make(tmp_path_factory.mktemp("target")) for name, make in TARGETS.items()}


def test_undamaged_examples_are_read(everything: dict[str, Target], tmp_path: Path) -> None:
    """Else every mutant would be refused for the same reason."""
    wrong = []
    for name, target in everything.items():
        if type(target) is Target:
            damage = _toml if name in OF_TABLES else lambda data, _: data
            sound = Target(target.examples, damage, target.commands)
            ends = (attacked(name, sound, seed, tmp_path) for seed in range(10))
            if not any(end.word == "done" for end in ends):
                wrong.append(name)
    assert not wrong, wrong


def _toml(data: bytes, _: object) -> bytes:
    return tomli_w.dumps(json.loads(data)).encode()


def test_some_mutants_of_every_kind(everything: dict[str, Target], tmp_path: Path) -> None:
    wrong = [
        f"{name}, seed {end.seed}, {end.word}: {end.failure}"
        for name, target in everything.items()
        for end in (attacked(name, target, seed, tmp_path) for seed in range(EACH))
        if end.word not in ENDS.values()
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.slow
def test_two_thousand_mutants() -> None:
    """In processes of their own: a crash in a library is a failure of one mutant and not of the
    suite; two at a time."""
    with ThreadPoolExecutor(2) as pool:
        ends = list(pool.map(lambda name: list(tally(name, EACH, MANY)), TARGETS))
    wrong = [
        f"{name}, seed {end.seed}, {end.word}: {end.failure}"
        for name, found in zip(TARGETS, ends, strict=True)
        for end in found
        if end.word not in ENDS.values()
    ]
    assert not wrong, "\n".join(wrong)
