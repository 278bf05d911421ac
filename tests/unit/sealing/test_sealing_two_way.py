"""The pressure of a fluid on both bodies: exact equivalence under an even pressure, limits, balance
of forces and energies, agreement with a plain iteration, histories, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.core.errors import InputError, NoSolutionError
from asperity.parts.advice import review
from asperity.physics.sealing.acting import acting_pressure
from asperity.physics.sealing.flow import flow_through, gap_flow
from asperity.physics.sealing.fluids import IdealGas, ViscousLiquid
from asperity.physics.sealing.law import FluidPressure
from asperity.physics.sealing.leak import leakage

OIL = ViscousLiquid(0.1)
STEEL = asp.Elastic(100e9, 0.3)
COATED = asp.Layered([asp.Layer(asp.Elastic(300e9, 0.3), thickness=2e-6)], base=STEEL)
SIDE = 1e-4


def rough(n: int = 48, seed: int = 3) -> asp.Surface:
    """Gaussian heights of 1 µm with waves from 25 µm on."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-6),
        hurst=0.8,
        rolloff_wavelength=SIDE / 3.0,
        shortest_wavelength=SIDE / 6.0,
    )
    return asp.generate.gaussian(asp.Grid((n, n), (SIDE / n, SIDE / n)), spectrum, seed=seed)


def wavy(n: int = 48) -> asp.Surface:
    """One wave along each axis."""
    x = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    return asp.Surface(1e-6 * np.cos(x)[:, None] * np.cos(x)[None], SIDE / n)


def wet(surface: asp.Surface, pressure: float, control: Any, **options: Any) -> Any:
    """Contact of ``surface`` under a fluid whose pressure falls from ``pressure`` (Pa) to zero."""
    fluid = {key: options.pop(key) for key in ("outlet", "driven", "back", "way") if key in options}
    body, given = options.pop("body", STEEL), FluidPressure(options.pop("fluid", OIL), pressure, **fluid)
    return asp.solve(asp.ContactProblem(surface, body, fluid_pressure=given, **options), control)


@pytest.mark.parametrize("body", [STEEL, COATED])
@pytest.mark.parametrize("driven", ["sides", "gradient"])
def test_even_pressure_is_the_dry_contact_under_the_load_that_is_left(body: Any, driven: str) -> None:
    """A uniform pressure moves a periodic surface as a whole: p = p0 + p', exactly."""
    surface, even, load = wavy(), 2e8, 5e8
    found = wet(surface, even * (1.0 + 1e-12), asp.MeanPressure(load), outlet=even, driven=driven, body=body)
    dry = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(load - even))
    # the error of each pressure is the root of that of its energy
    error = np.sqrt(dry.certificate.duality_gap) + np.sqrt(found.certificate.duality_gap)
    np.testing.assert_allclose(found.pressure, dry.pressure, atol=error * dry.max_pressure)
    np.testing.assert_allclose(found.fluid.pressure, even, rtol=1e-9)
    assert found.area_fraction == dry.area_fraction
    assert found.approach == pytest.approx(dry.approach, rel=error)
    area = surface.grid.area
    assert found.fluid.uplift == pytest.approx(even * area, rel=1e-9)
    assert found.fluid.solid_force == pytest.approx((load - even * (1.0 - dry.area_fraction)) * area, rel=1e-6)


def test_back_pressure_carries_an_even_pressure() -> None:
    surface = wavy()
    found = wet(surface, 2e8 * (1.0 + 1e-12), asp.MeanPressure(3e8), outlet=2e8, back=2e8)
    dry = asp.solve(asp.ContactProblem(surface, STEEL), asp.MeanPressure(3e8))
    assert found.fluid.uplift == pytest.approx(0.0, abs=1e-9 * 2e8 * surface.grid.area)
    assert found.area_fraction == dry.area_fraction


@pytest.mark.parametrize("driven", ["sides", "gradient"])
def test_small_pressures_change_the_leak_in_proportion(driven: str) -> None:
    surface, load = rough(), asp.MeanPressure(2e9)
    dry = leakage(asp.solve(asp.ContactProblem(surface, STEEL), load), OIL, 1.0, driven=driven).rate
    more = []
    for pressure in (2e7, 1e7):
        found = wet(surface, pressure, load, driven=driven)
        more.append(leakage(found, OIL, pressure, driven=driven).rate / pressure / dry - 1.0)
    assert more[0] > more[1] > 0.0
    # linear in the pressure, with a second order that is by the ratio of the changes itself
    assert more[0] == pytest.approx(2.0 * more[1], rel=4.0 * more[0])
    assert more[1] < 0.1


