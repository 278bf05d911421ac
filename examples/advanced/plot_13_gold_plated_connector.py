"""
How much gold does a connector need?
====================================

A dimple of a nickel spring is pressed on a nickel pad, both plated with hard gold. How many
milliohms the contact has depends on the load, and less than one might think on the gold: it spreads
the current around each spot, but not over the whole dimple. Roughness does not hurt where gold
keeps oxides away: the area is the load over the hardness, and many small spots conduct better than
one.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# Hard gold flows at 1.8 GPa and resists half as much again as pure gold. The dimple has a radius of
# 2 mm and a rough skin with waves from 4 to 16 µm.
nickel = asp.material("nickel")
gold = replace(asp.material("gold"), conduction=asp.solids.Conduction(electrical_resistivity=33e-9))
hardness, loads = asp.Hardness(1.8e9), np.array([0.1, 0.3, 1.0, 2.0])
grid = asp.Grid((144, 144), (0.7e-6, 0.7e-6))
ball = asp.generate.sphere(grid, radius=2e-3).heights
waves = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(1.0), hurst=0.8, rolloff_wavelength=16e-6, shortest_wavelength=4e-6
)
skin = asp.generate.gaussian(grid, waves, seed=1).heights


def resistance(thickness, roughness):
    surface = asp.Surface(ball + roughness * skin, 0.7e-6)
    plated = asp.Layered([asp.Layer(gold, thickness)], nickel)
    problem = asp.ContactProblem(surface, plated, counter_body=plated, law=hardness, boundary=asp.Free())
    path = asp.solve(problem, asp.History([asp.Force(load) for load in loads]))
    return [1 / asp.conductance.conductance(step, "electrical").extrapolated for step in path.steps], path.steps[-1]


# %%
# The boundary is free: the resistance is that between points of both bodies far away, the dimple's
# own constriction included. Nothing is to be added but the spring and the pad themselves.
thicknesses, heights = [0.1e-6, 0.5e-6, 2e-6], [0.05e-6, 0.15e-6, 0.4e-6]
found = {(t, h): resistance(t, h) for t in thicknesses for h in heights}
milliohm = np.array([[found[t, h][0] for h in heights] for t in thicknesses]) * 1e3
figure, axes = plt.subplots(1, 3, figsize=(10, 3.6), sharey=True, layout="constrained")
for k, (ax, height) in enumerate(zip(axes, heights, strict=True)):
    for j, thickness in enumerate(thicknesses):
        ax.loglog(loads, milliohm[j, k], "o-", label=f"{1e6 * thickness:g} µm of gold")
    ax.set(xlabel="load (N)", xticks=loads, xticklabels=loads, title=f"rms roughness {1e9 * height:.0f} nm")
axes[0].set(ylabel="resistance (mΩ)", yticks=[1, 2, 3], yticklabels=["1", "2", "3"])
axes[0].minorticks_off()
axes[0].legend()

# %%
# Where the current goes at 2 N on the roughest dimple: over a few spots.
result = found[0.5e-6, 0.4e-6][1]
flow = asp.conductance.conductance(result, "electrical")
print(f"{milliohm[1, 2, -1]:.2f} mΩ; {flow.spots.needed()} of {flow.spots.flow.size} spots carry half of the current")

# %%
# For a large flat contact a patch of it that repeats is solved instead: one mean pressure, one
# resistance of the patch, and as many patches in parallel as the contact has.
patch = asp.Surface(0.2e-6 * skin, 0.7e-6, periodic=True)
flat = asp.ContactProblem(patch, asp.Layered([asp.Layer(gold, 0.5e-6)], nickel), counter_body=nickel, law=hardness)
one = asp.conductance.conductance(asp.solve(flat, asp.MeanPressure(20e6)), "electrical")
number = 1e-6 / patch.grid.area
print(f"1 mm² at 20 MPa: {1e3 * one.resistance:.2f} mΩ a patch, {1e6 * one.resistance / number:.2f} µΩ of {number:.0f}")
plt.show()
