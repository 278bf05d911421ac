"""
Creep under an indenter on a polymer coating
============================================

A ball is pressed at once into a polymer coating on glass, held, and taken away. The coating creeps
as far as the glass lets it, and recovers when the load is gone. Half a second, ten seconds and a
minute are steps of one history; how each is divided follows from the error.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# The polymer relaxes to a fifth of its first modulus, with times of 0.1 s and 5 s; its retardation
# is slower. Its bulk modulus does not relax.
polymer = asp.Viscoelastic.prony(0.5e9, ((1.2e9, 0.1), (0.8e9, 5.0)), 0.38, elastic_bulk=True, name="polymer")
glass = asp.Elastic(70e9, 0.22, name="glass")
coated = asp.Layered([asp.Layer(polymer, 2e-6)], glass)
print(polymer)
x = (np.arange(64) - 31.5) * 0.15e-6
ball = asp.Surface(-(x[:, None] ** 2 + x**2) / (2 * 20e-6), 0.15e-6)
load = asp.Force(2e-3)
history = asp.History(
    [
        load,
        asp.Step(load, duration=0.5),
        asp.Step(load, duration=60.0),
        asp.Step(asp.Unloaded(), duration=0.5),
        asp.Step(asp.Unloaded(), duration=60.0),
    ]
)

# %%
# The same ball on a thick piece of the polymer creeps further: no glass holds it.
found = {
    name: asp.solve(asp.ContactProblem(ball, body, boundary=asp.Free()), history)
    for name, body in {"2 µm on glass": coated, "thick polymer": polymer}.items()
}

# %%
# Approach against time, from the records of the steps.
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
for name, result in found.items():
    time = np.concatenate([step.creep.time for step in result.steps])
    approach = np.concatenate([step.creep.column("approach") for step in result.steps])
    axes.plot(time, 1e9 * approach, label=name)
axes.set(xlabel="time (s)", ylabel="approach (nm)", title="Pressed at once, held for a minute, taken away")
axes.legend()

# %%
# Work of the load is stored in springs or turned into heat; nothing else.
for name, result in found.items():
    heat = sum(step.creep.dissipated for step in result.steps)
    growth = result.steps[2].contact_area / result.steps[0].contact_area
    print(f"{name}: area grows by a factor {growth:.2f}, heat {1e12 * heat:.1f} pJ")
plt.show()
