"""Parts: everything that one physics or analysis says about itself, in one module or folder each."""
