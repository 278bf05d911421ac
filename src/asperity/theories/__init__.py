"""Closed-form theories: they take and return numbers."""
