"""Depth transfer in the wavenumber domain: multiprecision rows, equations of elasticity,
continuity, limits."""

import numpy as np
import pytest
from elastic_fields import COLUMNS, label
from hypothesis import given, settings
from hypothesis import strategies as st
from layered_bodies import body_of, layered_bodies, plane_of
from reference_data import every_row, reference

import asperity as asp
from asperity.physics.stress.kernels.transfer import transfer
from asperity.physics.stress.regions import planes

ROWS = reference("spectral_transfer")


def fields(found, nu, c, s, load):
    """Nine fields (9,) of a unit traction, from the amplitudes at one wavenumber: the turned frame,
    straightforwardly."""
    p, qx, qy = {"z": (1, 0, 0), "x": (0, 1, 0), "y": (0, 0, 1)}[load]
    q_L, q_T = c * qx + s * qy, -s * qx + c * qy
    t_L = -1j * q_L
    t = {name: value[0] for name, value in vars(found).items()}
    tau_z, tau_L = t["tau_zz"] * p + t["tau_zL"] * t_L, t["tau_Lz"] * p + t["tau_LL"] * t_L
    LL = t["LL_z"] * p + t["LL_L"] * t_L
    TT, LT, Lz, Tz = nu * (LL - tau_z), 1j * t["LT"] * q_T, -1j * tau_L, -t["tau_T"] * q_T
    u_L, u_T, u_z = 1j * (t["U_z"] * p + t["U_L"] * t_L), t["u_T"] * q_T, t["W_z"] * p + t["W_L"] * t_L
    displacement = [c * u_L - s * u_T, s * u_L + c * u_T, u_z]
    stress = [c * c * LL + s * s * TT - 2 * s * c * LT, s * s * LL + c * c * TT + 2 * s * c * LT, -tau_z]
    shear = [s * c * (LL - TT) + (c * c - s * s) * LT, c * Lz - s * Tz, s * Lz + c * Tz]
    return np.array(displacement + stress + shear)


@every_row(ROWS, label=label)
def test_every_reference_row(row):
    """All digits of the table are good; the scheme is accurate to 5e-13 of the local field. Worst
    found: 7e-15."""
    body = body_of(row)
    plane = plane_of(
        row,
        body,
        row["z"]
        if row["region"] == 1
        else sum(part.thickness for part in body.layers[: int(row["region"]) - 1]) + row["z_local"],
    )
    found = transfer(body.reduced, plane, np.array([row["alpha"]]))
    nu = plane.region.material.poisson_ratio
    got = fields(found, nu, row["xi"] / row["alpha"], row["eta"] / row["alpha"], row["load"])
    wanted = np.array([row[f"Re_{name}"] + 1j * row[f"Im_{name}"] for name in COLUMNS])
    for part in (slice(0, 3), slice(3, 9)):
        np.testing.assert_allclose(got[part], wanted[part], atol=5e-13 * np.abs(wanted[part]).max(), rtol=0)


def test_reference_rows_cover_bases_loads_and_depths():
    assert len(ROWS) == 90
    assert {row["base"] for row in ROWS} == {"halfspace", "rigid"}
    assert {row["load"] for row in ROWS} == {"x", "y", "z"}


@settings(max_examples=60)
@given(layered_bodies(), st.floats(-3.0, 1.5), st.floats(0.02, 0.98), st.data())
def test_the_equations_of_elasticity_hold_inside_every_layer(body, exponent, share, data):
    """Equilibrium and Hooke's law across depth, d/dz by two sixth-order differences whose
    difference shows their error."""
    alpha = np.array([10.0**exponent])
    number = data.draw(st.integers(0, len(body.layers) - 1))
    top = sum(layer.thickness for layer in body.layers[:number])
    layer = body.layers[number]
    room = layer.thickness * min(share, 1.0 - share)
    depth = top + layer.thickness * share
    G, nu = layer.material.shear_modulus, layer.material.poisson_ratio

    def at(z):
        (plane,) = planes(body, [z])
        return {name: value[0] for name, value in vars(transfer(body.reduced, plane, alpha)).items()}

    def slopes(h):
        weights = {1: 3.0 / 4.0, 2: -3.0 / 20.0, 3: 1.0 / 60.0}
        pairs = {k: (at(depth + k * h), at(depth - k * h)) for k in weights}
        return {
            name: sum(w * (pairs[k][0][name] - pairs[k][1][name]) / h for k, w in weights.items())
            for name in pairs[1][0]
        }

    h = 0.3 * min(room / 3.0, 0.3 / alpha[0])
    here, coarse, fine = at(depth), slopes(h), slopes(0.5 * h)
    a = alpha[0]
    for load in "zL":
        U, W, t_L, t_z = (
            here[f"{name}_{load}" if name in "UW" else f"{name}{load}"] for name in ("U", "W", "tau_L", "tau_z")
        )
        equations = {
            f"U_{load}": -a * W - t_L / G,
            f"W_{load}": nu / (1.0 - nu) * a * U - (1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu)) * t_z,
            f"tau_z{load}": a * t_L,
            f"tau_L{load}": -a / (1.0 - nu) * (2.0 * G * a * U + nu * t_z),
        }
        sizes = {
            "U": a * (abs(U) + abs(W)) + (abs(t_L) + abs(t_z)) / G,
            "W": a * (abs(U) + abs(W)) + (abs(t_L) + abs(t_z)) / G,
            "t": G * a**2 * (abs(U) + abs(W)) + a * (abs(t_L) + abs(t_z)),
        }
        for name, wanted in equations.items():
            rounding = 1e-12 * sizes[name[0]] / (a * h)
            assert abs(fine[name] - wanted) <= abs(fine[name] - coarse[name]) + rounding
    assert abs(fine["u_T"] + here["tau_T"] / G) <= abs(fine["u_T"] - coarse["u_T"]) + 1e-12 * here["tau_T"] / (
        G * a * h
    )


