"""Surfaces: maps of heights, read, prepared and paired.

``read`` gives a ``Surface`` of a file, ``channels`` what it holds. Prepare it by ``levelled``,
``line_corrected``, ``despiked``, ``masked``, ``filled``, ``filtered``, ``tip_limited``,
``cropped``, ``sliced``, ``resampled``, ``tapered`` and ``periodised``; pair two in a
``SurfacePair`` by ``composite``, ``on_common_grid`` and ``turned_over``. ``Grid`` is what heights
stand on, and a ``Rectangle``, ``Ellipse`` or ``Polygon`` a region of a map that is masked.

A tip is a ``SphericalTip``, ``ParabolicTip``, ``ConicalTip`` or ``MeasuredTip``; ``scanned`` gives
its scan of a surface, ``reconstructed`` the surface behind a scan, ``certain_points`` where that is
certain, and ``estimated_tip`` the tip from a scan.
"""

from ..core.late import late_names

late_names(__name__, __file__)
