"""
A pin on a coated disk
======================

A ball of alumina slides on a disk with titanium nitride on steel, 5 N on a track of 60 mm. Every
point of the track is in contact once a turn only, every point of the ball all the time. After how
many metres is the coating worn through, and what do track and ball look like then?
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.wear import Sides, WearSteps, archard, worn

# %%
# The ball has the roughness of a polished one. Wear coefficients are those that one would measure:
# of the ball, of 300 nm of nitride, and of the steel below it, in m²/N (1e-15 is 1e-6 mm³/(N m)).
grid = asp.Grid((96, 96), (2.5e-6, 2.5e-6))
waves = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(20e-9), hurst=0.8, rolloff_wavelength=60e-6, shortest_wavelength=12e-6
)
heights = asp.generate.sphere(grid, radius=3e-3).heights + asp.generate.gaussian(grid, waves, seed=3).heights
disk = asp.Layered([asp.Layer(asp.material("TiN"), 300e-9)], asp.material("bearing steel"))
pin = asp.Surface(heights, 2.5e-6)
problem = asp.ContactProblem(pin, asp.material("alumina"), counter_body=disk, boundary=asp.Free())
sides = Sides(body=archard(1e-17), counter=archard(1e-14, layers=[(300e-9, 1e-15)]), counter_track=60e-3)

# %%
# The track widens as it deepens: its coating lasts longer than at the width of the first contact.
history = worn(problem, asp.Force(5.0), [10.0, 100.0, 300.0, 600.0], sides, steps=WearSteps(tolerance=0.05))
first = history.kept[0][1]
width = np.count_nonzero(first.pressure.any(axis=0)) * grid.spacing[1]
even = 300e-9 * 60e-3 * width / (1e-15 * 5.0)
print(f"coating gone after {history.breakthrough:.0f} m; worn evenly over the first width after {even:.0f} m")
print(f"pressure {first.max_pressure / 1e9:.2f} GPa at first, {history.last.max_pressure / 1e9:.2f} GPa at the end")
print(f"{history.error:.1%} of the worn volume may be misplaced by the steps")

# %%
# Across the track its depth and the mean of the pressure along it, after each distance. Where the
# coating is gone the steel below wears ten times as fast, and the nitride beside it takes the load.
figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
y = (np.arange(96) + 0.5) * 2.5
for distance, contact in history.kept:
    axes[0].plot(y, -1e9 * contact.problem.counter_surface.heights[48], label=f"{distance:g} m")
    axes[1].plot(y, contact.pressure.mean(axis=0) / 1e6)
axes[0].set(xlabel="y (µm)", ylabel="depth of the track (nm)")
axes[0].invert_yaxis()
axes[0].legend()
axes[1].set(xlabel="y (µm)", ylabel="mean pressure along the track (MPa)")
axes[2].semilogy(history.course, history["max_pressure"] / 1e9)
axes[2].axvline(history.breakthrough, color="0.5", linestyle="--")
axes[2].set(xlabel="distance (m)", ylabel="maximum pressure (GPa)")
plt.show()
