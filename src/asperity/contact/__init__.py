"""Contact: problems, loads, boundaries, the solve, its results and advice about them.

``solve`` takes a ``ContactProblem`` and a ``Control`` (``MeanPressure``, ``Force``, ``Approach``,
``MeanGap``, ``Pull``, ``FixedGrips``, ``Unloaded``) or a ``History`` of a ``Step`` after the other
(``ramps``), and gives a ``ContactResult`` or a ``HistoryResult``; ``steps`` gives the results one
by one. A ``Boundary`` (``Free``, ``FreeLine``, ``Periodic``) says what lies outside the grid,
``Flat`` is the other surface, ``Keep`` and ``TimeSteps`` say what is kept and how time is divided.
``advise`` and ``review`` give ``Advice`` before and after a solve.
"""

from ..core.late import late_names

late_names(__name__, __file__)
