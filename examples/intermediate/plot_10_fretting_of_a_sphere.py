"""
Fretting of a sphere
====================

A steel ball on steel is moved to and fro by less than a micrometre. While its middle sticks, a ring
around it slips and wears; with a larger shift all of it slips, and the scar is deepest in the
middle.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.wear import Sides, WearSteps, archard, fretted

# %%
# A ball of 10 mm radius under 10 N, friction 0.5, and a wear coefficient of 1e-5 mm³/(N m) of both.
size, points = 270e-6, 36
ball = asp.generate.sphere(asp.Grid((points, points), (size / points, size / points)), radius=10e-3)
steel = asp.material("bearing steel")
problem = asp.ContactProblem(
    ball, steel, counter_body=steel, boundary=asp.Free(), friction=asp.Coulomb(0.5, coupled=False)
)
wear = Sides(body=archard(1e-14), counter=archard(1e-14))

# %%
# Only some of the cycles are solved: in between the wear of the last one is taken for that of many,
# as long as the next one agrees. All of a point that slips rubs by four shifts a cycle.
found = {}
for shift, cycles in ((0.3e-6, [2000, 20000, 60000]), (2e-6, [200, 2000, 4000])):
    steps = WearSteps(tolerance=0.05)
    found[shift] = fretted(problem, asp.Force(10.0), asp.friction.Shift(shift), cycles, wear, steps=steps, quarter=4)
    print(f"±{1e6 * shift:g} µm: {found[shift].worn_volume * 1e18:.3g} µm³ after {cycles[-1]} cycles", end=", ")
    print(f"{len(found[shift].course) - 1} jumps, {found[shift].error:.1%} misplaced at most")

# %%
# The section along the shift: W-shaped in partial slip, U-shaped in gross sliding.
figure, axes = plt.subplots(2, 2, figsize=(9, 6), layout="constrained")
x = 1e6 * (np.arange(points) + 0.5) * size / points
start = ball.heights[:, points // 2]
for (depth, pressure), (shift, history) in zip(axes.T, found.items(), strict=True):
    for cycles, contact in history.kept:
        depth.plot(x, 1e9 * (start - contact.problem.profile()[:, points // 2]), label=f"{cycles:.0f} cycles")
        pressure.plot(x, 1e-6 * contact.pressure[:, points // 2])
    depth.set(title=f"shift ±{1e6 * shift:g} µm", xlabel="x (µm)", ylabel="worn depth of both (nm)")
    depth.invert_yaxis()
    depth.legend()
    pressure.set(xlabel="x (µm)", ylabel="pressure (MPa)")
plt.show()
