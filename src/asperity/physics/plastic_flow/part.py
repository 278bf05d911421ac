"""Plastic flow in the volume: layers and base that flow under the rough contact, zones, residual stress, imprint and what may crack layers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.units import percent, show
from ...core.values import Length, Number, Whole
from ...parts.part import Found, Part, Solved, Stored, Words
from .part_quantities import number_rows, quantities_of, tension_table, zones_table

if TYPE_CHECKING:
    from ...contact.controls import Control, Step
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure

PREFIX = "plastic_flow"

Tolerance = Annotated[float, Number(above=0.0, below=1.0)]


class PlasticFlowSettings(Settings):
    """Layers and base flow at their yield stress with their hardening, in the volume below the contact.

    A single load is reached in ``steps``, and with ``unload`` taken off in as many. Depth cells are chosen by the stress, unless ``depth`` says where they end.
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
    table = "plastic_flow"
    settings = PlasticFlowSettings
    whole_path = True

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, imprint, cut and curve."""
        return (*SCALARS, IMPRINT, *quantities_of(PREFIX))

    def asked(self, document: Any, folder: Path) -> Flows | None:
        """The table [plastic_flow], unless it is switched off."""
        table: PlasticFlowSettings = document.plastic_flow
        return Flows(table) if table.active else None

    def check(self, ask: Flows, problem: ContactProblem) -> None:
        """Refuse bodies that cannot flow, before the contact is solved."""
        from .law import plastic_body
        from .part_values import require_flow

        body, _ = plastic_body(problem.body, problem.counter_body)
        require_flow(body, unknown_is_elastic=ask.settings.unknown_is_elastic)

    def altered(self, ask: Flows, problem: ContactProblem) -> ContactProblem:
        """``problem`` with the laws of its bodies, by which the flow joins the solve."""
        from .work import flow_law

        return problem.with_physics(plastic_flow=flow_law(ask.settings, problem))

    def course(self, ask: Flows, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """A single load in steps, and the way back."""
        from ...contact.controls import Approach, Force, MeanPressure
        from ...contact.history import ramps

        table = ask.settings
        (control,) = controls if len(controls) == 1 else (None,)
        kind = type(control)
        if not isinstance(control, Approach | Force | MeanPressure):
            return controls
        value = float(control.value)
        if table.steps == 1 and not table.unload:
            return controls
        points = [value, 0.0] if table.unload else [value]
        return tuple(ramps(kind, points, steps=table.steps))  # type: ignore[arg-type]

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Zones, residual stress, imprint and tensions."""
        from .work import flow_found

        return flow_found(solved)

    def citations(self, ask: Any, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of the method."""
        from .answer import PlasticBody

        return (*PlasticBody.citation_keys, "SimoTaylor1985")

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of the imprint; on the cut through the largest strain zones, residual stress, stress under load; curve."""
        import numpy as np

        from ...plots.picture import figures_by
        from .figures import IMPRINT_MAP, ImprintMap, plots_of
        from .part_values import picture_of

        shown = picture_of(PREFIX, found.values, found.detail)
        surface = ImprintMap(solved.problem, np.asarray(found.values[IMPRINT.name]))
        return (*figures_by(plots_of(shown, "flow"), shown), *figures_by((IMPRINT_MAP,), surface))

    def words(self, found: Found, solved: Solved) -> Words:
        """What flows, what stays, zones by layer, tensions."""
        values = found.values
        strain = percent(float(values["flow_largest_strain"]))
        depth, dent = (show(float(values[name]), "m", 3) for name in ("flow_depth", "flow_imprint_depth"))
        work = show(float(values["flow_plastic_work"]), "J", 3)
        sentence = f"The body flows down to {depth} with plastic strains of up to {strain}; an imprint of {dent} stays, and plastic flow took {work}."
        if not float(values["flow_largest_strain"]) > 0.0:
            sentence = "Nothing flows beneath the contact: it is elastic."
        zones = ("Plastic zones", zones_table(found.detail))
        tables = (zones, ("Tension and shear that may crack layers", tension_table(values, "flow")))
        return Words(sentence, [("largest plastic strain", strain)], number_rows(SCALARS, values), tables, (REMARK,))

    def stored(self, found: Found) -> Stored:
        """Names of layers and table of zones."""
        return Stored(facts=found.detail)

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        return dict(stored.facts)


# In words and tables.

REMARK = (
    "Plastic strain is found in the volume with small strains, on the flat surface of the undeformed body. The residual stress is that of the plastic strain without load; flow in reverse during the "
    "unloading is in it only where the unloading was computed (--plastic-unload). Stresses of the table [stress] hold the plastic strain. Tensions are means over depth cells."
)
"""What the model is."""
