"""Generated surfaces: deterministic shapes and textures, Gaussian and other random roughness.

``gaussian`` takes a spectrum (``SelfAffine``, ``TwoSlopes``, ``TabulatedSpectrum``, ``spectrum_of``
a map, an autocorrelation) and an amplitude (``RmsHeight``, ``RmsSlope``, ``PlateauPSD``);
``translated``, ``rank_ordered``, ``bimodal``, ``two_process`` and ``particles`` are not Gaussian,
``digital_filter`` and ``endless`` need no memory of the whole. Shapes are ``sphere``, ``cylinder``,
``cone``, ``wedge``, ``sinusoid`` and others.
"""

from .core.late import late_names

late_names(__name__, __file__)
