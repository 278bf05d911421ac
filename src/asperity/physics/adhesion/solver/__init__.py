"""Adhesive contact beside a hard wall: majorise-minimise on the normal solver, then Newton with a
trust region."""
