"""The examples in the docstrings of theories run."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

from asperity import theories

MODULES = [module.name for module in pkgutil.walk_packages(theories.__path__, "asperity.theories.")]


def test_examples():
    found = [doctest.testmod(importlib.import_module(name)) for name in MODULES]
    assert sum(result.failed for result in found) == 0
    assert sum(result.attempted for result in found) > 15
