"""Frictional heating: flash temperature of sliding contacts, share of the heat between bodies.

``flash_temperature`` gives the ``FrictionalHeating`` of a solved contact: the temperature of the
plane in which heat is made and of both surfaces, the share of the heat of either body, and
estimates beside. ``Motion`` says how the bodies move under the contact, a ``HeatedInterface`` what
films, bonds and bulk temperatures there are.
"""

from .core.late import late_names

late_names(__name__, __file__)