@pytest.mark.parametrize(
    ("driven", "boundary"), [("sides", asp.Periodic()), ("gradient", asp.Periodic()), ("auto", asp.Free())]
)
def test_forces_and_flow_are_conserved(driven: Any, boundary: Any) -> None:
    surface, load = rough(), 3e9
    found = wet(surface, 2e9, asp.MeanPressure(load), driven=driven, boundary=boundary)
    fluid, force = found.fluid, load * surface.grid.area
    assert found.converged
    assert fluid.solid_force + fluid.borne_by_fluid == pytest.approx(force, rel=1e-9)
    assert found.external_force == pytest.approx(force, rel=1e-12)
    assert found.force + fluid.uplift == pytest.approx(force, rel=1e-9)
    checks = {check.name: check for check in found.certificate.couplings}
    assert checks["fluid"].residual <= checks["fluid"].tolerance
    assert fluid.residual <= 10.0 * fluid.tolerance
    leak = leakage(found, OIL, 2e9, driven=driven)
    assert leak.flow.section_error < 1e-8
    # displacements are those of all that acts, by the same operator
    operator = prepare_operator(found.problem.compliance, surface.grid, boundary)
    moved = operator.apply(found.pressure + fluid.pressure)
    np.testing.assert_allclose(found.displacement, moved, atol=1e-9 * np.ptp(moved))
    opened = ~found.contact
    np.testing.assert_allclose(
        found.gap[opened], (found.offset + moved - found.problem.profile())[opened], atol=1e-6 * found.gap.max()
    )


def plain(surface: asp.Surface, given: FluidPressure, load: float, body: Any = STEEL) -> Any:
    """Contact and flow in turn, without extrapolation: the pressure of the fluid at all cells as a
    displacement, the rest of the load on the contact."""
    dry = asp.ContactProblem(surface, body)
    operator, pressure = prepare_operator(dry.compliance, surface.grid, dry.boundary), np.zeros(surface.shape)
    for _ in range(60):
        lifted = surface.with_heights(surface.heights - operator.apply(pressure), "lifted")
        found = asp.solve(asp.ContactProblem(lifted, body), asp.MeanPressure(load - pressure.mean()))
        flow = gap_flow(found.gap, found.contact, surface.grid, (True, True), given.way, given.driven)
        leak = given.fluid.leak(flow, given.inlet, given.outlet)
        before, pressure = pressure, acting_pressure(flow, leak, given, pressure)
        if np.abs(pressure - before).max() < 1e-6 * given.inlet:
            return found, pressure, leak.rate
    raise AssertionError("the plain iteration has not settled")


@pytest.mark.parametrize("driven", ["sides", "gradient"])
@pytest.mark.parametrize("fluid", [OIL, IdealGas(18e-6, 0.0), IdealGas(18e-6, 65e-9)])
def test_agrees_with_a_plain_iteration(driven: Any, fluid: Any) -> None:
    surface, load = wavy(), 6e8
    given = FluidPressure(fluid, 3e8, 1e7, driven=driven)
    found = asp.solve(asp.ContactProblem(surface, STEEL, fluid_pressure=given), asp.MeanPressure(load))
    other, pressure, rate = plain(surface, given, load)
    assert leakage(found, fluid, 3e8, 1e7, driven=driven).rate == pytest.approx(rate, rel=1e-4)
    assert found.area_fraction == other.area_fraction
    opened = ~found.contact
    np.testing.assert_allclose(found.fluid.pressure[opened], pressure[opened], atol=1e-4 * 3e8)


def test_position_finds_the_load() -> None:
    surface, load = rough(), 3e9
    loaded = wet(surface, 2e9, asp.MeanPressure(load), driven="sides")
    for control in (asp.Approach(loaded.approach), asp.MeanGap(loaded.mean_gap)):
        placed = wet(surface, 2e9, control, driven="sides")
        assert placed.external_force == pytest.approx(load * surface.grid.area, rel=1e-5)


def test_energy_of_a_history_is_balanced_to_second_order() -> None:
    """Load, fluid and bodies: F dδ + Σ P dg = dE."""
    errors = []
    for count in (5, 10, 20):
        way = [*np.linspace(1e9, 4e9, count), *np.linspace(4e9, 1e9, count)[1:]]
        history = wet(rough(), 1e9, asp.History([asp.MeanPressure(p) for p in way]), driven="sides")
        energies = history.energies
        assert energies.fluid_work[count - 1] < 0.0  # pressed out of the gap
        errors.append(energies.relative_error)
        # elastic: the way back is the way there
        assert history[0].approach == pytest.approx(history[-1].approach, rel=1e-5)
    assert errors[2] < 0.35 * errors[1] < 0.35**2 * errors[0]
    assert errors[2] < 2e-3


def test_hardness_and_sliding_join() -> None:
    hard = wet(rough(), 2e9, asp.MeanPressure(3e9), law=asp.Hardness(1e10), driven="sides")
    assert hard.converged
    assert hard.plastic.any()
    assert wet(rough(), 2e9, asp.MeanPressure(3e9), friction=asp.Coulomb(0.3), driven="sides").converged


