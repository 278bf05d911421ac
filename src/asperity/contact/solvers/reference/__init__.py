"""Independent methods that check the default solver."""
