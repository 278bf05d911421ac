"""
A part of your own: electrical contact
======================================

A part computes something from every solved contact. It declares its settings and quantities once.
Installed by a package (see the guide *Add an analysis or a physics of your own*) it has its table
in documents, its options, columns and sections.
"""

from typing import Annotated

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp
from asperity.core.quantity import Quantity
from asperity.core.settings import Settings, setting
from asperity.core.values import Number
from asperity.parts.part import Found, Part, Solved

# %%
# Conductance and stiffness of a contact obey the same equation (Barber 2003): between two
# half-spaces of resistivity ρ the conductance is dF/dδ / (E* ρ).


class ElectricSettings(Settings):
    resistivity: Annotated[float, Number("ohm*m", above=0.0)] = setting("17 nohm*m", help="Resistivity of both bodies")


class Electric(Part):
    name = table = "electric"
    title, settings = "Electric current", ElectricSettings
    quantities = (Quantity("conductance", "S", "conductance of the contact"),)

    def compute(self, ask, solved):
        stiffness = solved.result.normal_stiffness * solved.problem.grid.area
        return Found({"conductance": stiffness / (solved.problem.contact_modulus * ask.resistivity)})


def conductance(surface, boundary, control):
    problem = asp.ContactProblem(surface, copper, counter_body=copper, boundary=boundary)
    solved = Solved(problem, control, asp.solve(problem, control))
    return Electric().compute(ElectricSettings(), solved).values["conductance"]


# %%
# Try it before packing it: a ball conducts 2a/ρ through its contact circle (Holm), a rough surface
# as much as it is loaded.
copper, loads = asp.material("copper"), np.geomspace(1e6, 100e6, 6)
ball = asp.generate.sphere(asp.Grid((96, 96), (0.5e-6, 0.5e-6)), radius=1e-3)
spectrum = asp.generate.GaussianAutocorrelation(10e-9, 0.6e-6)
rough = asp.generate.gaussian(asp.Grid((128, 128), (50e-9, 50e-9)), spectrum, seed=1)
holm = 2 * asp.theories.HertzPoint(asp.solids.contact_modulus(copper, copper), 1e-3).at_load(0.5).radius / 17e-9
print(f"ball: {conductance(ball, asp.Free(), asp.Force(0.5)):.1f} S, Holm {holm:.1f} S")
found = np.array([conductance(rough, asp.Periodic(), asp.MeanPressure(float(load))) for load in loads])
ax = plt.subplots(figsize=(6, 4), layout="constrained")[1]
ax.loglog(loads / 1e6, found, "o", label="rough copper on smooth copper")
ax.loglog(loads / 1e6, found[2] * loads / loads[2], "k:", label="proportional to the load")
ax.set(xlabel="mean pressure (MPa)", ylabel="conductance (S)")
ax.legend()
plt.show()
