from .physics.menisci.coupling import Menisci
from .physics.menisci.film import LiquidFilm
from .physics.menisci.summits import WetTheory, wet_theory
from .solids.library import Liquid, liquid, liquids

__all__ = ["Liquid", "LiquidFilm", "Menisci", "WetTheory", "liquid", "liquids", "wet_theory"]
