"""Theories of frictional heating: moving sources on one body, layers, and what two bodies share."""
