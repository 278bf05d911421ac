"""Menisci: liquid films and bridges between surfaces, liquids, wet summits.

A ``LiquidFilm`` on the surfaces makes ``Menisci``, which a result holds; ``Liquid``, ``liquid`` and
``liquids`` are the library of liquids. ``wet_theory`` gives the ``WetTheory`` of the summits of a
map.
"""

from .core.late import late_names

late_names(__name__, __file__)
