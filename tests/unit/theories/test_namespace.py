"""The namespace of theories: late imports."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from asperity import theories


def test_every_name_leads_to_what_its_module_defines():
    for name in theories.__all__:
        assert getattr(theories, name) is not None
        assert name in dir(theories)
    with pytest.raises(AttributeError, match="phlogiston"):
        theories.phlogiston  # noqa: B018 - reading the attribute is the test


def test_the_package_is_imported_without_its_theories():
    code = (
        "import sys, json, asperity.theories; print(json.dumps([m for m in sys.modules if "
        "m.startswith('asperity.theories.')]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    loaded = {name.removeprefix("asperity.theories.") for name in json.loads(done.stdout)}
    assert not loaded & {"catalogue", "hertz", "persson", "bush_gibson_thomas", "maugis"}
