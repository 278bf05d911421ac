"""
Similar contacts have similar stresses
======================================

Stresses below a coated rough surface, below the same with heights and load a tenth, and below one
of twice the size (Peng 2001, figs 3.15 to 3.17): over E₂σ/β they are the same, and the largest lie
in the bands that are predicted without solving.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# Factors on the rms height, on all lengths along the surface and into it, and on the load.
E, sigma, beta, thickness = 100e9, 1e-9, 0.5e-6, 1e-6
cases = {"σ = 1 nm": (1.0, 1.0, 1.0), "σ and p × 0.1": (0.1, 1.0, 0.1), "σ, β, h × 2": (2.0, 2.0, 1.0)}
depths = np.geomspace(0.01, 6.0, 40) * beta


def pressed(ratio, height, length, load):
    """Solved contact and prediction."""
    grid = asp.Grid((256, 256), (40.0 * length * beta / 256,) * 2)
    rough = asp.generate.ExponentialAutocorrelation(height * sigma, length * beta)
    coating = asp.Layer(asp.Elastic(ratio * E, 0.3), length * thickness)
    coated = asp.Layered([coating], base=asp.Elastic(E, 0.3))
    pressure = asp.MeanPressure(4e-6 * load * E)
    surface = asp.generate.gaussian(grid, rough, seed=2)
    return asp.solve(asp.ContactProblem(surface, coated), pressure), asp.predict(rough, coated, pressure, grid=grid)


# %%
# Sections through the highest stress under the stiff coating, in decades, and the largest stress at
# every depth under a stiff and a soft one; bands are the prediction for 19 of 20 surfaces.
figure, axes = plt.subplots(2, 2, figsize=(10, 7), layout="constrained")
curves = {}
for ratio, colour in ((2.0, "C3"), (0.5, "C0")):
    for place, (label, (height, length, load)) in enumerate(cases.items()):
        result, predicted = pressed(ratio, height, length, load)
        unit, z = E * height * sigma / (length * beta), length * depths
        field = asp.stress(result, z, on=asp.stresses.Section(y="max"))
        curves[ratio, label] = asp.stress(result, z).sqrt_J2.max(axis=(1, 2)) / unit
        if ratio == 2.0:
            x, values = field.x / (length * beta), np.log10(field.sqrt_J2 / unit)
            drawn = axes.flat[place].pcolormesh(x, z / (length * beta), values, vmin=-2.0, vmax=0.7)
            axes.flat[place].set(title=label, xlabel="x/β", ylabel="z/β", ylim=(2.0, 0.0))
        axes[1, 1].plot(curves[ratio, label], depths / beta, colour, ls=("-", "--", ":")[place], lw=1 + place)
    axes[1, 1].axvspan(*(end / unit for end in predicted.max_sqrtJ2_layer.band), color=colour, alpha=0.15)
figure.colorbar(drawn, ax=axes[0, 1], label="log₁₀(√J₂ β/(E₂σ))")
axes[1, 1].set(xlabel="largest √J₂ β/(E₂σ)", ylabel="z/β", yscale="log", title="E₁/E₂ = 2 (red) and 0.5 (blue)")
axes[1, 1].invert_yaxis()
plt.show()
