"""Pictures of a page as plain tables for Plotly, whose script NiceGUI brings: maps, curves and
surfaces in space."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from ..core.units import show, unit_factor

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Colours of Okabe & Ito, distinct under every common colour blindness."""

CONFIG = {
    "displaylogo": False,
    "responsive": True,
    "modeBarButtonsToRemove": ["select2d", "lasso2d", "toImage"],
    "modeBarButtonsToAdd": ["toImage"],
    "toImageButtonOptions": {"format": "svg"},
}
"""Buttons of a picture; it is saved as SVG."""

GREY = "#8a8f98"


def packed(values: Any) -> dict[str, Any]:
    """Array in the binary form that Plotly reads, single precision."""
    array = np.ascontiguousarray(values, dtype="<f4")
    shape = ", ".join(map(str, array.shape))
    return {"dtype": "f4", "bdata": base64.b64encode(array.tobytes()).decode("ascii"), "shape": shape}


def scaled(largest: float, unit: str = "m", kind: str = "length") -> tuple[str, float]:
    """Prefixed unit in which ``largest`` is between 1 and 1000, and its SI value."""
    if not np.isfinite(largest) or largest == 0.0:
        return unit, 1.0
    symbol = show(float(largest), unit).split(" ")[1]
    return symbol, unit_factor(symbol, kind, "unit of an axis")


def layout(**more: Any) -> dict[str, Any]:
    """Layout that suits dark and light."""
    return {
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"color": GREY, "family": "system-ui, sans-serif", "size": 12},
        "margin": {"l": 60, "r": 12, "t": 30, "b": 48},
        "colorway": list(COLOURS),
        **more,
    }


def axis(title: str, **more: Any) -> dict[str, Any]:
    """One axis."""
    return {
        "title": {"text": title},
        "gridcolor": "rgba(138,143,152,.25)",
        "zerolinecolor": "rgba(138,143,152,.4)",
        "linecolor": GREY,
        **more,
    }


def height_line(values: Any, spacing: tuple[float, float], title: str) -> dict[str, Any]:
    """Curve of heights (1, nx) in m at points of that spacing: a line scan."""
    count = values.shape[1]
    x_unit, x_scale = scaled(count * spacing[0])
    z_unit, z_scale = scaled(float(np.nanmax(np.abs(values), initial=0.0)))
    place = (np.arange(count, dtype=np.float32) + 0.5) * np.float32(spacing[0] / x_scale)
    return {
        "data": [{"type": "scattergl", "mode": "lines", "x": packed(place), "y": packed(values[0] / z_scale)}],
        "layout": layout(
            title={"text": title, "font": {"size": 13}},
            xaxis=axis(f"x / {x_unit}"),
            yaxis=axis(f"height / {z_unit}"),
        ),
        "config": CONFIG,
    }


def profile_curves(curves: list[tuple[str, Any, Any]], extent: float) -> dict[str, Any]:
    """Curves of heights in m over the distance in m along a line of that ``extent``, each with its
    name; the first stands out."""
    x_unit, x_scale = scaled(extent)
    z_unit, z_scale = scaled(max(float(np.nanmax(np.abs(z), initial=0.0)) for _, _, z in curves))
    return {
        "data": [
            {
                "type": "scattergl",
                "mode": "lines",
                "name": name,
                "x": packed(np.asarray(x) / x_scale),
                "y": packed(np.asarray(z) / z_scale),
                "line": {"color": "#1f83c4" if number == 0 else GREY, "width": 1.8 if number == 0 else 1},
                "hovertemplate": f"%{{x:.4g}} {x_unit}: %{{y:.4g}} {z_unit}<extra>{name}</extra>",
            }
            for number, (name, x, z) in reversed(list(enumerate(curves)))
        ],
        "layout": layout(
            xaxis=axis(f"distance / {x_unit}", range=[0.0, extent / x_scale]),
            yaxis=axis(f"height / {z_unit}"),
            margin={"l": 60, "r": 12, "t": 30 if len(curves) == 1 else 62, "b": 44},
            showlegend=len(curves) > 1,
            legend={"orientation": "h", "y": 1.0, "yref": "container", "yanchor": "top", "x": 0.0},
        ),
        "config": CONFIG,
    }


def height_map(values: Any, spacing: tuple[float, float], title: str) -> dict[str, Any]:
    """Map of heights (ny, nx) in m on a grid of that spacing."""
    ny, nx = values.shape
    x_unit, x_scale = scaled(max(nx * spacing[0], ny * spacing[1]))
    z_unit, z_scale = scaled(float(np.nanmax(np.abs(values), initial=0.0)))
    return {
        "data": [
            {
                "type": "heatmap",
                "z": packed(values / z_scale),
                "x0": 0.5 * spacing[0] / x_scale,
                "dx": spacing[0] / x_scale,
                "y0": 0.5 * spacing[1] / x_scale,
                "dy": spacing[1] / x_scale,
                "colorscale": "Cividis",
                "colorbar": {"title": {"text": z_unit}, "thickness": 12, "outlinewidth": 0},
                "hovertemplate": (
                    f"x %{{x:.4g}} {x_unit}<br>y %{{y:.4g}} {x_unit}<br>height %{{z:.4g}} {z_unit}<extra></extra>"
                ),
            }
        ],
        "layout": layout(
            title={"text": title, "font": {"size": 13}},
            xaxis=axis(f"x / {x_unit}", constrain="domain"),
            yaxis=axis(f"y / {x_unit}", scaleanchor="x", constrain="domain"),
        ),
        "config": CONFIG,
    }


