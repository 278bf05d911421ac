"""Repeated indentation of a layered half-space by a sphere at 100 to 300 times the load of first
yield: what Kral, Komvopoulos & Bogy (1995) state of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from layered_sliding_runs import HARDENING, LOAD, NU, RADIUS, E, R, Y
from page import Claim, Page, Stated, Table, statements, write_page

import asperity as asp
from asperity import fem

RATIOS, LOADS, CYCLES = (1.0, 2.0, 4.0), (100.0, 200.0, 300.0), 4
THICK = 3.0
"""Thickness in a_y of another layer."""

PUSHED = (0.009, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
LIFTED, AGAIN = (0.5, 0.15, 0.0), (0.3, 0.7, 1.0)
"""Parts of the load: first loading, each unloading, each loading again."""

ABOUT = (
    "A rigid sphere, without friction, on a half-space with one bonded layer of the thickness a_y, E₁/E₂ = "
    "Y₁/Y₂ = 1, 2 and 4, loaded to 100, 200 and 300 P_y, unloaded, and so again up to four times. P_y and a_y "
    "are load and contact radius at first yield of the homogeneous base. Kral, Komvopoulos & Bogy (1995a, b) "
    "did this with finite strains and perfect plasticity; their thicknesses are not printed in the works at "
    "hand, and the thickness is chosen here. Ours: `asperity.fem.indentation`, {across} elements across the "
    "largest contact radius and at least four over the layer, small strains, a paraboloid, ν = 0.3, a "
    "hardening of {hardening:g} E. Stresses are in Y, plastic strains in Y/E of the base."
)


READING = (
    "The closed loops of ratio 4 reverse a little flow at the interface in each cycle: at 100 P_y, with 10 "
    "elements across, the largest equivalent plastic strain of the base, which counts flow to and fro alike, "
    "grew from 6.3 by 0.8 Y/E with each cycle, and the layer did not flow again. Under ratio 2 both had "
    "shaken down."
)


@dataclass(frozen=True, eq=False)
class Indented:
    """A history at one load: its steps at the peaks and after each unloading, with the fields at
    the first of each and after the last unloading."""

    ratio: float
    load: float
    history: fem.IndentationHistory

    @cached_property
    def cycles(self) -> int:
        """How often the sphere was pressed."""
        return 1 + (len(self.history.steps) - len(PUSHED) - len(LIFTED)) // (len(LIFTED) + len(AGAIN))

    def numbers(self, cycle: int) -> tuple[int, int]:
        """Numbers of the steps at the peak and after the unloading of a ``cycle`` from 0."""
        top = len(PUSHED) - 1 + cycle * (len(LIFTED) + len(AGAIN))
        return top, top + len(LIFTED)

    def flow(self, cycle: int, region: int) -> float:
        """Largest plastic strain in Y/E after the unloading of a ``cycle``."""
        return self.history.steps[self.numbers(cycle)[1]].zones[region].largest * E / Y

    def dissipated(self, cycle: int) -> float:
        """Plastic work of a ``cycle``, as part of the first."""
        work = [self.history.steps[self.numbers(one)[1]].plastic_work for one in range(self.cycles)]
        return float(np.diff([0.0, *work])[cycle] / work[0])

    @property
    def radius(self) -> float:
        """Contact radius at the first peak in a_y."""
        return self.history.steps[self.numbers(0)[0]].contact_radius / RADIUS

    @property
    def base(self) -> fem.PlasticZone:
        """What has flowed of the base at the first peak."""
        return self.history.steps[self.numbers(0)[0]].zones[-1]

    @property
    def strained(self) -> float:
        """Plastic strain over the volume of the base at the first peak, in Y/E a_y³."""
        fields = self.history.fields[self.numbers(0)[0]]
        base = fields.elements.region == 1
        return float((fields.accumulated * fields.elements.weights)[base].sum() * E / Y / RADIUS**3)

    def tension(self, unloaded: bool) -> tuple[tuple[float, float], tuple[float, float]]:
        """Largest σ_rr of the upper and of the lower face of the layer in Y, each with its distance
        from the axis in a_y, at the first peak or after it."""
        faces = self.history.fields[self.numbers(0)[unloaded]].tension()
        return tuple((found / Y, r / RADIUS) for found, r in (faces.largest_top, faces.largest_bottom))

    def below(self, unloaded: bool) -> float:
        """σ_rr of the lower face of the layer on the axis in Y."""
        return float(self.history.fields[self.numbers(0)[unloaded]].tension().bottom[0] / Y)

    def interface(self, unloaded: bool) -> tuple[float, float]:
        """Largest normal tension and shear on the interface in Y."""
        passed = self.history.fields[self.numbers(0)[unloaded]].interface()
        return float(passed.normal.max() / Y), float(np.abs(passed.shear).max() / Y)


def indented(ratio: float, load: float, across: int, cycles: int, thickness: float = 1.0) -> Indented:
    """The history of a body with one layer of the ``thickness`` in a_y."""
    solids = [asp.Elastic(scale * E, NU) for scale in (ratio, 1.0)]
    laws = [asp.plasticity.LinearHardening(scale * Y, HARDENING * scale * E) for scale in (ratio, 1.0)]
    shares = [*PUSHED, *LIFTED, *((*AGAIN, *LIFTED) * (cycles - 1))]
    first = len(PUSHED) - 1
    found = fem.indentation(
        asp.Layered([asp.Layer(solids[0], thickness * RADIUS)], solids[1]),
        fem.Paraboloid(R),
        [fem.Load(share * load * LOAD) for share in shares],
        plasticity=laws,
        resolution=fem.Resolution(across=across, per_layer=4),
        keep=(first, first + len(LIFTED)),
    )
    return Indented(ratio, load, found)


ONSETS = tuple(np.geomspace(0.85, 4.5, 16))
"""Loads in P_y among which flow of layer and base begins."""


def onsets(ratio: float, across: int) -> tuple[float, float]:
    """Loads in P_y at which the part of the body above the depth a_y and that below first flow."""
    solids = [asp.Elastic(scale * E, NU) for scale in (ratio, 1.0)]
    laws = [asp.plasticity.LinearHardening(scale * Y, HARDENING * scale * E) for scale in (ratio, 1.0)]
    body = asp.Layered([asp.Layer(solids[0], RADIUS)], solids[1])
    steps = [fem.Load(load * LOAD) for load in ONSETS]
    found = fem.indentation(
        body, fem.Paraboloid(R), steps, plasticity=laws, resolution=fem.Resolution(across=across, per_layer=4), keep=()
    )
    first = [
        next((load for load, step in zip(ONSETS, found.steps, strict=True) if step.zones[part].volume > 0.0), math.inf)
        for part in (0, 1)
    ]
    return first[0], first[1]


def tables(runs: list[Indented]) -> tuple[Table, ...]:
    """First loading and unloading, and the cycles."""
    first, tension, cycles = [], [], []
    for one in runs:
        case = (f"{one.ratio:g}", f"{one.load:g}")
        zone = one.base
        r, z = (place / RADIUS for place in zone.place)
        first.append(
            (
                *case,
                f"{one.radius:.2f}",
                f"{one.flow(0, 0):.2f}",
                f"{zone.largest * E / Y:.2f}",
                f"{r:.2f}, {z:.2f}",
                f"{one.strained:.0f}",
                f"{zone.radius / RADIUS:.1f}",
                f"{zone.bottom / RADIUS:.1f}",
            )
        )
        (top, at), (bottom, _) = one.tension(False)
        (rim, beside), (_, _) = one.tension(True)
        loaded, left = one.interface(False), one.interface(True)
        tension.append(
            (
                *case,
                f"{top:.2f} at {at:.1f}",
                f"{bottom:.2f}",
                f"{rim:.2f} at {beside:.1f}",
                f"{one.below(True):.2f}",
                f"{loaded[0]:.2f}, {loaded[1]:.2f}",
                f"{left[0]:.2f}, {left[1]:.2f}",
            )
        )
        cycles.append((*case, *(f"{one.dissipated(cycle):.2g}" for cycle in range(1, one.cycles))))
    return (
        Table(
            "## First loading\n\nContact radius, largest plastic strain of layer and base, its place (r, z) "
            "in the base, plastic strain over the volume of the base, largest distance from the axis and "
            "largest depth of what has flowed there.",
            ("ratio", "P/P_y", "a/a_y", "layer", "base", "place/a_y", "volume/a_y³", "reach/a_y", "depth/a_y"),
            tuple(first),
        ),
        Table(
            "## Stresses of the first cycle\n\nLargest σ_rr of the surface of the layer, at r/a_y, and of its "
            "lower face under load; σ_rr of the surface and, on the axis, of the lower face after unloading; "
            "largest tension and shear on the interface under load and after unloading.",
            (
                "ratio",
                "P/P_y",
                "surface, loaded",
                "lower face",
                "surface, unloaded",
                "lower face, axis",
                "interface, loaded",
                "unloaded",
            ),
            tuple(tension),
        ),
        Table(
            "## Repeated loading\n\nPlastic work of a cycle over that of the first.",
            ("ratio", "P/P_y", *(f"cycle {cycle + 1}" for cycle in range(1, runs[0].cycles))),
            tuple(cycles),
        ),
    )


def _each(text: str, values: list[float]) -> str:
    return f"{text} {' / '.join(f'{value:.3g}' for value in values)}"


def compare(
    ratios: tuple[float, ...] = RATIOS, loads: tuple[float, ...] = LOADS, across: int = 12, cycles: int = CYCLES
) -> Page:
    """The page, with so many elements ``across`` the largest contact radius."""
    runs = {(ratio, load): indented(ratio, load, across, cycles) for load in loads for ratio in ratios}
    bare, soft, hard = ([runs[ratio, load] for load in loads] for ratio in ratios)
    begin = [onsets(ratio, 2 * across) for ratio in ratios]
    strains = [[one.base.largest * E / Y for one in column] for column in (bare, soft, hard)]
    strained = [[one.strained for one in column] for column in (bare, soft, hard)]
    outwards = [[one.base.place[0] / RADIUS for one in column] for column in (bare, soft, hard)]
    rims = [one.tension(True)[0][0] for one in (*soft, *hard)]
    below = [one.below(True) for one in (*soft, *hard)]
    third = [one.dissipated(cycles - 1) for one in runs.values()]
    edges = [one.tension(False)[0][1] / one.radius for one in (*soft, *hard)]
    top = [one.tension(False)[0][0] for one in (bare[0], soft[0], hard[0])]
    shears = [one.interface(False)[1] for one in (bare[0], soft[0], hard[0])]
    left = [one.interface(True)[1] for one in (bare[0], soft[0], hard[0])]
    thick = [indented(ratio, loads[0], across, 1, THICK) for ratio in ratios]
    part = {
        "over the volume": [hard_ / bare_ for hard_, bare_ in zip(strained[2], strained[0], strict=True)],
        "largest": [hard_ / bare_ for hard_, bare_ in zip(strains[2], strains[0], strict=True)],
        "thick": [thick[2].strained / thick[0].strained],
    }
    further = [soft_ > bare_ < hard_ for bare_, soft_, hard_ in zip(*outwards, strict=True)]
    rows = (
        Stated(
            "(i) at equal load a stiffer, harder layer lowers plastic flow of the base",
            _each(
                "plastic strain over the volume of the base, ratio 4 over homogeneous, at each load:",
                part["over the volume"],
            )
            + "; "
            + _each(f"under a layer of {THICK:g} a_y:", part["thick"])
            + "; "
            + _each("largest strain:", part["largest"]),
            max(part["over the volume"] + part["thick"]) < 1.0,
            "little by a layer of a seventh of the contact radius, whose largest strain of the base at the "
            "lowest load does not fall; clearly by a thicker one",
        ),
        Stated(
            "… and pushes it outwards",
            _each("r/a_y of the largest strain of the base at each load, homogeneous:", outwards[0])
            + "; "
            + _each("ratio 2:", outwards[1])
            + "; "
            + _each("ratio 4:", outwards[2]),
            all(further),
            ""
            if all(further)
            else (
                "not at "
                f"{' and '.join(f'{load:g}' for load, one in zip(loads, further, strict=True) if not one)} "
                "P_y, where the homogeneous body, too, flows most below the rim"
            ),
        ),
        Stated(
            "(ii) the first unloading leaves tension σ_rr at the rim of the contact",
            _each("Y times", rims),
            min(rims) > 0.0,
        ),
        Stated("… and at the bottom of the layer under the axis", _each("Y times", below), min(below) > 0.0),
        Stated(
            "(iii) repeated indentation adds little after the second to fourth cycle: shakedown, or a small "
            "closed loop",
            f"plastic work of the last cycle over the first: at most {max(third):.2g}",
            max(third) < 0.05,
        ),
        Stated(
            "(iv) under load the layer is in tension at the edge of the contact, where ring cracks begin",
            _each("place of the largest σ_rr of the surface over the contact radius:", edges),
            0.9 < min(edges) <= max(edges) < 1.4,
        ),
        Stated(
            "… and the interface is sheared and, unloaded, pulled, where it would come off",
            _each("shear loaded, ratios 1 / 2 / 4:", shears) + "; " + _each("unloaded:", left),
            min(left) > 0.0,
        ),
        Stated(
            "a stiffer and harder layer raises the load of first yield of the layer",
            _each("P/P_y, ratios 1 / 2 / 4:", [one[0] for one in begin]),
            begin[0][0] < begin[1][0] < begin[2][0],
        ),
        Stated(
            "… and of the base, beyond that of the homogeneous body",
            _each("P/P_y, ratios 2 / 4:", [one[1] for one in begin[1:]]),
            begin[0][0] < min(begin[1][1], begin[2][1]),
        ),
        Stated(
            "a stiffer layer carries larger tension at its surface",
            _each("Y times, ratios 1 / 2 / 4:", top),
            top[0] < top[1] < top[2],
        ),
    )
    claims = (
        Claim(
            "largest σ_rr left at the rim of a layer by the first unloading, smallest of all cases, in Y",
            min(rims),
            low=0.1,
        ),
        Claim("σ_rr left at the bottom of a layer on the axis, smallest of all cases, in Y", min(below), low=0.1),
        Claim(
            f"plastic strain over the volume of the base under a layer of {THICK:g} a_y, ratio 4 over "
            "homogeneous, lowest load",
            part["thick"][0],
            high=0.8,
        ),
        Claim("plastic work of the last cycle over the first, largest", max(third), high=0.05),
        Claim(
            "place of the largest tension of the surface under load over the contact radius, smallest",
            min(edges),
            low=0.9,
        ),
        Claim("the same, largest", max(edges), high=1.4),
        Claim("tension of the surface, ratio 4 over ratio 2, lowest load", top[2] / top[1], low=1.0),
        Claim("load of first yield of the layer, ratio 2 over homogeneous", begin[1][0] / begin[0][0], low=1.0),
        Claim(
            "load of first yield of the base under the layer of ratio 2 over that of the homogeneous body",
            begin[1][1] / begin[0][0],
            low=1.0,
        ),
        Claim("load of first yield of the homogeneous body in P_y", begin[0][0], 0.9, 1.15),
    )
    source = (
        "What Kral, Komvopoulos & Bogy (1995a, b) state as (i) to (iv), and Bhushan (1998, sec. 2.3) of "
        "their work as the last three rows."
    )
    return Page(
        title="Layered half-space indented again and again at 100 to 300 times first yield",
        about=ABOUT.format(across=across, hardening=HARDENING),
        parts=(statements(f"## Statements\n\n{source}", rows), *tables(list(runs.values())), READING),
        claims=claims,
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
