"""Analysis of a study: means, orders, critical thicknesses, sensitivities, as a labelled
dataset."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.arrays import RealArray
from ..io.schemas.study import StudyDocument
from .convergence import convergence, step_sizes
from .critical_thickness import critical_thickness
from .monte_carlo import CONFIDENCE, estimate
from .sensitivity import BASE, ENDS, sensitivity

if TYPE_CHECKING:
    import xarray

UNITS = {"order": "1", "remark": "", "error": "1", "count": "1", "floor": "m", "ceiling": "m", "elasticity": "1"}
"""Units of derived numbers that are not those of the quantity."""


def analysis(
    data: xarray.Dataset, document: StudyDocument, columns: tuple[str, ...] | None = None
) -> xarray.Dataset | None:
    """Derived numbers of the ``columns`` of the results ``data``, the quantities asked for by
    default: variables such as ``max_pressure_mean``; None for a sweep.

    monte_carlo: ``mean``, ``deviation``, ``half_width``, ``count``; convergence: ``order``,
    ``extrapolated``, ``error``, ``remark``; critical_thickness: ``floor``, ``ceiling``,
    ``at_zero``, ``at_infinity``; sensitivity, along ``scalar``: ``low``, ``high``, ``elasticity``,
    ``slope``.
    """
    columns = document.quantities if columns is None else columns
    if document.monte_carlo is not None:
        stop = document.monte_carlo.stop
        confidence = CONFIDENCE if stop is None else stop.confidence
        return _reduced(data, columns, "sample", lambda values: estimate(values, confidence))
    if document.convergence is not None:
        steps = step_sizes(document.convergence.of, [float(level) for level in data["level"]])
        return _reduced(data, columns, "level", lambda values: convergence(steps, list(values)))
    if document.critical_thickness is not None:
        inside, share = np.asarray(data["thickness"])[1:-1], document.critical_thickness.share
        return _reduced(
            data,
            columns,
            "thickness",
            lambda values: critical_thickness(inside, values[1:-1], float(values[0]), float(values[-1]), share=share),
        )
    return None if document.sensitivity is None else _sensitivities(data, columns)


def _reduced(
    data: xarray.Dataset, quantities: Sequence[str], dim: str, derive: Callable[[RealArray], object]
) -> xarray.Dataset:
    """Numbers and words that ``derive`` makes of each quantity along ``dim``, on the other axes."""
    import xarray

    made: dict[str, Any] = {}
    for name in quantities:
        array = data[name].transpose(..., dim)
        dims = {str(other): size for other, size in zip(array.dims[:-1], array.shape, strict=False)}
        found = [vars(derive(row)) for row in np.asarray(array).reshape(-1, array.shape[-1])]
        rows = [{key: value for key, value in each.items() if not isinstance(value, tuple)} for each in found]
        for key in rows[0]:
            made[f"{name}_{key}"] = _variable(data, name, key, dims, [row[key] for row in rows])
    kept = {str(key): value for key, value in data.coords.items() if dim not in value.dims}
    return xarray.Dataset(made, kept, {"kind": data.attrs["kind"], "title": data.attrs["title"]})


def _sensitivities(data: xarray.Dataset, quantities: Sequence[str]) -> xarray.Dataset:
    """Low and high case of every scalar side by side."""
    import xarray

    names = [str(name) for name in np.asarray(data["parameter"])]
    scalars = list(dict.fromkeys(name.rpartition(" ")[0] for name in names if name != BASE))
    ends = [data.isel(parameter=[names.index(f"{scalar} {end}") for scalar in scalars]) for end in ENDS]
    x = [np.asarray(end["value"], dtype=float) for end in ends]
    made: dict[str, Any] = {"scalar_low": ("scalar", x[0]), "scalar_high": ("scalar", x[1])}
    for name in quantities:
        y = [np.asarray(end[name].transpose(..., "parameter"), dtype=float) for end in ends]
        others = ends[0][name].transpose(..., "parameter").dims[:-1]
        dims = dict(zip([*map(str, others), "scalar"], y[0].shape, strict=True))
        rows = [
            vars(sensitivity((float(x[0][at[-1]]), float(x[1][at[-1]])), (float(y[0][at]), float(y[1][at]))))
            for at in np.ndindex(y[0].shape)
        ]
        for key in rows[0]:
            made[f"{name}_{key}"] = _variable(data, name, key, dims, [row[key] for row in rows])
    kept = {str(key): value for key, value in data.coords.items() if "parameter" not in value.dims}
    attributes = {"kind": data.attrs["kind"], "title": data.attrs["title"]}
    return xarray.Dataset(made, {**kept, "scalar": np.array(scalars, object)}, attributes)


def _variable(data: xarray.Dataset, name: str, key: str, dims: dict[str, int], values: Sequence[Any]) -> Any:
    """Numbers or texts ``key`` of the quantity ``name`` on axes of these sizes, with unit and
    label."""
    unit = "" if key == "slope" else UNITS.get(key, data[name].attrs["units"])
    labels = {"units": unit, "long_name": f"{data[name].attrs['long_name']}: {key.replace('_', ' ')}"}
    kind: Any = object if isinstance(values[0], str) else float
    return tuple(dims), np.array(values, kind).reshape(tuple(dims.values())), labels
