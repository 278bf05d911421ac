"""Figures of plastic flow beneath a contact: zones by layer, residual stress, load against
approach, imprint, hardness against depth, frames of a history."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.units import show
from ...plots.animation import save_frames
from ...plots.maps import Field, Look, map_of
from ...plots.picture import (
    BLACK,
    BLUE,
    GREEN,
    HEIGHT_MAP,
    ORANGE,
    VERMILLION,
    Plot,
    legend_above,
    literal,
    make_room,
    scale,
    style,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ...contact.problem import ContactProblem

ELASTIC = "#ECECEC"
"""Colour of what has not flowed."""

LEAST = 1e-12
"""Accumulated plastic strain below which a cell counts as elastic."""


@dataclass(frozen=True, eq=False)
class Cut:
    """Plane cut through a body that flowed: cells between lines across and in depth.

    Attributes
    ----------
    across, depth
        (n + 1,) and (m + 1,) edges of the cells in m; across is a radius or a coordinate, depth
        positive into the body.
    strain
        (n, m) accumulated plastic strain.
    interfaces
        Depths of the interfaces in m.
    layers
        Names of the layers from the surface down, the base last.
    axis
        What ``across`` is called.
    residual
        (n, m) residual stress along ``across`` in Pa, after the load is taken off; None where not
        known.
    stress
        (n, m) von Mises stress under the load in Pa; None where not known.
    label
        Which state this is, for frames.
    """

    across: RealArray
    depth: RealArray
    strain: RealArray
    interfaces: tuple[float, ...] = ()
    layers: tuple[str, ...] = ()
    axis: str = "x"
    residual: RealArray | None = None
    stress: RealArray | None = None
    label: str = ""

    @property
    def reach(self) -> tuple[float, float, float]:
        """Left, right and depth (m) of what is drawn: twice the plastic zone, all if nothing
        flowed."""
        columns = np.flatnonzero((self.strain > LEAST).any(axis=1))
        rows = np.flatnonzero((self.strain > LEAST).any(axis=0))
        if not columns.size:
            return float(self.across[0]), float(self.across[-1]), float(self.depth[-1])
        low, high = float(self.across[columns[0]]), float(self.across[columns[-1] + 1])
        deep = 1.6 * float(self.depth[rows[-1] + 1])
        room = 0.6 * max(high - low, deep)
        left, right = max(low - room, float(self.across[0])), min(high + room, float(self.across[-1]))
        return left, right, min(max(deep, 0.3 * (right - left)), float(self.depth[-1]))


@dataclass(frozen=True, eq=False)
class PlasticPicture:
    """What figures of plastic flow are drawn from, SI; arrays that are empty are left out.

    Attributes
    ----------
    cut
        State under the largest load, and residual stress.
    approach, force
        (steps,) of the history in m and N.
    hertz
        (steps,) force of the elastic contact at the same approach, N.
    place, imprint
        (n,) coordinate and height of the surface that stays, m, positive outwards.
    mean_pressure
        (steps,) force over contact area in Pa.
    unloading
        (2, k) approach and force of the fitted unloading.
    oliver_pharr
        Hardness by Oliver and Pharr in Pa; NaN where not known.
    """

    cut: Cut
    approach: RealArray = field(default_factory=lambda: np.zeros(0))
    force: RealArray = field(default_factory=lambda: np.zeros(0))
    hertz: RealArray = field(default_factory=lambda: np.zeros(0))
    place: RealArray = field(default_factory=lambda: np.zeros(0))
    imprint: RealArray = field(default_factory=lambda: np.zeros(0))
    mean_pressure: RealArray = field(default_factory=lambda: np.zeros(0))
    unloading: RealArray = field(default_factory=lambda: np.zeros((2, 0)))
    oliver_pharr: float = float("nan")


def plot_zones(shown: PlasticPicture | Cut, ax: Axes, *, largest: float | None = None) -> Axes:
    """Draw the accumulated plastic strain below the surface on ``ax``, with interfaces and names of
    the layers; what did not flow is grey.

    ``largest`` is the strain at the end of the colours, by default that of the cut.
    """
    cut = shown.cut if isinstance(shown, PlasticPicture) else shown
    strain = np.where(cut.strain > LEAST, cut.strain, np.nan)
    top = float(np.nanmax(strain)) if np.isfinite(strain).any() else 1e-3
    ends = (0.0, 100.0 * (largest or top))
    return _drawn(cut, 100.0 * strain, ax, label="accumulated plastic strain (%)", colours="viridis", ends=ends)


def plot_residual(shown: PlasticPicture, ax: Axes) -> Axes:
    """Draw the residual stress along the cut on ``ax``: blue compression, red tension."""
    assert shown.cut.residual is not None
    left, right, deep = shown.cut.reach
    inside = np.ix_((shown.cut.across[1:] > left) & (shown.cut.across[:-1] < right), shown.cut.depth[:-1] < deep)
    stress = scale(shown.cut.residual[inside], "Pa")
    largest = max(float(np.abs(stress(shown.cut.residual[inside])).max()), 1e-300)
    label = f"residual stress σ{shown.cut.axis}{shown.cut.axis} ({stress.symbol})"
    return _drawn(shown.cut, stress(shown.cut.residual), ax, label=label, colours="RdBu_r", ends=(-largest, largest))


def plot_stress_under_load(shown: PlasticPicture, ax: Axes) -> Axes:
    """Draw the von Mises stress under the largest load on ``ax``."""
    assert shown.cut.stress is not None
    stress = scale(shown.cut.stress, "Pa")
    values = stress(shown.cut.stress)
    return _drawn(
        shown.cut,
        values,
        ax,
        label=f"von Mises stress ({stress.symbol})",
        colours="inferno",
        ends=(0.0, float(values.max())),
    )


def _drawn(cut: Cut, values: RealArray, ax: Axes, *, label: str, colours: str, ends: tuple[float, float]) -> Axes:
    left, right, deep = cut.reach
    length = scale(np.array([right - left, deep]), "m")
    make_room(ax, right=0.9)
    ax.set_facecolor(ELASTIC)
    mesh = ax.pcolormesh(
        length(cut.across), length(cut.depth), values.T, cmap=colours, vmin=ends[0], vmax=ends[1], shading="flat"
    )
    names = cut.layers if len(cut.layers) > 1 else ()
    tops = (0.0, *cut.interfaces)
    for depth in cut.interfaces:
        if depth < deep:
            ax.axhline(float(length(depth)), color=VERMILLION, linewidth=0.9)
    for name, top in zip(names, tops, strict=False):
        bottom = min([z for z in (*cut.interfaces, deep) if z > top], default=deep)
        if top < deep and (min(bottom, deep) - top) > 0.05 * deep:
            middle = 0.5 * (top + min(bottom, deep))
            box = {"facecolor": "white", "alpha": 0.6, "linewidth": 0.0, "pad": 1.0}
            ax.text(
                0.98,
                1.0 - middle / deep,
                literal(name),
                transform=ax.transAxes,
                ha="right",
                va="center",
                fontsize=7.5,
                bbox=box,
            )
    bar = ax.inset_axes((1.03, 0.0, 0.04, 1.0))
    figure: Any = ax.figure
    figure.colorbar(mesh, cax=bar, label=label)
    ax.set(
        xlim=(float(length(left)), float(length(right))),
        ylim=(float(length(deep)), 0.0),
        xlabel=f"{cut.axis} ({length.symbol})",
        ylabel=f"depth ({length.symbol})",
    )
    return ax


def plot_load_approach(shown: PlasticPicture, ax: Axes) -> Axes:
    """Draw force against approach on ``ax``: loading and unloading, the elastic contact beside it,
    and the fitted unloading."""
    metres, newtons = scale(shown.approach, "m"), scale(shown.force, "N")
    peak = int(np.argmax(shown.force))
    ax.plot(
        metres(shown.approach[: peak + 1]), newtons(shown.force[: peak + 1]), color=BLUE, marker=".", label="loading"
    )
    if peak + 1 < shown.force.size:
        ax.plot(
            metres(shown.approach[peak:]),
            newtons(shown.force[peak:]),
            color=VERMILLION,
            marker=".",
            label="after the peak",
        )
    if shown.hertz.size:
        known = np.isfinite(shown.hertz[: peak + 1])
        elastic = newtons(shown.hertz[: peak + 1])[known]
        ax.plot(metres(shown.approach[: peak + 1])[known], elastic, color="0.55", linestyle="--", label="elastic")
    if shown.unloading.size:
        ax.plot(
            metres(shown.unloading[0]),
            newtons(shown.unloading[1]),
            color=GREEN,
            linestyle=":",
            label="fitted unloading",
        )
    top = 1.08 * float(newtons(shown.force.max()))
    ax.set(xlabel=f"approach ({metres.symbol})", ylabel=f"force ({newtons.symbol})", xlim=(0.0, None), ylim=(0.0, top))
    return legend_above(ax)


def plot_imprint(shown: PlasticPicture, ax: Axes) -> Axes:
    """Draw the surface that stays after the load is taken off on ``ax``: the dent, and what is
    piled up beside it."""
    metres, tall = scale(shown.place, "m"), scale(shown.imprint, "m")
    ax.plot(metres(shown.place), tall(shown.imprint), color=BLUE)
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    left, right, _ = shown.cut.reach
    ax.set(
        xlabel=f"{shown.cut.axis} ({metres.symbol})",
        ylabel=f"height of the residual surface ({tall.symbol})",
        xlim=(float(metres(max(left, shown.place.min()))), float(metres(min(right, shown.place.max())))),
    )
    return ax


def plot_hardness_depth(shown: PlasticPicture, ax: Axes) -> Axes:
    """Draw the mean contact pressure against the approach on ``ax``, and the hardness that Oliver
    and Pharr's method reads from the curve."""
    peak = int(np.argmax(shown.force))
    metres, pascals = scale(shown.approach, "m"), scale(shown.mean_pressure[: peak + 1], "Pa")
    ax.plot(
        metres(shown.approach[: peak + 1]),
        pascals(shown.mean_pressure[: peak + 1]),
        color=BLUE,
        marker=".",
        label="force / true area",
    )
    if np.isfinite(shown.oliver_pharr):
        ax.plot(
            [float(metres(shown.approach[peak]))],
            [float(pascals(shown.oliver_pharr))],
            color=ORANGE,
            marker="D",
            linestyle="none",
            label="Oliver-Pharr",
        )
    highest = max(float(np.nanmax(shown.mean_pressure[: peak + 1], initial=0.0)), np.nan_to_num(shown.oliver_pharr))
    ax.set(
        xlabel=f"approach ({metres.symbol})",
        ylabel=f"mean pressure ({pascals.symbol})",
        xlim=(0.0, None),
        ylim=(0.0, 1.1 * float(pascals(highest)) or None),
    )
    return legend_above(ax)


