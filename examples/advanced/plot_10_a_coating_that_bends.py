"""
A hard coating on a softer steel
================================

A diamond tip is pressed into a coated steel and taken off. Under the hard coating the steel yields
first; the coating bends into it and is pulled at its lower face within the contact and at its upper
face beside it: there it may crack. Finite elements follow plastic flow in both.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity import fem
from asperity.solids.plasticity import LinearHardening

# %%
# One micrometre of a nitride on steel, a tip of 10 µm radius, 300 nm deep; the load is taken off at
# last.
steel, nitride = asp.Elastic(210e9, 0.3), asp.Elastic(420e9, 0.25)
laws = {"coated": [LinearHardening(8e9, 4e9), LinearHardening(1e9, 2e9)], "bare": [LinearHardening(1e9, 2e9)] * 2}
steps = [*np.linspace(25e-9, 300e-9, 12), fem.Load(0.0)]
found = {}
for name, material in (("coated", nitride), ("bare", steel)):
    body = asp.Layered([asp.Layer(material, 1e-6)], base=steel)
    found[name] = fem.indentation(
        body, fem.Paraboloid(10e-6), steps, plasticity=laws[name], resolution=fem.Resolution(across=20), keep=(11,)
    )
    top = found[name].steps[11]
    print(
        f"{name}: {1e3 * top.load:.1f} mN, mean pressure {top.mean_pressure / 1e9:.2f} GPa, imprint "
        f"{1e9 * found[name].imprint[0]:.0f} nm"
    )

# %%
# Where the coating is pulled, and where the steel has flowed.
fields, coated = found["coated"].fields[11], found["coated"].steps[11]
tension = fields.tension()
print(
    f"tension at the upper face {tension.largest_top[0] / 1e9:.1f} GPa, "
    f"{tension.largest_top[1] / coated.contact_radius:.2f} contact radii from the axis"
)
print(
    f"tension at the lower face {tension.largest_bottom[0] / 1e9:.1f} GPa, "
    f"{tension.largest_bottom[1] / coated.contact_radius:.2f} contact radii from the axis"
)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.0), layout="constrained")
for name, history in found.items():
    left.plot(1e9 * np.r_[0.0, history.approach], 1e3 * np.r_[0.0, history.load], "o-", markersize=3, label=name)
left.set(xlabel="approach (nm)", ylabel="load (mN)")
left.legend(frameon=False)
r, z, cells = fields.rows()
shown = right.pcolormesh(1e6 * r, 1e6 * z, 100.0 * fields.accumulated.mean(axis=1)[cells].T, cmap="magma_r")
right.axhline(1.0, color="black", linewidth=0.8)
right.set(xlim=(0.0, 5.0), ylim=(5.0, 0.0), xlabel="r (µm)", ylabel="z (µm)", title="plastic strain under load")
figure.colorbar(shown, ax=right, label="%")
plt.show()
