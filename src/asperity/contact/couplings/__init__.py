"""THE place for physics that joins the normal contact: one driver, and one file for each coupling.

A coupling determines what it adds to the load, what it lifts the profile by, how it bounds the
pressure, and how far it is from its own balance (``protocol``). The ``driver`` finds the contact
that agrees with all of them.
"""
