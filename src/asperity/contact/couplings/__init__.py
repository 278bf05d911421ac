"""Couplings: one file for each physics that joins the normal contact, and the driver that settles
them together.

A coupling determines what it adds to the load, what it lifts the profile by, how it bounds the
pressure, and how far it is from its own balance (``protocol``). The ``driver`` finds the contact
that agrees with all of them.
"""
