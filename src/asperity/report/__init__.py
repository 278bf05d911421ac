"""Reports: self-contained pages of results, surfaces and comparisons, and animations.

``write_report`` is for outcomes and results, ``write_roughness_report`` for surfaces,
``write_profile_report`` for line scans, ``write_scans_report`` for many scans of one surface,
``write_comparison_report`` for theories beside a solution; ``save_plastic_animation`` moves through
the steps of plastic flow, ``save_wear_animation`` along the way of a contact that wears.
"""

from ..core.late import late_names

late_names(__name__, __file__)
