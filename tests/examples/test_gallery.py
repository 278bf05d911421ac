"""The examples run as pasted, are short, label their pictures, and agree with closed forms,
published values and laws."""

from __future__ import annotations

import ast
import itertools
import math
import os
import runpy
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes

import asperity as asp

FOLDER = Path(__file__).parents[2] / "examples"
SCRIPTS = sorted(path.relative_to(FOLDER).with_suffix("").as_posix() for path in FOLDER.glob("*/*.py"))
LIGHT = (math.sqrt(8.0 / math.pi), math.sqrt(2.0 * math.pi))
"""κ = (A/A₀) E* h'/p at light load: Persson (2001), and Bush, Gibson & Thomas (1975), between which
solutions lie."""


@pytest.fixture(scope="module", autouse=True)
def no_windows() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plt, "show", lambda: None)
        yield


def run(name: str) -> SimpleNamespace:
    """What the script ``name`` leaves behind; its pictures say what they show."""
    home = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            left = runpy.run_path(str(FOLDER / f"{name}.py"), run_name="__main__")
            assert not list(Path(folder).iterdir()), "files of an example belong into a folder of its own"
            figures = [plt.figure(number) for number in plt.get_fignums()]
            assert figures
            assert [ax for figure in figures for ax in figure.axes if not labelled(ax)] == []
        finally:
            os.chdir(home)
            plt.close("all")
    return SimpleNamespace(**left)


def labelled(ax: Axes) -> bool:
    """Whether data are drawn on ``ax``, and it is said what is along x and y, or in the colours of
    a bar."""
    if ax.get_label() == "<colorbar>":
        return bool(ax.get_ylabel())
    shared = any(other is not ax and other.get_ylabel() for other in ax.get_shared_y_axes().get_siblings(ax))
    return ax.has_data() and bool(ax.get_xlabel()) and (bool(ax.get_ylabel()) or shared)


def scatter(surface: asp.Surface, spectrum, weight) -> tuple[float, float]:
    """Expected Σ weight·C/A over the modes of ``surface``, and its standard deviation over random
    surfaces, relative.

    The powers of the modes of half a plane are independent and exponentially distributed.
    """
    grid = surface.grid
    power = spectrum.lattice_psd(grid) * weight
    pairs = np.full(power.shape, 2.0)
    pairs[:, [0, -1]] = 1.0  # whose partners are in the same half plane
    total = float((pairs * power).sum())
    return total / grid.area, math.sqrt(2.0 * float((pairs * power**2).sum())) / total


def balanced(result: asp.ContactResult) -> bool:
    """Whether the contact bears the load and what the menisci pull, within the tolerance that the
    certificate states."""
    both = result.external_force + result.menisci.meniscus_force
    check = next(item for item in result.certificate.couplings if item.name == "menisci")
    return check.tolerance < 0.01 and abs(both / result.force - 1.0) <= check.tolerance


@pytest.mark.parametrize("name", SCRIPTS)
def test_an_example_is_short_and_listed(name):
    text = (FOLDER / f"{name}.py").read_text(encoding="utf-8")
    code = text.splitlines()[ast.parse(text).body[0].end_lineno :]
    assert len([line for line in code if line.strip() and not line.startswith("#")]) < 45
    assert "\n# %%\n" in text
    assert f"]({name}.py) |" in (FOLDER / "README.md").read_text(encoding="utf-8")


def test_every_example_is_tested():
    here = Path(__file__).read_text(encoding="utf-8")
    assert [name for name in SCRIPTS if f'run("{name}")' not in here] == []
    assert len(SCRIPTS) >= 16


def test_scan_to_report():
    """The file gives back the heights; preparation takes out tilt and offsets; the area lies
    between two theories."""
    left = run("beginner/plot_1_scan_to_report")
    assert left.scan.heights == pytest.approx(left.measured, abs=0.51e-12, rel=0.0)  # the file counts in pm
    assert left.scan.size == pytest.approx(left.grid.size, rel=1e-12)
    # slopes of a plane and of lines are gone: what is left is the roughness, but for what lines and
    # plane took of it
    assert asp.roughness.rms_height(left.ready) == pytest.approx(left.rough.std(), rel=0.1)
    slope = asp.roughness_of(left.ready).rms_gradient
    kappa = left.result.area_fraction_corrected * left.problem.contact_modulus * slope / left.result.mean_pressure
    assert LIGHT[0] < kappa < LIGHT[1]
    assert "</html>" in (left.folder / "report.html").read_text(encoding="utf-8")


