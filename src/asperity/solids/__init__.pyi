from .elastic import Conduction, Elastic, Rigid, Strength
from .layers import (
    Bonded,
    ExponentialGrading,
    Frictionless,
    Layer,
    Layered,
    LinearGrading,
    PowerGrading,
    RigidBase,
    contact_modulus,
    graded,
)
from .library import material, materials

__all__ = [
    "Bonded",
    "Conduction",
    "Elastic",
    "ExponentialGrading",
    "Frictionless",
    "Layer",
    "Layered",
    "LinearGrading",
    "PowerGrading",
    "Rigid",
    "RigidBase",
    "Strength",
    "contact_modulus",
    "graded",
    "material",
    "materials",
]
