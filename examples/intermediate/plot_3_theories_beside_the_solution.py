"""
Theories beside the numerical solution
======================================

How much of a rough surface touches? Greenwood and Williamson, Bush, Gibson and Thomas, Persson and
others answer with closed forms. ``compare`` evaluates every theory that fits the surface, and
solves the contact beside them.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A self-affine surface, five loads. Names of theories may be left out: then all are tried.
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=2e-6, shortest_wavelength=0.5e-6
)
surface = asp.generate.gaussian(asp.Grid((256, 256), (60e-9, 60e-9)), spectrum, seed=1, variant="fixed")
chosen = ["persson", "bush-gibson-thomas", "greenwood-williamson"]
found = asp.compare(surface, asp.material("silicon"), np.geomspace(100e6, 3e9, 5), theories=chosen)

# %%
# Left the areas, right the slope κ = (A/A₀) E* h'/p, with h' the rms gradient. At light load Bush,
# Gibson and Thomas have √(2π) = 2.51, Persson √(8/π) = 1.60; the solution lies between. Pale parts
# are outside a theory's own limits.
figure, axes = plt.subplots(1, 2, figsize=(13, 4.5), layout="constrained")
found.plot("area", axes[0])
found.plot("kappa", axes[1])

kappa = found.kappa(found.numerical.area_fraction_corrected)
print("κ of the solution:", *(f"{value:.2f}" for value in kappa))
for curve in found.curves:
    deviation = found.deviation(curve.name)[np.isfinite(found.deviation(curve.name))]
    print(f"{curve.name}: area off by {100 * deviation[0]:+.0f} % at the lightest load")
    for note in curve.notes:
        print("   ", note)
plt.show()
