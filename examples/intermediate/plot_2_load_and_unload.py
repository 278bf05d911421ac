"""
Load, unload, load again
========================

Where the pressure reaches the hardness the surface flows and stays indented. The first loading is
therefore not the same as the second.
"""

import matplotlib.pyplot as plt

import asperity as asp

# %%
# A rough copper surface under a rigid flat. ``History.ramps`` makes the loads from turning point to
# turning point.
spectrum = asp.generate.GaussianAutocorrelation(20e-9, 2e-6)
surface = asp.generate.gaussian(asp.Grid((96, 96), (100e-9, 100e-9)), spectrum, seed=2)
problem = asp.ContactProblem(surface, asp.Elastic(130e9, 0.34, asp.Strength(hardness=1.2e9)), law=asp.Hardness(1.2e9))
path = asp.solve(problem, asp.History.ramps(asp.MeanPressure, [100e6, 0.0, 150e6, 0.0], steps=8))

# %%
# On the way back the contact is elastic, and the area at a given load is larger than on the way up.
# Reloading follows the unloading curve up to the largest load so far, where the first loading goes
# on as if nothing had happened.
path.plot("load_loop")
path.plot("area_loop")
path.steps[7].plot("indentation")

# %%
# The work put in is stored elastically or spent on flow. While unloading no work is spent.
balance = path.energies
print("plastic work of the steps (fJ):", *(f"{1e15 * step.plastic_work:.3g}" for step in path.steps))
print(f"work {1e12 * balance.external_work[-1]:.3f} pJ, of which plastic {1e12 * balance.plastic_work[-1]:.3f} pJ; "
      f"balance closes within {100 * balance.relative_error:.2f} %")  # fmt: skip
plt.show()
