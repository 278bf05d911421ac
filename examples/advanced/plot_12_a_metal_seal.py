"""
A metal seal: load to tightness
===============================

A turned or lapped metal face is pressed on a flat one, and helium leaks through what is left of the
gap. The leak rate falls by decades with the load, until a closed path of contact lies across: from
that load on nothing leaks. Where the gap is about to close, a few throats decide.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A lapped face of nickel, 0.2 µm rms, on a harder flat; 2 bar of helium against vacuum.
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(2e-7), hurst=0.8, rolloff_wavelength=4e-5, shortest_wavelength=4e-6
)
surface = asp.generate.gaussian(asp.Grid((128, 128), (1e-6, 1e-6)), spectrum, seed=6)
problem = asp.ContactProblem(surface, asp.material("nickel"), law=asp.Hardness(3e9))
helium = asp.sealing.IdealGas(19.6e-6, 192e-9)

# %%
# The load at which the gap closes, and the leak rate on the way to it.
closing = asp.sealing.closing_load(problem, (1e7, 1e9), rounds=8)
print(f"closes at {closing.upper / 1e6:.0f} MPa, with {100 * closing.closed_fraction:.0f} % in contact")
loads = closing.lower * np.array([0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97])
leaks = [asp.sealing.leakage(asp.solve(problem, asp.MeanPressure(p)), helium, 2e5, 0.0) for p in loads]
for load, leak in zip(loads, leaks, strict=True):
    print(
        f"{load / 1e6:4.0f} MPa: {10 * leak.rate:.2e} mbar l/s, {leak.bracket.lower / leak.rate:.2f} to "
        f"{leak.bracket.upper / leak.rate:.2f} times that; {leak.throats.count} throats"
    )

# %%
# Where it flows at four fifths of that load: lines of flow, and the throats that decide.
leak = leaks[5]
flow, throats = leak.flow, leak.throats.places
x = y = 0.5 + np.arange(128)  # µm, middles of the pixels
flux = [0.5 * (part + np.roll(part, 1, axis)) for axis, part in enumerate(flow.flux)]

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2), layout="constrained")
left.errorbar(
    loads / 1e6,
    [10 * leak.rate for leak in leaks],
    10 * np.abs([[leak.rate - leak.bracket.lower, leak.bracket.upper - leak.rate] for leak in leaks]).T,
    fmt="o-",
    markersize=3,
)
left.axvspan(closing.lower / 1e6, closing.upper / 1e6, color="C3", label="the gap closes")
left.set(xlabel="mean contact pressure (MPa)", ylabel="leak rate (mbar l/s)", yscale="log")
left.legend(frameon=False)
shown = right.pcolormesh(x, y, 1e9 * np.where(flow.gap > 0.0, flow.gap, np.nan).T, cmap="Blues")
right.streamplot(x, y, flux[0].T, flux[1].T, color="0.4", linewidth=0.6, arrowsize=0.6, density=1.5)
right.plot([1e6 * t.x for t in throats], [1e6 * t.y for t in throats], "o", mfc="none", mec="C3", label="throats")
right.set(xlabel="x (µm)", ylabel="y (µm)", title=f"gap and flow at {loads[5] / 1e6:.0f} MPa", aspect="equal")
figure.colorbar(shown, ax=right, label="gap (nm)")
plt.show()
