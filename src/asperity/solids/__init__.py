"""Solids: elastic, layered and graded bodies, the library of materials.

``Elastic``, ``Rigid`` and ``Layered`` bodies of one ``Layer`` after the other (``graded``:
``LinearGrading``, ``PowerGrading``, ``ExponentialGrading``; ``Bonded`` or ``Frictionless``
interfaces; ``RigidBase``), ``Strength`` for what they bear, ``material`` and ``materials`` of the
library, and the ``contact_modulus`` of two bodies.
"""

from ..core.late import late_names

late_names(__name__, __file__)
