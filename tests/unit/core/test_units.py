"""Quantities in text: parsed to SI, never guessed, printed with SI prefixes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from asperity.core import units
from asperity.errors import UnitError


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("50 kPa", "pressure", 50e3),
        ("5nm", "length", 5e-9),
        ("5 µm", "length", 5e-6),
        ("5um", "length", 5e-6),
        ("-2.5e-3 mm", "length", -2.5e-6),
        ("1 N/mm^2", "pressure", 1e6),
        ("1 MPa", "pressure", 1e6),
        (".5 mN", "force", 5e-4),
        ("10 deg", "angle", 0.17453292519943295),
        ("0.025 N/m", "surface tension", 0.025),
        ("25 mJ/m**2", "surface tension", 0.025),
        ("0.3", "number", 0.3),
        ("30 %", "number", 0.3),
    ],
)
def test_parse(text, kind, value):
    assert units.parse(text, kind, "x") == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "kind", "shown"),
    [
        ("5", "length", ["5 nm", "'5'"]),
        ("", "length", ["5 nm", "''"]),
        ("nm", "length", ["5 nm", "'nm'"]),
        ("5 kPa", "length", ["length", "'kPa'"]),
        ("5 nm", "pressure", ["pressure", "'nm'"]),
        ("5 bananas", "length", ["'bananas'"]),
        ("50mpa", "pressure", ["'mpa'", "MPa", "mPa"]),
        ("5 nm nm nm)", "length", ["'nm nm nm)'"]),
        ("1,5 nm", "length", ["'1,5 nm'", "1.5 nm"]),
        ("nan nm", "length", ["'nan nm'"]),
    ],
)
def test_refused_with_the_name_of_the_input(text, kind, shown):
    with refused(UnitError, "layer thickness", *shown):
        units.parse(text, kind, "layer thickness")


@pytest.mark.parametrize(
    ("text", "size"),
    [
        ("20 um x 10 um", (20e-6, 10e-6)),
        ("20um×10um", (20e-6, 10e-6)),
        ("20 um", (20e-6, 20e-6)),
        ("1 mm x 500 um", (1e-3, 5e-4)),
    ],
)
def test_parse_size(text, size):
    assert units.parse_size(text) == pytest.approx(size, rel=1e-14)


@pytest.mark.parametrize("text", ["20 x 10 um", "1 um x 2 um x 3 um", "20 um x", "20 kPa x 1 um"])
def test_bad_size(text):
    with pytest.raises(UnitError):
        units.parse_size(text)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (5e-9, "m", "5 nm"),
        (5e4, "Pa", "50 kPa"),
        (0.0, "m", "0 m"),
        (-3.2e-9, "m", "-3.2 nm"),
        (1.2e-13, "m**2", "0.12 µm²"),
        (1.2e-14, "m**2", "0.012 µm²"),
        (1.2e-15, "m**2", "1200 nm²"),
        (3.0, "m**2", "3 m²"),
        (9.254e-37, "m**4", "0.9254 nm⁴"),
        (2.637e-24, "m**4", "2.637 µm⁴"),
        (0.25, "1", "0.25"),
        (float("inf"), "Pa/m", "inf Pa/m"),
        (5.856e-28, "m", "5.856e-28 m"),  # rounding, not 585.6 rm
        (float("nan"), "Pa", "nan Pa"),
    ],
)
def test_show(value, unit, text):
    assert units.show(value, unit) == text


@given(st.floats(1e-12, 1e12))
def test_show_and_parse_are_inverse(value):
    assert units.parse(units.show(value, "m", digits=17), "length", "x") == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("3 um**-2", "1/m^2", 3e12),
        ("50mJ/m^2", "J/m^2", 0.05),
        ("72 mN/m", "J/m^2", 0.072),
        ("1 1/nm", "rad/m", 1e9),
        ("60deg", "rad", 1.0471975511965976),
        ("0.3", "", 0.3),
        ("30%", "", 0.3),
    ],
)
def test_parse_in_any_unit(text, unit, value):
    assert units.parse_in(text, unit, "x") == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "unit", "subject", "shown"),
    [
        ("3", "1/m^2", "x", "um**-2"),
        ("3 m", "1/m^2", "x", "1/m^2"),
        ("3 m", "", "x", "'m'"),
        ("3 foo", "m", "x", "'foo'"),
        ("many", "", "x", "'many'"),
    ],
)
def test_units_of_another_kind_are_refused(text, unit, subject, shown):
    with refused(UnitError, subject, shown):
        units.parse_in(text, unit, "x")


@pytest.mark.parametrize("unit", units._PREFIXED)
def test_prefixes_are_those_of_pint_to_the_bit(unit):
    registry = units._registry()
    for prefix in units._PREFIXES:
        assert units._factor(prefix + unit, unit) == registry.Quantity(1.0, prefix + unit).to(unit).magnitude
    edges = [float(f"{digits}e{power}") for power in range(-22, 22) for digits in ("0.9999", "0.99999951", "1", "-2.5")]
    for value in (0.0, -0.0, *edges):
        quantity = registry.Quantity(value, unit)
        compact = quantity if value == 0.0 or abs(value) < units._SMALLEST else quantity.to_compact()
        assert units.show(value, unit, 6) == f"{compact.magnitude:.6g} {compact.units:~P}"


def test_other_factors_are_those_of_pint_to_the_bit():
    for (name, unit), factor in units._DIRECT.items():
        assert factor == units._registry().Quantity(1.0, name).to(unit).magnitude
    for unit in units.DIMENSIONS.values():
        assert units._factor(unit, unit) == units._registry().Quantity(1.0, unit).to(unit).magnitude


@pytest.mark.parametrize("unit", units._POWERS)
def test_powers_of_a_length_are_printed_as_by_pint(unit):
    power, _, least = units._POWERS[unit]
    names = [f"{prefix}{unit}" for prefix in ("", "m", "u", "n")]
    assert units.show(0.0, unit) == f"{units._registry().Quantity(0.0, unit):~P}".replace("0.0", "0")
    for digits in ("0.9999", "0.99999951", "1", "-2.5"):
        for exponent in range(-12 * power, 4):
            value = float(f"{digits}e{exponent}")
            scaled = [units._registry().Quantity(value, unit).to(name) for name in names]
            wanted = next((found for found in scaled[:-1] if abs(found.magnitude) >= least), scaled[-1])
            assert units.show(value, unit, 6) == f"{wanted.magnitude:.6g} {wanted.units:~P}"
