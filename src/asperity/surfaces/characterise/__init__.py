"""Numbers that describe a surface: heights and slopes."""
