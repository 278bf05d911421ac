"""
How thick and how rough must a coated disk be?
==============================================

A smooth disk sticks to its slider: menisci pull it down. A rough one does not, but its summits
press harder, until the carbon yields. A design finds the roughness and the thickness with the
least pull at which nothing yields under a shock.
"""

import matplotlib.pyplot as plt

import asperity as asp

# %%
# The interface of the preset head-disk on a smaller patch. It rests under 50 kPa, and a shock
# presses with 5 MPa: both are cases of the study.
problem = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [64, 64],
        "size": "6 um",
        "seed": 1,
        "spectrum": {"kind": "exponential", "rms_height": "1 nm", "correlation_length": "0.5 um"},
    },
    "body": "E=150GPa,nu=0.25,H=15GPa:5nm/E=200GPa,nu=0.25,H=9GPa",
    "counter_body": "E=450GPa,nu=0.25,H=23GPa",
    "film": {"surface_tension": "25 mN/m", "thickness": "2 nm", "meniscus_height": "2 nm", "contact_angle": "10 deg"},
    "control": {"mean_pressure": "50 kPa"},
    "stress": {},
}
loads = {"path": "control.mean_pressure", "name": "load", "values": ["50 kPa", "5 MPa"]}
carbon = {"path": "body.layers.0.thickness", "name": "carbon", "low": "1 nm", "high": "20 nm"}
roughness = {"path": "surface.spectrum.rms_height", "name": "roughness", "low": "0.8 nm", "high": "3 nm"}
wanted = {
    "minimise": "relative_meniscus_force",
    "at": {"load": "50 kPa"},
    "variables": [carbon, roughness],
    "constraints": [{"quantity": "yield_load_factor", "at_least": 1.5}],
    "starts": 1,
}
design = asp.optimise({"version": 1, "title": "disk", "problem": problem, "axes": [loads], "design": wanted})
print(design)

# %%
# What a change by a tenth does, from the same answer: roughness decides, the carbon hardly matters.
figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True, layout="constrained")
names = [f"{change.variable} {1e9 * change.value:.3g} nm" for change in design.changes]
pull = [100 * (change.objective / design.objective.value - 1) for change in design.changes]
axes[0].barh(names, pull)
axes[0].set(xlabel="change of the pull of the menisci (%)", ylabel="instead of the design")
axes[1].barh(names, [100 * change.margins[0] for change in design.changes])
axes[1].set(xlabel="margin against yield (%)")
plt.show()
