from .contact import ContactSurface, Equilibrium, Pressed, Target
from .elements import Elements, axisymmetric, mean_dilatation, plane_strain
from .far_field import exterior
from .history import (
    IndentationHistory,
    IndentationState,
    IndentationStep,
    InterfaceTraction,
    LayerTension,
    PlasticZone,
    SolidFields,
    ring_areas,
)
from .indent import Depth, Indentation, Load, indentation
from .indenters import Cone, FlatPunch, Paraboloid, Sphere
from .mesh import Mesh, Resolution, layered_mesh, tensor_mesh
from .solid import Response, Solid

__all__ = [
    "Cone",
    "ContactSurface",
    "Depth",
    "Elements",
    "Equilibrium",
    "FlatPunch",
    "Indentation",
    "IndentationHistory",
    "IndentationState",
    "IndentationStep",
    "InterfaceTraction",
    "LayerTension",
    "Load",
    "Mesh",
    "Paraboloid",
    "PlasticZone",
    "Pressed",
    "Resolution",
    "Response",
    "Solid",
    "SolidFields",
    "Sphere",
    "Target",
    "axisymmetric",
    "exterior",
    "indentation",
    "layered_mesh",
    "mean_dilatation",
    "plane_strain",
    "ring_areas",
    "tensor_mesh",
]
