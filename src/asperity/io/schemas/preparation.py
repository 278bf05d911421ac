"""Preparation steps of a surface, carried out in the order in which they stand: each is a declared function.

The table of a step has the parameters of its function as keys, and ``prepared`` calls it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, Union

from pydantic import Field, model_validator

from ...core.errors import InputError
from ...core.parameters import checked
from ...core.settings import Settings, table_of
from ...core.values import Length, Whole
from ...surfaces.prepare.extent import cropped, periodised, resampled, sliced, tapered
from ...surfaces.prepare.fill import filled
from ...surfaces.prepare.filter import filtered, tip_limited
from ...surfaces.prepare.level import HIGHEST_DEGREE, despiked, levelled, line_corrected
from ...surfaces.surface import Surface


@checked
def level(
    surface: Surface,
    *,
    form: Annotated[Literal["mean", "plane", "quadratic"] | None, "form to remove; the plane by default"] = None,
    degree: Annotated[int | None, Whole(0, HIGHEST_DEGREE), "total degree of a polynomial to remove instead"] = None,
    robust: Annotated[bool, "leave out outliers, such as peaks and pits"] = False,
) -> Surface:
    """Remove a ``form`` or a polynomial of total ``degree``; ``robust`` leaves out outliers."""
    return levelled(surface, (form or "plane") if degree is None else degree, robust=robust)


@checked
def filter_waves(
    surface: Surface,
    *,
    short: Annotated[Length | None, "shorter waves are removed"] = None,
    short_y: Annotated[Length | None, "the same along y, if it differs"] = None,
    long: Annotated[Length | None, "longer waves are removed"] = None,
    long_y: Annotated[Length | None, "the same along y, if it differs"] = None,
    kind: Annotated[Literal["gaussian", "robust", "sharp"], "kind of filter"] = "gaussian",
    order: Annotated[Literal[0, 1, 2], "of the polynomial fitted around each node"] = 0,
) -> Surface:
    """Remove the waves shorter than ``short`` and longer than ``long``; ``short_y``, ``long_y`` where y differs from x."""
    cutoffs = {"short": (short, short_y), "long": (long, long_y)}
    pairs = {name: (x, x if y is None else y) for name, (x, y) in cutoffs.items() if x is not None}
    return filtered(surface, short=pairs.get("short"), long=pairs.get("long"), kind=kind, order=order)


STEPS: Mapping[str, Callable[..., Surface]] = MappingProxyType(
    {
        "level": level,
        "crop": cropped,
        "resample": resampled,
        "fill": filled,
        "despike": despiked,
        "line_correct": line_corrected,
        "filter": filter_waves,
        "tip_limit": tip_limited,
        "taper": tapered,
        "periodise": periodised,
        "slice": sliced,
    }
)
"""What carries out each step."""

_AT_LEAST_ONE = {
    "crop": (("x", "y"), 'x = ["0 um", "5 um"]'),
    "filter": (("short", "long"), 'short = "1 um"'),
}
_TOGETHER = {"filter": (("short", "short_y"), ("long", "long_y"))}


class AnyStep(Settings):
    """What all steps have: rules on which of their keys go together."""

    @model_validator(mode="after")
    def _keys_go_together(self) -> AnyStep:
        step, given = getattr(self, "step", ""), self.given()
        if step in _AT_LEAST_ONE:
            keys, example = _AT_LEAST_ONE[step]
            if not any(key in given for key in keys):
                raise InputError(f" must give {' or '.join(keys)} or both, such as {example}, but gives neither.")
        if step == "level" and "form" in given and "degree" in given:
            raise InputError(" must give form or degree, but gives both.")
        if step == "slice" and ("x" in given) == ("y" in given):
            both = "both" if "x" in given else "none"
            raise InputError(f' must give exactly one of x and y, such as y = "middle", but gives {both}.')
        for key, other in _TOGETHER.get(step, ()):
            if other in given and key not in given:
                raise InputError(f" must give {key} together with {other}, but gives only {other}.")
        return self


def prepared(surface: Surface, step: Any) -> Surface:
    """``surface`` after one preparation ``step``."""
    made: Surface = step.makes(surface, **step.given("step"))
    return made


if TYPE_CHECKING:
    Step: TypeAlias = Any
else:
    _TABLES = tuple(table_of(function, AnyStep, f"step={name}") for name, function in STEPS.items())
    Step = Annotated[Union[_TABLES], Field(discriminator="step")]  # noqa: UP007  (made from a tuple)
