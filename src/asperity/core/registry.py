"""Which physics and parts there are: the lists of those of this package, in plain text, so that nothing is imported before it is used."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType
from typing import Any, NamedTuple


class Known(NamedTuple):
    """A physics by the keyword of a problem.

    Attributes
    ----------
    home
        Where its class stands, such as ``physics.menisci.physics:Wet``.
    must_be
        What the keyword takes, for messages.
    absent
        What is said where a result is asked for what a coupling of it finds, but has none: a sentence by the name of the coupling.
    figures
        Where the figures of a result stand that has what a coupling of it finds, by the name of the coupling.
    """

    home: str
    must_be: str
    absent: Mapping[str, str]
    figures: Mapping[str, str] = MappingProxyType({})


PHYSICS: Mapping[str, Known] = MappingProxyType(
    {
        "film": Known(
            "physics.menisci.physics:Wet",
            "LiquidFilm.of(liquid, thickness)",
            {
                "menisci": "problem of the result must have a film of liquid, but has none. Give it as film=LiquidFilm.of(...)."
            },
            {"menisci": "physics.menisci.figures:PLOTS"},
        ),
        "adhesion": Known(
            "physics.adhesion.physics:Adhesive",
            "a law such as ExponentialAdhesion(work, range)",
            {
                "adhesion": "problem of the result must have adhesion, but has none. Give it as adhesion=ExponentialAdhesion(work, range)."
            },
        ),
        "plastic_flow": Known(
            "physics.plastic_flow.physics:Flowing",
            "PlasticFlow(J2(...))",
            {
                "plastic_flow": "problem of the result must have a plastic flow, but has none. Give it as plastic_flow=PlasticFlow(J2(...))."
            },
        ),
        "friction": Known(
            "physics.friction.physics:Rubbing",
            "Coulomb(coefficient), TrescaFriction(strength), FullStick()",
            {
                "sliding": "result must be one of gross sliding with Coulomb friction, but is not. Give the problem friction=Coulomb(0.3).",
                "stick_slip": "result must be one of a step with stick and slip, but has none. Solve ContactProblem(..., friction=Coulomb(0.3)) "
                "under Step(normal, Shift(5e-9)).",
            },
        ),
    }
)
"""Every physics of this package by its keyword, in the order in which couplings are prepared."""

PARTS = (
    "parts.contact:Contact",
    "physics.friction.part:Friction",
    "physics.friction.part_stick_slip:StickSlip",
    "physics.rolling.part:Rolling",
    "physics.menisci.part:Menisci",
    "physics.menisci.part:WetTheory",
    "physics.adhesion.part:Adhesion",
    "physics.plastic_flow.part:PlasticFlow",
    "parts.contact:LoadPath",
    "physics.viscoelastic.part:Viscoelasticity",
    "physics.viscoelastic.part_hysteresis:Hysteresis",
    "physics.viscoelastic.part_sliding_start:SlidingStart",
    "parts.contact:Plasticity",
    "physics.hardness.part:PlasticLoad",
    "physics.stress.part:Stress",
    "physics.stress.part:Yielding",
    "physics.dynamics.part:Dynamics",
    "physics.indentation.part:Indentation",
    "physics.indentation.part_passes:Passes",
)
"""The parts of this package, by which physics and analyses are asked for in documents, in the order in which they are computed and shown."""

PAIRS: Mapping[frozenset[str], str] = MappingProxyType(
    {frozenset({"adhesion", "menisci"}): "physics.pairs.adhesion_menisci:settle_forces"}
)
"""How couplings settle that must balance a force together, by their names."""

REFUSED: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        ("plastic_flow", "adhesion"): "the plastic strain would not feel what the attraction does below the surface. "
        "Solve it without adhesion, or with a Hardness instead of the flow",
    }
)
"""Why physics do not go together, by the keywords of both; ``PAIRS`` says how others settle."""

BY_DEPTH = "physics.hardness.coupling:DepthHardness"
"""The coupling of a limit of the pressure that changes with depth."""

IN_TIME = "physics.viscoelastic.in_time:InTime"
"""What takes over the steps of a prepared problem whose bodies relax."""

OUTCOMES = (*(name for known in PHYSICS.values() for name in known.absent), "creep")
"""Names of what couplings of this package find, that of bodies that relax last."""

ANSWERS = (
    "physics.menisci.coupling:Menisci",
    "physics.adhesion.answer:AdhesiveContact",
    "physics.plastic_flow.answer:PlasticBody",
    "physics.friction.sliding:GrossSliding",
    "physics.friction.answer:StickSlip",
    "physics.viscoelastic.moments:Creeping",
)
"""Where the types of what couplings of this package find stand, for files."""

ENERGY_TERMS = ("meniscus_work", "shear_work", "tangential_work", "slip_work", "step_work", "jump_work")
"""Names of what the physics of this package add to the energies of a history."""


def home(place: str) -> Any:
    """What stands at ``place``, such as ``physics.adhesion.physics:Adhesive``."""
    module, _, name = place.partition(":")
    return getattr(import_module(f"asperity.{module}"), name)
