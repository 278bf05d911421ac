"""Which physics and parts there are: the lists of those of this package, in plain text, so that
nothing is imported before it is used."""

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
        What is said where a result is asked for what a coupling of it finds, but has none: a
        sentence by the name of the coupling.
    figures
        Where the figures of a result stand that has what a coupling of it finds, by the name of the
        coupling.
    """

    home: str
    must_be: str
    absent: Mapping[str, str]
    figures: Mapping[str, str] = MappingProxyType({})


class Drawn(NamedTuple):
    """What notebooks draw of a type.

    Attributes
    ----------
    home
        Where the type stands.
    figure
        Where the function stands that gives the figure of a name: what draws it on axes, and its
        size in inches.
    """

    home: str
    figure: str


class Kept(NamedTuple):
    """A result beside contacts and load paths that files hold in a group of its own.

    Attributes
    ----------
    home
        Where its type stands.
    title
        Title of a file of it.
    contact
        Name of its field that is a contact, which stands in a group beside; empty if it has none.
    writes, reads
        Where the functions stand that make the group of it, and it of the group; empty where the
        codec does so from what its fields say.
    """

    home: str
    title: str
    contact: str = ""
    writes: str = ""
    reads: str = ""


PHYSICS: Mapping[str, Known] = MappingProxyType(
    {
        "film": Known(
            "physics.menisci.physics:Wet",
            "LiquidFilm.of(liquid, thickness)",
            {
                "menisci": (
                    "problem of the result must have a film of liquid, but has none. Give it as "
                    "film=LiquidFilm.of(...)."
                )
            },
            {"menisci": "physics.menisci.figures:PLOTS"},
        ),
        "adhesion": Known(
            "physics.adhesion.physics:Adhesive",
            "a law such as ExponentialAdhesion(work, range)",
            {
                "adhesion": (
                    "problem of the result must have adhesion, but has none. Give it as "
                    "adhesion=ExponentialAdhesion(work, range)."
                )
            },
        ),
        "plastic_flow": Known(
            "physics.plastic_flow.physics:Flowing",
            "PlasticFlow(J2(...))",
            {
                "plastic_flow": (
                    "problem of the result must have a plastic flow, but has none. Give it as "
                    "plastic_flow=PlasticFlow(J2(...))."
                )
            },
        ),
        "friction": Known(
            "physics.friction.physics:Rubbing",
            "Coulomb(coefficient), TrescaFriction(strength), FullStick()",
            {
                "sliding": (
                    "result must be one of gross sliding with Coulomb friction, but is not. Give the "
                    "problem friction=Coulomb(0.3)."
                ),
                "stick_slip": "result must be one of a step with stick and slip, but has none. Solve "
                "ContactProblem(..., friction=Coulomb(0.3)) under Step(normal, Shift(5e-9)).",
            },
        ),
        "fluid_pressure": Known(
            "physics.sealing.physics:Pressed",
            "FluidPressure(fluid, inlet, outlet)",
            {
                "fluid": (
                    "problem of the result must have the pressure of a fluid, but has none. Give it as "
                    "fluid_pressure=FluidPressure(fluid, inlet, outlet)."
                )
            },
        ),
    }
)
"""Every physics of this package by its keyword, in the order in which couplings are prepared."""

GROUP = "asperity.parts"
"""Entry points of packages that add parts; each names a ``Part``, the class or an instance of
it."""

PARTS = (
    "parts.contact:Contact",
    "physics.friction.part:Friction",
    "physics.friction.part_stick_slip:StickSlip",
    "physics.rolling.part:Rolling",
    "physics.menisci.part:Menisci",
    "physics.menisci.part:WetTheory",
    "physics.menisci.part_growth:Growth",
    "physics.adhesion.part:Adhesion",
    "physics.plastic_flow.part:PlasticFlow",
    "parts.contact:LoadPath",
    "physics.viscoelastic.part:Viscoelasticity",
    "physics.viscoelastic.part_hysteresis:Hysteresis",
    "physics.viscoelastic.part_sliding_start:SlidingStart",
    "parts.contact:Plasticity",
    "physics.hardness.part:PlasticLoad",
    "parts.waves:DecidingWavesPart",
    "physics.prediction.part:PredictionPart",
    "physics.stress.part:Stress",
    "physics.stress.part:Yielding",
    "physics.conductance.part:Conductance",
    "physics.sealing.part:Sealing",
    "physics.heating.part:Heating",
    "physics.wear.part:Wear",
    "physics.sensitivities.part:Sensitivities",
    "physics.sensitivities.part_uncertainty:Uncertainty",
    "physics.sealing.part_flow_factors:FlowFactors",
    "physics.dynamics.part:Dynamics",
    "physics.indentation.part:Indentation",
    "physics.indentation.part_passes:Passes",
)
"""The parts of this package, by which physics and analyses are asked for in documents, in the order
in which they are computed and shown."""

FORMS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "At the interface": ("adhesion", "film", "friction", "shear", "rolling", "hysteresis"),
        "In the bodies": ("plastic_flow", "viscoelastic"),
        "Asked of the solved contact": (
            "stress",
            "conductance",
            "sealing",
            "heating",
            "wear",
            "meniscus_growth",
            "plastic_load",
            "deciding_waves",
            "prediction",
            "sensitivities",
            "uncertainty",
        ),
        "Beside the contact": ("dynamics", "flow_factors", "indentation", "passes"),
    }
)
"""Tables of the parts in the order in which forms show them, by heading; those of others come
last."""

PAIRS: Mapping[frozenset[str], str] = MappingProxyType(
    {frozenset({"adhesion", "menisci"}): "physics.pairs.adhesion_menisci:settle_forces"}
)
"""How couplings settle that must balance a force together, by their names."""

REFUSED: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        ("plastic_flow", "adhesion"): "the plastic strain would not feel what the attraction does below the surface. "
        "Solve it without adhesion, or with a Hardness instead of the flow",
        ("fluid_pressure", "film"): "menisci stand in a gap that no fluid fills",
        ("fluid_pressure", "adhesion"): "the attraction would have to be balanced together with the fluid. Solve it "
        "without, or the leakage of the adhesive contact alone",
    }
)
"""Why physics do not go together, by the keywords of both; ``PAIRS`` says how others settle."""

NEEDS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "menisci": ("friction",),
        "viscoelastic": ("friction",),
        "rolling": ("friction",),
        "wear": ("friction", "stress", "rolling"),
        "indentation": ("plastic_flow",),
        "sensitivities": ("conductance", "stress"),
        "pairs": ("adhesion", "menisci"),
    }
)
"""Folders of physics without which that of another cannot be, by its name; every other can be left
out by itself."""

ROLES: Mapping[str, str] = MappingProxyType(
    {
        "layered_hardness": "physics.hardness.layered:LayeredHardness",
        "limit_by_depth": "physics.hardness.coupling:DepthHardness",
        "in_time": "physics.viscoelastic.in_time:InTime",
        "derivatives": "physics.sensitivities.of_quantities:derivatives",
    }
)
"""What the machinery takes from a physics, by what that is: the law of coated bodies, the coupling
of a limit of the pressure that changes with depth, what takes over the steps of a prepared problem
whose bodies relax, and derivatives of quantities."""

DESCRIBED = (
    "physics.hardness.layered:LayeredHardness",
    "physics.stress.regions:Region",
    "physics.wear.third_body:ThirdBody",
)
"""Types that files describe beside those of the keywords."""

OUTCOMES = (*(name for known in PHYSICS.values() for name in known.absent), "creep")
"""Names of what couplings of this package find, that of bodies that relax last."""

ANSWERS = (
    "physics.menisci.coupling:Menisci",
    "physics.adhesion.answer:AdhesiveContact",
    "physics.plastic_flow.answer:PlasticBody",
    "physics.friction.sliding:GrossSliding",
    "physics.friction.answer:StickSlip",
    "physics.viscoelastic.moments:Creeping",
    "physics.sealing.coupling:FluidContact",
    "physics.wear.third_body:CompressedLayer",
)
"""Where the types of what couplings of this package find stand, for files."""

OLDER: Mapping[str, str] = MappingProxyType(
    {
        "adhesion": "physics.adhesion.files:older",
        "menisci": "physics.menisci.files:older",
        "sliding": "physics.friction.files:older_sliding",
        "stick_slip": "physics.friction.files:older_stick_slip",
        "creep": "physics.viscoelastic.files:older",
        "plastic_flow": "physics.plastic_flow.files:older",
    }
)
"""Where what a coupling found, by its name, is read from files of format 2, which were written
until the codec."""

RESULTS: Mapping[str, Kept] = MappingProxyType(
    {
        "field": Kept(
            "physics.stress.field:StressField",
            "stress inside a body",
            writes="physics.stress.files:field_node",
            reads="physics.stress.files:field_from",
        ),
        "rolling_contact": Kept("physics.rolling.rolling:RollingContact", "contact of rough surfaces", "normal"),
        "wear_history": Kept("physics.wear.history:WearHistory", "contact that wears", "last"),
        "motion": Kept("physics.dynamics.motion:Motion", "motion of a model"),
        "indentation_state": Kept("fem.history:IndentationState", "state of finite elements"),
        "pass_state": Kept("fem.passes:PassState", "state of finite elements"),
    }
)
"""Results beside contacts and load paths by the name of their group in files."""

DRAWN = (Drawn("physics.stress.field:StressField", "physics.stress.figures:figure_of"),)
"""Types that notebooks draw beside surfaces, contacts and load paths."""

MORE_FIGURES = ("physics.friction.figures:SHEAR_PLOTS",)
"""Where figures of a contact stand that notebooks draw on request alone."""

PATH_FIGURES: Mapping[str, str] = MappingProxyType({"stick_slip": "physics.friction.figures:LOOP_PLOTS"})
"""Where figures of a load path stand, by the name of the coupling of which they are; the first is
the most telling where the path has that."""

STEP_TEXTS: Mapping[str, str] = MappingProxyType({"stick_slip": "physics.friction.fretting:step_texts"})
"""What a load path says of each step beside its load, by the name of the coupling that it is of."""

ENERGY_TERMS = ("meniscus_work", "shear_work", "tangential_work", "slip_work", "step_work", "jump_work", "fluid_work")
"""Names of what the physics of this package add to the energies of a history."""


def home(place: str) -> Any:
    """What stands at ``place``, such as ``physics.adhesion.physics:Adhesive``."""
    module, _, name = place.partition(":")
    return getattr(import_module(f"asperity.{module}"), name)


def role(name: str) -> Any:
    """What the physics of that role is.

    Raises
    ------
    LookupError
        If it is not there.
    """
    if name not in ROLES:
        raise LookupError(f"this package was installed without what is needed as {name!r}")
    return home(ROLES[name])
