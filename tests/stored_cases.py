"""Small results of every type that files hold, and what they tell: every number to the bit, by
name."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from typing import Any

import numpy as np
from adhesive_cases import sphere
from contact_cases import rough

import asperity as asp
from asperity import fem
from asperity.contact.problem import ContactProblem, Physics
from asperity.solids.plasticity import J2, LinearHardening

FILM = asp.LiquidFilm(surface_tension=0.025, thickness=0.4e-9, meniscus_height=0.8e-9)
STEEL = asp.Elastic(2e11, 0.3)
RUBBER = asp.Viscoelastic.standard_linear(1e6, 3e6, 1.0, 0.45)
FLOWING = J2(STEEL, LinearHardening(1e9, 2e10))
NOT_TOLD = ("at_edges", "problem", "law", "film", "deflections", "plastic_flow")
"""Fields that are what was given, or not stored."""


def ground(size: int = 12) -> asp.Surface:
    """White noise of 1 nm."""
    heights = np.random.default_rng(5).normal(size=(size, size - 2)) * 1e-9
    return asp.Surface(heights, 2e-8, periodic=True)


def wet() -> Any:
    """Plastic contact with menisci and gross sliding, loaded and unloaded."""
    problem = asp.ContactProblem(
        ground(),
        asp.Elastic(1e11, 0.3),
        law=asp.Hardness(8e9),
        film=FILM,
        friction=asp.Coulomb(0.3, coupled=True),
    )
    return asp.solve(problem, asp.History([asp.MeanPressure(p) for p in (1e8, 2e8, 5e7)]))


def adhesive() -> Any:
    """An adhesive sphere, pressed and pulled."""
    problem = sphere(16, 8.0, asp.ExponentialAdhesion(0.05, 4e-7))
    steps = [asp.Approach(2e-7), asp.Approach(1e-7), asp.Approach(3e-7)]
    return asp.solve(problem, asp.History(steps))


def creeping() -> Any:
    """Rubber that is pressed, held, and unloaded."""
    problem = asp.ContactProblem(ground(), RUBBER, counter_body=asp.Rigid())
    steps = [asp.Step(asp.MeanPressure(p), duration=t) for p, t in ((1e5, 0.1), (1e5, 1.0), (5e4, 0.1))]
    return asp.solve(problem, asp.History(steps), time_steps=asp.TimeSteps(tolerance=0.02))


def sticking() -> Any:
    """Stick and slip of a layered body."""
    body = asp.Layered([asp.Layer(asp.Elastic(2.0, 0.3), 2.0)], asp.Elastic(0.5, 0.2))
    problem = asp.ContactProblem(rough((12, 12), 4), body, friction=asp.Coulomb(0.3, limit=0.1))
    pressed = asp.MeanPressure(0.01)
    steps = [asp.Step(pressed, asp.Shift()), asp.Step(pressed, asp.Shift(3e-3, 1e-3))]
    return asp.solve(problem, asp.History([*steps, asp.Step(pressed, asp.TangentialForce(-0.2))]))


def flowing() -> Any:
    """Plastic flow below the surface: none, more, and after unloading."""
    surface = asp.generate.sphere(asp.Grid((12, 12), (2e-6, 2e-6)), radius=1e-4)
    flow = asp.PlasticFlow(FLOWING, cells=5)
    problem = asp.ContactProblem(surface, STEEL, boundary=asp.Free(), plastic_flow=flow)
    return asp.solve(problem, asp.History([asp.Force(f) for f in (1e-3, 0.6, 0.2)]))


def rolling(start: Any = None) -> Any:
    """A ball that rolls with creepage; from the ``start`` of another one with more."""
    surface = asp.generate.sphere(asp.Grid((12, 10), (1e-5, 1e-5)), radius=10e-3)
    problem = asp.ContactProblem(surface, STEEL, boundary=asp.Free(), friction=asp.Coulomb(np.full((12, 10), 0.2)))
    creepage = asp.rolling.Creepage(1e-4 if start is None else 1.2e-4, 5e-5, 0.2)
    return asp.roll(problem, asp.Force(2.0), creepage, direction="-x", start=start)


def stressed() -> Any:
    """Stresses and displacements on both sides of an interface."""
    body = asp.Layered([asp.Layer(asp.Elastic(4e11, 0.25, name="film"), 4e-9)], STEEL)
    result = asp.solve(asp.ContactProblem(ground(6), body), asp.MeanPressure(2e8))
    return asp.stress(result, [0.0, 4e-9, 1e-8], friction=0.3, displacement=True)


def indented(start: Any = None) -> Any:
    """State of finite elements after an indentation; the ``start`` of another one is unloaded."""
    coarse = fem.Resolution(across=4, per_layer=2, growth=1.8, distance=6.0)
    law = J2(STEEL, LinearHardening(400e6, 1e9), kinematic=10e9, recall=50.0)
    ball = fem.Indentation.of(STEEL, fem.Paraboloid(10e-6), [40e-9, 60e-9], plasticity=law, resolution=coarse)
    return ball.run([40e-9, 60e-9] if start is None else [fem.Load(0.0)], start=start).state


def passed(start: Any = None) -> Any:
    """State of finite elements after a pass, or after one more from the ``start``."""
    coarse = fem.Resolution(across=4, growth=1.8, depth=0.8, distance=6.0)
    law = J2(STEEL, LinearHardening(400e6, 1e9), kinematic=10e9, recall=50.0)
    ends = (-5e-4, 5e-4)
    track = fem.cylinder_track(STEEL, 1e-3, ends, plasticity=law, resolution=coarse)
    before = track.virgin() if start is None else start
    return fem.hertz_pass(track, before, 1.1e9, 1e-3, ends, friction=0.1, steps=2, ramp=1).state


def moved(start: Any = None) -> Any:
    """Stick and slip of a block on a belt; from the ``start`` of another motion on."""
    block = asp.dynamics.BeltOscillator(asp.dynamics.StaticKinetic(0.4, 0.25), 1.0, 1e4, 100.0, 0.01)
    return block.move(1.0, start=None if start is None else start.end, samples=20)


def aged() -> Any:
    """A block on a belt whose friction ages, without events."""
    friction = asp.dynamics.RateState(0.6, 0.01, 0.015, 1e-5, 1e-6)
    return asp.dynamics.BeltOscillator(friction, 1.0, 1e6, 100.0, 1e-5).move(0.1, samples=5)


def single() -> Any:
    """One load of an elastic contact."""
    return asp.solve(asp.ContactProblem(ground(), STEEL), asp.MeanPressure(1e8))


CASES: Mapping[str, Callable[[], Any]] = {
    made.__name__: made
    for made in (wet, adhesive, creeping, sticking, flowing, rolling, stressed, indented, passed, moved, aged, single)
}
"""What makes each, by name."""


GO_ON = {"rolling": rolling, "indented": indented, "passed": passed, "moved": moved}
"""What goes on from another one of it, by name."""


def goes_on(path: Any, name: str = "") -> Any:
    """What follows a result of that ``name``; of a path the second step, solved again from the
    state of the first, without the products at hand that no file holds."""
    if name in GO_ON:
        return GO_ON[name](path)
    if name == "single":
        return asp.solve(path.problem, asp.MeanPressure(2e8), state=replace(path.state, deflections=None))
    begin, step = path[0], path[1]
    sheared, relaxed = step.stick_slip, step.creep
    duration = 0.0 if relaxed is None else float(relaxed.time[-1] - relaxed.time[0])
    control = asp.Step(step.control, None if sheared is None else sheared.tangential, duration=duration)
    state = replace(begin.state, deflections=None)
    return asp.solve(step.problem, control, state=state, time_steps=asp.TimeSteps(tolerance=0.02))


def told(value: Any, name: str = "") -> dict[str, str]:
    """Every number and text in ``value`` by its place, arrays by the digest of type, shape and
    bytes."""
    return dict(_told(value, name))


def _told(value: Any, name: str) -> Iterator[tuple[str, str]]:
    if isinstance(value, ContactProblem | Physics):
        return
    if isinstance(value, Enum):
        yield name, str(value)
    elif is_dataclass(value):
        for item in fields(value):
            if item.name not in NOT_TOLD:
                yield from _told(getattr(value, item.name), f"{name}.{item.name}")
        if isinstance(value, asp.ContactResult):
            yield from _told({**value.state.memory}, f"{name}.state")
    elif isinstance(value, Mapping):
        for key in sorted(value):
            yield from _told(value[key], f"{name}.{key}")
    elif isinstance(value, tuple | list):
        for number, item in enumerate(value):
            yield from _told(item, f"{name}.{number}")
    elif isinstance(value, np.ndarray | np.generic):
        value = np.asarray(value)
        whole = f"{value.dtype}{value.shape}".encode() + np.ascontiguousarray(value).tobytes()
        yield name, hashlib.sha256(whole).hexdigest()[:24]
    else:
        yield name, repr(value)
