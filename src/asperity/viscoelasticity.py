"""Viscoelasticity: materials that relax, oscillating and sliding contacts, hysteretic friction.

``Viscoelastic`` is the material (times shift by ``Arrhenius`` or ``WilliamsLandelFerry``);
``fitted_solid`` fits it to moduli as a ``MasterCurve``, ``fitted_relaxation`` and ``fitted_creep``
to a ``TimeCurve``. ``Creeping`` is what a result holds. ``harmonic`` gives the
``HarmonicResponse`` of a contact, ``slide`` its ``SteadySliding`` and ``slide_in_time`` its
``TransientSliding``.
"""

from .core.late import late_names

late_names(__name__, __file__)
