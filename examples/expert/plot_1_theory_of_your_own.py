"""
A theory of your own
====================

Anything with the methods ``at_pressure`` and ``validity`` stands beside the theories of the
catalogue: in tables, figures, and with its limits checked.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.special import erf

import asperity as asp
from asperity.theories.protocol import Limit, prediction

# %%
# A rule of thumb: A/A₀ = erf(√π κ p/(2 E* h')) starts with the slope κ and ends at full contact.
# Persson's theory is the case κ = √(8/π); solutions for rough surfaces start steeper, and κ = 2.2
# is tried here.


class Rule:
    """A/A₀ = erf(√π κ p/(2 E* h')), h' the rms gradient."""

    name, title, citation_keys = "rule of thumb", "Error function with a free slope", ()

    def __init__(self, roughness, E_star, kappa):
        self.scale, self.kappa = E_star * roughness.rms_gradient, kappa

    def at_pressure(self, pressure):
        """Real area at nominal pressures in Pa."""
        p = np.asarray(pressure, dtype=float)
        return prediction(p, area_fraction=erf(0.5 * np.sqrt(np.pi) * self.kappa * p / self.scale))

    def validity(self, prediction):
        """Where the rule is meant to hold."""
        message = "Above, the way to full contact depends on the spectrum."
        return (Limit("area fraction", prediction.area_fraction, 0.0, 0.6, "", message, of=("area_fraction",)),)


# %%
# ``roughness_of`` gives what theories need of a surface.
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=2e-6, shortest_wavelength=0.5e-6
)
surface = asp.generate.gaussian(asp.Grid((256, 256), (60e-9, 60e-9)), spectrum, seed=1, variant="fixed")
body = asp.material("silicon")
mine = Rule(asp.roughness_of(surface), asp.solids.contact_modulus(body), kappa=2.2)
found = asp.compare(surface, body, np.geomspace(200e6, 10e9, 6), theories=[mine, "persson", "bush-gibson-thomas"])

found.plot("kappa")
for curve in found.curves:
    print(f"{curve.name}:", *(f"{100 * value:+.0f} %" for value in found.deviation(curve.name)), "off in area")
plt.show()
