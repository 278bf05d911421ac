"""
Rubber that slides on rough ground
==================================

Every bump that passes a point of rubber presses it in and lets it go again. What the rubber does
not give back is friction. It is largest where bumps pass about as fast as the rubber relaxes, and
the contact area falls with speed, for the rubber stiffens.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# The ground is rough and rigid, the rubber flat: only roughness that moves over the rubber deforms
# it again and again.
rubber = asp.Viscoelastic.prony(3e6, ((3e6, 1e-1), (10e6, 1e-2), (30e6, 1e-3)), 0.5, name="rubber")
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(10e-6), hurst=0.8, rolloff_wavelength=1e-3, shortest_wavelength=1.2e-4
)
ground = asp.generate.gaussian(asp.Grid((96, 96), (2e-5, 2e-5)), spectrum, seed=2)
problem = asp.ContactProblem(ground, asp.Rigid(), counter_body=rubber)
load = asp.MeanPressure(0.2e6)

# %%
# Steady sliding at speeds over five decades. Friction comes from the loss in all waves, and again
# from the slope of the ground.
speeds = np.geomspace(1e-4, 10.0, 11)
found = [asp.slide(problem, load, float(speed)) for speed in speeds]
friction = np.array([each.friction for each in found])
area = np.array([each.normal.area_fraction for each in found])
for speed, each in zip(speeds, found, strict=True):
    print(
        f"{speed:8.2g} m/s: friction {each.friction:.3f}, area {each.normal.area_fraction:.3f}, heat "
        f"{each.heat:.3g} W/m²"
    )

# %%
# Persson's theory beside it, from the power spectrum that the ground was made of.
q = np.geomspace(2 * np.pi / 1.92e-3, 2 * np.pi / 1.2e-4, 60)
waves = asp.theories.IsotropicSpectrum(q, np.asarray(spectrum.psd(q)))
modulus = rubber.contact_relaxation.complex_modulus
theory = [asp.theories.rubber_friction(waves, modulus, speed=v, pressure=0.2e6, reduction=0.5) for v in speeds]
figure, (top, bottom) = plt.subplots(2, 1, figsize=(7, 6), sharex=True, layout="constrained")
top.semilogx(speeds, friction, "o-", label="solved")
top.semilogx(speeds, [each.friction for each in theory], "--", label="Persson")
top.legend()
top.set(xlabel="speed (m/s)", ylabel="coefficient of friction", title="Hysteretic friction and contact area")
bottom.semilogx(speeds, area, "s-", label="solved")
bottom.semilogx(speeds, [each.area_fraction for each in theory], "--", label="Persson")
bottom.legend()
bottom.set(xlabel="speed (m/s)", ylabel="contact area / nominal area")

# %%
# Pressure is larger in front of the bumps: the map at the speed of the largest friction.
fastest = found[int(friction.argmax())]
figure, axes = plt.subplots(figsize=(5, 4.2), layout="constrained")
picture = axes.imshow(1e-6 * fastest.normal.pressure.T, origin="lower", extent=(0, 1.92, 0, 1.92), cmap="magma")
axes.set(xlabel="x (mm), direction of the ground", ylabel="y (mm)", title=f"Pressure at {fastest.speed:.2g} m/s")
figure.colorbar(picture, label="pressure (MPa)")
plt.show()
