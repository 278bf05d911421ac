"""The parts of the problem document, each a frozen model that checks its own values."""
