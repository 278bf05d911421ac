"""A block on an interface of normal compliance with friction, against reference values, a column,
and the friction at which it is no longer unique."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused
from scipy.optimize import brentq

import asperity as asp
from asperity.fem import CompliantInterface, compliant_block

SOLID = asp.Elastic(1.0, 0.3)


@every_row(reference("missing/compliance_block"))
def test_blocks_of_reference(row: Row) -> None:
    """By other elements, with forces to the error of the row and moments to 3e-4."""
    law = CompliantInterface(row["c_n"], row["m_n"])
    size = (row["width"], row["height"])
    found = compliant_block(asp.Elastic(1.0, row["nu"]), size, row["ram_displacement"], law, friction=row["mu"])
    assert found.normal_force == pytest.approx(row["N_per_depth"], rel=row["rel_error_N"])
    assert found.moment == pytest.approx(row["moment_per_depth"], rel=3e-4, abs=1e-12)
    assert found.shear_force == pytest.approx(row["mu"] * found.normal_force, rel=1e-12)
    assert found.residuals[-1] < 1e-11


@pytest.mark.parametrize("exponent", [1.0, 2.0, 3.3])
def test_columns_are_exact(exponent: float) -> None:
    """(p/c)^(1/m) + p L/M = push, and u_x = μ p L/G."""
    law, length, push, friction = CompliantInterface(30.0, exponent), 1.5, 0.2, 0.4
    modulus, shear = 0.7 / (1.3 * 0.4), 1.0 / 2.6
    found = compliant_block(SOLID, (1.0, length), push, law, friction=friction, endless=True, parts=2)
    pressure = brentq(lambda p: (p / 30.0) ** (1.0 / exponent) + p * length / modulus - push, 0.0, 1.0, xtol=1e-15)
    np.testing.assert_allclose(found.pressure, pressure, rtol=1e-9)
    np.testing.assert_allclose(found.along, friction * pressure * length / shear, rtol=1e-9)
    assert found.critical_friction == np.inf


def test_a_soft_interface_bears_the_push_and_a_hard_one_the_block() -> None:
    """c to zero: p = c push^m; c to infinity: the force comes to a limit as (p/c)^(1/m)."""
    soft = compliant_block(SOLID, (2.0, 1.0), 0.01, CompliantInterface(1e-5, 2.0))
    np.testing.assert_allclose(soft.pressure, 1e-9, rtol=1e-5)
    forces = [
        compliant_block(SOLID, (2.0, 1.0), 0.01, CompliantInterface(c, 2.0)).normal_force for c in (1e5, 1e7, 1e9)
    ]
    assert np.diff(forces)[1] / np.diff(forces)[0] == pytest.approx(0.1, rel=0.1)


@pytest.mark.parametrize(
    ("size", "stiffness", "friction"),
    [
        ((2.0, 1.0), 0.1, 22.6),
        ((2.0, 1.0), 1e3, 1.83),
        ((2.0, 1.0), 1.0, 3.91),
        ((2.0, 1.0), 10.0, 2.041),
        ((1.0, 1.0), 10.0, 2.191),
        ((1.0, 2.0), 1.0, 3.29),
    ],
)
def test_the_friction_at_which_the_tangent_is_singular(
    size: tuple[float, float], stiffness: float, friction: float
) -> None:
    """Values that agree to 0.3 % between meshes; at a fifth of it the block settles."""
    law = CompliantInterface(stiffness, 1.0)
    found = compliant_block(SOLID, size, 1e-3, law, parts=6)
    assert found.critical_friction == pytest.approx(friction, rel=5e-3)
    slid = compliant_block(SOLID, size, 1e-3, law, friction=0.2 * friction, parts=6)
    assert slid.residuals[-1] < 1e-11
    assert slid.critical_friction > 0.2 * friction


def test_small_friction_moves_the_pressure_toward_the_leading_edge() -> None:
    """In proportion to it, with the other sign for x reversed by the symmetry of the block."""
    law = CompliantInterface(1e3, 2.0)
    moments = [compliant_block(SOLID, (2.0, 1.0), 0.01, law, friction=mu).moment for mu in (0.01, 0.02)]
    assert moments[1] / moments[0] == pytest.approx(2.0, rel=0.01)
    assert moments[0] < 0.0


def test_a_crowned_block_touches_in_its_middle() -> None:
    law = CompliantInterface(1e4, 2.0)
    found = compliant_block(SOLID, (2.0, 1.0), 0.01, law, gap=lambda x: 0.05 * x**2)
    touching = found.pressure > 0.0
    assert touching.any()
    assert not touching[np.abs(found.x) > 0.6].any()
    assert abs(found.moment) < 1e-10 * found.normal_force


def test_blocks_that_cannot_be() -> None:
    law = CompliantInterface(1.0, 2.0)
    with refused(asp.InputError, "exponent of the interface"):
        CompliantInterface(1.0, 0.5)
    with refused(asp.InputError, "push of the ram (m)"):
        compliant_block(SOLID, (1.0, 1.0), 0.0, law)
    with refused(asp.InputError, "friction of the interface"):
        compliant_block(SOLID, (1.0, 1.0), 0.1, law, friction=-1.0)
    with refused(asp.InputError, "gap of the interface"):
        compliant_block(SOLID, (1.0, 1.0), 0.1, law, gap=lambda x: np.full_like(x, np.nan))