def in_space(heights: Any, colours: Any, spacing: tuple[float, float], title: str, scale: str) -> dict[str, Any]:
    """Surface (ny, nx) in space, heights in m, coloured by ``colours`` with the name ``title`` and
    a colour ``scale``."""
    ny, nx = heights.shape
    x_unit, x_scale = scaled(max(nx * spacing[0], ny * spacing[1]))
    z_unit, z_scale = scaled(float(np.nanmax(np.abs(heights), initial=0.0)))
    return {
        "data": [
            {
                "type": "surface",
                "z": packed(heights / z_scale),
                "x": packed((np.arange(nx) + 0.5) * spacing[0] / x_scale),
                "y": packed((np.arange(ny) + 0.5) * spacing[1] / x_scale),
                "surfacecolor": packed(colours),
                "colorscale": scale,
                "colorbar": {"title": {"text": title}, "thickness": 12, "outlinewidth": 0},
            }
        ],
        "layout": layout(
            margin={"l": 0, "r": 0, "t": 10, "b": 0},
            scene={
                "xaxis": axis(f"x / {x_unit}"),
                "yaxis": axis(f"y / {x_unit}"),
                "zaxis": axis(f"z / {z_unit}"),
                "aspectmode": "manual",
                "aspectratio": {"x": 1.0, "y": ny * spacing[1] / (nx * spacing[0]), "z": 0.3},
            },
        ),
        "config": CONFIG,
    }


OF_THEORIES = ("pressures", "exact", "theories", "nearest")
"""What the picture of theories shows, as arguments of ``theories``."""


def theories(
    pressures: list[float],
    exact: list[float | None] | None,
    theories: list[tuple[str, list[float | None]]],
    nearest: list[str],
) -> dict[str, Any]:
    """Area fractions over mean pressures (Pa): those of the ``exact`` solution bold and black, on
    top; of the theories the ``nearest`` in colours, by name, the others grey, named at the
    pointer."""
    symbol, factor = scaled(float(np.median(pressures)), "Pa", "pressure")
    x = [pressure / factor for pressure in pressures]
    hover = f"%{{x:.3g}} {symbol}: %{{y:.3g}}<extra></extra>"
    traces: list[dict[str, Any]] = []

    def add(name: str, y: list[float | None], line: dict[str, Any], **more: Any) -> None:
        common: dict[str, Any] = {"type": "scatter", "mode": "lines", "x": x, "y": y, "meta": name, "name": name}
        traces.append(
            common | {"hovertemplate": f"<b>{name}</b><br>{hover}", "line": line, "connectgaps": False} | more
        )

    others = [item for item in theories if nearest and item[0] not in nearest]
    for number, (name, area) in enumerate(others):
        add(name, area, {"color": "#b4b8be", "width": 1}, legendrank=1003, legendgroup="others")
        traces[-1] |= {"name": "other theories", "showlegend": number == 0}
    named = [item for item in theories if item not in others]
    named.sort(key=lambda item: nearest.index(item[0]) if nearest else 0)
    for number, (name, area) in enumerate(named):
        colour, dash = COLOURS[number % (len(COLOURS) - 1)], ("solid", "dash", "dot")[number // (len(COLOURS) - 1) % 3]
        add(name, area, {"color": colour, "width": 1.8, "dash": dash}, legendrank=1002)
    if exact is not None:
        line = {"color": "#000000", "width": 3.5}
        add("boundary elements", exact, line, mode="lines+markers", marker={"color": "#000000"}, legendrank=1001)
    plain = {"type": "log", "tickformat": "~g", "dtick": 1}
    return {
        "data": traces,
        "layout": layout(
            xaxis=axis(f"mean pressure / {symbol}", **plain),
            yaxis=axis("real over nominal area", **plain, range=[_least(exact, theories), 0.0]),
            legend={"orientation": "h", "y": 1.14},
            showlegend=True,
        ),
        "config": CONFIG,
    }


def _least(exact: list[float | None] | None, theories: list[tuple[str, list[float | None]]]) -> float:
    """Logarithm of the lower end of the axis: half the least area of the exact solution, or of the
    theories."""
    known = [value for area in ([exact] if exact else [area for _, area in theories]) for value in area if value]
    return float(np.log10(0.5 * min(known, default=0.02)))


def area_by_load(points: list[list[float]]) -> dict[str, Any]:
    """Curve of the share of the points that touch over the mean pressure (Pa), from ``points`` of
    both."""
    symbol, factor = scaled(max(pressure for pressure, _ in points), "Pa", "pressure")
    line = ("", [pressure / factor for pressure, _ in points], [100.0 * share for _, share in points])
    made = curves([line], f"mean pressure / {symbol}", "points in contact / %")
    made["layout"]["margin"]["t"] = 8
    return made


def curves(
    lines: list[tuple[str, Any, Any]], x: str, y: str, *, log: bool = False, points: bool = True
) -> dict[str, Any]:
    """Curves with their names over one pair of axes with the titles ``x`` and ``y``."""
    return {
        "data": [
            {
                "type": "scatter",
                "mode": "lines+markers" if points else "lines",
                "name": name,
                "x": [float(value) for value in xs],
                "y": [None if not np.isfinite(value) else float(value) for value in ys],
                "connectgaps": True,
            }
            for name, xs, ys in lines
        ],
        "layout": layout(
            xaxis=axis(x, type="log" if log else "linear"),
            yaxis=axis(y),
            showlegend=len(lines) > 1,
            legend={"orientation": "h", "y": 1.12},
        ),
        "config": CONFIG,
    }
