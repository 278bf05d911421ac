"""Contacts that wear: running-in, fretting, break-through of coatings.

``worn`` follows a contact over the sliding distance, ``fretted`` over cycles of a small shift; both
give a ``WearHistory``. Laws are ``archard`` and ``dissipated_energy``, or ``of_layers`` of bodies
whose materials have a wear coefficient; ``Sides`` says which body wears, and which is a track.
"""

from .core.late import late_names

late_names(__name__, __file__)
