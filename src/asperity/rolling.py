"""Rolling: creepage, creep forces and their curve, of smooth and of rough bodies.

``roll`` and ``roll_rough`` take a ``Creepage`` and give a ``RollingContact`` or a ``RoughRolling``;
``creep_curve`` gives the ``CreepCurve`` of many.
"""

from .core.late import late_names

late_names(__name__, __file__)
