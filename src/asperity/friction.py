"""Friction: laws, stick and slip under a tangential load, tangential stiffness.

The laws are ``Coulomb``, ``TrescaFriction`` and ``FullStick``; ``Shift`` and ``TangentialForce``
load tangentially, ``shear_cycles`` to and fro. ``StickSlip`` and ``GrossSliding`` are what a result
holds; ``tangential_stiffness`` is that of a contact that does not slip, and ``contraction_factor``
tells whether rounds between normal and tangential contact converge. ``shear_displacement`` and
``sheared`` take a prescribed shear traction, ``bonded_contact`` a prescribed displacement.
"""

from .core.late import late_names

late_names(__name__, __file__)
