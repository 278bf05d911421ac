from ..solids.compliant_interface import CompliantInterface
from .bricks import brick_mesh, bricks
from .compliance import CompliantBlock, compliant_block
from .compression import CylinderCompression, compressed_cylinder
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
from .pass_fields import PassInterface, RegionFindings, interface_tractions, region_findings
from .pass_histories import hertz_pass, hertz_steps, line_load, point_load, sliding_pass, sliding_steps
from .passes import PassHistory, PassState, Track, cylinder_track, sphere_track
from .solid import Response, Solid

__all__ = [
    "CompliantBlock",
    "CompliantInterface",
    "Cone",
    "ContactSurface",
    "CylinderCompression",
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
    "PassHistory",
    "PassInterface",
    "PassState",
    "PlasticZone",
    "Pressed",
    "RegionFindings",
    "Resolution",
    "Response",
    "Solid",
    "SolidFields",
    "Sphere",
    "Target",
    "Track",
    "axisymmetric",
    "brick_mesh",
    "bricks",
    "compliant_block",
    "compressed_cylinder",
    "cylinder_track",
    "exterior",
    "hertz_pass",
    "hertz_steps",
    "indentation",
    "interface_tractions",
    "layered_mesh",
    "line_load",
    "mean_dilatation",
    "plane_strain",
    "point_load",
    "region_findings",
    "ring_areas",
    "sliding_pass",
    "sliding_steps",
    "sphere_track",
    "tensor_mesh",
]
