"""A physics of one's own takes a file of its own and no change of any other: a layer of glue, as an
example."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from refusals import refused
from study_cases import PROBLEM

import asperity as asp
from asperity.contact.answer import Answer
from asperity.contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, Share
from asperity.contact.operators import Operator
from asperity.contact.problem import ContactProblem, Physics, Preparing
from asperity.core.arrays import BoolArray, RealArray
from asperity.core.errors import InputError
from asperity.core.quantity import Quantity


@dataclass(frozen=True, eq=False)
class Glued(Answer):
    """What the glue does: its tension (nx, ny) in Pa, where it is whole, its force in N and its
    energy in J."""

    tension: RealArray
    whole: BoolArray
    glue_force: float
    glue_energy: float
    quantities: ClassVar[tuple[Quantity, ...]] = (Quantity("glue_force", "N", "force of the glue"),)

    def traction_beside(self) -> RealArray:
        return self.tension

    def pulls(self) -> float:
        return self.glue_force

    def stores(self, *, relaxing: bool) -> float:
        return self.glue_energy


@dataclass(frozen=True)
class GlueCoupling(Coupling):
    """Springs between points that are nearer than they tear; what is torn does not heal."""

    glue: Glue
    operator: Operator
    tolerance: float
    name: ClassVar[str] = "glue"
    feedback: ClassVar[bool] = True
    remedy: ClassVar[str] = "Take a softer glue."

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        x = memory.get("tension", np.zeros(posed.profile.shape))
        whole = memory.get("whole", np.ones(posed.profile.shape))
        return Exchange(x, x, np.inf, self.tolerance, scale=self.glue.stiffness * self.glue.stretch, note=whole)

    def share(self, exchange: Exchange) -> Share:
        load = float(exchange.x.sum()) * self.operator.grid.pixel_area
        return Share(load=load, lift=-self.operator.apply(exchange.x), attraction=exchange.x)

    def held(self, exchange: Exchange, contact: Contact) -> BoolArray:
        return np.asarray((exchange.note > 0.0) & (contact.gap < self.glue.stretch))

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        target = np.where(self.held(exchange, contact), self.glue.stiffness * contact.gap, 0.0)
        residual = float(np.abs(target - exchange.x).max()) / (self.glue.stiffness * self.glue.stretch)
        return replace(exchange, target=target, residual=residual)

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, Glued]:
        whole, pixel = self.held(exchange, contact), self.operator.grid.pixel_area
        energy = 0.5 * self.glue.stiffness * float((np.where(whole, contact.gap, 0.0) ** 2).sum()) * pixel
        found = Glued(exchange.x, whole, float(exchange.x.sum()) * pixel, energy)
        return {"tension": exchange.x, "whole": whole.astype(float)}, found


@dataclass(frozen=True)
class Glue(Physics):
    """Glue of a ``stiffness`` (Pa/m) that tears at ``stretch`` (m)."""

    stiffness: float
    stretch: float
    attracts: ClassVar[bool] = True

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        yield GlueCoupling(self, operator, how.tolerances.get("glue", 1e-7))


def wave(n: int = 24) -> asp.Surface:
    x = 2.0 * np.pi * np.arange(n) / n
    return asp.Surface(4e-9 * (np.cos(x)[:, None] + np.cos(x)[None, :]), 10e-9, periodic=True)


SOLID = asp.Elastic(10e9, 0.3)
GLUE = Glue(2e15, 3e-9)
LOADS = [asp.MeanPressure(p) for p in (20e6, 60e6, 100e6)]


def problem(*physics: Physics, **given: Any) -> asp.ContactProblem:
    return asp.ContactProblem(wave(), SOLID, physics=physics, **given)


def test_glue_joins_solve_result_and_history() -> None:
    """Balance of force, law of the springs at the gap found, energies, restart: all by the general
    hooks."""
    history = asp.solve(problem(GLUE), asp.History(LOADS))
    assert history.converged
    for step in history:
        found = step.require("glue")
        assert found is step.couplings["glue"]
        assert found.glue_force > 0.0
        assert step.external_force == pytest.approx(step.force - found.glue_force, rel=1e-12)
        assert step.external_force == pytest.approx(step.control.value * step.problem.grid.area, rel=1e-7)
        law = np.where(found.whole, GLUE.stiffness * step.gap, 0.0)
        assert np.abs(found.tension - law).max() <= 1e-6 * GLUE.stiffness * GLUE.stretch
    again = asp.solve(problem(GLUE), LOADS[2], state=history.steps[1].state)
    assert again.force == pytest.approx(history.last.force, rel=1e-6)


def test_energies_of_glued_contacts_balance() -> None:
    """The work over the approach is what body and glue store; the trapezium errs by the square of
    the steps."""
    errors = []
    for steps in (4, 8, 16):
        loads = np.linspace(20e6, 100e6, steps + 1)
        strong = Glue(GLUE.stiffness, 30e-9)  # none of it tears on the way
        errors.append(asp.solve(problem(strong), asp.History(map(asp.MeanPressure, loads))).energies.relative_error)
    assert errors[2] < errors[1] < errors[0]
    assert errors[2] < 2e-3


def test_weak_glue_leaves_the_dry_contact() -> None:
    weak, dry = (asp.solve(one, LOADS[1]) for one in (problem(Glue(1e3, 3e-9)), problem()))
    assert np.abs(weak.pressure - dry.pressure).max() <= 1e-6 * dry.pressure.max()


def test_it_goes_with_other_physics() -> None:
    """Two of one's own, and one of the package, in the order of the registry."""

    @dataclass(frozen=True)
    class SecondGlue(Glue):
        """Another one."""

    film = asp.LiquidFilm.of(asp.liquid("water"), 1e-9)
    both = problem(GLUE, SecondGlue(1e14, 2e-9), film=film)
    assert [type(item).__name__ for item in both.physics] == ["Wet", "Glue", "SecondGlue"]
    assert both.film is film
    assert both.with_physics(film=None).physics == (GLUE, SecondGlue(1e14, 2e-9))
    with refused(InputError, "physics of a ContactProblem"):
        problem(GLUE, GLUE)
    with refused(InputError, "physics of a ContactProblem"):
        problem("glue")  # type: ignore[arg-type]
    with refused(InputError, "couplings of the result", "glue"):
        asp.solve(problem(), LOADS[0]).require("glue")


