"""
Pressure along a line, and menisci, on several coatings
=======================================================

A rough profile and the contact pressures along it on thin and thick, stiff and soft coatings (Peng
2001, fig. 3.19), and the force of menisci against the thickness of the coating (fig. 3.20), solved
and predicted.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

E, sigma, beta = 100e9, 1e-9, 0.5e-6
rough = asp.generate.ExponentialAutocorrelation(sigma, beta)
grid = asp.Grid((256, 256), (20e-6 / 256, 20e-6 / 256))
surface = asp.generate.gaussian(grid, rough, seed=4)
film = asp.LiquidFilm(surface_tension=1e-6, thickness=sigma)  # too weak to press the surfaces together
load = asp.MeanPressure(2e-3 * E * sigma / beta)


def coated(ratio, thickness):
    """The base under a layer."""
    return asp.Layered([asp.Layer(asp.Elastic(ratio * E, 0.3), thickness)], base=asp.Elastic(E, 0.3))


# %%
# Pressures along the line through the highest summit, over E₂σ/β. The stiff coating bears the load
# on fewer summits with more pressure, the soft one on more with less; both the more, the thicker.
figure, axes = plt.subplots(3, 1, figsize=(9, 9), layout="constrained")
x, line = 1e6 * grid.coordinates()[0][:, 0], int(np.unravel_index(np.argmax(surface.heights), grid.shape)[1])
axes[0].plot(x, 1e9 * surface.heights[:, line], color="0.3", lw=0.8)
axes[0].set(xlabel="x (µm)", ylabel="height (nm)", xlim=(0.0, 20.0))
cases = ((1.0, 1e-6), (2.0, 50e-9), (2.0, 1e-6), (0.5, 50e-9), (0.5, 1e-6))
for place, (ratio, thickness) in enumerate(cases):
    pressure = asp.solve(asp.ContactProblem(surface, coated(ratio, thickness)), load).pressure[:, line]
    label = "E₁ = E₂" if ratio == 1.0 else f"E₁/E₂ = {ratio:g}, h = {thickness / beta:g} β"
    axes[1].plot(x, pressure * beta / (E * sigma) - 16.0 * place, lw=0.9)
    axes[1].text(20.2, -16.0 * place, label, va="bottom")
axes[1].set(xlabel="x (µm)", ylabel="p β/(E₂σ), 16 apart", xlim=(0.0, 20.0), yticks=[0.0, 8.0, 16.0])

# %%
# Force of menisci as high as the rms height, over that without a coating: lines are predicted, dots
# solved on this surface.
thicknesses, forces = np.geomspace(0.02, 20.0, 13) * beta, {}
for ratio, colour in ((0.5, "C0"), (2.0, "C3")):
    for name, solids in (("base", [asp.Elastic(E, 0.3)]), ("coated", [coated(ratio, h) for h in thicknesses])):
        pull = (film.suction, film.thickness)
        dry = [asp.solve(asp.ContactProblem(surface, solid), load) for solid in solids]
        solved = [float((one.gap <= sigma).mean()) - one.area_fraction for one in dry]
        predicted = [asp.predict(rough, one, load, grid=grid, pull=pull).pull_pressure.value for one in solids]
        forces[ratio, name] = np.array(solved), np.array(predicted) / film.suction
    solved, predicted = (of / base for of, base in zip(forces[ratio, "coated"], forces[ratio, "base"], strict=True))
    axes[2].semilogx(thicknesses / beta, predicted, colour, label=f"E₁/E₂ = {ratio:g}")
    axes[2].semilogx(thicknesses / beta, solved, "o", color=colour, ms=4)
axes[2].set(xlabel="h/β", ylabel="force of menisci / that without coating")
axes[2].legend()
plt.show()
