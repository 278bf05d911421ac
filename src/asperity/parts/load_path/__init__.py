"""A load path: the state of the contact at every step, where the load turns, and where its work goes."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...core.quantity import Quantity
from ..part import Found, Part, Solved, Words

if TYPE_CHECKING:
    from ...plots.picture import Figure


class LoadPath(Part):
    """Steps of a load path and their energies."""

    name = "path"
    title = "Load path"
    table = "control.path"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars and energies of every step."""
        from ...contact.result import SCALARS
        from ...io.results import ENERGIES

        names = {item.name: item for item in SCALARS} | {f"path_{item.name}": item for item in ENERGIES}
        return tuple(replace(item, name=name, dims=("step",), costly=False) for name, item in names.items())

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Scalars and energies of the steps, if these were kept."""
        import numpy as np

        if solved.path is None:
            return Found()
        balance, values = solved.path.energies, {}
        for item in self.quantities:
            if item.name.startswith("path_"):
                values[item.name] = getattr(balance, item.name.removeprefix("path_"))
            else:
                values[item.name] = np.array([getattr(step, item.name) for step in solved.path.steps])
        return Found(values, solved.path)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Loops of load and area, and the energies."""
        from ...plots.contact import PATH_PLOTS, render_path_plot
        from ...plots.picture import Figure

        plots = PATH_PLOTS if found.detail is not None else ()
        return tuple(Figure(p.name, p.title, p.caption, render_path_plot(p, found.detail)) for p in plots)

    def words(self, found: Found, solved: Solved) -> Words:
        """Where the load turns, and where its work goes."""
        from .words import words

        return Words() if found.detail is None else words(found.detail)
