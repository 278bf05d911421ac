"""
Yield map: friction against coating thickness
=============================================

Friction moves first yield from below the surface to the surface; a coating moves it to its
interface. A map of the load at first yield shows what is safe, and which part fails.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

# %%
# A cylinder slides on steel with a coating that is twice as stiff and twice as strong (plane
# strain, per metre).
steel = asp.Elastic(210e9, 0.3, asp.Strength(yield_stress=1e9), name="steel")
coating = asp.Elastic(420e9, 0.3, asp.Strength(yield_stress=2e9), name="coating")
hertz = asp.theories.HertzLine(asp.solids.contact_modulus(steel), 1e-3).at_peak(1e9)
a = float(hertz.radius)
cylinder = asp.generate.cylinder(asp.Grid((121, 1), (0.02 * a, 1.0)), radius=1e-3)
friction, thickness = np.linspace(0.0, 0.6, 13), np.array([0.0, 0.1, 0.25, 0.5, 0.8, 1.2])  # in half-widths a


def first_yields(body, deepest):
    """Report of first yield for every friction; stresses are linear in the friction, so that two
    fields give all."""
    problem = asp.ContactProblem(cylinder, body, boundary=asp.FreeLine())
    result = asp.solve(problem, asp.Force(float(hertz.load)), keep=asp.Keep(stiffness=False))
    depths = asp.stresses.depths_through(body, deepest=deepest, per_region=8)
    none, full = (asp.stress(result, depths, friction=mu) for mu in (0.0, 1.0))
    return [asp.first_yield(replace(none, tensor=none.tensor * (1.0 - mu) + full.tensor * mu)) for mu in friction]


# %%
# The load factor multiplies the stresses. On bare steel, with peak pressure and yield stress of 1
# GPa, it is the ratio of the two at first yield, which is known in closed form: 1.79 without
# friction.
reports = [first_yields(asp.Layered([asp.Layer(coating, t * a)], steel), (t + 1.0) * a) for t in thickness]
factor = np.array([[report.load_factor for report in row] for row in reports])
in_steel = np.array([[report.first.region.name == "steel" for report in row] for row in reports])
closed_form = asp.theories.CylinderYield(nu=0.3).at_friction(friction).peak_over_Y
print("bare steel:", *(f"{ours:.2f} ({theirs:.2f})" for ours, theirs in zip(factor[0], closed_form, strict=True)))

# %%
# Where dots are, the steel yields first, near the interface; elsewhere the coating.
figure, ax = plt.subplots(figsize=(7, 5), layout="constrained")
levels = ax.contourf(friction, thickness, factor, levels=np.arange(0.7, 2.2, 0.1), cmap="viridis")
figure.colorbar(levels, label="load factor at first yield (peak pressure 1 GPa)")
mu, t = np.meshgrid(friction, thickness)
ax.plot(mu[in_steel], t[in_steel], "w.", ms=4)
ax.set(xlabel="friction coefficient", ylabel="coating thickness / half-width a of the bare contact")
plt.show()
