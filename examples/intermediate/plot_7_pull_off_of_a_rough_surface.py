"""
Pull-off of a rough surface
===========================

A soft pad, as of a gecko's foot or a soft gripper, is pressed on a rough surface and pulled off
again. It jumps into contact, holds on while it is pulled, and lets go in jumps; a stiffer pad of
the same work of adhesion hardly sticks at all.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.physics.adhesion.figures import plot_adhesion, plot_adhesion_loop
from asperity.physics.adhesion.stickiness import stickiness

# %%
# A work of adhesion of 50 mJ/m² and a range chosen so that the grid resolves the attracting zone;
# what the pull-off of compliant contacts depends on is the work.
spectrum = asp.generate.GaussianAutocorrelation(45e-9, 1.2e-6)
surface = asp.generate.gaussian(asp.Grid((96, 96), (0.07e-6, 0.07e-6)), spectrum, seed=3)
law = asp.ExponentialAdhesion(work=0.05, range=45e-9)
cycle = asp.adhesion.adhesion_cycle(farthest=-200e-9, deepest=60e-9, steps=12)

loops, histories = {}, {}
for name, modulus in (("soft, 7 MPa", 7e6), ("stiff, 70 MPa", 70e6)):
    problem = asp.ContactProblem(surface, asp.Elastic(modulus, 0.49), adhesion=law)
    histories[name] = asp.solve(problem, asp.History(cycle))
    loops[name] = asp.adhesion.adhesion_loop(histories[name].steps)
    found, loop = histories[name].last.adhesion, loops[name]
    criteria = stickiness(problem)
    print(f"{name}: {found.pixels_per_length:.1f} pixels in the cohesive length, resolved: {found.resolved}")
    print(f"  pull-off {loop.pull_off_force / loop.area / 1e3:.0f} kPa, {int(loop.jumped.sum())} jumps")
    print(f"  lost in the cycle {loop.hysteresis / loop.area * 1e3:.2f} mJ/m²")
    print(f"  Pastewka and Robbins' number over its limit {criteria.share_of_limit:.2f}")
    print(f"  work left by Persson and Tosatti {criteria.effective_work * 1e3:.1f} mJ/m²")

# %%
# Force against approach of both, and where the soft pad touches and attracts at its pull-off.
figure, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
for ax, (name, history) in zip(axes, histories.items(), strict=False):
    plot_adhesion_loop(history, ax)
    ax.set_title(name, y=1.18)
soft = "soft, 7 MPa"
plot_adhesion(histories[soft].steps[loops[soft].pull_off], axes[2])

# %%
# The energy of the cycle closes: what the grips put in is lost in jumps.
loop = loops[soft]
print(f"work of the cycle {loop.work[-1]:.3e} J, lost {loop.hysteresis:.3e} J")
print("smallest margin of stability on the way:", np.round(loop.margin.min(), 3))
plt.show()
