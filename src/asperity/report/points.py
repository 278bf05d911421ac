"""Axes of a study and their points in words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..core.units import show
from ..studies.axes import Axis

if TYPE_CHECKING:
    import xarray


def labelled(variable: xarray.DataArray) -> Labelled:
    """Values, unit and label of ``variable``."""
    quantity = Quantity(str(variable.name), str(variable.attrs.get("units", "1")), axis_words(variable))
    return Labelled(quantity, np.asarray(variable, dtype=float))


def axis_words(variable: xarray.DataArray) -> str:
    """What ``variable`` is, in words: its label, or the scalar at the end of the path of an
    axis."""
    label = str(variable.attrs.get("long_name", variable.name))
    if " " in label:
        return label
    return path_words(label) if "." in label else label.replace("_", " ")


def axis_name(axis: Axis) -> str:
    """What is varied on an axis of a study, in words."""
    return path_words(axis.path) if axis.path and not axis.title else axis.name.replace("_", " ")


_NAMES = {"youngs_modulus": "Young's modulus", "poisson_ratio": "Poisson's ratio", "rms_height": "rms height"}


def path_words(path: str) -> str:
    """A ``path`` in words, with the body or layer that it leads to: "body.layers.0.thickness" is
    the thickness of layer 1."""
    keys = path.split(".")
    word = _NAMES.get(keys[-1], keys[-1].replace("_", " "))
    if keys[-1].isdigit():
        word = f"{keys[-2].replace('_', ' ')} {int(keys[-1]) + 1}"
    of = []
    if "layers" in keys[:-2]:
        of.append(f"layer {int(keys[keys.index('layers') + 1]) + 1}")
    elif "base" in keys[:-1]:
        of.append("the base")
    if keys[0].startswith("counter"):
        of.append(f"the {keys[0].replace('_', ' ')}")
    return " of ".join([word, *of])


def point_text(coordinate: xarray.DataArray) -> str:
    """Name and value of one point of an axis."""
    text = coordinate_text(coordinate.item(), str(coordinate.attrs.get("units", "1")))
    return f"{axis_words(coordinate)} {text}"


def coordinate_text(value: float | str, unit: str) -> str:
    """Where a point lies on its axis; only thicknesses are infinite, and mean that the layer never
    ends."""
    if isinstance(value, str):
        return value
    return "endless" if math.isinf(value) else show(float(value), unit)
