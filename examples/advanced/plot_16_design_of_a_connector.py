"""
The thinnest gold on a connector
================================

Gold is dear, polishing too. Which roughness allows how little gold, if the contact must conduct
and neither gold nor nickel may yield?
"""

import matplotlib.pyplot as plt

import asperity as asp

# %%
# A patch that repeats, both sides plated alike: the thickness of the counter body follows that of
# the body.
gold = "gold{rho=33nohm*m,H=1.8GPa}:2um/nickel{H=3GPa}"
problem = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 48],
        "size": "20 um",
        "seed": 1,
        "spectrum": {"kind": "gaussian", "rms_height": "15 nm", "correlation_length": "2 um"},
    },
    "body": gold,
    "counter_body": gold,
    "control": {"mean_pressure": "2 MPa"},
    "conductance": {"flow": "electrical"},
    "stress": {},
}
plating = {"path": "body.layers.0.thickness", "name": "gold", "low": "0.2 um", "high": "4 um"}
roughness = {"path": "surface.spectrum.rms_height", "name": "roughness", "low": "10 nm", "high": "40 nm"}
wanted = {
    "minimise": "gold",
    "variables": [plating | {"also": {"counter_body.layers.0.thickness": 1.0}}, roughness],
    "constraints": [
        {"quantity": "yield_load_factor", "at_least": 1.0},
        {"quantity": "electrical_conductance", "at_least": "80 S"},
    ],
    "pareto": {"maximise": "roughness", "points": 5},
    "starts": 1,
}
design = asp.optimise({"version": 1, "title": "connector", "problem": problem, "design": wanted})
print(design)

# %%
# The front: less polishing takes more gold.
figure, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.plot([1e9 * point.second for point in design.front], [1e6 * point.objective for point in design.front], "o-")
ax.set(xlabel="rms roughness (nm)", ylabel="thinnest gold (µm)")
plt.show()
