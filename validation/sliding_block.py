"""A sliding block on a rough interface with one constant coefficient of friction: steady sliding,
flutter, apparent friction, stick-slip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from page import Claim, Page, Table, write_page

from asperity import dynamics as dyn
from asperity.theories import flutter_friction

C_N = 2.8e18
"""c_n in Pa/m² of ground steel, δ = 0.6 µm √(p/MPa) (Back, Burdekin and Cowley 1973)."""

BLOCK = dyn.SlidingBlock(
    dyn.NormalCompliance.amontons(C_N, 2.0, friction=0.4),
    mass=1.0,
    length=0.1,
    width=0.02,
    height=0.05,
    load=100.0,
    stiffness=2e5,
    speed=1e-3,
    damping=40.0,
)

ABOUT = (
    "A block on a moving belt is held by a spring; the interface is a power law of the approach with damping, "
    "the friction coefficient one constant. Martins, Oden and Simoes (1990) found by computation that such a "
    "block shows what is measured of friction: a static coefficient above the kinetic one, stick-slip at low "
    "speed, and self-excited normal vibration as the cause of both. Theirs are figures without numbers, so "
    "that what is compared are the statements. Ours: `asp.dynamics`. No parameter is chosen: block and "
    "interface are the same in all rows but for what the row names."
)

WORDS = """* The coefficient between the surfaces is the same at rest and in motion. What is lower in motion
  is the mean force on the spring: the base catches up with the belt and moves with it for a sixth of each
  period of the vibration, and friction is then less than μ times the normal force.
* How long the block waits on the plateau before it flutters hangs on the logarithm of the disturbance, here
  the error of the integration; peaks, valleys and means do not."""


def law(friction: float, damping: float) -> dyn.NormalCompliance:
    """Law of the interface with b_n = ``damping`` in Pa s/m³."""
    return dyn.NormalCompliance(C_N, 2.0, damping, None, friction * C_N)


def slides(friction: float, damping: float, speed: float) -> dict[str, float]:
    """Numbers of the block that slides, from just below sliding for 0.25 s, with the mean over the
    last 0.1 s."""
    block = replace(BLOCK, law=law(friction, damping), speed=speed)
    start = (0.95 * block.steady.displacement, block.rest, 0.0, 0.0, 0.0, 0.0)
    return dyn.move_block(block, 0.25, start=start).numbers(0.15)


def slow(friction: float, damping: float, speed: float) -> dyn.BlockRun:
    """The block on a stiffer spring without a dashpot, from rest over three loadings of the
    spring."""
    block = replace(BLOCK, law=law(friction, damping), speed=speed, stiffness=1e6, damping=0.0)
    duration = 3.0 * block.reference_displacement / speed
    return dyn.move_block(block, duration, smoothing_speed=2e-5)


def page() -> Page:
    """The page."""
    flutter = replace(BLOCK, law=law(0.3, 0.0)).critical_friction()
    damped = replace(BLOCK, law=law(0.3, 4e19)).critical_friction()
    cases = [(0.2, 4e19, 1e-3), (0.35, 4e19, 1e-3), (0.5, 8e19, 1e-3), (0.5, 8e19, 1e-2), (0.4, 1.6e20, 1e-3)]
    runs = [slides(*case) for case in cases]
    rows = tuple(
        (
            f"{mu:g}",
            f"{b:.1e}",
            f"{1e3 * U:g}",
            f"{run['friction_reduction']:.2f}",
            f"{run['smallest_normal_force']:.1f} to {run['largest_normal_force']:.1f}",
        )
        for (mu, b, U), run in zip(cases, runs, strict=True)
    )
    slowly = [(0.5, 3e19, 4e-4), (0.5, 1.6e20, 4e-4), (0.2, 3e19, 4e-4)]
    traces = [slow(*case).numbers() for case in slowly]
    cycles = tuple(
        (
            f"{mu:g}",
            f"{b:.1e}",
            *(
                ("none", "")
                if np.isnan(run["stick_slip_valley"])
                else (f"{run['stick_slip_peak']:.2f}", f"{run['stick_slip_valley']:.2f}")
            ),
        )
        for (mu, b, _), run in zip(slowly, traces, strict=True)
    )
    peak = max(run["peak_friction"] / case[0] for run, case in zip(runs[:3], cases[:3], strict=True))
    return Page(
        "A sliding block with constant friction",
        ABOUT,
        (
            Table(
                "Sliding: mean spring force over μW, and the range of the normal force over W:",
                ("μ", "b_n (Pa s/m³)", "speed (mm/s)", "mean", "normal force"),
                rows,
            ),
            Table(
                "At 0.4 mm/s on a spring of 1 MN/m: displacement where slip begins and ends, over that under μW:",
                ("μ", "b_n (Pa s/m³)", "begins", "ends"),
                cycles,
            ),
            WORDS,
        ),
        (
            Claim("friction above which steady sliding flutters, undamped", flutter, 0.27, 0.30),
            Claim(
                "the same over the formula for small tilt", flutter / float(flutter_friction(2.0, 0.1, 0.05)), 1.0, 1.2
            ),
            Claim("damping raises it: with b_n = 4e19", damped, 0.30, 0.35),
            Claim("apparent static friction over μ", peak, 0.99, 1.02),
            Claim("below the boundary no vibration: mean over μW", runs[0]["friction_reduction"], 0.99, 1.0),
            Claim("above it the mean friction drops, μ = 0.35", runs[1]["friction_reduction"], 0.86, 0.97),
            Claim("and μ = 0.5", runs[2]["friction_reduction"], 0.86, 0.97),
            Claim("at ten times the speed it does not", runs[3]["friction_reduction"], 0.99, 1.0),
            Claim("nor with strong damping", runs[4]["friction_reduction"], 0.99, 1.0),
            Claim(
                "stick-slip at low speed ends at 0.5 to 0.7 of where it begins",
                traces[0]["stick_slip_valley"],
                0.5,
                0.7,
            ),
        ),
    )


if __name__ == "__main__":
    write_page(page(), __file__)
