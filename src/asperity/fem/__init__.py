"""Finite elements: plastic flow beneath indenters and rolling passes on layered solids.

``indentation`` presses an indenter (``Sphere``, ``Cone``, ``Paraboloid``, ``FlatPunch``) into a
solid, ``hertz_pass`` and ``sliding_pass`` move a load over it; meshes, elements and histories have
names of their own.
"""

from ..core.late import late_names

late_names(__name__, __file__)
