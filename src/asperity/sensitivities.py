"""Sensitivities: derivatives of answers to heights, load, moduli and thicknesses.

``sensitivities`` gives the ``Sensitivities`` of one number of a solved contact with respect to all
its parameters, from one linear solve; ``PressureNorm``, ``StressNorm`` and ``EdgeArea`` take the
place of peak pressure, largest stress and area, which have no derivative on a grid. ``yield_load``
gives the load at which a layer begins to yield, with its derivatives.
"""

from .core.late import late_names

late_names(__name__, __file__)
