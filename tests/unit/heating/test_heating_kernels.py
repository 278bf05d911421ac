"""Pixels of heat and waves of heat: reference values, limits, symmetries, and each by the other."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.physics.conductance.operator import LayeredConductor
from asperity.solids.compliance.influence import patch_displacement
from asperity.theories import HeatConductor, HeatLayer, critical_wavelength
from asperity.theories.heating.impedance import after, buried, decay
from asperity.theories.heating.pixel import pixel_kernel, rectangle
from asperity.theories.heating.thermoelastic import bulge, growth_rate, surface_stress

SOLIDS = {
    "homogeneous": HeatConductor(1.0, 1.0),
    "soft_film": HeatConductor(1.0, 1.0, (HeatLayer(0.1, 0.2, 1.0),)),
    "good_film": HeatConductor(1.0, 1.0, (HeatLayer(10.0, 5.0, 0.5),)),
    "film_resistance": HeatConductor(1.0, 1.0, (HeatLayer(1.0, 1.0, 1.0, 0.7),)),
    "two_layers": HeatConductor(1.0, 1.0, (HeatLayer(5.0, 2.0, 0.2, 0.1), HeatLayer(0.2, 0.3, 0.4))),
    "slab_sink": HeatConductor(1.0, 1.0, sink_depth=0.8),
}
STEEL = (46.0, 1.2e-5)


@every_row(reference("heating/kernel_layered"), label=lambda row: str(row["case"]))
def test_impedance(row: dict[str, float]) -> None:
    """Known to 2e-9, in ten digits."""
    wave = (row["qx"], row["qy"], row["v"], row["laplace_p"])
    expected = complex(row["Z_re"], row["Z_im"])
    found = SOLIDS[str(row["solid"])].impedance(*wave)
    assert abs(found - expected) <= 2.5e-9 * abs(expected)


@every_row(reference("heating/thermoelastic_kernel"), label=lambda row: str(row["case"]))
def test_thermoelastic_kernels(row: dict[str, float]) -> None:
    """Written with ten digits."""
    wave = (row["qx"], row["qy"])
    surface = 1.0 / decay(*wave, 1.0, row["v"])
    found = [bulge(*wave, 1.0, 1.0, row["nu"], row["v"]), *surface_stress(*wave, 1.0, 1.0, row["nu"], row["v"])]
    for value, name in zip(found, ("u", "sxx", "syy", "sxy"), strict=True):
        expected = complex(row[f"{name}_re"], row[f"{name}_im"])
        assert value * surface == pytest.approx(expected, abs=6e-10 * max(1.0, abs(expected)))


# Pixels.


def test_a_pixel_at_rest_is_loves_rectangle() -> None:
    """Love's form takes the place of the rectangle by its moments from 300 sides on, to 1e-9."""
    found = pixel_kernel((40, 12), (1e-6, 3e-6), *STEEL)
    x, y = 1e-6 * np.arange(-39, 40)[:, None], 3e-6 * np.arange(-11, 12)
    expected = patch_displacement(x, y, 1e-6, 3e-6) / (2.0 * STEEL[0])
    np.testing.assert_allclose(found, expected, rtol=1e-11)


@pytest.mark.parametrize("speed", [0.0, 1e-3, 3.0, -40.0, 2e4, (3.0, -5.0)])
@pytest.mark.parametrize(("depth", "time"), [(0.0, math.inf), (2e-6, math.inf), (0.0, 1e-7), (1e-6, 1e-5)])
def test_pixels_are_rectangles_and_pass_by_reciprocally(speed, depth: float, time: float) -> None:
    """K(v)ᵀ = K(-v)."""
    options = {"depth": depth, "time": time}
    kernel = pixel_kernel((6, 4), (1e-6, 2e-6), *STEEL, speed, **options)
    x, y = 1e-6 * np.arange(-5, 6)[:, None], 2e-6 * np.arange(-3, 4)
    points = rectangle(x, y, (0.5e-6, 1e-6), *STEEL, speed, **options)
    np.testing.assert_allclose(kernel, points, rtol=1e-11, atol=1e-13 * kernel.max())
    back = tuple(-v for v in speed) if isinstance(speed, tuple) else -speed
    np.testing.assert_allclose(
        pixel_kernel((6, 4), (1e-6, 2e-6), *STEEL, back, **options)[::-1, ::-1],
        kernel,
        rtol=1e-12,
        atol=1e-14 * kernel.max(),
    )


def test_the_wake_lies_downstream() -> None:
    kernel = pixel_kernel((4, 1), (1e-6, 1e-6), *STEEL, 10.0)[:, 0]
    assert np.all(kernel[4:] > kernel[2::-1])
    across = pixel_kernel((1, 4), (1e-6, 1e-6), *STEEL, (0.0, 10.0))[0]
    np.testing.assert_allclose(across, kernel, rtol=1e-13)