def plot_mesh(shown: PlasticPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the lines of the mesh under the indenter, with the interfaces of layers."""
    cut = shown.cut
    length = scale(float(cut.depth[-1]), "m")
    right, deep = (float(length(line[-1])) for line in (cut.across, cut.depth))
    ax.vlines(length(cut.across), 0.0, deep, color=BLACK, linewidth=0.3)
    ax.hlines(length(cut.depth), float(length(cut.across[0])), right, color=BLACK, linewidth=0.3)
    for depth in cut.interfaces:
        if depth <= float(cut.depth[-1]):
            ax.axhline(float(length(depth)), color=VERMILLION, linewidth=1.0)
    ax.set(xlabel=f"{cut.axis} ({length.symbol})", ylabel=f"depth ({length.symbol})", aspect="equal")
    ax.set_xlim(float(length(cut.across[0])), right)
    ax.set_ylim(deep, 0.0)
    return ax


MESH = Plot(
    "mesh",
    "Mesh",
    "Elements under the indenter, finest where it touches; they grow to the far boundary beyond. Red lines are "
    "interfaces of layers.",
    plot_mesh,
)
ZONES = Plot(
    "plastic_zones",
    "Plastic zones",
    "Accumulated plastic strain below the surface; what stayed elastic is grey, lines are interfaces.",
    plot_zones,
)
RESIDUAL = Plot(
    "residual_stress",
    "Residual stress",
    "Stress along the cut that stays when the load is taken off: blue compression, red tension, balanced over "
    "the body.",
    plot_residual,
)
LOADED = Plot(
    "plastic_stress",
    "Stress under the largest load",
    "Von Mises stress below the surface under the largest load; perfectly plastic layers are at their yield stress.",
    plot_stress_under_load,
)
CURVE = Plot(
    "load_approach",
    "Load against approach",
    "Force against approach of the history, the elastic contact beside its loading. The area between loading "
    "and unloading is the work that plastic flow took.",
    plot_load_approach,
)
IMPRINT = Plot(
    "imprint",
    "Residual imprint",
    "Height of the surface along the cut after the load is taken off, enlarged in height.",
    plot_imprint,
)
HARDNESS = Plot(
    "hardness_depth",
    "Hardness against depth",
    "Force over the true contact area while the indenter goes in, and the hardness that an instrument would "
    "read from the unloading.",
    plot_hardness_depth,
)


@dataclass(frozen=True, eq=False)
class ImprintMap:
    """Displacement (nx, ny) in m of the surface of a ``problem`` by plastic strain, positive into
    the body."""

    problem: ContactProblem
    displacement: RealArray


def imprint_field(shown: ImprintMap) -> Field:
    """Height of the residual surface as a map."""
    return Field(
        -shown.displacement,
        shown.problem.grid,
        Look("m", "height of the residual imprint", HEIGHT_MAP, from_zero=False),
    )


IMPRINT_MAP = map_of(
    "flow_imprint_map",
    "Residual imprint",
    "Height that plastic flow adds to the surface, seen from above, after the load is taken off.",
    imprint_field,
    by_step=False,
)


def plots_of(shown: PlasticPicture, prefix: str = "") -> tuple[Plot, ...]:
    """Figures that ``shown`` has values for, in the order of a report; names of files begin with
    the ``prefix``."""
    made = [ZONES]
    made += [RESIDUAL] if shown.cut.residual is not None else []
    made += [LOADED] if shown.cut.stress is not None else []
    made += [CURVE] if shown.approach.size > 1 else []
    made += [IMPRINT] if shown.imprint.size else []
    made += [HARDNESS] if shown.mean_pressure.size > 1 else []
    made += [MESH] if prefix == "indentation" else []
    return tuple(replace(plot, name=f"{prefix}_{plot.name}") if prefix else plot for plot in made)


# Frames of a loading history.

FRAME_SIZE = (5.6, 3.4)
"""Width and height in inches of a frame."""


def plastic_frames(cuts: Sequence[Cut], *, dpi: int = 100) -> tuple[bytes, ...]:
    """PNG of the plastic zone in each of ``cuts``, one for each step of a history; all of one size,
    place and range of colours.

    Raises
    ------
    InputError
        If there is none.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    if not cuts:
        raise InputError("cuts of an animation must be at least one, but there is none.")
    largest = max(float(cut.strain.max()) for cut in cuts)
    whole = max(cuts, key=lambda cut: int(np.count_nonzero(cut.strain > LEAST)))
    left, right, deep = whole.reach
    length = scale(np.array([right - left, deep]), "m")

    class Frame(Cut):
        """Drawn as far as the largest zone reaches, so that all frames share one unit of length."""

        @property
        def reach(self) -> tuple[float, float, float]:
            return whole.reach

    made = []
    with style():
        for cut in cuts:
            figure, buffer = Canvas(figsize=FRAME_SIZE, dpi=dpi), io.BytesIO()
            FigureCanvasAgg(figure)
            ax = figure.add_axes((0.13, 0.15, 0.83, 0.73))
            known = {item.name: getattr(cut, item.name) for item in fields(cut)}
            plot_zones(Frame(**known), ax, largest=largest or 1e-3)
            ax.set(xlim=(float(length(left)), float(length(right))), ylim=(float(length(deep)), 0.0))
            ax.set_title(cut.label, loc="left")
            figure.savefig(buffer, format="png")
            made.append(buffer.getvalue())
    return tuple(made)


def save_cuts(cuts: Sequence[Cut], path: str | Path, *, overwrite: bool = False) -> Path:
    """Write the plastic zone in ``cuts``, one for each step of a history, as an animated picture
    (.gif, .png or .webp) of 5 steps a second.

    Raises
    ------
    InputError
        If the suffix is another, or there are fewer than two steps.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    return save_frames(path, lambda: plastic_frames(cuts), len(cuts), pause=200, overwrite=overwrite)


def step_label(number: int, approach: float, force: float) -> str:
    """Title of the frame of a step."""
    return f"step {number}: approach {show(approach, 'm', 3)}, force {show(force, 'N', 3)}"
