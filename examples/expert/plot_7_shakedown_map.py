"""
Shakedown map: friction against coating thickness
=================================================

A contact that passes again and again may yield in the first passes and respond elastically ever
after: it shakes down. The load up to which it does is above that of first yield, and depends on
friction and coating.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.plots import plot_shakedown_curve, plot_shakedown_map

# %%
# A hard sphere slides on steel with a coating that is twice as stiff and twice as strong.
steel = asp.Elastic(210e9, 0.3, asp.Strength(yield_stress=1e9), name="steel")
coating = asp.Elastic(420e9, 0.3, asp.Strength(yield_stress=2e9), name="coating")
hertz = asp.theories.HertzPoint(asp.solids.contact_modulus(steel), 1e-3).at_peak(1e9)
a, k = float(hertz.radius), 1e9 / np.sqrt(3.0)
sphere = asp.generate.sphere(asp.Grid((40, 40), (0.07 * a, 0.07 * a)), radius=1e-3)
friction, thickness = np.linspace(0.0, 0.6, 7), np.array([0.0, 0.2, 0.5, 1.0])  # in contact radii of the bare steel


def curve(t):
    """Limits with a coating of thickness t a, as factors on the stresses."""
    body = asp.Layered([asp.Layer(coating, t * a)], steel) if t else steel
    problem = asp.ContactProblem(sphere, body, boundary=asp.Free())
    result = asp.solve(problem, asp.Force(float(hertz.load)), keep=asp.Keep(stiffness=False))
    return asp.stresses.shakedown(result, asp.stresses.depths_through(body, (t + 0.9) * a, per_region=6), friction)


# %%
# Without a coating the limit is between two bounds: one with the residual stresses that a pass
# leaves, one that no residual stress can exceed.
curves = [curve(t) for t in thickness]
closed_form = [asp.theories.sphere_shakedown(mu) for mu in friction]
for mu, low, high, found in zip(
    friction, curves[0].limit / k * 1e9, curves[0].bound / k * 1e9, closed_form, strict=True
):
    print(
        f"friction {mu:.1f}: {low:.2f} to {high:.2f} k, in closed form {found.peak_over_k:.2f} to "
        f"{found.bound_over_k:.2f} k"
    )

# %%
# The map multiplies the load that gives bare steel a peak pressure equal to its yield stress. Where
# dots are, the steel below the coating sets the limit.
figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
plot_shakedown_curve(curves[0], axes[0], per=1e9 / k, label="peak pressure / k, bare steel")
found = asp.stresses.shakedown_map(thickness, curves)
plot_shakedown_map(found, axes[1], across="coating thickness / contact radius of bare steel")
plt.show()