@settings(max_examples=60)
@given(layered_bodies(contrast=1e6), st.floats(-4.0, 2.0))
def test_tractions_and_displacements_pass_through_interfaces(body, exponent):
    """Both sides of a bonded interface; 1e-12 of the local field is the accuracy of the
    transfer."""
    alpha = np.array([10.0**exponent])
    depth = 0.0
    for layer in body.layers:
        depth += layer.thickness
        sides = [vars(transfer(body.reduced, plane, alpha)) for plane in planes(body, [depth])]
        if len(sides) == 1:  # the rigid base moves nowhere
            for name in ("U_z", "W_z", "U_L", "W_L", "u_T"):
                assert sides[0][name][0] == 0.0
            continue
        for group in (("tau_zz", "tau_Lz"), ("tau_zL", "tau_LL"), ("tau_T",), ("U_z", "W_z"), ("U_L", "W_L"), ("u_T",)):
            size = max(abs(sides[0][name][0]) for name in group)
            for name in group:
                np.testing.assert_allclose(sides[1][name], sides[0][name], atol=1e-12 * size)


@pytest.mark.parametrize("depth", [0.0, 0.4, 1.0, 1.7, 3.0, 6.0])
def test_identical_layers_are_a_half_space(depth):
    """σ of (3.7) in closed form, at depths in, between and below the layers; a few roundings."""
    solid = asp.Elastic(3.0, 0.3)
    body = asp.Layered([asp.Layer(solid, h) for h in (1.0, 0.7, 1.3)], solid)
    alpha = np.geomspace(1e-3, 30.0, 40)
    x = alpha * depth
    e = np.exp(-x)
    for plane in planes(body, [depth]):
        t = transfer(body.reduced, plane, alpha)
        for got, wanted in (
            (t.tau_zz, (1.0 + x) * e),
            (t.tau_Lz, -x * e),
            (t.LL_z, -(1.0 - x) * e),
            (t.tau_zL, x * e),
            (t.tau_LL, (1.0 - x) * e),
            (t.LL_L, -(2.0 - x) * e),
            (t.tau_T, e),
            (t.LT, e),
        ):
            np.testing.assert_allclose(got, wanted, atol=1e-14)


def test_a_frictionless_interface_carries_no_shear_and_lets_the_sides_slip():
    body = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.3), 1.0, asp.Frictionless())], asp.Elastic(1.0, 0.2))
    above, below = (transfer(body.reduced, plane, np.array([0.7])) for plane in planes(body, [1.0]))
    assert above.tau_Lz[0] == below.tau_Lz[0] == 0.0
    np.testing.assert_allclose(above.tau_zz, below.tau_zz, rtol=1e-14)
    np.testing.assert_allclose(above.W_z, below.W_z, rtol=1e-13)
    assert abs(above.U_z[0] - below.U_z[0]) > 0.1 * abs(below.U_z[0])
    # in the layer just above, the stress tends to that of its lower face
    close = transfer(body.reduced, planes(body, [1.0 - 1e-7])[0], np.array([0.7]))
    np.testing.assert_allclose(close.LL_z, above.LL_z, rtol=1e-5)


@pytest.mark.parametrize("depth", [0.3, 1.0, 1.5])
def test_a_slipping_layer_without_poisson_contraction_keeps_its_digits(depth):
    """At long wavelengths amplitudes are smooth in αh: over 2 % a cubic in its logarithm leaves
    rounding, 4e-14.

    Where ν = 0 the term of first order in αh of sinh αh - αh cosh αh is absent, and differences
    lost up to 9e-7 here.
    """
    layers = [asp.Layer(asp.Elastic(1.0, 0.0), 1.0, asp.Frictionless()), asp.Layer(asp.Elastic(1.0, 0.5), 1.0)]
    body, step = asp.Layered(layers, asp.RigidBase()), np.linspace(-0.01, 0.01, 21)
    for plane in planes(body, [depth]):
        for name, values in vars(transfer(body.reduced, plane, 3.5e-5 * np.exp(step))).items():
            if np.all(values != 0.0):
                logs = np.log(np.abs(values))
                rest = logs - np.polyval(np.polyfit(step, logs, 3), step)
                assert np.abs(rest).max() < 1e-12, (plane.side, name)
