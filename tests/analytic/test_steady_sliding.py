"""Steady sliding over viscoelastic bodies against closed forms, the reference of a sliding wave,
limits, and a march in time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.surfaces.characterise.spectrum import power_spectrum, radial_spectrum

PRONY = {
    "sls": (1.0, ((9.0, 1.0),)),
    "sls_mild": (1.0, ((1.0, 1.0),)),
    "prony3": (1.0, ((2.0, 10.0), (5.0, 1.0), (20.0, 0.01))),
    "prony5": (0.5, ((0.2, 100.0), (0.4, 10.0), (1.0, 1.0), (3.0, 0.1), (10.0, 0.01))),
}


def rubber(name: str) -> asp.Viscoelastic:
    return asp.Viscoelastic.prony(*PRONY[name], 0.0)


def wave(points: int, amplitude: float, length: float) -> asp.Surface:
    x = 2.0 * np.pi * np.arange(points) / points
    return asp.Surface(amplitude * np.cos(x)[:, None], length / points, 1.0)


def over(surface: asp.Surface, body: asp.Elastic | asp.Layered) -> asp.ContactProblem:
    return asp.ContactProblem(surface, asp.Rigid(), counter_body=body)


@every_row(reference("viscoelasticity/sliding_wave_full_contact"))
def test_wave_in_full_contact(row: Row) -> None:
    """Pressure amplitude, its lead in front of the wave, and friction, to the error of the
    solve."""
    material = str(row["material"])
    problem = over(wave(32, 0.01, 2.0 * np.pi), rubber(material))
    found = asp.slide(problem, asp.MeanPressure(0.5 * PRONY[material][0] + 1.0), float(row["omega"]))
    assert found.normal.area_fraction == 1.0
    first = np.fft.rfft(found.normal.pressure[:, 0])[1] / 16.0
    assert abs(first) == pytest.approx(row["pressure_amplitude"], rel=1e-5)
    assert -np.angle(first) == pytest.approx(row["phase_lead_rad"], rel=1e-4, abs=1e-9)
    assert found.friction_stress == pytest.approx(row["friction_stress"], rel=1e-4, abs=1e-10)
    assert found.slope_friction == pytest.approx(found.friction, rel=1e-4, abs=1e-10)


@pytest.mark.slow
@every_row(reference("viscoelasticity/sliding_wave_partial_contact"))
def test_wave_in_partial_contact(row: Row) -> None:
    """Friction, largest pressure, fraction and shift of the contact at 256 points: error of the
    reference at 1024, and a pixel at the edge."""
    material, points = str(row["material"]), 256
    scale = np.pi * PRONY[material][0] * 0.01
    problem = over(wave(points, 0.01, 1.0), rubber(material))
    load = asp.MeanPressure(float(row["pbar_over_pstar_relaxed"]) * scale)
    found = asp.slide(problem, load, float(row["v_tau0_over_lambda"]))
    touching = found.normal.contact[:, 0]
    x = (np.arange(points) / points + 0.5) % 1.0 - 0.5
    width = touching.mean()
    assert found.friction == pytest.approx(row["mu"], abs=float(row["err_mu"]) + 4e-5)
    assert found.normal.max_pressure / scale == pytest.approx(
        row["p_max_over_pstar"], rel=0.04 + float(row["err_pmax"])
    )
    assert width == pytest.approx(row["contact_fraction"], abs=2.0 / points + float(row["err_fraction"]))
    assert x[touching].mean() == pytest.approx(
        row["centre_shift_over_lambda"], abs=1.0 / points + float(row["err_fraction"])
    )
    assert found.energy_error < 1e-5


def rough() -> asp.Surface:
    x = 2.0 * np.pi * (np.arange(32) + 0.5) / 32
    waves = np.cos(x)[:, None] + 0.4 * np.cos(3 * x + 1.0)[:, None] * np.cos(2 * x) + 0.2 * np.sin(5 * x)
    return asp.Surface(1e-7 * waves, 1e-6 / 32)


RUBBER = asp.Viscoelastic.prony(2e6, ((5e6, 1e-3), (9e6, 1e-4)), 0.5)
LOAD = asp.MeanPressure(0.3e6)


@pytest.mark.parametrize("speed", [0.0, 1e6])
def test_slow_and_fast_sliding_are_elastic(speed: float) -> None:
    """The relaxed contact at rest, that of the first instant at high speed, where no wave stands
    still; no friction in either."""
    E = 16e6 if speed else 2e6
    x = 2.0 * np.pi * (np.arange(64) + 0.5) / 64
    surface = asp.Surface(1e-7 * (np.cos(x) + 0.4 * np.cos(3 * x + 1.0))[:, None], 1e-6 / 64)
    elastic = asp.solve(over(surface, asp.Elastic(E, 0.5)), LOAD)
    found = asp.slide(over(surface, RUBBER), LOAD, speed)
    assert np.abs(found.normal.pressure - elastic.pressure).max() < 1e-3 * elastic.max_pressure
    assert abs(found.friction) < 1e-4
    assert found.heat == pytest.approx(found.friction * 0.3e6 * speed)


def test_direction_turns_with_the_surface_and_times_scale_with_the_speed() -> None:
    surface = rough()
    first = asp.slide(over(surface, RUBBER), LOAD, 1e-3)
    turned = asp.Surface(np.ascontiguousarray(surface.heights.T), surface.grid.spacing[0])
    second = asp.slide(over(turned, RUBBER), LOAD, 1e-3, direction=np.pi / 2)
    assert second.friction == pytest.approx(first.friction, rel=1e-4)
    np.testing.assert_allclose(second.normal.pressure.T, first.normal.pressure, atol=1e-4 * first.normal.max_pressure)
    slower = asp.slide(over(surface, RUBBER.with_times(2.0)), LOAD, 0.5e-3)
    assert slower.friction == pytest.approx(first.friction, rel=1e-9)
    back = asp.slide(over(surface, RUBBER), LOAD, 1e-3, direction=np.pi)
    mirrored = asp.Surface(np.ascontiguousarray(surface.heights[::-1]), surface.grid.spacing[0])
    assert asp.slide(over(mirrored, RUBBER), LOAD, 1e-3).friction == pytest.approx(back.friction, rel=1e-4)
    assert first.friction > 0.01
    assert first.slope_friction == pytest.approx(first.friction, rel=0.05)


def test_coating_between_rigid_base_and_half_space() -> None:
    """A thick coating is the half-space of its material; a thin one on a stiff base dissipates
    less."""
    whole = asp.slide(over(rough(), RUBBER), LOAD, 1e-3)
    stiff = asp.Elastic(1e9, 0.3)
    thick, thin = (
        asp.slide(over(rough(), asp.Layered([asp.Layer(RUBBER, h)], stiff)), LOAD, 1e-3) for h in (3e-6, 1e-7)
    )
    assert thick.friction == pytest.approx(whole.friction, rel=1e-3)
    assert thin.friction < 0.8 * whole.friction
    assert thin.normal.area_fraction < whole.normal.area_fraction


def test_load_that_reaches_a_position() -> None:
    problem = over(rough(), RUBBER)
    by_load = asp.slide(problem, LOAD, 1e-3)
    by_gap = asp.slide(problem, asp.MeanGap(by_load.normal.mean_gap), 1e-3)
    assert by_gap.normal.mean_pressure == pytest.approx(0.3e6, rel=1e-5)
    assert by_gap.friction == pytest.approx(by_load.friction, rel=1e-4)


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (
            lambda: asp.slide(asp.ContactProblem(rough(), RUBBER), LOAD, 1.0),
            "surface of a viscoelastic body in steady sliding",
        ),
        (lambda: asp.slide(over(rough(), asp.Elastic(1e6, 0.5)), LOAD, 1.0), "body or counter_body of steady sliding"),
        (lambda: asp.slide(over(rough(), RUBBER), LOAD, -1.0), "sliding speed (m/s)"),
        (
            lambda: asp.slide(over(rough(), asp.Viscoelastic.maxwell(1e6, 1.0, 0.5)), LOAD, 0.0),
            "bodies in steady sliding at 0 m/s",
        ),
        (lambda: asp.slide(over(rough(), RUBBER), asp.Unloaded(), 1.0), "control of steady sliding"),
        (
            lambda: asp.slide(
                asp.ContactProblem(rough(), asp.Rigid(), counter_body=RUBBER, law=asp.Hardness(1e6)), LOAD, 1.0
            ),
            "law of steady sliding",
        ),
        (
            lambda: asp.slide(
                asp.ContactProblem(rough(), asp.Rigid(), counter_body=RUBBER, friction=asp.Coulomb(0.2)), LOAD, 1.0
            ),
            "friction and plastic_flow of steady sliding",
        ),
        (lambda: asp.slide(sticky(32, asp.adhesion.JKRAdhesion(1e-4)), LIGHT, 1.0), "adhesion of viscoelastic bodies"),
        (lambda: asp.slide(sticky(32, None), asp.contact.Pull(1e-4), 1.0), "control of a problem without adhesion"),
        (
            lambda: asp.slide(sticky(32), LIGHT, 1.0, after=asp.slide(sticky(16), LIGHT, 1.0)),
            "permanent indentation of the state",
        ),
        (lambda: asp.slide(sticky(32), LIGHT, 1.0).persson(), "adhesion and film beside Persson's theory"),
    ],
)
def test_what_is_refused(make: Callable[[], object], subject: str) -> None:
    with refused(asp.InputError, subject):
        make()


# With adhesion and menisci.

SLS = rubber("sls")
LIGHT = asp.MeanPressure(0.1 * np.pi * 0.01)
STICKY = asp.ExponentialAdhesion(2e-4, 2e-3)


def sticky(
    points: int,
    adhesion: asp.adhesion.Adhesion | None = STICKY,
    body: asp.Elastic = SLS,
    film: asp.LiquidFilm | None = None,
) -> asp.ContactProblem:
    return asp.ContactProblem(wave(points, 0.01, 1.0), asp.Rigid(), counter_body=body, adhesion=adhesion, film=film)


@pytest.mark.slow
def test_adhesive_sliding_is_where_the_motion_in_time_ends() -> None:
    """Friction to the error of the steps of time (5e-3 at two steps a pixel); the two ways to it,
    work of pressure and attraction, by a pixel at the edges."""
    steady, dry = asp.slide(sticky(64), LIGHT, 0.1), asp.slide(sticky(64, None), LIGHT, 0.1)
    found = asp.viscoelasticity.slide_in_time(sticky(64), LIGHT, 0.1, 3.0)
    assert found.mean_friction(1.0) == pytest.approx(steady.friction, rel=0.02)
    assert found.last.area_fraction == pytest.approx(steady.normal.area_fraction, abs=1.5 / 64)
    fine = asp.slide(sticky(256), LIGHT, 0.1)
    assert fine.slope_friction == pytest.approx(fine.friction, rel=5e-3)
    assert fine.friction == pytest.approx(steady.friction, rel=0.03)
    assert steady.friction > 3.0 * dry.friction
    assert steady.energy_error < 1e-6
    assert steady.normal.external_force == pytest.approx(LIGHT.value, rel=1e-9)


@pytest.mark.parametrize(("speed", "modulus", "error"), [(1e7, 10.0, 1e-6), (1e-8, 1.0, 1e-5)])
def test_adhesive_sliding_fast_and_slow_is_elastic(speed: float, modulus: float, error: float) -> None:
    """The adhesive contact of the first instant or of the relaxed body: the lag goes with the ratio
    of times, 1e-7 of the displacement."""
    found = asp.slide(sticky(64), LIGHT, speed)
    elastic = asp.solve(sticky(64, body=asp.Elastic(modulus, 0.0)), LIGHT)
    np.testing.assert_allclose(found.normal.pressure, elastic.pressure, atol=error * elastic.max_pressure)
    assert found.normal.area_fraction == elastic.area_fraction
    assert abs(found.friction) < 1e-5


def test_full_adhesive_contact_has_no_edge() -> None:
    """Both ways to the friction agree to the error of the displacement, and it is that of the wave
    in full contact: attraction changes no displacement."""
    found = asp.slide(sticky(64), LIGHT, 0.01)
    assert found.normal.area_fraction == 1.0
    assert found.slope_friction == pytest.approx(found.friction, rel=1e-6)
    pressed = asp.slide(sticky(64, None), asp.MeanPressure(1.0), 0.01)
    assert pressed.normal.area_fraction == 1.0
    assert found.friction_stress == pytest.approx(pressed.friction_stress, rel=1e-6)


def test_adhesive_sliding_stays_on_its_branch() -> None:
    """Under one load a steep wave touches in part after it was brought to touch, and everywhere
    after it was pressed there, under a pull as well."""
    steep = asp.ContactProblem(wave(64, 0.02, 1.0), asp.Rigid(), counter_body=SLS, adhesion=STICKY)
    touched = asp.slide(steep, LIGHT, 1e-3)
    pressed = asp.slide(steep, asp.MeanPressure(0.5), 1e-3)
    held = asp.slide(steep, LIGHT, 1e-3, after=pressed)
    assert touched.normal.area_fraction < 0.5
    assert held.normal.area_fraction == 1.0
    assert held.friction > touched.friction
    pulled = asp.slide(steep, asp.contact.Pull(1e-3), 1e-3, after=held)
    assert pulled.normal.area_fraction == 1.0
    assert pulled.normal.external_force == pytest.approx(-1e-3, rel=1e-9)
    assert pulled.friction_stress == pytest.approx(held.friction_stress, rel=1e-6)
    assert np.isnan(pulled.friction)
    with refused(asp.errors.NoSolutionError, "force"):
        asp.slide(steep, asp.contact.Pull(1.0), 1e-3, after=held)


@pytest.mark.slow
def test_machine_that_gives_way_while_it_slides() -> None:
    """The approach of the bodies is that of the grips less the force over the stiffness, and the
    contact is that at this approach, to the tolerance of the attraction."""
    grips = asp.FixedGrips(4e-3, 5.0)
    found = asp.slide(sticky(64), grips, 0.1)
    force = found.normal.external_force
    assert found.normal.approach == pytest.approx(grips.value - force / grips.stiffness, rel=1e-5)
    again = asp.slide(sticky(64), asp.FixedGrips(found.normal.approach), 0.1)
    assert again.normal.external_force == pytest.approx(force, rel=1e-4)
    assert again.friction_stress == pytest.approx(found.friction_stress, rel=1e-4)


@pytest.mark.parametrize("adhesion", [None, STICKY])
def test_menisci_press_a_sliding_surface(adhesion: asp.adhesion.Adhesion | None) -> None:
    """The contact is that under the load and the force of the menisci together, and the coefficient
    is over the load."""
    film = asp.LiquidFilm(surface_tension=2.5e-6, thickness=1e-3)
    load = 0.1 * np.pi * 0.01
    found = asp.slide(sticky(64, adhesion, film=film), asp.MeanPressure(load), 1.0)
    menisci = found.normal.menisci
    assert menisci is not None
    assert menisci.meniscus_force > 0.0
    assert found.normal.external_force == pytest.approx(load, rel=1e-4)
    both = asp.slide(sticky(64, adhesion), asp.MeanPressure(load + menisci.meniscus_force), 1.0)
    np.testing.assert_allclose(found.normal.pressure, both.normal.pressure, atol=2e-3 * both.normal.max_pressure)
    assert found.friction_stress == pytest.approx(both.friction_stress, rel=1e-3)
    assert found.friction == pytest.approx(found.friction_stress / load, rel=1e-3)


# Persson's theory beside it.


def error_of_bands(surface: asp.Surface) -> float:
    """Largest relative error of the moments of order 1 to 3 of the spectrum in bands: friction
    grows with q when it is fast, with q³ when it is slow."""
    bands = radial_spectrum(power_spectrum(surface))
    table = asp.theories.IsotropicSpectrum(bands.q[bands.psd > 0.0], bands.psd[bands.psd > 0.0])
    wave = np.abs(np.fft.fft2(surface.heights)) ** 2 / surface.heights.size**2
    qx, qy = (2.0 * np.pi * np.fft.fftfreq(n, surface.dx) for n in surface.heights.shape)
    q = np.hypot(qx[:, None], qy)
    found = [
        float(table.partial_moment(k + 1, table.span[-1:])[0]) / (2.0 * np.pi) / float((wave * q**k).sum())
        for k in (1, 2, 3)
    ]
    return max(abs(ratio - 1.0) for ratio in found)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [1e-4, 3e-3, 3e-2, 1.0])
def test_persson_beside_a_sliding_surface(speed: float) -> None:
    """In full contact the mean over directions, to the bands of the spectrum; in partial contact
    too little area and, with S = 1, too much friction."""
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=3e-5, shortest_wavelength=8e-6
    )
    ground = asp.generate.gaussian(asp.Grid((64, 64), (1e-6, 1e-6)), waves, seed=2)
    solid = asp.Viscoelastic.standard_linear(1e6, 1e7, 1e-3, 0.5)
    full, partial = (asp.slide(over(ground, solid), asp.MeanPressure(p), speed) for p in (6e6, 1e5))
    theory = full.persson()
    assert full.normal.area_fraction == 1.0
    assert theory.area_fraction > 0.999
    angles = np.arange(4) * np.pi / 4.0
    all_round = [asp.slide(over(ground, solid), asp.MeanPressure(6e6), speed, direction=a).friction for a in angles]
    assert theory.friction == pytest.approx(np.mean(all_round), rel=0.01 + error_of_bands(ground))
    theory = partial.persson()
    assert 0.6 * partial.normal.area_fraction_corrected < theory.area_fraction < partial.normal.area_fraction_corrected
    assert 0.5 * partial.friction < theory.friction < 4.0 * partial.friction
    assert partial.persson(reduction=0.5).friction < theory.friction


def test_persson_knows_half_spaces_and_maps_alone() -> None:
    coated = asp.slide(over(rough(), asp.Layered([asp.Layer(RUBBER, 1e-6)], asp.Elastic(1e9, 0.3))), LOAD, 1e-3)
    with refused(asp.InputError, "bodies beside Persson's theory"):
        coated.persson()
    x = np.arange(32) / 32
    line = asp.Surface(1e-7 * np.cos(2.0 * np.pi * x)[:, None], 1e-6 / 32, 1e-6, periodic=True)
    with refused(asp.InputError, "boundary beside Persson's theory"):
        asp.slide(over(line, RUBBER), LOAD, 1e-3).persson()


# Persson's theory of rubber friction.


@every_row(reference("viscoelasticity/persson_friction"))
def test_rubber_friction_of_persson(row: Row) -> None:
    """Friction and area of the reference, to the error of 800 wavenumbers between two of the
    table."""
    q = [float(row[name]) for name in ("qL_per_m", "q0_per_m", "q1_per_m")]
    level = float(row["C0_m4"]) * (2.0 * np.pi) ** 2
    C = [level, level, level * (q[2] / q[1]) ** (-2.0 - 2.0 * float(row["H"]))]
    start = 0 if q[1] > q[0] else 1
    spectrum = asp.theories.IsotropicSpectrum(q[start:], C[start:])
    solid = asp.Viscoelastic.prony(float(row["E_relaxed_Pa"]), ((float(row["E_step_Pa"]), float(row["tau_s"])),), 0.0)
    found = asp.theories.rubber_friction(
        spectrum, solid.contact_relaxation.complex_modulus, speed=float(row["v_m_per_s"]), pressure=float(row["p0_Pa"])
    )
    assert found.friction == pytest.approx(row["mu"], rel=1e-7)
    assert found.area_fraction == pytest.approx(row["area_fraction"], rel=1e-7)
    assert found.cumulative_friction[-1] == found.friction


def test_reduced_deformation_lowers_the_friction() -> None:
    spectrum = asp.theories.IsotropicSpectrum([1e3, 1e6], [1e-15, 1e-26])
    E = asp.Viscoelastic.standard_linear(2e6, 2e8, 1e-4, 0.5).contact_relaxation.complex_modulus
    whole, reduced = (
        asp.theories.rubber_friction(spectrum, E, speed=0.1, pressure=1e5, reduction=gamma) for gamma in (1.0, 0.5)
    )
    assert 0.5 * whole.friction < reduced.friction < whole.friction
    with refused(asp.InputError, "sliding speed (m/s)"):
        asp.theories.rubber_friction(spectrum, E, speed=0.0, pressure=1e5)


def test_theory_of_the_catalogue_is_the_function() -> None:
    """Along speeds and pressures, for a series of terms; as many times as moduli."""
    q, psd = np.array([1e3, 1e5, 1e6]), np.array([1e-15, 1e-21, 1e-26])
    theory = asp.theories.PerssonFriction(2e6, [1e7, 2e7], [1e-2, 1e-4], q, psd, reduction=0.5)
    solid = asp.Viscoelastic.prony(2e6, ((1e7, 1e-2), (2e7, 1e-4)), 0.0)
    by_speed, by_pressure = theory.at_speed([1e-3, 1e-1], 1e5), theory.at_pressure([1e5, 1e6], 1e-3)
    for speed, pressure, answer, at in ((1e-1, 1e5, by_speed, 1), (1e-3, 1e6, by_pressure, 1)):
        found = asp.theories.rubber_friction(
            asp.theories.IsotropicSpectrum(q, psd),
            solid.contact_relaxation.complex_modulus,
            speed=speed,
            pressure=pressure,
            reduction=0.5,
        )
        assert answer.friction[at] == pytest.approx(found.friction, rel=1e-12)
        assert answer.area_fraction[at] == pytest.approx(found.area_fraction, rel=1e-12)
        assert answer.heat[at] == pytest.approx(found.friction * pressure * speed, rel=1e-12)
    assert by_speed.friction[0] == by_pressure.friction[0]
    with refused(asp.InputError, "times of a relaxation"):
        asp.theories.PerssonFriction(2e6, [1e7, 2e7], [1e-2], q, psd)


def test_spectrum_in_many_pieces_is_that_in_few() -> None:
    """Fewer points between neighbours of a dense table lose no digits that matter."""
    few = np.array([1e3, 1e5, 1e6]), np.array([1e-15, 1e-21, 1e-26])
    dense = np.union1d(np.geomspace(1e3, 1e6, 400), [1e5])
    many = dense, np.exp(np.interp(np.log(dense), np.log(few[0]), np.log(few[1])))
    one, other = (
        asp.theories.PerssonFriction(2e6, [2e7], [1e-4], *table).at_speed([1e-2], 1e5) for table in (few, many)
    )
    assert other.friction == pytest.approx(one.friction, rel=1e-7)
    assert other.area_fraction == pytest.approx(one.area_fraction, rel=1e-7)
