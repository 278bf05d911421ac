"""Rolling: bodies that roll with creepage, smooth or rough."""
