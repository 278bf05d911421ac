from .physics.menisci.coupling import Menisci
from .physics.menisci.film import LiquidFilm
from .physics.menisci.growth import GrowingMeniscusForce, growing_menisci
from .physics.menisci.summits import WetTheory, wet_theory
from .solids.library import Liquid, liquid, liquids
from .theories.wet.feeds import FilmFeed, FloodedFeed, VapourFeed

__all__ = [
    "FilmFeed",
    "FloodedFeed",
    "GrowingMeniscusForce",
    "Liquid",
    "LiquidFilm",
    "Menisci",
    "VapourFeed",
    "WetTheory",
    "growing_menisci",
    "liquid",
    "liquids",
    "wet_theory",
]
