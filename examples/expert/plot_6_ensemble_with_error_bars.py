"""
Many surfaces, one number, and its error bar
============================================

One rough surface is a sample. What belongs to the roughness, and not to the sample, is a mean over
many, and it comes with an error bar.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.stats import t

import asperity as asp

# %%
# Sixteen surfaces of one spectrum, sixteen points on the shortest wavelength, five loads each, on
# one path that starts every load from the pressures of the one before.
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=1.6e-6, shortest_wavelength=0.4e-6
)
body, grid, count = asp.material("silicon"), asp.Grid((256, 256), (25e-9, 25e-9)), 16
loads = 0.1 * asp.solids.contact_modulus(body) * np.geomspace(0.003, 0.3, 5)  # mean pressures in units of E* h'
history = asp.History([asp.MeanPressure(float(load)) for load in loads])


def areas(variant):
    """Real area fraction, (surfaces, loads)."""
    found = []
    for seed in range(count):
        surface = asp.generate.gaussian(grid, spectrum, seed=seed, variant=variant)
        found.append(asp.solve(asp.ContactProblem(surface, body), history).area_fraction_corrected)
    return np.array(found)


# %%
# The mean of n samples with standard deviation s lies within t s/√n of the true mean with 95 %
# confidence (Student's t). Surfaces with random amplitudes scatter in slope as samples of a
# material do; with fixed amplitudes only the phases differ.
figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
slope = 0.1 * asp.solids.contact_modulus(body) / loads  # κ = (A/A₀) E* h'/p
kappa, half_width = {}, {}
for variant in ("random", "fixed"):
    each = areas(variant) * slope
    kappa[variant] = each.mean(axis=0)
    half_width[variant] = t.ppf(0.975, count - 1) * each.std(axis=0, ddof=1) / np.sqrt(count)
    axes[0].errorbar(
        loads / 1e6, kappa[variant], half_width[variant], fmt="o-", capsize=3, label=f"{variant} amplitudes"
    )
    running = np.cumsum(each[:, 2]) / np.arange(1, count + 1)
    axes[1].plot(range(1, count + 1), running, "o-", label=f"{variant} amplitudes")
axes[0].set(xscale="log", xlabel="mean pressure (MPa)", ylabel="κ = (A/A₀) E* h'/p")
axes[0].legend()
axes[1].set(xlabel="number of surfaces", ylabel="mean of κ so far, third load")
axes[1].legend()
plt.show()
