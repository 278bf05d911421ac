"""Sensitivities: derivatives of answers to heights, load, moduli and thicknesses.

``sensitivities`` gives the ``Sensitivities`` of one number of a solved contact with respect to all
its parameters, from one linear solve; ``PressureNorm`` and ``SmoothArea`` take the place of peak
pressure and area, which have no derivative on a grid.
"""

from .core.late import late_names

late_names(__name__, __file__)