@settings(max_examples=30, deadline=None)
@given(peclet=st.floats(-1e3, 1e3), turn=st.floats(0.0, 6.3), ratio=st.floats(0.2, 5.0), time=st.floats(1e-3, 1e3))
def test_four_pixels_are_one_of_twice_the_side(peclet, turn, ratio, time) -> None:
    speed = 2.0 * peclet * math.cos(turn), 2.0 * peclet * math.sin(turn)
    fine = pixel_kernel((4, 4), (1.0, ratio), 1.0, 1.0, speed, time=time)
    coarse = pixel_kernel((2, 2), (2.0, 2.0 * ratio), 1.0, 1.0, speed, time=time)
    # the middle of the coarse pixel is a corner of the fine ones: mean over a coarse pixel of both
    assert coarse[1, 1] > 0.0
    x, y = np.array([-0.5, 0.5]), ratio * np.array([-0.5, 0.5])
    parts = sum(rectangle(0.3 - a, 0.2 - b, (0.5, 0.5 * ratio), 1.0, 1.0, speed, time=time) for a in x for b in y)
    whole = rectangle(0.3, 0.2, (1.0, ratio), 1.0, 1.0, speed, time=time)
    assert float(parts) == pytest.approx(float(whole), rel=1e-11)
    assert np.all(fine >= 0.0)


def test_short_times_conduct_straight_down() -> None:
    """2 q sqrt(κ t/π)/k under the source, nothing beside."""
    kernel = pixel_kernel((2, 1), (1.0, 1.0), 2.0, 3.0, time=1e-6)[:, 0]
    assert kernel[1] == pytest.approx(math.sqrt(3e-6 / math.pi), rel=1e-12)
    assert kernel[2] == pytest.approx(0.0, abs=1e-20)


@pytest.mark.parametrize(("speed", "time"), [(3.0, math.inf), (0.0, 0.4), (3.0, 0.2)])
def test_pixels_summed_over_images_are_waves(speed: float, time: float) -> None:
    """One flux exp(2πi x/L), constant on each pixel, is a sum of waves 2π/L + 2π m/dx, which fall
    as m**-2: 4000 leave 1e-8. Far pixels fade out over 200 periods."""
    n, periods, length = 8, 400, 1.0
    count, side = n * periods, length / n
    offsets = np.arange(2 * count - 1) - (count - 1)
    kernel = pixel_kernel((count, 1), (side, 4e3), 1.0, 1.0, speed, time=time)[:, 0]
    q = 2.0 * math.pi / length
    waves = q + 2.0 * math.pi / side * np.arange(-4000, 4001)
    response = 1.0 / decay(waves, 0.0, 1.0, speed) if math.isinf(time) else after(time, waves, 0.0, 1.0, 1.0, speed)
    expected = complex(np.sum(response * np.sinc(0.5 * waves * side / math.pi)))
    near = np.clip((count - np.abs(offsets)) / (0.5 * count), 0.0, 1.0)
    fading = 0.5 - 0.5 * np.cos(math.pi * near)
    found = complex(np.sum(kernel * np.exp(-1j * q * offsets * side) * fading))
    assert found == pytest.approx(expected, abs=1e-7)


# Waves.

WAVES = st.tuples(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0)).filter(lambda q: math.hypot(*q) > 1e-3)
LAYERS = st.lists(
    st.builds(HeatLayer, st.floats(0.1, 10.0), st.floats(0.1, 10.0), st.floats(0.01, 3.0), st.floats(0.0, 1.0)),
    max_size=3,
)


def by_hand(body: HeatConductor, wave: tuple[float, float], v: float) -> complex:
    """The recursion with tanh."""
    qx, qy = wave

    def root(part) -> complex:
        return cmath.sqrt(qx**2 + qy**2 + 1j * v * qx / part.diffusivity)

    ks = body.conductivity * root(body)
    z = 1.0 / ks
    for layer in reversed(body.layers):
        ks, tanh = layer.conductivity * root(layer), cmath.tanh(root(layer) * layer.thickness)
        z += layer.resistance
        z = (ks * z + tanh) / (ks * (1.0 + ks * z * tanh))
    return z


