"""Roughness: every quantity of a surface, one function or record each.

``characterise`` calls them all and gives a ``Characterisation``; ``QUANTITIES`` defines them.
``roughness_of`` gives the ``Roughness`` that theories of rough contact take. Heights, slopes,
spectra, autocovariance, summits, texture and sampling have functions of their own.
"""

from .core.late import late_names

late_names(__name__, __file__)