def test_generated_surface():
    """Mean square slope as prescribed, within four standard deviations; the rms height of fixed
    amplitudes is exact."""
    left = run("beginner/plot_2_generate_a_surface")
    expected, deviation = scatter(left.surface, left.spectrum, left.grid.wavenumber() ** 2)
    assert math.sqrt(expected) == pytest.approx(0.1, rel=1e-12)
    moments = left.found.moments.spectral
    assert moments.m20 + moments.m02 == pytest.approx(0.01, rel=4.0 * deviation)
    assert asp.roughness.rms_height(left.rough) == pytest.approx(10e-9, rel=1e-9)
    assert sorted(left.slopes.values()) == [left.slopes[wave] for wave in (1e-6, 0.5e-6, 0.25e-6)]


def test_hertz():
    """Pressure of second order in the pixel; the rim known within half a pixel."""
    left = run("beginner/plot_3_hertz")
    errors = left.errors["largest pressure"]
    assert errors[-1] < 1.5 * errors[-2] / 4.0 < 1e-4
    radius = math.sqrt(left.result.contact_area / math.pi)
    assert radius == pytest.approx(float(left.exact.radius), abs=0.5 * left.result.problem.grid.spacing[0])
    assert left.result.approach == pytest.approx(float(left.exact.approach), rel=1e-3)


def test_roughness_parameters():
    """Sa = √(2/π) Sq for Gaussian heights; the other surface has the moments that were asked
    for."""
    left = run("beginner/plot_4_roughness_parameters")
    gaussian, plateau = (found.heights for found in left.found.values())
    assert gaussian.Sa / gaussian.Sq == pytest.approx(math.sqrt(2.0 / math.pi), rel=1e-3)
    assert (plateau.Ssk, plateau.Sku) == pytest.approx((-1.5, 6.0), rel=1e-2)
    assert plateau.Sq == pytest.approx(gaussian.Sq, rel=1e-2)


def test_stress_below_a_coating():
    """Equilibrium: every plane carries load and friction."""
    left = run("intermediate/plot_1_stress_below_a_coating")
    assert left.field.normal_zz.mean(axis=(1, 2)) == pytest.approx(-200e6, rel=1e-9)
    assert left.field.shear_xz.mean(axis=(1, 2)) == pytest.approx(-60e6, rel=1e-9)


def test_load_and_unload():
    """Plastic work is hardness times indented volume; unloading and reloading take none; the
    energies balance."""
    path = run("intermediate/plot_2_load_and_unload").path
    work = np.array([step.plastic_work for step in path.steps])
    assert np.abs(work[8:22]).max() < 1e-6 * work.max()
    last = path.steps[-1]
    assert last.total_plastic_work == pytest.approx(1.2e9 * last.plastic_volume, rel=1e-6)
    assert last.total_plastic_work == pytest.approx(work.sum(), rel=1e-9)
    assert path.energies.relative_error < 0.01  # trapezoids of eight steps


def test_theories_beside_the_solution():
    left = run("intermediate/plot_3_theories_beside_the_solution")
    persson = left.found.kappa(left.found.curve("persson").prediction.area_fraction)
    assert persson[0] == pytest.approx(LIGHT[0], rel=1e-3)  # the error function bends with the square of p
    assert LIGHT[0] < left.kappa[0] < LIGHT[1]


def test_menisci_and_humidity():
    """Kelvin and Laplace: Δp = (RT/V) ln(1/φ) at 293.15 K, V = 18.048 cm³/mol; the contact bears
    load and menisci."""
    left = run("intermediate/plot_4_menisci_and_humidity")
    kelvin = 8.314462618 * 293.15 / 18.048e-6 * np.log(1.0 / left.humidity)
    assert left.suction == pytest.approx(kelvin, rel=1e-6)
    for result, found in zip(left.results, left.menisci, strict=True):
        assert found.meniscus_force == pytest.approx(
            found.suction * found.meniscus_area_fraction * left.surface.grid.area
        )
        assert balanced(result)