@settings(max_examples=50, deadline=None)
@given(wave=WAVES, layers=LAYERS, v=st.floats(-20.0, 20.0))
def test_waves_of_layered_bodies(wave, layers, v) -> None:
    body = HeatConductor(1.0, 1.0, tuple(layers))
    found = complex(body.impedance(*wave, v))
    assert found == pytest.approx(by_hand(body, wave, v), rel=1e-10)
    assert found.real > 0.0  # heat flows from hot to cold
    assert complex(body.impedance(-wave[0], -wave[1], v)) == pytest.approx(found.conjugate(), rel=1e-12)
    assert complex(body.impedance(-wave[0], wave[1], -v)) == pytest.approx(found, rel=1e-12)
    bare = 1.0 / decay(*wave, 1.0, v)
    assert complex(bare + body.beyond_base(*wave, v)) == pytest.approx(found, rel=1e-10)
    top = layers[0] if layers else body
    own = 1.0 / (top.conductivity * decay(*wave, top.diffusivity, v))
    assert complex(own + body.under_surface(*wave, v)) == pytest.approx(found, rel=1e-9)
    assert complex(body.below(0.0, *wave, v)) == pytest.approx(found, rel=1e-12)


@settings(max_examples=30, deadline=None)
@given(wave=WAVES, layers=LAYERS, v=st.floats(-5.0, 5.0), depth=st.floats(0.001, 2.0))
def test_temperatures_below_obey_conduction(wave, layers, v, depth) -> None:
    """Halved thicknesses change nothing, and across a bond they fall by its resistance times the
    flux."""
    layers = [HeatLayer(each.conductivity, each.diffusivity, each.thickness) for each in layers]
    halves = [HeatLayer(each.conductivity, each.diffusivity, 0.5 * each.thickness) for each in layers for _ in range(2)]
    whole, cut = HeatConductor(1.0, 1.0, tuple(layers)), HeatConductor(1.0, 1.0, tuple(halves))
    scale = abs(complex(whole.impedance(*wave, v)))
    assert complex(cut.below(depth, *wave, v)) == pytest.approx(
        complex(whole.below(depth, *wave, v)), abs=1e-11 * scale
    )


def test_jumps_across_a_bond() -> None:
    body = HeatConductor(1.0, 1.0, (HeatLayer(2.0, 0.5, 0.3, 0.7),))
    above, below = (complex(body.below(z, 1.3, 0.4, 2.0)) for z in (0.3, 0.3 + 1e-13))
    flux = below * complex(decay(1.3, 0.4, 1.0, 2.0))
    assert above - below == pytest.approx(0.7 * flux, rel=1e-9)
    assert abs(complex(HeatConductor(1.0, 1.0, sink_depth=0.8).below(0.8, 1.0, 0.0, 3.0))) < 1e-15


def test_layers_at_rest_are_those_of_conductance() -> None:
    q = np.geomspace(1e2, 1e8, 30)
    layers = (HeatLayer(400.0, 1e-4, 2e-6), HeatLayer(10.0, 3e-6, 5e-6))
    expected = LayeredConductor((2e-6, 5e-6), (400.0, 10.0, 46.0)).spectral(q)
    np.testing.assert_allclose(HeatConductor(46.0, 1.2e-5, layers).impedance(q, 0.0), expected, rtol=1e-12)


def test_the_base_is_left_as_effusivities_say_for_long_waves() -> None:
    body = SOLIDS["two_layers"]
    moving = 0.1 + 0.2 / 5.0 * (1.0 - 25.0 / 2.0) + 0.4 / 0.2 * (1.0 - 0.04 / 0.3)
    still = 0.1 + 0.2 / 5.0 * (1.0 - 25.0) + 0.4 / 0.2 * (1.0 - 0.04)
    assert body.beyond_base(0.0, 0.0, 3.0) == pytest.approx(moving, rel=1e-13)
    assert body.beyond_base(1e-14, 0.0, 3.0) == pytest.approx(moving, rel=1e-5)
    assert body.beyond_base(0.0, 0.0) == pytest.approx(still, rel=1e-13)
    assert body.beyond_base(1e-9, 0.0) == pytest.approx(still, rel=1e-7)
    assert HeatConductor(2.0, 1.0, body.layers, 0.4).mean_mode() == pytest.approx(0.1 + 0.04 + 2.0 + 0.2)
    assert math.isinf(body.mean_mode())


def test_a_step_of_flux() -> None:
    """2 q sqrt(t/π)/b at first and of the mean, the steady wave at last; a Laplace variable by its
    integral."""
    assert complex(after(1e-9, 3.0, 1.0, 2.0, 0.5, 4.0)) == pytest.approx(
        2e-9**0.5 / math.sqrt(math.pi) * 0.5, rel=1e-6
    )
    assert complex(after(2.0, 0.0, 0.0, 2.0, 0.5)) == pytest.approx(2.0 * math.sqrt(2.0 / math.pi) / (2.0 / 0.5**0.5))
    assert complex(after(50.0, 3.0, 1.0, 2.0, 0.5, 4.0)) == pytest.approx(complex(0.5 / decay(3.0, 1.0, 0.5, 4.0)))
    u, weight = np.polynomial.laguerre.laggauss(60)
    p = 2.0
    smooth = np.array([complex(after(float(t) / p, 1.0, 0.5, 1.0, 1.0, 2.0)) for t in u])
    expected = complex(HeatConductor(1.0, 1.0).impedance(1.0, 0.5, 2.0, laplace=p))
    assert complex(weight @ smooth) == pytest.approx(expected, rel=1e-3)  # the root of t at the start


