"""Menisci of single asperities and of rough surfaces."""
