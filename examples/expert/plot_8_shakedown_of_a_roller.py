"""
Does a roller shake down?
=========================

A roller passes over steel again and again. Up to 4 k, the yield stress in shear, plastic flow
ceases after a few passes, because residual stress builds up (Johnson 1962); above it every pass
flows again. Finite elements follow the passes; the theory needs none of them.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity import fem
from asperity.solids.plasticity import J2, LinearHardening
from asperity.theories import cylinder_shakedown

# %%
# Steel of 400 MPa with Prager's back stress, and Hertz's pressure of half-width 0.1 mm below and
# above the limit, on a track of eight half-widths.
steel, half_width = asp.Elastic(200e9, 0.3), 1e-4
law = J2(steel, LinearHardening(400e6), kinematic=20e9)
limit = cylinder_shakedown(friction=0.0).peak_over_k * 400e6 / np.sqrt(3.0)
ends, coarse = (-4.0 * half_width, 4.0 * half_width), fem.Resolution(across=6, growth=1.4, depth=1.2, distance=60.0)
growth, residual = {}, {}
for share in (0.9, 1.15):
    track = fem.cylinder_track(steel, half_width, ends, plasticity=law, resolution=coarse)
    state, before, growth[share] = track.virgin(), 0.0, []
    for _ in range(5):
        state = fem.hertz_pass(track, state, share * limit, half_width, ends, steps=24).state
        strain = track.column(state.plastic.accumulated)[1]
        growth[share].append(float(np.max(strain - before)))
        before = strain
    residual[share] = track.column(track.response(state).stress)
    last = growth[share][-1] / growth[share][0]
    print(
        f"at {share:g} of the limit the fifth pass adds {100.0 * last:.1f} % of the plastic strain that the first added"
    )

# %%
# Plastic strain that each pass adds below the middle of the track, and the residual stress that
# stays.
figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.0), layout="constrained")
for (share, added), colour in zip(growth.items(), ("tab:blue", "tab:red"), strict=True):
    left.semilogy(range(1, 6), np.maximum(added, 1e-9), "o-", color=colour, label=f"{share:g} of the limit")
    depth, stress = residual[share]
    near = depth < 3.0 * half_width
    right.plot(1e3 * depth[near], stress[near, 0] / 1e6, "-", color=colour, label=f"σxx, {share:g}")
    right.plot(1e3 * depth[near], stress[near, 1] / 1e6, "--", color=colour, label=f"σyy, {share:g}")
left.set(xlabel="pass", ylabel="plastic strain added", ylim=(1e-7, 1e-2), xticks=range(1, 6))
right.axhline(0.0, color="black", linewidth=0.5)
right.set(xlabel="depth (mm)", ylabel="residual stress (MPa)")
left.legend(frameon=False)
right.legend(frameon=False)
plt.show()
