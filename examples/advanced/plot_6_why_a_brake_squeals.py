"""
Why a brake squeals
===================

A block is pressed on a moving surface. Its coefficient of friction is one constant, the same at
rest and in motion. Yet above a certain friction the block begins to vibrate on the stiffness of the
rough interface by itself, and the friction that its spring feels becomes smaller than that between
the surfaces.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity import dynamics as dyn
from asperity.physics.dynamics.figures import plot_frame, plot_stability

# %%
# The stiffness of the interface comes from the contact of the rough surface: a power law is fitted
# to pressure against approach.
grid = asp.Grid((128, 128), (4e-6, 4e-6))
surface = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(4e-6, 80e-6), seed=2)
problem = asp.ContactProblem(surface, asp.material("cast iron"))
pressures = np.geomspace(1e5, 8e5, 8)
curve = asp.solve(problem, asp.History([asp.MeanPressure(p) for p in pressures]))
fit = dyn.fit_compliance([step.approach for step in curve.steps], pressures, offset=0.0)
print(f"pressure grows with the power {fit.law.normal_exponent:.2f} ± {fit.exponent_error:.2f} of the approach")

# %%
# A pad of 1 kg on 20 cm² under 0.3 MPa, with 1 % of damping. Growth rates of small motion over
# friction and height: the pad flutters where its normal motion and its tilt have one frequency,
# which friction brings together.
area, load = 20e-4, 600.0
law = fit.law.with_friction(0.45).damped(0.01, 1.0 / area, load / area)
pad = dyn.SlidingBlock(law, 1.0, 0.05, 0.04, 0.015, load, stiffness=2e7, speed=2e-3, damping=100.0)
print(f"steady sliding is {pad.stability.kind}: it squeals above a friction of {pad.critical_friction():.2f}")
stable = dyn.stability_map(pad, {"friction": np.linspace(0.05, 0.8, 40), "height": np.linspace(0.005, 0.03, 40)})

# %%
# In time: the vibration grows from nothing until the base leaves the surface for part of each
# period.
start = (0.995 * pad.steady.displacement, pad.rest, 0.0, 0.0, 0.0, 0.0)
squeal = dyn.move_block(pad, 40e-3, start=start)
numbers = squeal.numbers(20e-3)
print(f"it squeals at {numbers['vibration_frequency'] / 1e3:.1f} kHz")
print(f"at 2 mm/s apparent friction {numbers['apparent_friction']:.3f} instead of {pad.friction:.3f}")

# %%
# On a belt that is faster than the vibration of the base nothing of this is felt: the base never
# catches up with it.
swift = dyn.move_block(replace(pad, speed=0.02), 40e-3, start=start).numbers(20e-3)
print(f"at 20 mm/s {swift['apparent_friction']:.3f}")
figure, axes = plt.subplots(1, 3, figsize=(14, 3.8), layout="constrained")
plot_stability(stable, axes[0], labels=("friction coefficient", "height (m)"))
axes[1].plot(1e3 * squeal.motion.time, squeal.motion["normal_force"] / load, linewidth=0.4)
axes[1].set(xlabel="time (ms)", ylabel="normal force / load")
plot_frame(squeal, squeal.motion.time.size - 5, axes[2])
plt.show()
