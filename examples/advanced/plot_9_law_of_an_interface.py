"""
The law of an interface from a contact curve
============================================

Joints vibrate on the stiffness of their rough interfaces. Handbooks give a power law of pressure
against approach with constants of measured metal joints; here the constants come from the contact
of a rough surface, elastic and with plastic flow at its summits, on the way up and on the way back.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity import dynamics as dyn

# %%
# A ground surface on steel, loaded up to 30 MPa and unloaded: once elastic, once with the pressure
# limited by the hardness.
grid = asp.Grid((128, 128), (4e-6, 4e-6))
surface = asp.generate.gaussian(grid, asp.generate.GaussianAutocorrelation(0.5e-6, 40e-6), seed=4)
up = np.geomspace(3e6, 3e7, 8)
down = up[-2::-1]
curves = {}
for name, law in (("elastic", asp.plasticity.HardWall()), ("plastic", asp.Hardness(2e9))):
    problem = asp.ContactProblem(surface, asp.material("steel"), law=law)
    history = asp.solve(problem, asp.History([asp.MeanPressure(p) for p in (*up, *down)]))
    curves[name] = np.array([step.approach for step in history.steps])

# %%
# A power law is fitted to each curve, from where the surfaces first touch; after plastic flow they
# separate earlier, and that offset is fitted.
fits = {
    "elastic": dyn.fit_compliance(curves["elastic"][:8], up, offset=0.0),
    "plastic, loading": dyn.fit_compliance(curves["plastic"][:8], up, offset=0.0),
    "plastic, unloading": dyn.fit_compliance(curves["plastic"][7:], np.r_[up[-1], down]),
}
for name, fit in fits.items():
    print(
        f"{name}: power {fit.law.normal_exponent:.2f} ± {fit.exponent_error:.2f}, from {1e6 * fit.offset:.2f} µm, "
        f"pressures within {100.0 * fit.largest_error:.0f} %"
    )

# %%
# A plate of 20 kg on 20 cm² vibrates on this interface. Small vibrations do not make new plastic
# flow: their stiffness is that of unloading, and the slope of the loading curve would give too low
# a frequency.
frequencies = {}
for name, fit in fits.items():
    joint = dyn.NormalOscillator(fit.law, mass=20.0, area=20e-4, load=float(up[-1]) * 20e-4)
    frequencies[name] = joint.natural_frequency / (2.0 * np.pi)
    print(f"{name}: {frequencies[name] / 1e3:.2f} kHz at {up[-1] / 1e6:.0f} MPa")

figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
for name, mark in (("elastic", "o"), ("plastic", "s")):
    axes.plot(1e6 * curves[name], np.r_[up, down] / 1e6, mark, markersize=4, label=name)
for name, fit in fits.items():
    line = np.linspace(fit.offset, fit.approach[-1], 100)
    axes.plot(1e6 * line, fit.fitted(line) / 1e6, linewidth=0.9, label=f"law, {name}")
axes.set(xlabel="approach from first touch (µm)", ylabel="mean pressure (MPa)")
axes.legend(frameon=False)
plt.show()
