"""Plastic flow beneath the surface: which parts of a body flow, and how it is resolved in depth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...core import require
from ...core.errors import InputError
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Body, Layered, RigidBase
from ...solids.plasticity import J2


@dataclass(frozen=True)
class PlasticFlow:
    """Plastic flow in the volume of the deformable body: plastic strain as an eigenstrain of the
    layered half-space.

    Small strains; the body keeps its flat surface for the elastic response, the plastic
    displacement of the surface adds to its heights.

    Parameters
    ----------
    plasticity
        ``J2`` law of a homogeneous body; of a layered one a sequence of them for each layer from
        the surface down and then the base, None (or its ``Elastic``, as ``plastic_parts`` has it)
        for what stays elastic. The elastic constants must be those of the body.
    cells
        Depth cells down to where the elastic von Mises stress of the first load that yields is
        below the yield stress, at least 4. More are added below where larger loads need them.
    depth
        Depth in m that the cells end at; None to choose it by the stress.
    tolerance
        Relative change of the plastic strain by the return mapping at which it counts as settled.

    Raises
    ------
    InputError
        If a law is no ``J2`` or a number is out of its range.
    """

    plasticity: J2 | Sequence[J2 | Elastic | None]
    cells: int = 40
    depth: float | None = None
    tolerance: float = 1e-4
    name: ClassVar[str] = "plastic flow"
    citation_keys: ClassVar[tuple[str, ...]] = ("Frerot2019", "Jacq2002", "SimoTaylor1985")

    def __post_init__(self) -> None:
        laws = (self.plasticity,) if isinstance(self.plasticity, J2) else self.plasticity
        if not isinstance(laws, Sequence) or isinstance(laws, str):
            raise InputError(
                f"plasticity of a PlasticFlow must be a J2 law or a sequence of them, but is {self.plasticity!r}. "
                "Write J2(Elastic(E, nu), LinearHardening(Y))."
            )
        for law in laws:
            if not isinstance(law, J2 | Elastic | None):
                raise InputError(
                    f"plasticity of a PlasticFlow must hold J2 laws and None alone, but holds {law!r}. "
                    "Write J2(Elastic(E, nu), LinearHardening(Y))."
                )
        if not any(isinstance(law, J2) for law in laws):
            raise InputError(
                "plasticity of a PlasticFlow must hold at least one J2 law, but holds none. Leave "
                "plastic_flow out of an elastic problem."
            )
        if not isinstance(self.plasticity, J2):
            kept = tuple(law if isinstance(law, J2) else None for law in laws)
            object.__setattr__(self, "plasticity", kept)
        require.integer(self.cells, 4, "number of depth cells of a PlasticFlow")
        require.positive(self.tolerance, "tolerance of a PlasticFlow")
        if self.depth is not None:
            require.positive(self.depth, "depth of a PlasticFlow (m)")

    def laws(self, body: Elastic | Layered) -> tuple[J2 | None, ...]:
        """Laws of the layers of finite thickness of ``body`` and of its base.

        Raises
        ------
        InputError
            If their number or elastic constants are not those of the body.
        """
        given = (self.plasticity,) if isinstance(self.plasticity, J2) else self.plasticity
        if isinstance(body, Layered) and len(given) != len(body.layers) + 1:
            body = body.reduced  # laws of what takes part alone
        layers = body.layers if isinstance(body, Layered) else ()
        materials = [layer.material for layer in layers] + [body.base if isinstance(body, Layered) else body]
        if isinstance(materials[-1], RigidBase) and len(given) == len(layers):
            given = (*given, None)
        if len(given) != len(materials):
            raise InputError(
                f"plasticity of a PlasticFlow must hold one law for each of the {len(layers)} layers and one "
                f"for the base, but holds {len(given)}. Write None for what stays elastic."
            )
        found: list[J2 | None] = []
        for number, (law, material) in enumerate(zip(given, materials, strict=True)):
            if isinstance(law, J2):
                if not isinstance(material, Elastic):
                    raise InputError(
                        "plasticity of a rigid base must be None, but is a J2 law. Write None as the last of the laws."
                    )
                ours, own = law.elastic, material
                if (ours.youngs_modulus, ours.poisson_ratio) != (own.youngs_modulus, own.poisson_ratio):
                    raise InputError(
                        f"elastic constants of a J2 law must be E = {own.youngs_modulus:g} Pa, nu = "
                        f"{own.poisson_ratio:g} of the body, but are E = {ours.youngs_modulus:g} Pa, nu = "
                        f"{ours.poisson_ratio:g}."
                    )
            thickness = layers[number].thickness if number < len(layers) else 1.0
            if thickness > 0.0:
                found.append(law if isinstance(law, J2) else None)
            if thickness == float("inf"):
                break
        return tuple(found)


def plastic_body(body: Body, counter_body: Body) -> tuple[Elastic | Layered, float]:
    """The body that flows and the sign of the shear traction on it: ``body``, or where that is
    rigid the ``counter_body``."""
    if not isinstance(body, Rigid):
        return body, 1.0
    assert not isinstance(counter_body, Rigid)
    return counter_body, -1.0
