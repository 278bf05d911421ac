"""Conductance: current and heat through a solved contact.

``conductance`` gives the ``ContactConductance`` of a result for current or heat, with a
``ConductingInterface`` for a film in contact and a gap that conducts (``radiation``,
``temperature_jump``); its ``spots`` are ``SpotFlows``. ``conductance_bounds`` come from the forces
of a load path alone.
"""

from .core.late import late_names

late_names(__name__, __file__)
