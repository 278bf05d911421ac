"""Derivatives of layered compliances: reference values, identities, kernels made of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from reference_data import Row, every_row, reference

from asperity.contact import Free, FreeLine, Periodic
from asperity.contact.boundary import Boundary
from asperity.core.arrays import RealArray
from asperity.core.grid import Grid
from asperity.solids import Bonded, Elastic, Frictionless, Layer, Layered, RigidBase
from asperity.solids.compliance.halfspace import contact_compliance
from asperity.solids.compliance.layered import interface_compliances
from asperity.solids.compliance.rates import Constant, compliance_rates, constants, normal_rates
from asperity.solids.elastic import Rigid

WAVES = np.geomspace(1e-3, 1e2, 61)

THREE = Layered(
    [
        Layer(Elastic(8.0, 0.2), 0.3),
        Layer(Elastic(0.2, 0.45), 0.1, Frictionless()),
        Layer(Elastic(3.0, 0.1), 0.7, Bonded()),
    ],
    Elastic(1.0, 0.3),
)
ON_RIGID = Layered([Layer(Elastic(2.0, 0.3), 0.5), Layer(Elastic(0.3, 0.4), 0.4)], RigidBase())


def with_value(stack: Layered, constant: Constant, value: float) -> Layered:
    """``stack`` with another value of the ``constant``."""
    layers, base = list(stack.layers), stack.base
    at = layers[constant.layer].material if constant.layer < len(layers) else base
    assert isinstance(at, Elastic)
    given = {"youngs_modulus": at.youngs_modulus, "poisson_ratio": at.poisson_ratio, constant.kind: value}
    material = Elastic(given["youngs_modulus"], given["poisson_ratio"])
    if constant.layer == len(layers):
        return Layered(layers, material)
    layer = layers[constant.layer]
    thickness = value if constant.kind == "thickness" else layer.thickness
    layers[constant.layer] = Layer(material, thickness, layer.interface)
    return Layered(layers, base)


def differences(stack: Layered, step: float = 1e-4) -> Iterator[tuple[Layered, Layered, float]]:
    """For each constant the stacks on either side and the distance of the values."""
    for constant in constants(stack):
        apart = step * (abs(constant.value) or 1.0)
        yield (
            with_value(stack, constant, constant.value + apart),
            with_value(stack, constant, constant.value - apart),
            2.0 * apart,
        )


@every_row(reference("sensitivities/compliance_derivatives_1layer"), lambda row: f"case {row['case']:g}")
def test_one_layer(row: Row) -> None:
    value = {key: float(given) for key, given in row.items()}
    stack = Layered([Layer(Elastic(value["E1"], value["nu1"]), value["h"])], Elastic(value["E2"], value["nu2"]))
    wanted = [value[f"dc_d{name}"] for name in ("E1", "nu1", "h", "E2", "nu2")]
    assert normal_rates(stack, value["q"]) == pytest.approx(wanted, rel=1e-11)


@every_row(reference("sensitivities/compliance_derivatives_2layer"), lambda row: f"case {row['case']:g}")
def test_two_layers(row: Row) -> None:
    value = {key: float(given) for key, given in row.items()}
    layers = [Layer(Elastic(value[f"E{k}"], value[f"nu{k}"]), value[f"h{k}"]) for k in (1, 2)]
    stack = Layered(layers, Elastic(value["E_sub"], value["nu_sub"]))
    names = ("E1", "nu1", "h1", "E2", "nu2", "h2", "E_sub", "nu_sub")
    assert normal_rates(stack, value["q"]) == pytest.approx([value[f"dc_d{name}"] for name in names], rel=1e-11)


@pytest.mark.parametrize("stack", [THREE, ON_RIGID], ids=["slipping", "rigid base"])
def test_rates_are_those_of_differences(stack: Layered) -> None:
    rates = normal_rates(stack, WAVES)
    largest = interface_compliances(stack, WAVES)[0].zz
    for rate, (above, below, apart) in zip(rates, differences(stack), strict=True):
        up, down = (interface_compliances(one, WAVES)[0].zz for one in (above, below))
        # the error of the difference is (step)² of a third derivative, and rounding over the step
        assert np.abs(rate - (up - down) / apart).max() <= 1e-6 * np.abs(rate).max() + 1e-11 * largest.max() / apart


@pytest.mark.parametrize("stack", [THREE, ON_RIGID], ids=["slipping", "rigid base"])
def test_units_of_pressure_and_of_length_do_not_matter(stack: Layered) -> None:
    rates, found, values = constants(stack), normal_rates(stack, WAVES), interface_compliances(stack, WAVES)[0].zz
    moduli = sum(c.value * rate for c, rate in zip(rates, found, strict=True) if c.kind == "youngs_modulus")
    assert moduli == pytest.approx(-values, rel=1e-12)
    step = 1e-4
    slope = (
        interface_compliances(stack, WAVES * (1.0 + step))[0].zz
        - interface_compliances(stack, WAVES * (1.0 - step))[0].zz
    ) / (2.0 * step)
    lengths = sum(c.value * rate for c, rate in zip(rates, found, strict=True) if c.kind == "thickness")
    # the third derivative to ln q is at most about 10 values
    assert np.abs(lengths - values - slope).max() <= 10.0 * step**2 * values.max()


def test_a_stiffer_solid_gives_way_less_and_equal_ones_have_no_thickness() -> None:
    for stack in (THREE, ON_RIGID):
        for constant, rate in zip(constants(stack), normal_rates(stack, WAVES), strict=True):
            assert constant.kind != "youngs_modulus" or (rate <= 0.0).all()
    same = Elastic(2.0, 0.3)
    stack = Layered([Layer(same, 0.4), Layer(same, 0.1)], same)
    rates = normal_rates(stack, WAVES)
    for constant, rate in zip(constants(stack), rates, strict=True):
        assert constant.kind != "thickness" or np.abs(rate).max() <= 1e-12


def summed(stack: Layered, boundary: Boundary, grid: Grid) -> RealArray:
    """What the boundary makes of the compliance of ``stack``."""
    compliance = contact_compliance(stack, Rigid())
    if isinstance(boundary, Periodic):
        return np.asarray(compliance.spectral(np.geomspace(0.3, 40.0, 9000)))
    return boundary.influence(compliance, grid)


@pytest.mark.parametrize(
    ("boundary", "grid"),
    [
        (Periodic(), Grid((4, 4), (0.1, 0.1))),
        (Free(), Grid((40, 12), (0.1, 0.15))),
        (FreeLine(), Grid((60, 1), (0.1, 1.0))),
    ],
    ids=["periodic", "free", "line"],
)
@pytest.mark.parametrize("base", [Elastic(1.0, 0.3), RigidBase()], ids=["half-space", "rigid base"])
def test_kernels_of_rates_are_rates_of_kernels(boundary: Boundary, grid: Grid, base: Elastic | RigidBase) -> None:
    stack = Layered([Layer(Elastic(4.0, 0.2), 0.3), Layer(Elastic(0.5, 0.4), 0.2)], base)
    for rate, (above, below, apart) in zip(compliance_rates(stack), differences(stack), strict=True):
        wanted = (summed(above, boundary, grid) - summed(below, boundary, grid)) / apart
        if isinstance(boundary, Periodic):
            found = rate.factor * np.asarray(rate.compliance.spectral(np.geomspace(0.3, 40.0, 9000)))
        else:
            found = rate.factor * boundary.influence(rate.compliance, grid)
        # influence coefficients have 1e-8 of the largest, over the distance of the values
        error = 1e-8 * np.abs(summed(stack, boundary, grid)).max() / apart
        assert np.abs(found - wanted).max() <= 1e-6 * np.abs(wanted).max() + error


def test_the_mean_mode_of_a_rigid_base() -> None:
    for rate, (above, below, apart) in zip(compliance_rates(ON_RIGID), differences(ON_RIGID), strict=True):
        up, down = (contact_compliance(one, Rigid()).mean_mode() for one in (above, below))
        assert rate.factor * rate.compliance.mean_mode() == pytest.approx((up - down) / apart, rel=1e-6)


def test_a_homogeneous_body_and_layers_that_vanish() -> None:
    steel = Elastic(2.0, 0.3)
    E, nu = compliance_rates(steel)
    q = np.array([0.5, 3.0])
    value = 2.0 * (1.0 - 0.09) / (2.0 * q)
    assert E.factor * E.compliance.spectral(q) == pytest.approx(-value / 2.0, rel=1e-15)
    assert nu.factor * nu.compliance.spectral(q) == pytest.approx(-2.0 * 0.3 * 2.0 / (2.0 * q), rel=1e-15)
    kinds = [rate.constant.kind for rate in compliance_rates(Layered([Layer(Elastic(9.0, 0.2), 0.0)], steel))]
    assert kinds == ["youngs_modulus", "poisson_ratio"]
