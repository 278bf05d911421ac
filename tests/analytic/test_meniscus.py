"""Single, statistical and growing menisci against their reference rows, limits and trends."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from scipy.integrate import quad

from asperity.core.errors import InputError, NoSolutionError
from asperity.theories.rough.greenwood_williamson import GreenwoodWilliamson
from asperity.theories.statistics.heights import ExponentialHeights, GaussianHeights
from asperity.theories.wet import meniscus
from asperity.theories.wet.meniscus import MeniscusGrowth, grown
from asperity.theories.wet.single import DropletMeniscus, FilmMeniscus, VapourMeniscus
from asperity.theories.wet.summits import GrowingMenisci, KineticMeniscus, StatisticalMeniscus, WetSummits, caught


@every_row(reference("kelvin_film"), label=lambda row: f"{row['T_K']:g}-{row['RH']:g}")
def test_kelvin_radius_and_film(row):
    gamma, volume, temperature = row["gamma_N_per_m"], row["V_m3_per_mol"], row["T_K"]
    radius = meniscus.kelvin_radius(row["RH"], gamma, volume, temperature)
    assert radius == pytest.approx(row["r_K_nm"] * 1e-9, rel=1e-12)
    assert meniscus.adsorbed_water_film(row["RH"]) == pytest.approx(row["h_adsorbed_nm"] * 1e-9, rel=1e-12)
    angle = math.radians(60.0)
    both, film = meniscus.wetting_factor(angle, angle), meniscus.wetting_factor(angle)
    assert radius * both == pytest.approx(row["s_two_solid_theta60_nm"] * 1e-9, rel=1e-12)
    assert radius * film == pytest.approx(row["s_film_theta60_nm"] * 1e-9, rel=1e-12)
    # the pressure does not depend on the height at which it is taken
    for factor in (both, film):
        pressure = meniscus.laplace_pressure(gamma, radius * factor, factor)
        assert pressure == pytest.approx(row["laplace_pressure_MPa"] * 1e6, rel=1e-12)


@every_row(reference("single_meniscus"))
def test_single_menisci_of_the_catalogue(row):
    radius, gamma, gap = row["R_m"], row["gamma_N_per_m"], row["gap_D_m"]
    angles = math.radians(row["theta_deg"]), math.radians(row["theta2_deg"])
    drop = DropletMeniscus(radius, gamma, angles[0], row["immersion_d_m"], angles[1])
    assert drop.at_gap([0.0, gap]).force == pytest.approx(
        [row["F_caseA_two_angles_N"], row["F_caseB_two_angles_N"]], rel=1e-12
    )
    film = FilmMeniscus(radius, gamma, angles[0], height=4.0 * gap)
    touching = row["F_caseC_N"]
    assert film.at_gap([0.0, gap, 5.0 * gap]).force == pytest.approx([touching, 0.75 * touching, 0.0], rel=1e-12)


def test_menisci_of_vapour_in_the_catalogue():
    vapour = VapourMeniscus(surface_tension=0.07275, molar_volume=1.8048e-5)
    answer = vapour.at_humidity([0.2, 0.5])
    for share, radius, deficit, film in zip(
        [0.2, 0.5], answer.kelvin_radius, answer.deficit, answer.water_film, strict=True
    ):
        assert radius == meniscus.kelvin_radius(share, 0.07275, 1.8048e-5)
        assert deficit == pytest.approx(meniscus.laplace_pressure(0.07275, radius, 1.0))
        assert film == meniscus.adsorbed_water_film(share)
    with refused(InputError, "relative humidity", "1"):
        vapour.at_humidity(1.0)
    with refused(InputError, "contact angles"):
        DropletMeniscus(1e-6, 0.07, 3.0, 1e-9, 1.0)


@every_row(reference("single_meniscus"))
def test_forces_of_one_sphere(row):
    sphere = row["R_m"], row["gamma_N_per_m"]
    first, second = math.radians(row["theta_deg"]), math.radians(row["theta2_deg"])
    same, mixed = meniscus.wetting_factor(first, first), meniscus.wetting_factor(first, second)
    apart = {"gap": row["gap_D_m"], "immersion": row["immersion_d_m"]}
    assert meniscus.droplet_force(*sphere, same) == pytest.approx(row["F_caseA_N"], rel=1e-13)
    assert meniscus.droplet_force(*sphere, same, **apart) == pytest.approx(row["F_caseB_N"], rel=1e-13)
    assert meniscus.film_force(*sphere, first) == pytest.approx(row["F_caseC_N"], rel=1e-13)
    assert meniscus.droplet_force(*sphere, mixed) == pytest.approx(row["F_caseA_two_angles_N"], rel=1e-13)
    assert meniscus.droplet_force(*sphere, mixed, **apart) == pytest.approx(row["F_caseB_two_angles_N"], rel=1e-13)


def test_a_sphere_leaves_the_film_at_the_height_of_its_meniscus():
    force = [meniscus.film_force(1e-6, 0.07, 0.3, gap=gap, height=1e-9) for gap in (0.0, 0.5e-9, 1e-9, 2e-9)]
    assert force[1] == pytest.approx(0.5 * force[0], rel=1e-12)
    assert force[2:] == [0.0, 0.0]


def wet(row, heights=GaussianHeights()) -> StatisticalMeniscus:
    """Summits and film of a normalised row: σ_s = R = 1, so that 4/3 E* η = k, and F_max = m k."""
    density, tension = 2.0, 0.1
    largest = density * meniscus.film_force(1.0, tension, 0.0)
    modulus = 0.75 * largest / (row["m"] * density)
    return StatisticalMeniscus(GreenwoodWilliamson(modulus, density, 1.0, 1.0, heights=heights), tension, row["H"])


@every_row(reference("statistical_wet_normalised"))
def test_statistical_menisci(row):
    theory = wet(row)
    unit = 4.0 / 3.0 * theory.contact.E_star * theory.contact.density
    found = theory.at_pressure(row["w"] * unit)
    assert found.contact.separation[0] == pytest.approx(row["D"], rel=1e-11, abs=1e-12)
    # D carries 1e-12 and the tail changes by exp(D dD)
    assert found.meniscus_pressure[0] / unit == pytest.approx(row["fm"], rel=2e-11)
    assert found.meniscus_pressure[0] / found.pressure[0] == pytest.approx(row["Fm_over_W"], rel=2e-11)
    assert found.contact.area_fraction[0] / theory.contact.density == pytest.approx(row["area_norm"], rel=2e-11)
    assert theory.feedback(found.contact.separation)[0] == pytest.approx(row["picard_slope"], rel=2e-11)
    # what the summits carry is the load and the menisci
    assert found.contact.pressure[0] == pytest.approx(found.pressure[0] + found.meniscus_pressure[0], rel=1e-11)


@every_row(reference("statistical_wet_contact"))
def test_statistical_menisci_with_units(row):
    # a nominal area of one: densities are numbers, pressures are forces
    contact = GreenwoodWilliamson(row["Estar_Pa"], row["N0"], row["R_m"], row["sigma_p_m"])
    theory = StatisticalMeniscus(
        contact, row["gamma_N_per_m"], row["h_film_m"], contact_angle=math.radians(row["theta_deg"])
    )
    found = theory.at_pressure(row["W_N"])
    assert theory.largest == pytest.approx(row["Fm_max_N"], rel=1e-13)
    assert found.contact.separation[0] == pytest.approx(row["d_m"], rel=1e-10)
    assert found.meniscus_pressure[0] == pytest.approx(row["Fm_N"], rel=1e-10)
    assert found.contact.area_fraction[0] == pytest.approx(row["Ar_m2"], rel=1e-10)
    assert found.static_friction(row["mu_r"])[0] == pytest.approx(row["mu_s"], rel=1e-10)


@settings(max_examples=25)
@given(thin=st.floats(0.01, 1.0), thicker=st.floats(1.01, 3.0), load=st.floats(1e-4, 0.1))
def test_a_thicker_film_pulls_harder(thin, thicker, load):
    row = {"m": 0.05, "H": thin}
    less, more = (wet({**row, "H": H}).at_pressure(load).meniscus_pressure[0] for H in (thin, thicker * thin))
    assert more > less


def test_without_film_the_contact_is_dry():
    row = {"m": 0.05, "H": 1.0}
    theory = wet(row)
    layer = StatisticalMeniscus(theory.contact, theory.surface_tension, 0.1, molecular_layer=0.2)
    found = layer.at_pressure(0.01)
    dry = theory.contact.at_pressure(0.01)
    assert found.meniscus_pressure[0] == 0.0
    assert found.contact.separation[0] == pytest.approx(dry.separation[0], rel=1e-12)


def test_menisci_of_exponential_summits_are_proportional_to_the_load():
    """F_m = F_max exp(H - D) and L = k Γ(5/2) exp(-D): a constant ratio of meniscus force and
    load."""
    row = {"m": 0.1, "H": 0.5}
    theory = wet(row, ExponentialHeights())
    ratio = row["m"] * math.exp(row["H"]) / math.gamma(2.5)
    found = theory.at_pressure([1e-4, 1e-3, 1e-2])
    np.testing.assert_allclose(found.meniscus_pressure / found.contact.pressure, ratio, rtol=1e-10)


def test_pull_off():
    """At the pull-off load the balance has a double root: less tension is held, more is not."""
    theory = wet({"m": 0.5, "H": 1.0})
    separations = np.linspace(-6.0, 6.0, 20_001)
    net = theory.contact.at_separation(separations).pressure - theory.meniscus_pressure(separations)
    # the grid misses the minimum by at most half a step, its value by the square
    assert theory.pull_off == pytest.approx(-net.min(), rel=1e-6)
    assert wet({"m": 1e-6, "H": 0.01}).pull_off >= 0.0


def meniscus_share(skewness: float = 0.0, kurtosis: float = 3.0, film: float = 2e-9, **changed: float) -> float:
    """Meniscus force over a light load on summits with heights of this shape."""
    numbers = {"E_star": 50e9, "density": 1e12, "radius": 1e-6, "height_deviation": 5e-9, "surface_tension": 0.072}
    model = WetSummits(**(numbers | changed), film_thickness=film, skewness=skewness, kurtosis=kurtosis)
    found = model.at_pressure(1e5)
    return float(found.meniscus_pressure[0] / found.pressure[0])


def test_few_high_summits_stick_less_and_mind_the_film_less():
    """Published trends: positive skewness and a kurtosis of 5 and more lower the meniscus force and
    its rise with the film."""
    by_skewness = [meniscus_share(skewness, 3.5) for skewness in (-0.5, 0.0, 0.3, 0.5)]
    assert (np.diff(by_skewness) < 0.0).all()
    by_kurtosis = [meniscus_share(0.0, kurtosis) for kurtosis in (2.2, 3.0, 5.0, 8.0)]
    assert (np.diff(by_kurtosis) < 0.0).all()
    assert meniscus_share(0.5, 5.0) < 0.5 * meniscus_share()
    rises = [
        meniscus_share(*shape, film=5e-9) / meniscus_share(*shape, film=1e-9) for shape in ((0.0, 3.0), (0.5, 5.0))
    ]
    assert rises[1] < rises[0]


def test_what_lowers_the_meniscus_force():
    """It rises steeply with the film, and falls with the roughness and the stiffness."""
    by_film = np.array([meniscus_share(film=film) for film in (1e-9, 2e-9, 4e-9, 8e-9)])
    doubled = by_film[1:] / by_film[:-1]
    assert (np.diff(doubled) > 0.0).all(), "ever more steeply up to films of the order of the roughness"
    assert doubled[-1] > 3.0
    assert meniscus_share(height_deviation=1e-8) < meniscus_share() < meniscus_share(E_star=25e9)


def test_plain_numbers_make_the_same_theories():
    """The catalogue's theories from plain numbers against those from parts."""
    contact = GreenwoodWilliamson(50e9, 2e12, 1e-6, 2e-9, 1e-9)
    numbers = (50e9, 2e12, 1e-6, 2e-9, 0.025, 1.5e-9)
    assert WetSummits(*numbers, 0.2, 1e-9).theory == StatisticalMeniscus(contact, 0.025, 1.5e-9, contact_angle=0.2)
    grown_ = GrowingMenisci(*numbers, 0.2, 5e-20, 0.2)
    loads = np.array([1e5])
    found = grown_.at_time([0.0, 1e-4], 1e5)
    each = [grown_.theory.at(time, loads).meniscus_pressure[0] for time in (0.0, 1e-4)]
    assert found.meniscus_pressure == pytest.approx(each, rel=1e-12)
    assert found.height == pytest.approx(grown_.theory.growth.height([0.0, 1e-4]))