PAGE = Path(__file__).parents[2] / "docs/develop/own-physics.md"


def test_the_physics_of_the_guide_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its pieces in one file, as the page says: law, closed form, limit, energies, door."""
    code = "\n".join(re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL))
    (tmp_path / "voltage.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    guide = importlib.import_module("voltage")
    films = guide.ChargedFilms(10.0, 5e-9)
    found = guide.result.require("voltage")
    assert np.abs(found.attraction - films.at(guide.result.gap)).max() <= 1e-6 * films.at(0.0)
    flat = asp.Surface(np.zeros((8, 8)), 10e-9, periodic=True)
    pressed = asp.solve(asp.ContactProblem(flat, SOLID, physics=[guide.Voltage(films)]), LOADS[0])
    assert pressed.mean_pressure == pytest.approx(LOADS[0].value + films.at(0.0), rel=1e-12)
    without, dry = (
        asp.solve(one, LOADS[0]) for one in (problem(guide.Voltage(guide.ChargedFilms(1e-3, 5e-9))), problem())
    )
    assert np.abs(without.pressure - dry.pressure).max() <= 1e-6 * dry.pressure.max()
    errors = []
    for count in (4, 8, 16):
        loads = map(asp.MeanPressure, np.linspace(5e6, 50e6, count + 1))
        errors.append(asp.solve(guide.problem, asp.History(loads)).energies.relative_error)
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.1)
    document = PROBLEM | {"electrostatic": {"volts": "10 V", "thickness": "5 nm"}}
    outcome = asp.run(document, parts=[guide.VoltagePart])
    assert outcome.converged
    assert outcome.values["electric_force"] == outcome.result.require("voltage").electric_force > 0.0
    asp.save(guide.result, tmp_path / "r.nc")
    again = asp.load(tmp_path / "r.nc")
    assert again.problem.physics == guide.problem.physics
    assert again.require("voltage").attraction.tobytes() == found.attraction.tobytes()


@dataclass(frozen=True)
class Brush(Glue):
    """Bristles that push apart what is nearer than their length, the ``stretch``."""

    attracts: ClassVar[bool] = False

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        yield BrushCoupling(self, operator, how.tolerances.get("glue", 1e-7))


@dataclass(frozen=True)
class BrushCoupling(GlueCoupling):
    """A glue of the other sign."""

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        target = -self.glue.stiffness * np.maximum(self.glue.stretch - contact.gap, 0.0)
        residual = float(np.abs(target - exchange.x).max()) / (self.glue.stiffness * self.glue.stretch)
        return replace(exchange, target=target, residual=residual)


def test_what_pushes_the_bodies_apart_carries_its_part_and_not_more() -> None:
    """Flat bodies: where the bristles bear the whole load the solids do not touch, which a coupling
    that holds none apart cannot find; it is not said to be converged."""
    flat, brush = asp.Surface(np.zeros((8, 8)), 10e-9, periodic=True), Brush(1e15, 5e-9)
    posed = asp.ContactProblem(flat, SOLID, physics=[brush])
    pressed = asp.solve(posed, asp.MeanPressure(20e6))
    assert pressed.mean_pressure == pytest.approx(15e6, rel=1e-9)
    with pytest.raises(asp.ConvergenceError):
        asp.solve(posed, asp.MeanPressure(4e6))


def test_a_coupling_has_the_compliance_of_its_step_of_time() -> None:
    """After a long time the body has relaxed to the soft solid that it is then."""
    body, load = asp.Viscoelastic.standard_linear(10e9, 20e9, 1.0, 0.3), asp.MeanPressure(20e6)
    held = asp.History([load, asp.Step(load, duration=0.5), asp.Step(load, duration=100.0)])
    glue = Glue(GLUE.stiffness, 30e-9)
    found = asp.solve(asp.ContactProblem(wave(), body, physics=[glue]), held)
    soft = asp.solve(asp.ContactProblem(wave(), asp.Elastic(10e9, 0.3), physics=[glue]), load)
    assert found.last.mean_gap == pytest.approx(soft.mean_gap, rel=1e-5)
    assert found.last.force == pytest.approx(soft.force, rel=1e-5)


def test_it_does_not_roll_unless_it_says_so() -> None:
    with refused(InputError, "physics of a rolling contact"):
        asp.roll(problem(GLUE, friction=asp.Coulomb(0.3)), LOADS[0], asp.rolling.Creepage(1e-3))
