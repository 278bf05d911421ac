"""A sphere that slides over a layered half-space at 100 and 200 times the load of first yield: fig.
2.8 of Peng (2001), after Kral & Komvopoulos (1997).

Usage: python validation/layered_sliding.py [FOLDER]. FOLDER keeps the results of the runs: what it
holds already is not computed again.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from layered_sliding_runs import HARDENING, Case, Snapshots, stored
from page import Claim, Page, Published, Stated, Table, statements, write_page

CASES = (Case(2.0, 0.1), Case(4.0, 0.1), Case(2.0, 0.25), Case(4.0, 0.25))
HEAVY = Case(2.0, 0.1, load=200.0, radius=9.3, across=7, passes=1, step=0.8)
LONG = Case(2.0, 0.1, passes=1, far=24.0)

INDENTED, SECOND, FOURTH, EIGHTH, END, LIFTED = range(6)
"""Numbers of the times of a pass over 12 a_y; the second pass begins with number 6."""

ABOUT = (
    "A rigid sphere is pressed on a half-space with one bonded layer, E₁/E₂ = Y₁/Y₂, slid 12 a_y with "
    "friction, and lifted; then again from the start. P_y and a_y are load and contact radius at first yield "
    "of the homogeneous base, stresses are in its Y, plastic strains in its Y/E, places x relative to the "
    "centre of the sphere, which slides towards +x. Peng (2001, sec. 2.3.1.1) describes the figure in words, "
    "and prints neither the thickness of the layer nor its contours as numbers. Ours: "
    "`asperity.fem.sphere_track`, the half y ≥ 0 of the body. Layer of the thickness a_y (chosen here), ν = "
    "0.3, small strains, a paraboloid, a hardening of {hardening:g} E where theirs are perfectly plastic, "
    "yield at the eight Gauss points of an element (theirs: one); elements of 1.1 a_y along x and y and two "
    "over the layer, theirs of about a_y; far boundary fixed at eight contact radii."
)

READING = (
    "**How far to trust them.** Contact radii come from counted points and are good to half an element, 0.5 "
    "a_y. With elements of 1.7 a_y the case of fig. 2.8 gives the same approach and plastic work within 1 %, "
    "plastic strains and tension within 13 %. Depths of the plastic zone are those of Gauss points, 2 to 4 "
    "a_y apart there. The largest plastic strain is that of one Gauss point; means over the elements beside "
    "the plane of symmetry, as a picture shows them, are smaller.\n\n**The caption of fig. 2.8** names "
    "sliding distances of 2, 4, 8 and 12 a_y for its parts (a) to (d); the text describes (a) as indentation "
    "without sliding. Here both are given."
)


@dataclass(frozen=True)
class Peak:
    """Largest value in the plane of symmetry, with its place in a_y relative to the centre of the
    sphere."""

    value: float
    x: float
    z: float

    @classmethod
    def of(cls, found: Snapshots, time: int, values: np.ndarray, region: int, thickness: float = 1.0) -> Peak:
        """That of the ``values`` (n_x, n_z) in layer (0) or base (1)."""
        x, z = (0.5 * (line[1:] + line[:-1]) for line in (found.x, found.z))
        inside = z < thickness if region == 0 else z > thickness
        own = values[:, inside]
        row, column = np.unravel_index(int(own.argmax()), own.shape)
        return cls(float(own[row, column]), float(x[row] - found.centre[time]), float(z[inside][column]))


def strain(found: Snapshots, time: int, region: int) -> Peak:
    """Largest plastic strain beside the plane of symmetry."""
    return Peak.of(found, time, found.strain[time], region)


def rate(found: Snapshots, time: int) -> float:
    """Plastic work of sliding between the time before and ``time``, in P_y δ_y for each a_y."""
    return float(np.diff(found.lost)[time - 1] / np.diff(found.centre)[time - 1])


def base_strain(found: Snapshots, time: int) -> float:
    """Plastic strain over the plane of symmetry of the base, in Y/E a_y²."""
    deep = found.z[:-1] >= 1.0 - 1e-9
    area = np.outer(np.diff(found.x), np.diff(found.z)[deep])
    return float((found.strain[time][:, deep] * area).sum())


def figure_table(found: Snapshots) -> Table:
    """The case of fig. 2.8 at its distances."""
    rows = []
    for time, name in enumerate(("0, indented", "2", "4", "8", "12", "12, lifted")):
        layer, base = (strain(found, time, region) for region in (0, 1))
        along = Peak.of(found, time, found.along[time], 0)
        rows.append(
            (
                name,
                f"{layer.value:.1f} at {layer.x:+.1f}",
                f"{base.value:.1f} at {base.x:+.1f}, {base.z:.1f}",
                f"{found.flow[time][0]:.1f}",
                f"{found.flow[time][1]:.1f}",
                f"{along.value:.2f} at {along.x:+.1f}",
                f"{found.depth[time][1]:.1f}",
                f"{found.zone[time][1]:.0f}",
                f"{found.approach[time]:.1f}" if time != LIFTED else "–",
            )
        )
    head = (
        "Δx/a_y",
        "layer, plane y = 0, at x",
        "base, plane y = 0, at x, z",
        "layer, anywhere",
        "base, anywhere",
        "largest σ_xx of the layer, y = 0, at x",
        "depth of the plastic zone",
        "its volume in the base/a_y³",
        "approach/δ_y",
    )
    about = (
        "## Fig. 2.8: E₁/E₂ = Y₁/Y₂ = 2, μ = 0.1, W/W_Y = 100\n\nLargest equivalent plastic strains and "
        "σ_xx; the pictures are `plastic_strain_sliding` and `sigma_xx_sliding` of "
        "`validation/pictures.py`."
    )
    return Table(about, head, tuple(rows))


def case_table(runs: dict[Case, Snapshots]) -> Table:
    """All cases after 12 a_y."""
    rows = []
    for case, found in runs.items():
        at = found.tension_place[END][0] - np.array([found.centre[END], 0.0, 0.0])
        rows.append(
            (
                f"{case.ratio:g}, {case.friction:g}, {case.load:g}",
                f"{found.radius[END]:.1f}",
                f"{found.flow[END][0]:.1f}, {found.flow[END][1]:.1f}",
                f"{base_strain(found, END):.0f}",
                f"{found.depth[END][1]:.1f}",
                f"{found.tension[END][0]:.2f} at {at[0]:+.1f}, {at[1]:.1f}, {at[2]:.1f}",
                f"{found.surface[END][0]:.2f}, {found.surface[END][1]:.2f}",
                f"{found.tension[LIFTED][0]:.2f}",
                f"{found.peel[END]:.2f}, {found.shear[END]:.2f}",
                f"{found.lost[LIFTED]:.0f}",
                f"{again(found):.2f}" if case.passes == 2 else "–",
            )
        )
    head = (
        "E₁/E₂, μ, W/W_Y",
        "a/a_y",
        "largest plastic strain, layer, base",
        "over the plane y = 0 of the base/a_y²",
        "depth/a_y",
        "largest tension of the layer, at x, y, z",
        "σ_xx of the surface behind, before the centre",
        "tension, lifted",
        "interface: tension, shear",
        "plastic work of the first pass/P_y δ_y",
        "second over first",
    )
    return Table(
        "## All cases after 12 a_y\n\nTwice the load makes the zone larger and deeper; the tension of the "
        "layer, which yields, hardly changes.",
        head,
        tuple(rows),
    )


def again(found: Snapshots) -> float:
    """Plastic work of the second pass over that of the first."""
    first, second = found.lost[LIFTED], found.lost[2 * LIFTED + 1]
    return float(second / first - 1.0)


def of_figure(found: Snapshots) -> tuple[Stated, ...]:
    """What the text of fig. 2.8 says, from the first part to the last."""
    layer = [strain(found, time, 0) for time in range(LIFTED)]
    base = [strain(found, time, 1) for time in range(LIFTED)]
    radius = found.radius[INDENTED]
    rim = float(np.hypot(*found.flow_place[INDENTED][0][:2]) / radius)
    below = found.flow_place[INDENTED][1]
    grown = [layer[time].value - layer[time - 1].value for time in (EIGHTH, END)]
    moved = layer[EIGHTH].x - layer[FOURTH].x
    return (
        Stated(
            "indented: the largest plastic strain of the layer is near the edge of the contact",
            f"at {rim:.2f} a from the axis",
            0.7 < rim < 1.2,
        ),
        Stated(
            "indented: that of the base is at the interface near the centre",
            f"at {np.hypot(*below[:2]):.1f} a_y from the axis, z = {below[2]:.1f} a_y; beside the plane of "
            f"symmetry {base[0].value:.1f} at z = {base[0].z:.1f} against {found.flow[0][1]:.1f}",
            float(np.hypot(*below[:2])) < 0.5 * radius and below[2] < 2.0,
            "two nearly equal maxima, one below the axis as in a homogeneous body, one at the interface under "
            "two thirds of the radius",
        ),
        Stated(
            "2 a_y: the largest of the layer is at the front, almost doubled",
            f"{layer[SECOND].value / layer[INDENTED].value:.2f} times, at x = {layer[SECOND].x / radius:+.2f} a",
            1.6 < layer[SECOND].value / layer[INDENTED].value < 2.2 and layer[SECOND].x > 0.5 * radius,
        ),
        Stated(
            "2 a_y: the largest of the base is under the centre",
            f"at x = {base[SECOND].x / radius:+.2f} a",
            abs(base[SECOND].x) < 0.25 * radius,
            "it is under the centre from 4 a_y on" if abs(base[FOURTH].x) < 0.25 * radius else "",
        ),
        Stated(
            "4 to 8 a_y: the largest of the layer goes on growing near the front, at the same place "
            "relative to the sphere",
            f"{layer[FOURTH].value:.1f} to {layer[EIGHTH].value:.1f}, moves by {moved:+.1f} a_y, x = "
            f"{layer[EIGHTH].x / radius:+.2f} a",
            layer[EIGHTH].value > layer[FOURTH].value and layer[EIGHTH].x > 0.5 * radius and abs(moved) < 2.0,
        ),
        Stated(
            "8 a_y: the largest of the base is slightly behind the centre",
            f"at x = {base[EIGHTH].x / radius:+.2f} a",
            base[EIGHTH].x < 0.0,
        ),
        Stated(
            "12 a_y: the largest of the layer approaches a constant",
            f"grows by {grown[0]:.1f} from 4 to 8 and by {grown[1]:.1f} from 8 to 12 a_y",
            grown[1] < 0.5 * grown[0],
            "see the longer slide below",
        ),
        Stated(
            "12 a_y: the plastic zone of the base spreads parallel to the interface",
            f"depth {found.depth[SECOND][1]:.1f} a_y at 2, {found.depth[END][1]:.1f} at 12 a_y, volume "
            f"{found.zone[END][1] / found.zone[SECOND][1]:.2f} times",
            found.depth[END][1] < 1.05 * found.depth[SECOND][1],
        ),
        Stated(
            "12 a_y: the strain grows towards the interface",
            f"largest at z = {base[INDENTED].z:.1f} a_y indented, {base[END].z:.1f} at 12 a_y",
            base[END].z < base[INDENTED].z,
            "not up to it: it peaks an element and a half below" if base[END].z > 1.5 else "",
        ),
    )


def of_papers(runs: dict[Case, Snapshots], longer: Snapshots) -> tuple[Stated, ...]:
    """What Kral and Komvopoulos state of all their cases."""
    soft, hard, rough, both = (runs[case] for case in CASES)
    rates = [rate(soft, time) for time in (FOURTH, EIGHTH, END)]
    far = [[strain(longer, time, region).value for time in range(4, 8)] for region in (0, 1)]
    steady = all(one[-1] / one[-2] < 1.05 for one in far)
    places = [(found.tension_place[END][0][0] - found.centre[END]) / found.radius[END] for found in runs.values()]
    depths = [strain(found, END, 1).z for found in runs.values()]
    seconds = [again(found) for found in runs.values()]
    lifts = [found.lost[LIFTED] - found.lost[END] for found in runs.values()]
    return (
        Stated(
            "a steady state after about 12 a_y, two to three initial contact radii",
            f"plastic work for each a_y {rates[0]:.0f}, {rates[1]:.0f}, {rates[2]:.0f} P_y δ_y over 2 to "
            f"4, 4 to 8, 8 to 12 a_y; 12 a_y are {12.0 / soft.radius[INDENTED]:.1f} contact radii",
            abs(rates[2] / rates[1] - 1.0) < 0.05,
        ),
        Stated(
            "… also of the largest plastic strains",
            f"y = 0, at 12, 16, 20, 24 a_y: layer {', '.join(f'{one:.1f}' for one in far[0])}; base "
            f"{', '.join(f'{one:.1f}' for one in far[1])}",
            steady,
            (
                f"after 20 a_y, {20.0 / longer.radius[INDENTED]:.1f} contact radii of ours; at 12 a_y the "
                f"layer has {100.0 * far[0][0] / far[0][-1]:.0f} %"
            )
            if steady
            else "not within 24 a_y",
        ),
        Stated(
            "friction moves the largest tension of the layer to the trailing edge",
            f"x/a, cases in order: {', '.join(f'{one:+.2f}' for one in places)}; σ_xx of the surface "
            f"before the centre falls from {soft.surface[INDENTED][1]:.2f} to {soft.surface[END][1]:.2f}",
            max(places) < 0.0,
        ),
        Stated(
            "the plastic strain of the base peaks below the interface",
            f"beside y = 0 at z/a_y, cases in order: {', '.join(f'{one:.1f}' for one in depths)}",
            min(depths) > 1.0,
        ),
        Stated(
            "a second pass adds a fraction of the first",
            f"plastic work, cases in order: {', '.join(f'{one:.2f}' for one in seconds)}",
            max(seconds) < 1.0,
        ),
        Stated(
            "a stiffer, harder layer lowers plastic flow of the base",
            f"ratio 4 over 2, μ = 0.1 and 0.25: plastic work {hard.lost[LIFTED] / soft.lost[LIFTED]:.2f}, "
            f"{both.lost[LIFTED] / rough.lost[LIFTED]:.2f}; strain over the plane y = 0 "
            f"{base_strain(hard, END) / base_strain(soft, END):.2f}, "
            f"{base_strain(both, END) / base_strain(rough, END):.2f}; largest strain "
            f"{hard.flow[END][1] / soft.flow[END][1]:.2f}, {both.flow[END][1] / rough.flow[END][1]:.2f}",
            max(base_strain(hard, END) / base_strain(soft, END), base_strain(both, END) / base_strain(rough, END))
            < 1.0,
            (
                "but little, and not the largest strain at one point with the lower friction: a layer of a "
                "sixth of the contact radius bears little of the load"
            )
            if hard.flow[END][1] > soft.flow[END][1]
            else "",
        ),
        Stated(
            "… and raises the tension of the layer",
            f"{hard.tension[END][0] / soft.tension[END][0]:.2f}, "
            f"{both.tension[END][0] / rough.tension[END][0]:.2f} times",
            hard.tension[END][0] > soft.tension[END][0],
        ),
        Stated(
            "it yields again while the sphere is lifted",
            f"plastic work of lifting, cases in order: {', '.join(f'{one:.0f}' for one in lifts)} P_y δ_y",
            min(lifts) > 0.0,
        ),
    )


def claims_of(runs: dict[Case, Snapshots], longer: Snapshots) -> tuple[Claim, ...]:
    """Numbers behind the statements that hold."""
    soft, hard, rough, both = (runs[case] for case in CASES)
    layer = [strain(soft, time, 0) for time in range(LIFTED)]
    return (
        Claim(
            "place of the largest strain of the layer at 2 a_y over the contact radius, before the centre",
            layer[SECOND].x / soft.radius[SECOND],
            low=0.5,
        ),
        Claim("plastic work for each a_y, 8 to 12 over 4 to 8 a_y", rate(soft, END) / rate(soft, EIGHTH), 0.95, 1.05),
        Claim(
            "largest plastic strain of the layer, y = 0, at 24 over 20 a_y",
            strain(longer, 7, 0).value / strain(longer, 6, 0).value,
            0.99,
            1.05,
        ),
        Claim(
            "depth of the plastic zone at 12 over 2 a_y", float(soft.depth[END][1] / soft.depth[SECOND][1]), high=1.05
        ),
        Claim(
            "place of the largest tension over the contact radius, most forward of all cases",
            max((found.tension_place[END][0][0] - found.centre[END]) / found.radius[END] for found in runs.values()),
            high=0.0,
        ),
        Claim(
            "depth of the largest plastic strain of the base beside y = 0 over a_y, least of all cases",
            min(strain(found, END, 1).z for found in runs.values()),
            low=1.0,
        ),
        Claim("plastic work of the second pass over the first, largest", max(map(again, runs.values())), high=0.8),
        Claim("plastic work, ratio 4 over 2, μ = 0.1", float(hard.lost[LIFTED] / soft.lost[LIFTED]), high=1.0),
        Claim("the same, μ = 0.25", float(both.lost[LIFTED] / rough.lost[LIFTED]), high=1.0),
        Claim(
            "tension of the layer, ratio 4 over 2, μ = 0.1", float(hard.tension[END][0] / soft.tension[END][0]), low=1.0
        ),
        Claim(
            "energy: work over plastic work of the first pass, lifted, least of all cases",
            min(float(found.work[LIFTED] / found.lost[LIFTED]) for found in runs.values()),
            low=1.0,
        ),
    )


def compare(folder: Path | None = None) -> Page:
    """The page; ``folder`` keeps the results."""
    runs = {case: stored(case, folder) for case in CASES}
    longer = stored(LONG, folder)
    soft = runs[CASES[0]]
    doubled = strain(soft, SECOND, 0).value / strain(soft, INDENTED, 0).value
    published = Published(
        "Peng 2001, sec. 2.3.1.1",
        "largest plastic strain of the layer, plane y = 0, at 2 a_y over indented: almost doubled",
        "2",
        doubled,
        within=0.1,
        reason="the thickness of the layer was chosen",
    )
    return Page(
        title="Sphere sliding over a layered half-space at 100 and 200 times first yield",
        about=ABOUT.format(hardening=HARDENING),
        parts=(
            figure_table(soft),
            statements("## What the text of fig. 2.8 says", of_figure(soft)),
            case_table(runs | {HEAVY: stored(HEAVY, folder)}),
            statements(
                "## What Kral & Komvopoulos (1996, 1997) say of all cases\n\nIn the order of the table above.",
                of_papers(runs, longer),
            ),
            READING,
        ),
        claims=claims_of(runs, longer),
        published=(published,),
    )


if __name__ == "__main__":
    write_page(compare(Path(sys.argv[1]) if sys.argv[1:] else None), __file__)
