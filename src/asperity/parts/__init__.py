"""Parts: everything that one physics or analysis declares, in one module each."""
