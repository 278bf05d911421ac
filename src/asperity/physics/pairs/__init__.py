"""What two physics must settle together."""