@pytest.mark.slow
def test_fretting_loop():
    """Masing's rule, exact for equal bodies at constant load; heat between the cube and the first
    power of the amplitude."""
    left = run("intermediate/plot_6_fretting_loop")
    assert left.masing < 1e-3
    assert 0.2 < left.slipping < 0.9
    assert 3.1 > left.exponents[0] > left.exponents[1] > 1.0


@pytest.mark.slow
def test_pull_off_of_a_rough_surface():
    """The work of the closed cycle is what was lost; the stiff pad jumps less, loses less and holds
    less than the soft one."""
    left = run("intermediate/plot_7_pull_off_of_a_rough_surface")
    soft, stiff = left.loops.values()
    assert abs(np.trapezoid(soft.force, soft.approach) - soft.hysteresis) <= soft.hysteresis_error
    assert soft.jumped.any()
    assert not stiff.jumped.any()
    assert soft.hysteresis > 100.0 * abs(stiff.hysteresis)
    assert soft.pull_off_force > stiff.pull_off_force
    assert all(history.last.adhesion.resolved for history in left.histories.values())


@pytest.mark.slow
def test_rough_wheel():
    """Carter's curve; the soft layer bends the curve of the plain rollers down; roughness hardly
    changes the force."""
    left = run("intermediate/plot_8_rough_wheel")
    limit = left.plain.friction_limit
    assert left.plain.longitudinal_force == pytest.approx(left.carter.force_x, abs=0.01 * limit)
    assert np.all(left.layered.longitudinal_force[:4] < left.plain.longitudinal_force[:4])
    assert 0.4 < left.share < 0.8
    assert left.mean == pytest.approx(left.plain.longitudinal_force[2], rel=0.03)


def test_polymer_coating():
    """The coating creeps less than the thick polymer, no energy is lost, and both recover."""
    left = run("intermediate/plot_9_polymer_coating")
    grown = [result.steps[2].approach / result.steps[0].approach for result in left.found.values()]
    assert 1.0 < grown[0] < grown[1] < 5.0
    for result in left.found.values():
        assert result.energies.relative_error < 0.3, "the load at once is one trapezium"
        assert result.last.approach < 0.05 * result.steps[2].approach


@pytest.mark.slow
def test_rubber_on_rough_ground():
    """Friction rises and falls with speed, the area falls, and theory and solution peak within a
    decade of each other."""
    left = run("advanced/plot_8_rubber_on_rough_ground")
    peak = int(left.friction.argmax())
    assert 0 < peak < 6
    assert np.all(np.diff(left.friction[: peak + 1]) > 0.0)
    assert np.all(np.diff(left.friction[peak:]) < 0.0)
    assert left.area[0] > 3.0 * left.area[-1]
    theory = np.array([each.friction for each in left.theory])
    assert abs(int(theory.argmax()) - peak) <= 2
    slopes = np.array([each.slope_friction for each in left.found])
    np.testing.assert_allclose(slopes[: peak + 1], left.friction[: peak + 1], rtol=0.1)


def test_wet_and_sliding():
    """Friction resists load and menisci: μ_s = μ (1 + F/W); both fall towards the dry values as the
    load grows."""
    left = run("intermediate/plot_5_wet_and_sliding")
    assert left.static == pytest.approx(0.3 * (1.0 + left.pull), rel=1e-12)
    assert np.all(np.diff(left.static) < 0.0)
    assert all(balanced(step) for step in left.path.steps)


def test_film_thickness():
    """One meniscus pulls with 4πRγ, its area counted in pixels; no film pulls harder than its
    suction on everything."""
    left = run("advanced/plot_1_film_thickness")
    radii = np.sqrt(2.0 * 1e-6 * left.films) / 2e-9  # of the menisci in pixels
    assert np.all(np.abs(left.single / left.closed_form - 1.0) < 0.5 / radii)
    for force in left.rough.values():
        assert np.all(force < 2.0 * left.lubricant.surface_tension / left.films / left.load.value)