def test_files_keep_it(tmp_path: Path) -> None:
    found = wet(rough(), 2e9, asp.MeanPressure(3e9), driven="sides", back=1e8)
    asp.save(found, tmp_path / "wet.nc")
    again = asp.load(tmp_path / "wet.nc")
    assert again.problem.fluid_pressure == found.problem.fluid_pressure
    np.testing.assert_array_equal(again.fluid.pressure, found.fluid.pressure)
    assert again.fluid.line() == found.fluid.line()
    assert asp.solve(again.problem, asp.MeanPressure(3e9), state=again.state).certificate.rounds <= 3


def test_pressure_within_pools_and_contacts() -> None:
    """Pools keep what they had, and a contact has that of the fluid at its edge."""
    gap = np.ones((24, 24))
    gap[8:16, 8:16] = 0.0
    gap[11:13, 11:13] = 0.5
    grid = asp.Grid((24, 24), (1.0, 1.0))
    flow = flow_through(gap, grid, "x", wraps=(False, True))
    given = FluidPressure(OIL, 2.0, 1.0)
    found = acting_pressure(flow, OIL.leak(flow, 2.0, 1.0), given, np.full(gap.shape, 1.7))
    np.testing.assert_allclose(found[11:13, 11:13], 1.7)
    assert found[gap == 0.0].min() > 1.0
    assert found[gap == 0.0].max() < 2.0
    assert found[8, 11] == pytest.approx(found[7, 11])
    assert found[15, 11] == pytest.approx(found[16, 11])


def test_closed_gap_bears_the_pressures_of_its_sides() -> None:
    surface = rough()
    found = wet(surface, 1e9, asp.MeanPressure(20e9), driven="sides")
    leak = leakage(found, OIL, 1e9, driven="sides")
    assert leak.sealed
    opened = ~found.contact
    assert found.fluid.pressure[0][opened[0]] == pytest.approx(1e9)
    assert found.fluid.pressure[-1][opened[-1]] == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("made", "kind", "subject", "shown"),
    [
        (lambda: FluidPressure(OIL, 1e5, 2e5), InputError, "pressure at the inlet", "200000"),
        (lambda: FluidPressure(1.0, 1e5), InputError, "fluid that presses", "float"),  # type: ignore[arg-type]
        (lambda: FluidPressure(IdealGas(18e-6, 0.0), 1e5, -1e5), InputError, "pressure of a gas", "-100000"),
        (lambda: wet(wavy(), 1e9, asp.MeanPressure(4e8)), NoSolutionError, "fluid pressure", "400 MPa"),
        (
            lambda: wet(wavy(), 1e7, asp.MeanPressure(4e8), driven="gradient", boundary=asp.Free()),
            InputError,
            "way of driving the flow",
            "gradient",
        ),
        (
            lambda: wet(wavy(), 1e7, asp.MeanPressure(4e8), adhesion=asp.ExponentialAdhesion(0.05, 1e-9)),
            InputError,
            "adhesion of a contact with fluid pressure",
            "0.05",
        ),
    ],
)
def test_wrong_input(made: Callable[[], Any], kind: Any, subject: str, shown: str) -> None:
    with refused(kind, subject, shown):
        made()


def test_a_contact_near_lifting_off_is_a_finding() -> None:
    found = wet(wavy(), 7.3e8, asp.MeanPressure(4e8), driven="sides")
    near = [item for item in review(found) if item.criterion == "contact near lifting off"]
    assert near[0].numbers["share"] == found.fluid.share > 0.9


DOCUMENT: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 48],
        "size": "100 um",
        "seed": 3,
        "spectrum": {"kind": "gaussian", "rms_height": "1 um", "correlation_length": "10 um"},
    },
    "body": "E=100GPa,nu=0.3",
    "counter_body": {"rigid": True},
    "control": {"mean_pressure": "2 GPa"},
    "sealing": {"inlet": "600 MPa", "outlet": "100 kPa", "driven": "sides"},
}


def test_documents_solve_both_together_and_findings_say_when_to() -> None:
    one_way = asp.run(DOCUMENT)
    doubted = [item for item in one_way.findings if item.criterion == "pressure of the fluid"]
    assert "two_way" in doubted[0].remedy
    sealing = DOCUMENT["sealing"] | {"two_way": True}
    both = asp.run(DOCUMENT | {"sealing": sealing})
    assert both.result.fluid is not None
    assert [item for item in both.findings if item.criterion == "pressure of the fluid"] == []
    assert both.values["leak_rate"] > one_way.values["leak_rate"]
    assert both.values["fluid_force"] == both.result.fluid.borne_by_fluid
    assert both.result.external_force == pytest.approx(one_way.result.external_force, rel=1e-9)
    words = [next(w for part, w in each.sections if part.name == "sealing") for each in (one_way, both)]
    assert words[0].remarks != words[1].remarks
    held = asp.run(DOCUMENT | {"sealing": sealing | {"back": "300 MPa"}})
    assert held.values["leak_rate"] < both.values["leak_rate"]
    assert held.result.problem.fluid_pressure.back == 3e8
    with refused(InputError, "problem document: sealing.back", "100000"):
        asp.run(DOCUMENT | {"sealing": {"back": "100 kPa"}})
