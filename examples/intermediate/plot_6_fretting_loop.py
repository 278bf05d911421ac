"""
A fretting loop
===============

Two coated rough surfaces are pressed together and moved to and fro by less than they can give
elastically. The rims of the contact spots slip while their middles stick; what slip takes is heat,
and in the end wear.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.physics.friction.fretting import loop_of

# %%
# Both bodies carry the same coating, so that shear does not change the pressure.
spectrum = asp.generate.GaussianAutocorrelation(3e-9, 0.8e-6)
surface = asp.generate.gaussian(asp.Grid((96, 96), (40e-9, 40e-9)), spectrum, seed=4)
coated = asp.Layered([asp.Layer(asp.material("TiN"), 200e-9)], base=asp.material("bearing steel"))
problem = asp.ContactProblem(surface, coated, counter_body=coated, friction=asp.Coulomb(0.3))

# %%
# Press, move to 0.3 nm, back to -0.3 nm and to 0.3 nm again, at constant load.
load = asp.MeanPressure(100e6)
history = asp.solve(problem, asp.History(asp.friction.shear_cycles(load, asp.Shift(0.3e-9), cycles=1, steps=8)))
loop = loop_of(history.steps)
slipping = history.steps[7].stick_slip.slipping.sum() / history.last.contact.sum()
print(f"at the end of the first shift {100 * slipping:.0f} % of the contact slips")
print(f"a cycle takes {loop.cycle_energies[0] * 1e15:.2f} fJ")

# %%
# Masing's rule: the way back is the first shift, twice as large in shift and force. It holds
# wherever shear and pressure do not couple and slip keeps its direction.
back = loop.force[7] - loop.force[7:24:2]
first = 2.0 * np.append(0.0, loop.force[:8])
masing = np.abs(back - first).max() / first.max()
print(f"Masing's rule holds to {100 * masing:.2f} %")

# %%
# The loop, where the surfaces slip, and where the heat goes: to the rims of the spots.
figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
history.plot("loop", axes[0])
history.steps[7].plot("stick_slip", axes[1])
history.plot("dissipation", axes[2])

# %%
# Under one smooth spot the heat grows with the cube of a small amplitude, and in proportion to one
# at which everything slides. A rough contact has spots of all sizes, and lies between.
amplitudes = np.array([0.1e-9, 0.2e-9, 0.4e-9])
heat = []
for amplitude in amplitudes:
    steps = asp.friction.shear_cycles(load, asp.Shift(amplitude), cycles=1, steps=12)
    heat.append(loop_of(asp.solve(problem, asp.History(steps)).steps).cycle_energies[0])
exponents = np.diff(np.log(heat)) / np.diff(np.log(amplitudes))
print("heat grows with the amplitude to the power", ", ".join(f"{power:.2f}" for power in exponents))
plt.show()
