"""Frictional heat of the contact and its flash temperature."""
