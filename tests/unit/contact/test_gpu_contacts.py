"""Contacts of all kinds with the normal contact on a GPU: the answers of the CPU. The GPU is
emulated, so that arrays of host and device are kept apart."""

from __future__ import annotations

import weakref
from typing import Any

import numpy as np
import pytest
from contact_cases import rough
from emulated_gpu import EmulatedGpu

import asperity as asp
from asperity.solids.plasticity import J2, LinearHardening

STEEL, DLC = asp.Elastic(200e9, 0.3), asp.material("DLC")
COATED = asp.Layered([asp.Layer(DLC, 0.5e-6)], base=asp.Elastic(200e9, 0.3, strength=asp.Strength(hardness=5e9)))
STIFF = asp.Layered([asp.Layer(asp.Elastic(20e12, 0.3), 0.5e-6)], base=STEEL)
LOAD = asp.MeanPressure(1e9)

CASES: dict[str, tuple[dict[str, Any], Any]] = {
    "load": ({}, LOAD),
    "position": ({}, asp.Approach(200e-9)),
    "position on a free grid": ({"boundary": asp.Free()}, asp.Approach(200e-9)),
    "position just in contact": ({"boundary": asp.Free()}, asp.Approach(1e-12)),
    "gap": ({}, asp.MeanGap(150e-9)),
    "stiff film": ({"body": STIFF}, LOAD),
    "history": ({}, asp.History([asp.MeanPressure(p) for p in (0.5e9, 1e9, 0.7e9)])),
    "hardness": ({"law": asp.Hardness(8e9)}, asp.History([asp.MeanPressure(p) for p in (0.5e9, 1e9, 0.3e9)])),
    "light load under a hardness": ({"law": asp.Hardness(1e7)}, asp.MeanPressure(1e6)),
    "hardness of layers": ({"body": COATED, "law": asp.plasticity.LayeredHardness(COATED)}, LOAD),
    "adhesion": ({"adhesion": asp.ExponentialAdhesion(0.5, 10e-9)}, LOAD),
    "pull": ({"adhesion": asp.ExponentialAdhesion(0.5, 10e-9)}, asp.Unloaded()),
    "sliding": ({"friction": asp.Coulomb(0.3)}, LOAD),
    "stick and slip": ({"friction": asp.Coulomb(0.3)}, asp.Step(LOAD, asp.Shift(1e-9))),
    "creep": (
        {"body": asp.Viscoelastic.prony(50e9, ((20e9, 10.0), (30e9, 1.0)), 0.4)},
        asp.History([asp.Step(LOAD, duration=1.0), asp.Step(LOAD, duration=5.0)]),
    ),
    "plastic flow": (
        {"plastic_flow": asp.PlasticFlow(J2(STEEL, LinearHardening(2e9)), cells=8)},
        asp.MeanPressure(0.5e9),
    ),
    "menisci": ({"film": asp.LiquidFilm(surface_tension=0.07, thickness=5e-9, meniscus_height=20e-9)}, LOAD),
}


@pytest.mark.parametrize("case", CASES)
def test_contacts_on_a_gpu_are_those_of_the_cpu(case: str) -> None:
    """Pressures go with the root of the error of a solve, 1e-10 here."""
    own, control = CASES[case]
    heights = 100e-9 * rough((66, 70), seed=5).heights
    problem = asp.ContactProblem(asp.Surface(heights, 0.3e-6, 0.25e-6, periodic=True), **{"body": STEEL, **own})
    results = []
    for engine in (asp.engines.CpuEngine(1), EmulatedGpu()):
        found = asp.solve(problem, control, solver=asp.solvers.ActiveSet(tolerance=1e-10), engine=engine)
        results.append(found.last if isinstance(found, asp.HistoryResult) else found)
    wanted, found = results
    scale = np.linalg.norm(wanted.pressure)
    assert np.linalg.norm(found.pressure - wanted.pressure) <= 1e-4 * scale
    assert found.area_fraction == pytest.approx(wanted.area_fraction, abs=2.0 / heights.size)
    assert found.contact_perimeter == pytest.approx(wanted.contact_perimeter, rel=1e-2)
    assert found.normal_stiffness == pytest.approx(wanted.normal_stiffness, rel=1e-4, nan_ok=True)
    assert found.max_permanent_indentation == pytest.approx(wanted.max_permanent_indentation, rel=1e-3)
    for field in (found.pressure, found.displacement, found.gap, found.permanent_indentation, found.plastic):
        assert type(field) is np.ndarray
    assert found.certificate.duality_gap < 1e-6


def test_heights_go_to_the_gpu_once_and_leave_it_with_the_surface() -> None:
    engine, surface = EmulatedGpu(), rough((66, 70), seed=5)
    first = engine.resident(surface.heights)
    assert engine.resident(surface.heights) is first
    changing = np.array(surface.heights)
    assert engine.resident(changing) is not engine.resident(changing)
    kept, gone = weakref.ref(first), weakref.ref(engine)
    del first, surface
    assert kept() is None
    engine.resident(rough((8, 8), seed=1).heights)
    del engine
    assert gone() is None, "no search for garbage is needed"
