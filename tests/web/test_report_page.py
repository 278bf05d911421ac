"""The page of a result in a real browser."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity as asp

PHONE = {"viewport": {"width": 420, "height": 900}, "device_scale_factor": 2.0, "has_touch": True, "is_mobile": True}


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    heights = np.random.default_rng(3).standard_normal((48, 32)).cumsum(0).cumsum(1)
    surface = asp.Surface((heights - heights.mean()) * 1e-10, 1e-8, 2e-8)
    result = asp.solve(asp.ContactProblem(surface, asp.Elastic(100e9, 0.3)), asp.MeanPressure(20e6))
    path = tmp_path_factory.mktemp("page") / "report.html"
    asp.write_report(result, path)
    return path


def test_nothing_is_wider_than_a_phone(report: Path, open_page: Callable[..., Any]) -> None:
    page = open_page(report, **PHONE).page
    assert page.evaluate("document.documentElement.scrollWidth") <= 420
