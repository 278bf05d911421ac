"""Solvers: methods of the normal contact, prepared operators, rounds of couplings.

``ActiveSet`` is the default, ``ConjugateGradient``, ``NogiKato``, ``SteepestDescent``,
``QuasiNewton``, ``NonNegativeLeastSquares``, ``GradientProjection``, ``DenseActiveSet`` and
``Lemke`` are there to compare; ``run`` runs one on a ``ContactQP``. ``prepare_operator`` prepares
an operator for several solves, ``InterfaceState`` is what a later solve starts from, ``Rounds``
limits the rounds between couplings and ``CouplingCheck`` is what they came to.
"""

from .core.late import late_names

late_names(__name__, __file__)
