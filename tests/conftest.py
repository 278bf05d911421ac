"""Set-up shared by all tests."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import matplotlib
import pytest
import reference_data
from hypothesis import settings

matplotlib.use("Agg")

IN_CI = os.environ.get("CI", "").lower() in {"1", "true"}

settings.register_profile("default", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if IN_CI else "default")


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of measured topographies, which lies beside the repository and not in it."""
    folder = Path(__file__).parents[2] / "shared" / "data"
    if folder.is_dir():
        return folder
    message = f"the measured topographies are not at {folder}"
    if IN_CI and not os.environ.get("ASPERITY_WITHOUT_SCANS"):
        pytest.fail(f"{message}; CI must provide them, or say ASPERITY_WITHOUT_SCANS=1")
    pytest.skip(message)


@pytest.fixture(scope="session")
def reference() -> Callable[[str], list[reference_data.Row]]:
    """Reader of tests/reference/<name>.csv; ``from reference_data import reference`` serves in parametrisations."""
    return reference_data.reference