@every_row(reference("kinetic_meniscus_height"))
def test_height_of_a_growing_meniscus(row):
    assert float(grown(row["tau"], row["y0"])) == pytest.approx(row["y"], rel=1e-11)


@every_row(reference("kinetic_meniscus_times"))
def test_times_of_growth(row):
    growth = MeniscusGrowth(
        row["R_m"],
        row["gamma_N_per_m"],
        row["h_m"],
        row["viscosity_Pa_s"],
        row["hamaker_J"],
        contact_angle=math.radians(row["theta_deg"]),
        radius_ratio=row["radius_ratio"],
    )
    assert growth.disjoining_pressure == pytest.approx(row["disjoining_Pa"], rel=1e-12)
    assert growth.equilibrium_height == pytest.approx(row["s_eq_m"], rel=1e-12)
    assert growth.start == pytest.approx(row["y0"], rel=1e-12)
    assert growth.time_scale == pytest.approx(row["t0_s"], rel=1e-12)
    assert growth.time_to(0.99) == pytest.approx(row["t99_s"], rel=1e-12)
    assert float(growth.height(growth.time_to(0.99))) == pytest.approx(0.99 * growth.equilibrium_height, rel=1e-10)
    assert float(growth.height(0.0)) == pytest.approx(row["h_m"], rel=1e-12)