def test_sampling_interval():
    """Mean squares of differences as expected of the spectrum, within four standard deviations."""
    left = run("advanced/plot_2_sampling_interval")
    qx = left.fine.grid.wavevector()[0]
    for number in range(4):
        step = left.interval[number]
        expected, deviation = scatter(left.fine, left.spectrum, (2.0 * np.sin(0.5 * qx * step) / step) ** 2)
        assert left.expected[number] == pytest.approx(expected, rel=0.01)  # an integral for the sum over the modes
        assert left.study.mean["m2_x"][number] == pytest.approx(expected, rel=4.0 * deviation)
    # from one interval to twice it within a tenth; each area is known to a quarter and worse, for
    # its contacts have few pixels
    assert all(max(pair) < 1.1 * min(pair) for pair in itertools.pairwise(left.product))
    assert max(left.product) < 1.15 * min(left.product)


def test_running_in():
    """At one place the second pass is elastic; the hardness carries the load; new places give way
    less and less."""
    left = run("advanced/plot_3_running_in")
    assert left.same[1].plastic_work < 1e-6 * left.same[0].plastic_work
    work = np.array([result.plastic_work for result in left.sliding])
    assert work[-8:].mean() < 0.5 * work[0]
    for result in left.sliding:
        assert result.area_fraction >= 60e6 / 1.2e9
        assert result.max_pressure <= 1.2e9 * (1.0 + 1e-9)


def test_before_and_after_polishing():
    """Height parameters of a Gaussian surface that is cut at half its rms height."""
    left = run("advanced/plot_4_before_and_after_polishing")
    z = np.linspace(-8.0, 8.0, 16001)
    weight = np.exp(-0.5 * z**2) / np.exp(-0.5 * z**2).sum()
    cut = np.minimum(z, 0.5) - (np.minimum(z, 0.5) * weight).sum()
    rms = math.sqrt((cut**2 * weight).sum())
    before, after = (left.parameters[name].heights for name in ("before", "after"))
    # a map of 16 µm holds about 2 L²/πβ² = 260 independent heights, β = 0.79 µm where the
    # correlation is 1/e
    error = 4.0 / math.sqrt(2.0 * 260)
    assert after.Sq / before.Sq == pytest.approx(rms, rel=error)
    assert after.Ssk == pytest.approx((cut**3 * weight).sum() / rms**3, abs=4.0 * math.sqrt(6.0 / 260))
    assert left.results["after"].area_fraction_corrected > 3.0 * left.results["before"].area_fraction_corrected


def test_own_materials():
    """The area is a function of pressure over E* alone."""
    left = run("advanced/plot_5_own_materials")
    first, second = left.areas.values()
    assert first == pytest.approx(second, rel=1e-4)  # a pixel of the rim more or less
    assert left.coating.strength.hardness == 21e9


def test_theory_of_your_own():
    left = run("expert/plot_1_theory_of_your_own")
    rule, persson = (left.found.curve(name).prediction.area_fraction for name in ("rule of thumb", "persson"))
    assert left.found.kappa(rule)[0] == pytest.approx(2.2, rel=2e-3)
    assert np.all(rule > persson)
    assert np.abs(left.found.deviation("rule of thumb")[:3]).max() < 0.1


def test_part_of_your_own():
    """Holm's 2a/ρ for a circle; the grid of 0.5 µm holds the stiffness of a radius of 17 µm within
    a tenth of a pixel."""
    left = run("expert/plot_2_part_of_your_own")
    ball = left.conductance(left.ball, asp.Free(), asp.Force(0.5))
    assert ball == pytest.approx(left.holm, rel=0.1 * 0.5 / 17.0)
    assert np.polyfit(np.log(left.loads), np.log(left.found), 1)[0] == pytest.approx(1.0, abs=0.1)


def test_campaign_on_dask():
    """The cluster gives what one solve gives, and a stiffer coating less area the thicker it is."""
    left = run("expert/plot_3_campaign_on_dask")
    alone = asp.run(left.study["problem"]).result.area_fraction_corrected
    area = left.data.area_fraction_corrected
    assert float(area.sel(pressure=10e6, thickness=100e-9, method="nearest")) == pytest.approx(alone, rel=1e-9)
    assert np.all(area.diff("thickness") < 0.0)


def test_critical_coating_thickness():
    """Hertz with the modulus of the substrate and of the coating are the ends, up to the ratio of
    thickness and contact."""
    left = run("expert/plot_4_critical_coating_thickness")
    for way in left.curves.values():
        assert way[0] == pytest.approx(0.0, abs=4.0 * 0.01)
        assert way[-1] == pytest.approx(1.0, abs=0.01)
        assert np.all(np.diff(way) > -1e-3)


