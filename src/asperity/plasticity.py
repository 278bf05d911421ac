"""Plasticity: hardness of the interface, plastic flow of the bodies, hardening.

``HardWall``, ``Hardness`` and ``LayeredHardness`` are laws of the interface, ``plastic_load`` the
``PlasticLoad`` at which a contact is plastic throughout. ``PlasticFlow`` lets bodies flow by ``J2``
with ``LinearHardening``, ``Swift`` or ``Voce``; a result holds each ``PlasticBody`` with its
``PlasticZone``, and a ``PlasticState`` goes on. ``plastic_solid`` and ``plastic_parts`` are flowing
bodies from a ``Strength``.
"""

from .core.late import late_names

late_names(__name__, __file__)
