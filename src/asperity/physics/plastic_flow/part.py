"""Plastic flow in the volume: layers and base that flow under the rough contact, zones, residual
stress, imprint and what may crack layers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Length, Number, Whole
from ...parts.part import Part
from .part_quantities import quantities_of

PREFIX = "plastic_flow"

Tolerance = Annotated[float, Number(above=0.0, below=1.0)]


class PlasticFlowSettings(Settings):
    """Layers and base flow at their yield stress with their hardening, in the volume below the
    contact.

    A single load is reached in ``steps``, and with ``unload`` taken off in as many. Depth cells are
    chosen by the stress, unless ``depth`` says where they end.
    """

    active: bool = setting(True, option="--plastic", help="Plastic flow in the volume of the deformable body")
    steps: Annotated[int, Whole(1, 1000)] = setting(
        5, option="--plastic-steps", help="Steps in which a single load is reached"
    )
    unload: bool = setting(False, option="--plastic-unload", help="Take the load off again, in as many steps")
    cells: Annotated[int, Whole(4, 400)] = setting(40, option="--plastic-cells", help="Depth cells")
    depth: Length | None = setting(
        None, option="--plastic-depth", help="Where the depth cells end; by default as deep as the stress needs"
    )
    tolerance: Tolerance = setting(
        1e-4, option="--plastic-tolerance", help="Relative change of the plastic strain at which it counts as settled"
    )
    unknown_is_elastic: bool = setting(
        False,
        option="--plastic-unknown-elastic",
        help="Materials of unknown yield stress stay elastic, instead of being refused",
    )


SCALARS = (
    Quantity("flow_plastic_work", "J", "plastic work in the volume"),
    Quantity("flow_residual_energy", "J", "elastic energy of the residual stress"),
    Quantity("flow_volume", "m**3", "volume that has flowed"),
    Quantity("flow_layer_volume", "m**3", "volume of the layers that has flowed"),
    Quantity("flow_largest_strain", "1", "largest accumulated plastic strain in the volume"),
    Quantity("flow_layer_strain", "1", "largest accumulated plastic strain in the layers"),
    Quantity("flow_base_strain", "1", "largest accumulated plastic strain in the base"),
    Quantity("flow_top", "m", "least depth that has flowed"),
    Quantity("flow_depth", "m", "largest depth that has flowed"),
    Quantity("flow_first_yield", "Pa", "mean pressure of the step in which the first point flowed"),
    Quantity("flow_imprint_depth", "m", "depth of the residual imprint"),
    Quantity("flow_pile_up", "m", "height of what is piled up beside the imprint"),
    Quantity("flow_mean_contact_pressure", "Pa", "force / contact area under the largest load"),
    Quantity("flow_surface_tension", "Pa", "largest tension along the surface under load"),
    Quantity("flow_layer_tension", "Pa", "largest tension at the bottom of a layer under load"),
    Quantity("flow_interface_shear", "Pa", "largest shear of an interface under load"),
    Quantity("flow_interface_peel", "Pa", "largest peel stress of an interface under load"),
    Quantity("flow_residual_surface_tension", "Pa", "largest residual tension along the surface"),
    Quantity("flow_residual_layer_tension", "Pa", "largest residual tension at the bottom of a layer"),
    Quantity("flow_residual_interface_shear", "Pa", "largest residual shear of an interface"),
    Quantity("flow_residual_interface_peel", "Pa", "largest residual peel stress of an interface"),
)
"""Numbers of plastic flow; NaN where there is no layer or nothing flows."""

IMPRINT = Quantity("flow_imprint", "m", "displacement of the surface by the plastic strain, into the body", ("x", "y"))


@dataclass(frozen=True)
class Flows:
    """The table and the law."""

    settings: PlasticFlowSettings


class PlasticFlow(Part):
    """Plastic flow of the body below the contact."""

    name = "plastic_flow"
    title = "Plastic flow"
    purpose = "Where the bodies yield below the surface, how far, and what shape and stresses remain."
    table = "plastic_flow"
    settings = PlasticFlowSettings
    whole_path = True
    work = "physics.plastic_flow.work:PlasticFlowWork"
    quantities = (*SCALARS, IMPRINT, *quantities_of(PREFIX))

    def asked(self, document: Any, folder: Path) -> Flows | None:
        """The table [plastic_flow], unless it is switched off."""
        table: PlasticFlowSettings = document.plastic_flow
        return Flows(table) if table.active else None
