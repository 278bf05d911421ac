"""What a calibration leaves in its folder: numbers, the curve with its fit, and figures."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..plots.design import plot_fit, plot_profile_likelihood
from ..plots.picture import Figure, curve_figure
from ..plots.together import save_pictures
from ..studies.calibrate import LIKELY
from ..studies.calibration import Calibration
from ..studies.plan import measures

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CALIBRATION, CURVE, PLOTS = "calibration.json", "curve.csv", "plots"
"""Names in the folder."""


def calibration_figures(found: Calibration) -> Iterator[Figure]:
    """Figures of the curve with its fit, and of the profiles where there are some."""
    known, units = measures(), {"force": "N", "mean_pressure": "Pa", "approach": "m", "mean_gap": "m"}
    for name in dict.fromkeys(point.quantity for point in found.curve):
        points = [point for point in found.curve if point.quantity == name]
        key = points[0].path.rpartition(".")[2]
        x = Labelled(Quantity(key, units.get(key, "1"), key.replace("_", " ")), np.array([p.load for p in points]))
        columns = [np.array([getattr(p, part) for p in points]) for part in ("measured", "deviation", "model")]
        y = Labelled(known[name], columns[0])

        def draw(ax: Axes, x: Labelled = x, y: Labelled = y, columns: list[np.ndarray] = columns) -> Axes:
            return plot_fit(x, y, columns[1], columns[2], ax)

        yield curve_figure(name, known[name].title, "The measured curve and its fit.", draw)
    for each in found.parameters:
        if each.name in found.profiles:
            values, rises = np.array(found.profiles[each.name]).T
            x = Labelled(Quantity(each.name, each.unit, each.name), values)
            text = "Rise of the sum of squares when all other parameters are fitted; below the line 95 %."
            yield curve_figure(
                f"profile_{each.name}", each.name, text, partial(plot_profile_likelihood, x, rises, LIKELY)
            )


def write_calibration_files(found: Calibration, folder: str | Path) -> tuple[Path, ...]:
    """Write numbers, curve and figures of ``found`` into ``folder``, over those of an earlier time.

    Raises
    ------
    OutputError
        If one of them cannot be written.
    """
    place = Path(folder)
    found.save_json(place / CALIBRATION, overwrite=True)
    found.save_csv(place / CURVE, overwrite=True)
    save_pictures(calibration_figures(found), place / PLOTS, overwrite=True)
    return place / CALIBRATION, place / CURVE, place / PLOTS