@every_row(reference("kinetic_meniscus_force"))
def test_force_of_growing_menisci(row):
    found = float(caught(GaussianHeights(), np.array(row["D"]), row["H"], row["S"]))
    assert found == pytest.approx(row["fm_over_N0_max"], rel=1e-11)
    whole = float(caught(GaussianHeights(), np.array(row["D"]), row["H"], math.inf))
    assert found / whole == pytest.approx(row["relative_to_equilibrium"], rel=1e-11)


@settings(max_examples=40)
@given(D=st.floats(-1.0, 3.0), film=st.floats(0.05, 2.0), more=st.floats(1.0, 5.0))
def test_the_force_of_growing_menisci_is_its_integral(D, film, more):
    height = film * more
    density = lambda s: float(GaussianHeights().density(np.array(s)))  # noqa: E731 - a name for the integrand
    touching = quad(density, D, 12.0, epsabs=1e-13)[0]
    near = quad(lambda s: (1.0 - (D - s) / height) * density(s), D - film, D, epsabs=1e-13)[0]
    assert float(caught(GaussianHeights(), np.array(D), film, height)) == pytest.approx(touching + near, rel=1e-8)


def test_stiction_grows_with_time_towards_the_statistical_value():
    contact = GreenwoodWilliamson(50e9, 2e12, 1e-6, 2e-9)
    statistical = StatisticalMeniscus(contact, 0.025, 1.5e-9, contact_angle=math.radians(10.0))
    growth = MeniscusGrowth(1e-6, 0.025, 1.5e-9, 0.2, 5e-20, contact_angle=math.radians(10.0))
    model = KineticMeniscus(statistical, growth)
    load = np.array([1e5])
    forces = [model.at(t * growth.time_scale, load).meniscus_pressure[0] for t in (0.0, 0.01, 0.1, 1.0, 10.0)]
    assert (np.diff(forces) > 0.0).all()
    final = statistical.at_pressure(load).meniscus_pressure[0]
    # at the end s = s_eq, and gaps of the film's order are left out of the statistical value
    assert forces[-1] < final
    assert forces[-1] == pytest.approx(final, rel=2.0 * statistical.film_thickness / growth.equilibrium_height)


def test_times_grow_with_thickness_viscosity_and_radius():
    base = {
        "radius": 1e-6,
        "surface_tension": 0.025,
        "film_thickness": 1e-9,
        "viscosity": 0.1,
        "hamaker_constant": 5e-20,
    }
    scale = MeniscusGrowth(**base).time_scale
    for name, power in (("radius", 1), ("viscosity", 1), ("film_thickness", 6)):
        assert MeniscusGrowth(**{**base, name: 2.0 * base[name]}).time_scale == pytest.approx(2.0**power * scale)


def test_inputs_out_of_range_are_refused():
    with refused(InputError, "contact angles"):
        meniscus.wetting_factor(math.radians(120.0), math.radians(80.0))
    with refused(InputError, "contact angle (rad)", "0"):
        meniscus.wetting_factor(4.0)
    with refused(InputError, "relative humidity"):
        meniscus.kelvin_radius(1.0, 0.07, 1.8e-5)
    with refused(InputError, "film thickness (m)"):
        MeniscusGrowth(1e-6, 0.025, 1e-10, 0.1, 1e-19)
    with refused(NoSolutionError, "load (Pa) with its menisci"):
        wet({"m": 0.1, "H": 1.0}).at_pressure(1e9)