@pytest.mark.slow
def test_yield_map_under_friction():
    """First yield below a sliding cylinder in closed form, Johnson's 1.79 without friction; an edge
    known within a pixel."""
    left = run("expert/plot_5_yield_map_under_friction")
    assert left.closed_form[0] == pytest.approx(1.79, abs=0.005)
    assert left.factor[0] == pytest.approx(left.closed_form, rel=0.02)


@pytest.mark.slow
def test_flow_below_a_rough_coating():
    """Flow enlarges the real area and leaves residual stress that balances itself on every vertical
    plane; the zones stay in their layers."""
    left = run("advanced/plot_11_flow_below_a_rough_coating")
    assert left.share > left.elastic_share
    film, steel = left.flow.zones
    assert 0.0 <= film.top < film.bottom <= 200e-9 * (1.0 + 1e-9) <= steel.bottom
    assert 0.0 < steel.largest_strain < 0.1
    assert left.off.force == 0.0
    whole = left.flow.stress()[:, 2].mean(axis=(1, 2))
    assert np.abs(whole).max() < 1e-3 * np.abs(left.flow.stress()[:, 2]).max()  # no force through any depth


@pytest.mark.slow
def test_gold_plated_connector():
    """More load and more gold make less resistance, and all less than one circle of nickel as large
    as the area, load over hardness; patches in parallel share it."""
    left = run("advanced/plot_13_gold_plated_connector")
    assert np.all(np.diff(left.milliohm, axis=2) < 0.0)
    assert np.all(np.diff(left.milliohm, axis=0) < 0.0)
    one_circle = 1e3 * 69.3e-9 / (2.0 * np.sqrt(left.loads / 1.8e9 / math.pi))
    assert np.all(left.milliohm < one_circle)
    assert left.flow.spots.needed() < left.flow.spots.flow.size / 3
    assert left.number == pytest.approx(98.4, abs=0.1)


def test_design_of_a_disk_coating():
    """Yield is at 1.5 times the load of the shock, and less roughness pulls more."""
    design = run("advanced/plot_15_design_of_a_disk_coating").design
    assert design.feasible
    assert design.active == ("yield_load_factor",)
    smoother = next(change for change in design.changes if change.variable == "roughness")
    assert smoother.value < design["roughness"]
    assert smoother.objective > 1.2 * design.objective.value
    assert smoother.margins[0] > 0.03


def test_design_of_a_connector():
    """Less gold yields; along the front a rougher contact takes more gold."""
    design = run("advanced/plot_16_design_of_a_connector").design
    assert design.feasible
    thinner = next(change for change in design.changes if change.variable == "gold")
    assert thinner.value < design["gold"]
    assert thinner.margins[0] < -0.05
    gold, roughness = np.array([(point.objective, point.second) for point in design.front]).T
    assert len(gold) == 5
    assert np.all(np.diff(gold) < 0.0)
    assert np.all(np.diff(roughness) < 0.0)


@pytest.mark.slow
def test_shakedown_of_a_roller():
    """Below the limit flow ceases, above it goes on; a compression below the surface protects, and
    pulls nothing across the plane as a whole."""
    left = run("expert/plot_8_shakedown_of_a_roller")
    low, high = (np.array(left.growth[share]) for share in (0.9, 1.15))
    assert low[-1] < 1e-3 * low[0]
    assert high[-1] > 0.5 * high[0]
    for depth, stress in left.residual.values():
        protected = (depth > 0.4 * left.half_width) & (depth < 0.9 * left.half_width)
        assert np.all(stress[protected][:, :2] < 0.0)


@pytest.mark.slow
def test_shakedown_map():
    """Bare steel in closed form within the pixels; the coating that is twice as strong helps at the
    surface, where friction sets the limit."""
    left = run("expert/plot_7_shakedown_map")
    k = 1e9 / np.sqrt(3.0)
    assert left.curves[0].limit * 1e9 / k == pytest.approx([found.peak_over_k for found in left.closed_form], rel=0.02)
    assert left.curves[0].bound * 1e9 / k == pytest.approx([found.bound_over_k for found in left.closed_form], rel=0.02)
    assert np.all(left.found.limit[1:, -1] > left.found.limit[0, -1])


