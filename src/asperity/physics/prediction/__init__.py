"""Contacts of rough surfaces predicted from a table of solved ones."""
