"""Bodies of a problem document."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from ..core import units
from ..core.errors import InputError
from ..core.settings import problems
from ..solids.elastic import Elastic, Rigid, Strength
from ..solids.grading import ExponentialGrading, Grading, LinearGrading, PowerGrading, graded
from ..solids.layers import Base, Body, Bonded, Frictionless, Interface, Layer, Layered, RigidBase
from ..solids.library import material
from .schemas.bodies import BaseTable, BodyTable, GradedTable, LayerTable, MaterialTable
from .schemas.body_text import body_from_text


def build_body(table: BodyTable, folder: Path) -> Body:
    """Body that ``table`` names or describes; the path of its materials file starts at ``folder``."""
    library = None if table.materials_file is None else folder / table.materials_file
    if table.base is not None:
        layers = [layer for part in table.layers for layer in _layers(part, library)]
        return Layered(layers, _base(table.base, library), table.name or "")
    return Rigid() if table.rigid else _elastic(table, library)


def body_of_text(text: str, what: str) -> Body:
    """Body from its one line of text, such as ``"DLC"`` or ``"E=140GPa,nu=0.25,H=15GPa"``; ``what`` names it in messages.

    Raises
    ------
    InputError
        If it is not understood.
    """
    try:
        table = BodyTable.model_validate(body_from_text(text))
    except InputError as error:
        raise InputError(f"{what}{error}") from None
    except ValidationError as error:
        raise InputError(f"{what}: {'; '.join(problems(error, BodyTable.model_json_schema(), {}))}") from None
    return build_body(table, Path())


def _layers(table: LayerTable | GradedTable, library: Path | None) -> tuple[Layer, ...]:
    thickness = units.parse(table.thickness, "length", "thickness")
    interface: Interface = Frictionless() if table.interface == "frictionless" else Bonded()
    if isinstance(table, LayerTable):
        return (Layer(_elastic(table, library), thickness, interface),)
    top, bottom = _elastic(table.top, library), _elastic(table.bottom, library)
    return graded(top, bottom, thickness, grading=_grading(table), sublayers=table.sublayers, interface=interface)


def _grading(table: GradedTable) -> Grading:
    if table.exponent is not None:
        return PowerGrading(table.exponent)
    return LinearGrading() if table.kind == "linear" else ExponentialGrading()


def _base(table: BaseTable, library: Path | None) -> Base:
    return RigidBase() if table.rigid else _elastic(table, library)


def _elastic(table: MaterialTable, library: Path | None) -> Elastic:
    if table.material is not None:
        return material(table.material, library=library)
    assert table.youngs_modulus is not None
    assert table.poisson_ratio is not None
    strength = Strength(_pressure(table.hardness), _pressure(table.yield_stress))
    return Elastic(
        _pressure(table.youngs_modulus), table.poisson_ratio, strength, name=table.name or "", sources=("user",)
    )


def _pressure(value: float | str | None) -> float:
    return float("nan") if value is None else float(value)