@pytest.mark.slow
def test_ensemble_with_error_bars():
    """Between two theories at light load; both kinds of amplitudes have one mean, within their
    error bars."""
    left = run("expert/plot_6_ensemble_with_error_bars")
    for variant in ("random", "fixed"):
        assert LIGHT[0] < left.kappa[variant][1] - left.half_width[variant][1]
        assert left.kappa[variant][1] + left.half_width[variant][1] < LIGHT[1]
    apart = np.abs(left.kappa["random"] - left.kappa["fixed"])
    assert np.all(apart < 2.0 * np.hypot(left.half_width["random"], left.half_width["fixed"]))


@pytest.mark.slow
def test_why_a_brake_squeals():
    """Below the critical friction nothing grows; vibration lowers the friction that is felt, but
    not at ten times the speed."""
    left = run("advanced/plot_6_why_a_brake_squeals")
    growing = left.stable.growth_rate[:, np.searchsorted(left.stable.axis_values[1], left.pad.height)] > 0.0
    first = left.stable.axis_values[0][np.argmax(growing)]
    assert abs(first - left.pad.critical_friction()) < 0.04  # two steps of the map
    assert left.numbers["apparent_friction"] < 0.8 * left.pad.friction
    assert left.swift["apparent_friction"] > 0.95 * left.pad.friction
    assert left.squeal.motion.energy_error < 1e-5


def test_stiction_of_a_disk_drive():
    """The first slip is where the spring bears the static friction: after μ_s W/(k U)."""
    left = run("advanced/plot_7_stiction_of_a_disk_drive")
    assert np.all(np.diff(left.static) > 0.0)
    for mu, motion in zip(left.static, left.starts, strict=True):
        held = 0.02 * left.speed  # of the dashpot, while the slider moves with the disk
        first = (mu * left.load - held) / (left.stiffness * left.speed)
        assert motion.events[0].time == pytest.approx(first, rel=1e-9)


def test_law_of_an_interface():
    """Frequencies are those of the tangent stiffness; after plastic flow the joint is stiffer than
    its loading curve, as the fit says."""
    left = run("advanced/plot_9_law_of_an_interface")
    top, curve = left.up[-1], left.curves["plastic"]
    loading, unloading = ((top - left.up[-2]) / (curve[7] - curve[place]) for place in (6, 8))
    assert unloading > 1.3 * loading
    law = left.fits["plastic, unloading"].law
    chord = (top - left.down[0]) / float(law.approach(top) - law.approach(left.down[0]))
    assert chord == pytest.approx(unloading, rel=0.15)
    step = 1e-6 * top
    tangent = 2.0 * step / float(law.approach(top + step) - law.approach(top - step))
    expected = math.sqrt(tangent * 20e-4 / 20.0) / (2.0 * math.pi)
    assert left.frequencies["plastic, unloading"] == pytest.approx(expected, rel=1e-6)
    assert left.frequencies["plastic, unloading"] > 1.2 * left.frequencies["plastic, loading"]


def test_a_metal_seal():
    """The rate falls with the load ever faster and within its brackets; nothing leaks from the
    closing load on, at 0.3 to 0.5 of the area, and lines of flow obey the balance."""
    left = run("advanced/plot_12_a_metal_seal")
    rates = np.array([leak.rate for leak in left.leaks])
    assert (np.diff(np.log(rates)) / np.diff(left.loads) < 0.0).all()
    slopes = np.diff(np.log(rates)) / np.diff(np.log(left.loads))
    assert (np.diff(slopes) < 0.0).all()
    assert all(leak.bracket.lower <= leak.rate <= leak.bracket.upper for leak in left.leaks)
    assert 0.3 < left.closing.open_fraction <= left.closing.closed_fraction < 0.5
    sealed = asp.sealing.leakage(asp.solve(left.problem, asp.MeanPressure(left.closing.upper)), left.helium, 2e5)
    assert sealed.sealed
    assert sealed.rate == 0.0
    assert left.flow.section_error < 1e-8


