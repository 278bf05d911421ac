"""The examples in the docstrings of theories run."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

from asperity import theories

MODULES = [module.name for module in pkgutil.iter_modules(theories.__path__)]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    assert doctest.testmod(importlib.import_module(f"asperity.theories.{name}")).failed == 0
