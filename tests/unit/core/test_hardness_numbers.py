"""Hardness numbers as pressures: Vickers, Brinell and Rockwell C."""

from __future__ import annotations

import math

import pytest
from refusals import refused

from asperity.core.errors import UnitError
from asperity.core.units import KILOPOND, hardness_of, parse


def pressure(text: str) -> float:
    found = hardness_of(text, "hardness")
    assert found is not None
    return found


@pytest.mark.parametrize("text", ["700 HV", "700HV", " 700 HV10 ", "700 hv 0.3"])
def test_vickers_number_is_the_force_over_the_faces_of_the_pyramid(text: str) -> None:
    """Of an imprint of diagonal d the projected area is d²/2 and that of the faces d²/(2 sin 68°),
    d²/1.8544."""
    d = 1e-4
    force = 700 * KILOPOND * d**2 / 1.8544
    assert pressure(text) == pytest.approx(force / (d**2 / 2), rel=1e-4)


@pytest.mark.parametrize(
    ("text", "diameter"), [("200 HB", None), ("200 HBW10/3000", 10.0), ("60HBW10/500", 10.0), ("95 HBW 10/500", 10.0)]
)
def test_brinell_number_is_the_force_over_the_cap(text: str, diameter: float | None) -> None:
    """The imprint follows from the definition, HB = 2F/(π D (D - sqrt(D² - d²))), and with it the
    projected area."""
    ball, force = 10.0, 500.0 if "500" in text else 3000.0
    number = float(text.split("H")[0])
    low, high = 0.0, ball
    for _ in range(100):
        d = 0.5 * (low + high)
        found = 2.0 * force / (math.pi * ball * (ball - math.sqrt(ball**2 - d**2)))
        low, high = (d, high) if found > number else (low, d)
    assert pressure(text) == pytest.approx(force / (math.pi * d**2 / 4.0) * KILOPOND, rel=1e-9)


def test_softer_metals_are_tested_with_less_force() -> None:
    assert pressure("60 HB") == pytest.approx(pressure("60 HBW10/1000"))
    assert pressure("95.5 HB") == pytest.approx(pressure("95.5 HBW10/3000"))


@pytest.mark.parametrize(
    ("number", "vickers"), [(20, 238), (25, 266), (36, 354), (45, 446), (60, 697), (62, 746), (68, 940)]
)
def test_rockwell_numbers_of_steel_by_the_table(number: int, vickers: int) -> None:
    assert pressure(f"{number} HRC") == pytest.approx(pressure(f"{vickers} HV"), rel=1e-9)


@pytest.mark.parametrize("odd", [(21, 243), (33, 327), (51, 528), (59, 674), (61, 720), (67, 900)])
def test_numbers_between_the_rows_are_those_of_the_table_within_its_rounding(odd: tuple[int, int]) -> None:
    number, vickers = odd
    assert pressure(f"{number}HRC") == pytest.approx(pressure(f"{vickers}HV"), rel=3e-3)


@pytest.mark.parametrize(
    "text", ["19 HRC", "69HRC", "20 HB", "700HB", "20HBW10/3000", "0 HV", "-3 HV", "0HB", "200HBW0/3000"]
)
def test_beyond_a_scale_is_refused(text: str) -> None:
    with refused(UnitError, "hardness", text):
        hardness_of(text, "hardness")


@pytest.mark.parametrize("text", ["5 GPa", "700", "HV", "700 HX", "60 HRB", "1e3 HV"])
def test_other_text_is_no_hardness_number(text: str) -> None:
    assert hardness_of(text, "hardness") is None


def test_numbers_stand_for_a_hardness_only() -> None:
    assert parse("700 HV", "hardness", "hardness") == pressure("700 HV")
    assert parse("7 GPa", "hardness", "hardness") == 7e9
    with refused(UnitError, "load", "HV"):
        parse("700 HV", "pressure", "load")
    with refused(UnitError, "hardness", "kg"):
        parse("700 kg", "hardness", "hardness")