@pytest.mark.slow
def test_a_coating_that_bends():
    """The coating carries more and leaves a shallower imprint; it is pulled beneath the tip from
    below and beside the contact from above."""
    left = run("advanced/plot_10_a_coating_that_bends")
    coated, bare = left.found["coated"], left.found["bare"]
    assert coated.load[11] > 1.3 * bare.load[11]
    assert coated.hardness > bare.hardness
    assert coated.imprint[0] < bare.imprint[0]
    assert coated.load[12] == bare.load[12] == 0.0
    under = left.fields.net_axial_force()[:5]
    np.testing.assert_allclose(under, -coated.load[11], rtol=1e-5)
    assert left.tension.largest_bottom[1] < 0.6 * coated.contact_radius[11]
    assert left.tension.largest_top[1] > 0.9 * coated.contact_radius[11]


@pytest.mark.slow
def test_fretting_of_a_sphere():
    """A ring in partial slip; a scar, deepest in its middle, where all slips by four shifts a
    cycle."""
    left = run("intermediate/plot_10_fretting_of_a_sphere")
    ring, scar = left.found.values()
    middle = left.points // 2
    assert ring.depth[middle, middle] == 0.0
    assert scar.depth.max() == pytest.approx(scar.depth[middle, middle], rel=0.02)
    slid = 4.0 * 2e-6 * 4000
    assert scar.worn_volume == pytest.approx(2.0 * 1e-14 * 10.0 * slid, rel=0.15), "but for what sticks at the turns"
    assert max(ring.error, scar.error) < 0.05


def test_predicted_scaling():
    """Counted areas of Peng (2001, table 3.1) within 4 %, and the laws as local slopes."""
    left = run("intermediate/plot_11_predicted_scaling")
    for ratio, (loads, areas) in left.published.items():
        found = np.exp(np.interp(np.log(loads), np.log(left.loads), np.log(left.areas[ratio])))
        assert found == pytest.approx(areas, rel=0.04)
        slopes = np.diff(np.log(left.areas[ratio])) / np.diff(np.log(left.loads))
        light = left.areas[ratio][1:] < 0.1  # far from full contact the area goes as X^0.9
        assert slopes[light] == pytest.approx(0.9, abs=0.06)


def test_similar_contacts():
    """Stresses over E₂σ/β are the same under heights and loads a tenth and under twice the size;
    the largest lies in the predicted band."""
    left = run("intermediate/plot_12_similar_contacts")
    first, *others = left.cases
    for ratio in (2.0, 0.5):
        for other in others:
            np.testing.assert_allclose(left.curves[ratio, other], left.curves[ratio, first], rtol=1e-4)
    low, high = (end / left.unit for end in left.predicted.max_sqrtJ2_layer.band)  # of the soft coating
    assert low < left.curves[0.5, first].max() < high


def test_profiles_on_layers():
    """The force of menisci between that of a base of each material, solved and predicted."""
    left = run("intermediate/plot_13_profiles_on_layers")
    for ratio, ends in ((0.5, (1.0, 1.8)), (2.0, (0.5, 1.0))):
        for coated, base in zip(left.forces[ratio, "coated"], left.forces[ratio, "base"], strict=True):
            over = coated / base
            assert np.all((over > ends[0]) & (over < ends[1]))
            assert abs(np.log(over[-1])) > abs(np.log(over[0])) + 0.3
        solved, predicted = (
            of / base for of, base in zip(left.forces[ratio, "coated"], left.forces[ratio, "base"], strict=True)
        )
        assert predicted == pytest.approx(solved, rel=0.2)


def test_pin_on_a_coated_disk():
    """Volumes by the forces; the track wears alike along it, and lasts longer than at its first
    width."""
    left = run("advanced/plot_14_pin_on_a_coated_disk")
    assert left.even < left.history.breakthrough < 600.0
    early = [contact for distance, contact in left.history.kept if distance == 300.0]
    depth = -early[0].problem.counter_surface.heights
    np.testing.assert_allclose(depth, depth[:1] * np.ones((96, 1)), rtol=1e-12)
    length = 96 * 2.5e-6
    volume = depth.sum() * (2.5e-6) ** 2 * 60e-3 / length
    assert volume == pytest.approx(1e-15 * 5.0 * 300.0, rel=1e-6)
    assert left.history["body_volume"][-1] == pytest.approx(1e-17 * 5.0 * 600.0, rel=1e-6)
