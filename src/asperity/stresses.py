"""Stresses: fields below the surface, loads, criteria, first yield, shakedown.

``stress`` and ``stress_planes`` give the ``StressField`` of a result or of a ``LoadedBody``
(``PointLoad``, ``LineLoad``, ``PatchLoad``, ``Tractions``, ``Sliding``, ``ShearTraction``) in a
region (``DepthProfile``, ``Section``, ``Everywhere``, ``depths_through``). ``VonMises``, ``Tresca``
and ``MaxPrincipal`` are criteria; ``first_yield``, ``load_at_yield``, ``fracture_indicators``,
``shakedown`` and ``shakedown_map`` judge by them.
"""

from .core.late import late_names

late_names(__name__, __file__)
