"""
Running-in: pass after pass
===========================

A soft surface that meets a hard one again and again is flattened where it touches. At the same
place one pass is enough, and the contact is elastic from then on; at ever new places the plastic
work of a pass fades slowly.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A copper surface under a rigid rough counter surface. Where the pressure reaches the hardness,
# copper flows.
grid, rng = asp.Grid((96, 96), (100e-9, 100e-9)), np.random.default_rng(0)
copper = asp.Elastic(130e9, 0.34, asp.Strength(hardness=1.2e9), name="copper")
soft = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(20e-9, 1.5e-6), seed=1)
hard = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(5e-9, 1.5e-6), seed=2)


def passes(shifts):
    """Results of the passes with the counter surface shifted by so many pixels, each on what the
    last one has left."""
    surface, results = soft, []
    for shift in shifts:
        counter = hard.with_heights(np.roll(hard.heights, shift, axis=(0, 1)), f"shifted by {shift}")
        problem = asp.ContactProblem(surface, copper, counter, asp.Rigid(), law=asp.Hardness(1.2e9))
        results.append(asp.solve(problem, asp.MeanPressure(60e6), keep=asp.Keep(stiffness=False)))
        surface = results[-1].residual_surface("body")
    return results


# %%
# Passes at the same place, and at random ones.
same = passes([(0, 0)] * 4)
sliding = passes(rng.integers(0, 96, (24, 2)).tolist())
run_in = sliding[-1].residual_surface("body")
print(
    f"plastic work of the second pass at the same place: {same[1].plastic_work / same[0].plastic_work:.1e} of the first"
)

figure, axes = plt.subplots(1, 3, figsize=(14, 4), layout="constrained")
for results, label in ((same, "same place"), (sliding, "random places")):
    axes[0].plot(range(1, len(results) + 1), [1e12 * found.plastic_work for found in results], "o-", label=label)
axes[0].set(xlabel="pass", ylabel="plastic work (pJ)", ylim=(0, None))
axes[0].legend()
soft.plot("heights", axes[1]).set_title("new")
run_in.plot("heights", axes[2]).set_title("after 24 passes at random places")

# %%
# The flattened summits show in the heights: reduced peaks are lower, the skewness is negative.
for name, surface in (("new", soft), ("run in", run_in)):
    found = asp.characterise(surface)
    print(f"{name}: Ssk {found.heights.Ssk:.2f}, Spk {1e9 * found.functional.Spk:.1f} nm")
plt.show()