def test_heat_made_at_depth() -> None:
    """At the surface it is the flux; from depth it reaches the surface as the surface reaches
    it."""
    body, wave = HeatConductor(2.0, 0.3), (1.0, 0.5, 3.0)
    assert complex(buried(0.0, 0.0, body, *wave)) == pytest.approx(complex(body.impedance(*wave)))
    assert complex(buried(0.0, 0.4, body, *wave)) == pytest.approx(complex(body.below(0.4, *wave)))
    assert complex(buried(0.2, 0.4, body, *wave)) == pytest.approx(complex(buried(0.4, 0.2, body, *wave)))


# Thermoelastic.


def test_bulges_and_stresses_at_rest_and_fast() -> None:
    """Barber's δ q/q², σxx + σyy = -E α T; fast -E α T/(1 - ν) both ways."""
    alpha, nu, E, k, kappa = 12e-6, 0.3, 210e9, 46.0, 1.2e-5
    q = np.array([3e3, 1e5])
    flux = 1.0 / (k * decay(q, 0.0, kappa))
    np.testing.assert_allclose(bulge(q, 0.0, kappa, alpha, nu) * flux, alpha * (1.0 + nu) / k / q**2, rtol=1e-14)
    still = surface_stress(q, 2.0 * q, kappa, E * alpha, nu)
    np.testing.assert_allclose(still.xx + still.yy, -E * alpha, rtol=1e-14)
    fast = surface_stress(q, 2.0 * q, kappa, E * alpha, nu, 1e14)
    np.testing.assert_allclose([fast.xx, fast.yy], -E * alpha / (1.0 - nu), rtol=1e-4)
    assert E * alpha / (1.0 - nu) == pytest.approx(3.6e6, rel=1e-2)


def test_waves_longer_than_critical_grow() -> None:
    numbers = {"friction": 0.3, "speed": 1.0, "expansion": 12e-6, "nu": 0.3, "E_star": 115e9, "conductivity": 46.0}
    critical = critical_wavelength(**numbers)
    assert critical == pytest.approx(1.1e-3, rel=0.03)
    rates = growth_rate(2.0 * math.pi / (critical * np.array([0.9, 1.0, 1.1])), 1.2e-5, critical)
    assert rates[0] < 0.0 < rates[2]
    assert abs(rates[1]) < 1e-9 * rates[2]
    assert math.isinf(critical_wavelength(**{**numbers, "speed": 0.0}))


@pytest.mark.parametrize(
    ("call", "subject"),
    [
        (lambda: HeatLayer(0.0, 1.0, 1.0), "thermal conductivity (W/m/K)"),
        (lambda: HeatLayer(1.0, 0.0, 1.0), "thermal diffusivity (m²/s)"),
        (lambda: HeatLayer(1.0, 1.0, 0.0), "thickness of a layer (m)"),
        (lambda: HeatLayer(1.0, 1.0, 1.0, -1.0), "resistance of a bond (m² K/W)"),
        (lambda: HeatConductor(1.0, 1.0, sink_depth=0.0), "depth of the sink (m)"),
        (lambda: HeatConductor(1.0, 1.0, sink_depth=1.0).below(1.5, 1.0, 0.0), "depth (m)"),
        (lambda: pixel_kernel((2, 2), (0.0, 1.0), 1.0, 1.0), "spacing (m)"),
        (lambda: pixel_kernel((2, 2), (1.0, 1.0), 1.0, 1.0, time=0.0), "time since the flux began (s)"),
        (lambda: after(0.0, 1.0, 0.0, 1.0, 1.0), "time since the flux began (s)"),
        (lambda: buried(0.0, 0.0, HeatConductor(1.0, 1.0, sink_depth=1.0), 1.0, 0.0), "body with heat made at depth"),
        (lambda: growth_rate(1.0, 1.0, 0.0), "critical wavelength (m)"),
        (lambda: growth_rate(0.0, 1.0, 1.0), "wavenumbers (rad/m)"),
    ],
)
def test_what_cannot_be_is_refused(call, subject: str) -> None:
    with refused(InputError, subject):
        call()
