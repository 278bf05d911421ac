"""Dynamics: normal compliance, vibration, stick-slip and sliding blocks.

``NormalOscillator`` vibrates on a ``NormalCompliance`` (``fit_compliance``, ``metal_joint``),
``BeltOscillator`` sticks and slips by ``StaticKinetic`` or ``RateState`` friction, ``SlidingBlock``
moves (``move_block``) on rough surfaces; ``sweep_block``, ``bifurcation`` and ``stability_map``
vary its speed, load or stiffness.
"""

from .core.late import late_names

late_names(__name__, __file__)
