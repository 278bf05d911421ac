"""
Before and after polishing
==========================

Two maps of one surface, from files. Polishing takes off the summits and leaves the valleys. What
does that change for roughness, contact area and pressure?
"""

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

folder = Path(mkdtemp())

# %%
# **Stand-ins for the scans**, written as matrices of text like those that Gwyddion exports: a
# ground surface, and the same cut 10 nm above its mean plane, with 0.5 nm of fresh roughness on the
# cuts. With files of your own begin at the next cell.
grid = asp.Grid((160, 160), (100e-9, 100e-9))
ground = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(20e-9, 1.2e-6), seed=5, variant="fixed")
fresh = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(0.5e-9, 0.6e-6), seed=6)
cut = ground.with_heights(np.minimum(ground.heights, 10e-9 + fresh.heights), "polished")
for surface, name in ((ground, "before.txt"), (cut, "after.txt")):
    asp.files.save_surface(surface, folder / name)

# %%
# **Compare.** Skewness and peak height tell polishing from a mere reduction of the rms height.
scans = {name: asp.periodised(asp.levelled(asp.read(folder / f"{name}.txt"))) for name in ("before", "after")}
results, parameters = {}, {}
for name, scan in scans.items():
    results[name] = asp.solve(asp.ContactProblem(scan, asp.material("steel")), asp.MeanPressure(20e6))
    parameters[name] = asp.characterise(scan)
    h, f, r = parameters[name].heights, parameters[name].functional, results[name]
    print(
        f"{name}: Sq {1e9 * h.Sq:.1f} nm, Ssk {h.Ssk:.2f}, Spk {1e9 * f.Spk:.1f} nm, area "
        f"{100 * r.area_fraction_corrected:.1f} %, mean real pressure {r.mean_real_pressure / 1e9:.2f} GPa"
    )

figure, axes = plt.subplots(2, 2, figsize=(9, 8), layout="constrained")
for row, name in zip(axes, scans, strict=True):
    scans[name].plot("heights", row[0]).set_title(name)
    results[name].plot("pressure", row[1])
plt.show()
