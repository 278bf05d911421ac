"""Compliance of the contact of two bodies."""

from __future__ import annotations

from ..elastic import Body, contact_modulus
from .halfspace import HalfSpace
from .protocol import Compliance


def contact_compliance(body: Body, counter_body: Body) -> Compliance:
    """Sum of the normal compliances of ``body`` and ``counter_body`` (Peng 2001, eq. 3.32).

    Two homogeneous half-spaces act as one of contact modulus E*.

    Raises
    ------
    InputError
        If both bodies are rigid.
    """
    return HalfSpace(contact_modulus(body, counter_body))
