"""
Materials of your own
=====================

Keep what you have measured in one file, with its source, and ask for it by name. Here it also shows
a law: materials enter an elastic contact only by the ratio of pressure to modulus.
"""

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# The file: values are text with units, or tables that also say where they come from.
library = Path(mkdtemp()) / "laboratory.toml"
library.write_text("""
[material."our coating"]
aliases = ["coating A"]
youngs_modulus = { value = "210 GPa", source = "nanoindentation, sample 12" }
poisson_ratio = 0.22
hardness = "21 GPa"

[material."our resin"]
youngs_modulus = { value = "3.2 GPa", source = "tensile test" }
poisson_ratio = 0.38
""")
coating, resin = (asp.material(name, library=library) for name in ("coating A", "our resin"))
print(coating, resin, sep="\n")

# %%
# Press the same surface into both, over three decades of load. The areas differ by orders of
# magnitude, and fall on one curve when the pressure is divided by the contact modulus E*.
grid = asp.Grid((128, 128), (50e-9, 50e-9))
surface = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(10e-9, 1e-6), seed=1)
ratios = np.geomspace(1e-4, 1e-2, 6)  # mean pressure / E*
figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
areas = {}
for body, style in ((coating, "o-"), (resin, "x--")):
    modulus = asp.solids.contact_modulus(body)
    path = asp.solve(asp.ContactProblem(surface, body), asp.History([asp.MeanPressure(r * modulus) for r in ratios]))
    areas[body.name] = path.area_fraction_corrected
    axes[0].loglog(path.mean_pressure / 1e6, 100 * path.area_fraction_corrected, style, label=body.name)
    axes[1].loglog(path.mean_pressure / modulus, 100 * path.area_fraction_corrected, style, label=body.name)
axes[0].set(xlabel="mean pressure (MPa)", ylabel="real area (% of nominal)")
axes[1].set(xlabel="mean pressure / E*")
axes[0].legend()
axes[1].legend()
plt.show()
