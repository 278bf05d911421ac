"""Theories: closed forms of contact, which take and return numbers.

``theory`` finds one by name, ``evaluate`` asks it along an axis, and ``THEORIES`` and ``FAMILIES``
list all. Single contacts, rough contacts, adhesion, friction, hardness, wet contacts, stresses
below the surface and dynamics have classes of their own.
"""

from ..core.late import late_names

late_names(__name__, __file__)
