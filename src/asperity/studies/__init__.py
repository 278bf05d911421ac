"""Studies: documents run, campaigns of many cases, theories compared with the solution.

``run`` runs a document and gives its ``Outcome``, ``run_study`` and ``open_study`` a ``Campaign``
with its ``CampaignState``; ``compare`` gives the ``Comparison`` of theories with the solution of
one surface.
"""

from ..core.late import late_names

late_names(__name__, __file__)
