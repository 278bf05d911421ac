"""Menisci: liquid films and bridges between surfaces, liquids, wet summits.

A ``LiquidFilm`` on the surfaces makes ``Menisci``, which a result holds; ``Liquid``, ``liquid`` and
``liquids`` are the library of liquids. ``wet_theory`` gives the ``WetTheory`` of the summits of a
map. ``growing_menisci`` gives the ``GrowingMeniscusForce`` of a map in time, with liquid from a
``FilmFeed``, a ``FloodedFeed`` or a ``VapourFeed``.
"""

from .core.late import late_names

late_names(__name__, __file__)
