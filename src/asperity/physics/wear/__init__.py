"""Contacts that wear: laws of wear, implicit steps of the sliding distance, fretting."""
