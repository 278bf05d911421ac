"""Solvers of the contact problem: numerical methods behind one protocol; new ones stand here."""
