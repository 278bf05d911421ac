"""Preparation of measured surfaces: levelling, cropping, resampling, filling and making
periodic."""
